#include "kept_momenta.h"

#include <algorithm>

#include "tissu/base/index.h"

namespace tissu {
namespace {

std::vector<ConnectedPart> parts_of_body(const World& world, std::string_view name) {
  const Body& body = world.body(name);
  std::vector<ConnectedPart> parts = parts_of(world);
  std::erase_if(parts, [&](const ConnectedPart& part) {
    const std::int32_t node = part.nodes.front() - body.first_node;
    return node < 0 || node >= body.node_count;
  });
  return parts;
}

}  // namespace

KeptMomenta::KeptMomenta(const World& world, const State& state, std::string_view body)
    : body_(body), part_of_(at(world.blocks()), -1) {
  for (const ConnectedPart& part : parts_of_body(world, body)) {
    for (const std::int32_t node : part.nodes) part_of_[at(node)] = static_cast<std::int32_t>(before_.size());
    before_.push_back(totals(world, state, part.nodes));
  }
}

std::vector<KeptMomenta::Lack> KeptMomenta::lacks(const World& world, const State& state,
                                                  const RowsBorn& born,
                                                  std::span<const std::int32_t> around) const {
  std::vector<std::int32_t> part_of = part_of_;
  std::vector<char> is_divided(before_.size(), 0);
  const auto take = [&](std::int32_t row, std::int32_t from) {
    if (part_of[at(row)] < 0) part_of[at(row)] = part_of[at(from)];
    if (part_of[at(row)] >= 0) is_divided[at(part_of[at(row)])] = 1;
  };
  for (const RowBlend& blend : born.blends) take(blend.to, blend.from[0]);
  for (const RowCopy& copy : born.copies) take(copy.to, copy.from);
  std::vector<Lack> lacks(before_.size());
  for (const std::int32_t row : around) {
    if (part_of[at(row)] >= 0) lacks[at(part_of[at(row)])].rows.push_back(row);
  }
  for (std::size_t p = 0; p < before_.size(); ++p) {
    lacks[p].momentum = before_[p].momentum;
    lacks[p].angular_momentum = before_[p].angular_momentum;
    if (!lacks[p].rows.empty()) is_divided[p] = 0;
  }
  for (const ConnectedPart& part : parts_of_body(world, body_)) {
    const auto known =
        std::ranges::find_if(part.nodes, [&](std::int32_t node) { return part_of[at(node)] >= 0; });
    if (known == part.nodes.end()) continue;
    const std::size_t p = at(part_of[at(*known)]);
    const BodyTotals now = totals(world, state, part.nodes);
    lacks[p].momentum -= now.momentum;
    lacks[p].angular_momentum -= now.angular_momentum;
    if (is_divided[p] != 0) lacks[p].rows.insert(lacks[p].rows.end(), part.nodes.begin(), part.nodes.end());
  }
  return lacks;
}

}  // namespace tissu
