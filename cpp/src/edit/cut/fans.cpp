#include "edit/cut/fans.h"

#include <algorithm>

#include "tissu/base/index.h"
#include "tissu/base/sort_unique.h"

namespace tissu {

Fans::Fans(const Patch& patch, const Fragments& fragments, const std::vector<std::int32_t>& parted)
    : patch_(patch),
      fragments_(fragments),
      vertices_(patch.tetrahedra.size()),
      riders_(at(patch.new_riders)) {
  for (std::size_t t = 0; t < vertices_.size(); ++t) {
    const Patch::Tetra& tetra = patch.tetrahedra[t];
    vertices_[t].fill(kNoVertex);
    for (std::size_t i = 0; i < tetra.corners(); ++i)
      vertices_[t][i] = patch.vertex(tetra.vertices[i]).number;
  }
  for (std::int32_t v = 0; v < static_cast<std::int32_t>(patch.vertices.size()); ++v) {
    number_vertex(v, std::ranges::binary_search(parted, v));
  }
}

std::vector<std::int32_t> Fans::numbers(std::int32_t vertex) const {
  std::vector<std::int32_t> found;
  for (const std::int32_t t : patch_.tetrahedra_at(vertex)) {
    const auto& before = patch_.tetra(t).vertices;
    const auto corner = static_cast<std::size_t>(std::ranges::find(before, vertex) - before.begin());
    found.push_back(vertices_[at(t)][corner]);
  }
  sort_unique(found);
  return found;
}

std::int32_t Fans::cell_number(std::int32_t tetra) const {
  return patch_.cell(patch_.tetra(tetra).cell).number;
}

/// The fans in the order of their lowest cells; tetrahedra of each likewise. Those of hosts that stay as they
/// are or go are left out.
std::vector<std::vector<std::int32_t>> Fans::fans_at(std::int32_t vertex) const {
  std::vector<std::int32_t> left;
  for (const std::int32_t t : patch_.tetrahedra_at(vertex)) {
    if (fragments_.of(t) >= 0) left.push_back(t);
  }
  std::ranges::sort(left, [&](std::int32_t a, std::int32_t b) {
    return std::pair(cell_number(a), a) < std::pair(cell_number(b), b);
  });
  std::vector<std::vector<std::int32_t>> fans;
  while (!left.empty()) {
    std::vector<std::int32_t>& fan = fans.emplace_back(1, left.front());
    left.erase(left.begin());
    const auto join = [&](std::int32_t other) {
      const auto place = std::ranges::find(left, other);
      if (other < 0 || place == left.end()) return;
      fan.push_back(other);
      left.erase(place);
    };
    for (std::size_t next = 0; next < fan.size(); ++next) {
      const std::int32_t piece = fan[next];
      const Patch::Tetra& tetra = patch_.tetra(piece);
      for (std::size_t f = 0; f < 4; ++f) {
        if (tetra.vertices[f] == vertex) continue;  // the face opposite does not have the vertex
        join(fragments_.across()[at(piece)][f]);
      }
      for (const auto& [one, other] : fragments_.carriers().at(piece)) join(other);
    }
  }
  return fans;
}

void Fans::number_vertex(std::int32_t vertex, bool parted) {
  taken_.clear();
  const Patch::Vertex& own = patch_.vertex(vertex);
  if (-1 - own.number >= patch_.old_riders) riders_[at(-1 - own.number - patch_.old_riders)] = own.rider;
  if (!parted) {
    std::vector<std::int32_t> fan;
    for (const std::int32_t t : patch_.tetrahedra_at(vertex)) {
      if (fragments_.of(t) >= 0) fan.push_back(t);
    }
    if (!fan.empty()) number_fan(vertex, fan, true);
    return;
  }
  bool first = true;
  for (const std::vector<std::int32_t>& fan : fans_at(vertex)) {
    number_fan(vertex, fan, first);
    first = false;
  }
}

void Fans::number_fan(std::int32_t vertex, const std::vector<std::int32_t>& fan, bool first) {
  const Patch::Vertex& own = patch_.vertex(vertex);
  const std::int32_t fragment = fragments_.of(fan.front());
  Rider rider = own.rider;
  for (std::size_t i = 0; i < at(rider.count); ++i)
    rider.node[i] = fragments_.becomes(fragment, rider.node[i]);
  std::int32_t number = own.number;
  if (number >= 0) {
    number = rider.node[0];
    if (std::ranges::find(taken_, number) != taken_.end()) number = add_rider(rider);
    taken_.push_back(number);
  } else if (!first) {
    number = add_rider(rider);
  } else if (-1 - number >= patch_.old_riders) {
    riders_[at(-1 - number - patch_.old_riders)] = rider;
  } else if (rider.node != own.rider.node) {
    changed_.emplace_back(-1 - number, rider);
  }
  for (const std::int32_t t : fan) {
    const auto& before = patch_.tetra(t).vertices;
    vertices_[at(t)][static_cast<std::size_t>(std::ranges::find(before, vertex) - before.begin())] = number;
  }
}

std::int32_t Fans::add_rider(const Rider& rider) {
  riders_.push_back(rider);
  return -(patch_.old_riders + static_cast<std::int32_t>(riders_.size()));
}

}  // namespace tissu
