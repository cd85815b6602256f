#include "tissu/cell/chunk_edit.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include "chunk_lanes.h"
#include "tissu/base/index.h"
#include "tissu/base/sort_unique.h"

namespace tissu {
namespace {

constexpr std::int32_t kLanes = ElementOrder::kLanes;

/// Lanes that nothing reads.
void leave(std::int32_t begin, std::int32_t end, ElementOrder& order) {
  std::fill(order.real.begin() + begin * kLanes, order.real.begin() + end * kLanes, std::uint8_t{0});
  std::fill(order.element.begin() + begin * kLanes, order.element.begin() + end * kLanes, 0);
}

}  // namespace

ChunkEdit::ChunkEdit(std::shared_ptr<const ChunkPlan> plan, const ElementOrder& order,
                     const PlannedCells& cells)
    : plan_(std::move(plan)),
      size_(cells.size),
      by_colour_(plan_->colour.size()),
      parts_(plan_->colour.size()),
      standing_(plan_->colour.size()) {
  std::iota(by_colour_.begin(), by_colour_.end(), 0);
  std::ranges::stable_sort(by_colour_, {}, [&](std::int32_t c) { return plan_->colour[at(c)]; });
  for (const Chunk& chunk : order.chunks) {
    const std::int32_t origin = cells.origins[at(order.element[at(chunk.begin * kLanes)])];
    parts_[at(chunk_of(origin))].push_back({chunk.begin, chunk.end - chunk.begin, chunk.end - chunk.begin,
                                            static_cast<std::size_t>(chunk.nodes - order.nodes.data()),
                                            chunk.node_count, static_cast<std::size_t>(chunk.node_count)});
  }
  for (std::vector<Part>& parts : parts_) std::ranges::sort(parts, {}, &Part::begin);
  for (std::size_t e = 0; e < cells.numbers.size(); ++e) {
    const std::int32_t origin = cells.origins[e];
    standing_[at(chunk_of(origin))].push_back({plan_->place[at(origin)], cells.numbers[e]});
  }
  for (std::vector<Standing>& standing : standing_) std::ranges::sort(standing);
}

void ChunkEdit::add(std::int32_t origin, std::int32_t number) {
  std::vector<Standing>& standing = standing_[at(chunk_of(origin))];
  const Standing one{plan_->place[at(origin)], number};
  standing.insert(std::ranges::lower_bound(standing, one), one);
  touch(origin);
}

void ChunkEdit::take(std::int32_t origin, std::int32_t number) {
  std::vector<Standing>& standing = standing_[at(chunk_of(origin))];
  standing.erase(std::ranges::lower_bound(standing, Standing{plan_->place[at(origin)], number}));
  touch(origin);
}

void ChunkEdit::move(std::int32_t origin, std::int32_t from, std::int32_t to, ElementOrder& order) const {
  for (const Part& part : parts_[at(chunk_of(origin))]) {
    const auto begin = order.element.begin() + part.begin * kLanes;
    std::replace(begin, begin + part.groups * kLanes, from, to);
  }
}

ChunkEdit::Seat ChunkEdit::seat(std::int32_t origin, std::int32_t lane) const {
  const std::int32_t chunk = chunk_of(origin);
  const std::vector<Part>& parts = parts_[at(chunk)];
  const auto part = std::ranges::find_if(parts, [&](const Part& one) {
    return lane >= one.begin * kLanes && lane < (one.begin + one.groups) * kLanes;
  });
  const std::int64_t rank =
      (std::int64_t{chunk} << 32) + ((part - parts.begin()) << 16) + lane - part->begin * kLanes;
  return {{part->begin, part->begin + part->groups}, rank};
}

std::vector<ElementOrder::Run> ChunkEdit::lay(std::span<const std::int32_t> place,
                                              std::span<const std::int32_t> cells, ElementOrder& order) {
  sort_unique(touched_);
  std::vector<ElementOrder::Run> laid;
  for (const std::int32_t chunk : touched_) {
    lay_chunk(chunk, place, cells, order);
    for (const Part& part : parts_[at(chunk)]) laid.push_back({part.begin, part.begin + part.groups});
  }
  touched_.clear();
  list_chunks(order);
  return laid;
}

/// Puts a part that has grown behind all others, where it has room for all that a chunk may hold.
void ChunkEdit::fit(Part& part, std::int32_t groups, ElementOrder& order) const {
  leave(part.begin, part.begin + part.capacity, order);
  if (groups > part.capacity) {
    part.begin = order.groups();
    part.capacity = ElementOrder::chunk_size(size_) / kLanes;
    order.element.resize(at((part.begin + part.capacity) * kLanes), 0);
    order.real.resize(order.element.size(), 0);
    order.places.resize(order.element.size() * at(size_));
  }
  part.groups = groups;
}

void ChunkEdit::lay_chunk(std::int32_t chunk, std::span<const std::int32_t> place,
                          std::span<const std::int32_t> cells, ElementOrder& order) {
  const std::vector<Standing>& standing = standing_[at(chunk)];
  std::vector<std::int32_t> elements;
  elements.reserve(standing.size());
  for (const Standing& one : standing) elements.push_back(place[at(one.number)]);
  const std::int32_t count = chunk_parts(elements.size(), size_);
  std::vector<Part>& parts = parts_[at(chunk)];
  for (std::size_t p = at(count); p < parts.size(); ++p)
    leave(parts[p].begin, parts[p].begin + parts[p].capacity, order);
  parts.resize(at(count));
  for (std::int32_t p = 0; p < count; ++p) {
    const std::size_t first = first_of_part(elements.size(), p, count);
    const auto own = std::span(elements).subspan(first, first_of_part(elements.size(), p + 1, count) - first);
    Part& part = parts[at(p)];
    fit(part, groups_for(own.size()), order);
    lay_lanes(own, part.begin, order);
    const std::vector<std::int32_t> nodes =
        lay_places(cells, size_, part.begin, part.begin + part.groups, order);
    part.nodes = static_cast<std::int32_t>(nodes.size());
    if (nodes.size() > part.node_room) {
      part.first_node = order.nodes.size();
      part.node_room = nodes.size() + nodes.size() / 4;
      order.nodes.resize(order.nodes.size() + part.node_room);
    }
    std::ranges::copy(nodes, order.nodes.begin() + static_cast<std::ptrdiff_t>(part.first_node));
  }
}

/// Chunks by colour, then the further parts of chunks, each alone; and all groups along the curve.
void ChunkEdit::list_chunks(ElementOrder& order) const {
  const auto chunk = [&](const Part& part) {
    return Chunk{part.begin, part.begin + part.groups, order.nodes.data() + part.first_node, part.nodes};
  };
  order.chunks.clear();
  order.colour_begin.assign(1, 0);
  const auto close = [&] {
    const auto count = static_cast<std::int32_t>(order.chunks.size());
    if (count > order.colour_begin.back()) order.colour_begin.push_back(count);
  };
  for (std::size_t i = 0; i < by_colour_.size(); ++i) {
    if (i > 0 && plan_->colour[at(by_colour_[i])] != plan_->colour[at(by_colour_[i - 1])]) close();
    const std::vector<Part>& parts = parts_[at(by_colour_[i])];
    if (!parts.empty()) order.chunks.push_back(chunk(parts.front()));
  }
  close();
  order.runs.clear();
  for (const std::vector<Part>& parts : parts_) {
    for (std::size_t p = 0; p < parts.size(); ++p) {
      order.runs.push_back({parts[p].begin, parts[p].begin + parts[p].groups});
      if (p == 0) continue;
      order.chunks.push_back(chunk(parts[p]));
      close();
    }
  }
}

}  // namespace tissu
