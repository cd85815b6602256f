#include "contact/grid.h"

#include <algorithm>
#include <limits>

#include "contact/tree_pairs.h"

namespace tissu {
namespace {

constexpr double kSide = 1.5;          ///< of a cell, in mean sides of a box
constexpr double kMost = 1048576.0;    ///< cells along an axis
constexpr std::int32_t kFewCells = 8;  ///< a box in more is a large one

/// fn(cell, at_first) for each cell of a range.
template <class Range, class Function>
void for_each_cell(const Range& range, Function&& fn) {
  for (std::int32_t x = range.first[0]; x <= range.last[0]; ++x) {
    for (std::int32_t y = range.first[1]; y <= range.last[1]; ++y) {
      for (std::int32_t z = range.first[2]; z <= range.last[2]; ++z) {
        const auto cell = static_cast<std::uint64_t>(x) << 42U | static_cast<std::uint64_t>(y) << 21U |
                          static_cast<std::uint64_t>(z);
        const std::uint32_t at_first = (x == range.first[0] ? 1U : 0U) | (y == range.first[1] ? 2U : 0U) |
                                       (z == range.first[2] ? 4U : 0U);
        fn(cell, at_first);
      }
    }
  }
}

double longest_side(const Box& box) {
  double longest = 0.0;
  for (std::size_t k = 0; k < 3; ++k) {
    longest = std::max(longest, static_cast<double>(box.high[k]) - static_cast<double>(box.low[k]));
  }
  return longest;
}

}  // namespace

GridBroadPhase::GridBroadPhase(const SearchPlan& plan) : meetings_(plan), slot_bits_(1) {
  const std::size_t n = meetings_.searched().size();
  while (std::size_t{1} << static_cast<unsigned>(slot_bits_) < 4 * n) ++slot_bits_;
  small_.reserve(n);
  large_.reserve(n);
  ranges_.reserve(n);
  end_.resize((std::size_t{1} << static_cast<unsigned>(slot_bits_)) + 1);
  entries_.reserve(kFewCells * n);
  tree_.reserve(n);
}

void GridBroadPhase::find(std::span<const Box> boxes, std::vector<BoxPair>& pairs) {
  meetings_.check(boxes);
  found_.clear();
  if (!meetings_.searched().empty()) {
    sort_into_cells(boxes);
    add_pairs_in_cells(boxes);
    add_pairs_of_large(boxes);
  }
  sort_.sort(found_.all(), meetings_.primitive_count(), pairs);
}

GridBroadPhase::Cells GridBroadPhase::cells(std::span<const Box> boxes) const {
  Box all = boxes[static_cast<std::size_t>(meetings_.searched().front())];
  double sides = 0.0;
  for (const std::int32_t p : meetings_.searched()) {
    const Box& box = boxes[static_cast<std::size_t>(p)];
    all.add(box);
    sides += longest_side(box);
  }
  const double mean = sides / static_cast<double>(meetings_.searched().size());
  const double side = std::max(kSide * mean, longest_side(all) / kMost);
  Cells cells{{}, side > 0.0 ? 1.0 / side : 0.0};
  for (std::size_t k = 0; k < 3; ++k) cells.origin[k] = static_cast<double>(all.low[k]);
  return cells;
}

/// Ascends with the box's sides, so that boxes that overlap share a cell whatever the round-off.
GridBroadPhase::Range GridBroadPhase::range(const Box& box, const Cells& cells) {
  Range range{};
  for (std::size_t k = 0; k < 3; ++k) {
    const auto number = [&](float x) {
      return static_cast<std::int32_t>((static_cast<double>(x) - cells.origin[k]) * cells.per_length);
    };
    range.first[k] = number(box.low[k]);
    range.last[k] = number(box.high[k]);
  }
  return range;
}

/// Multiplied by 2^64 over the golden ratio, whose highest bits mix all of the cell's (Knuth, 6.4).
std::size_t GridBroadPhase::slot(std::uint64_t cell) const {
  return static_cast<std::size_t>((cell * 0x9E3779B97F4A7C15U) >> static_cast<unsigned>(64 - slot_bits_));
}

/// A counting sort.
void GridBroadPhase::sort_into_cells(std::span<const Box> boxes) {
  const Cells grid = cells(boxes);
  small_.clear();
  large_.clear();
  ranges_.clear();
  std::ranges::fill(end_, 0U);
  for (const std::int32_t p : meetings_.searched()) {
    const Range of = range(boxes[static_cast<std::size_t>(p)], grid);
    std::int64_t count = 1;
    for (std::size_t k = 0; k < 3; ++k) count *= of.last[k] - of.first[k] + 1;
    if (count > kFewCells) {
      large_.push_back(p);
      continue;
    }
    small_.push_back(p);
    ranges_.push_back(of);
    for_each_cell(of, [&](std::uint64_t cell, std::uint32_t) { ++end_[slot(cell) + 1]; });
  }
  for (std::size_t s = 0; s + 1 < end_.size(); ++s) end_[s + 1] += end_[s];
  entries_.resize(std::max<std::size_t>(entries_.size(), end_.back()));
  for (std::size_t i = 0; i < small_.size(); ++i) enter(ranges_[i], small_[i]);
}

void GridBroadPhase::enter(const Range& range, std::int32_t primitive) {
  for_each_cell(range, [&](std::uint64_t cell, std::uint32_t at_first) {
    entries_[end_[slot(cell)]++] = {cell, primitive, at_first};
  });
}

/// Two boxes may share several cells. Their pair is made in the one where, along each axis, one of them
/// begins.
void GridBroadPhase::add_pairs_in_cells(std::span<const Box> boxes) {
  std::size_t begin = 0;
  for (std::size_t s = 0; s + 1 < end_.size(); begin = end_[s++]) {
    const std::span<const Entry> slot(entries_.data() + begin, end_[s] - begin);
    for (std::size_t i = 0; i + 1 < slot.size(); ++i) {
      const Entry& one = slot[i];
      const Box& box = boxes[static_cast<std::size_t>(one.primitive)];
      for (const Entry& other : slot.subspan(i + 1)) {
        if (one.cell != other.cell || (one.at_first | other.at_first) != 7U) continue;
        if (!box.overlaps(boxes[static_cast<std::size_t>(other.primitive)])) continue;
        if (meetings_.meet(one.primitive, other.primitive)) found_.add(one.primitive, other.primitive);
      }
    }
  }
}

void GridBroadPhase::add_pairs_of_large(std::span<const Box> boxes) {
  if (large_.empty()) return;
  tree_.build(boxes, large_);
  const std::size_t first = found_.count();
  add_pairs_within(tree_, found_);
  for (const std::int32_t p : small_) {
    add_pairs_with(tree_, boxes[static_cast<std::size_t>(p)], p, found_);
  }
  found_.keep_if(first, [&](std::int32_t a, std::int32_t b) { return meetings_.meet(a, b); });
}

std::size_t GridBroadPhase::bytes() const {
  return meetings_.bytes() + (small_.capacity() + large_.capacity()) * sizeof(std::int32_t) +
         ranges_.capacity() * sizeof(Range) + end_.capacity() * sizeof(std::uint32_t) +
         entries_.capacity() * sizeof(Entry) + tree_.bytes() + found_.bytes() + sort_.bytes();
}

}  // namespace tissu
