#include <algorithm>

#include "tissu/base/error.h"
#include "tissu/edit/topology.h"

namespace tissu {
namespace {

[[noreturn]] void refuse(const char* what) {
  throw ParameterError(std::string("the material of cut cells has ") + what +
                       "; restore it as it was taken.");
}

/// Refuses what are not the beginnings of lists that fill `total` entries.
void check_first(const std::vector<std::int32_t>& first, std::size_t lists, std::size_t total) {
  const bool fits = first.size() == lists + 1 && first.front() == 0 && std::ranges::is_sorted(first) &&
                    first.back() == static_cast<std::int32_t>(total);
  if (!fits) refuse("lists that do not fit together");
}

void check_vertices(const std::vector<std::int32_t>& vertices, std::int32_t nodes, std::int32_t riders) {
  if (std::ranges::any_of(vertices, [&](std::int32_t v) { return v >= nodes || v < -riders; }))
    refuse("vertices that are not there");
}

/// Of tetrahedra, triangles and pieces of lines, four for each.
std::vector<std::int32_t> corners_of(const std::vector<std::int32_t>& vertices) {
  std::vector<std::int32_t> corners;
  corners.reserve(vertices.size());
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    if (i % 4 < 2 || vertices[i] != kNoVertex) corners.push_back(vertices[i]);
  }
  return corners;
}

}  // namespace

PackedMaterial pack(const Material& material) {
  PackedMaterial packed;
  for (const Rider& rider : material.riders) {
    for (std::size_t k = 0; k < 4; ++k) {
      const bool used = static_cast<std::int32_t>(k) < rider.count;
      packed.rider_nodes.push_back(used ? rider.node[k] : -1);
      packed.rider_weights.push_back(used ? rider.weight[k] : 0.0);
    }
  }
  packed.first.push_back(0);
  for (const auto& [host, tetrahedra] : material.cells) {
    packed.hosts.push_back(host);
    for (const MaterialTetra& tetra : tetrahedra) {
      packed.vertices.insert(packed.vertices.end(), tetra.vertices.begin(), tetra.vertices.end());
      packed.cut.push_back(tetra.cut);
    }
    packed.first.push_back(static_cast<std::int32_t>(packed.cut.size()));
  }
  packed.first_of_incision.push_back(0);
  for (const Incision& incision : material.incisions) {
    packed.incisions.push_back(incision.number);
    packed.on_incision.insert(packed.on_incision.end(), incision.vertices.begin(), incision.vertices.end());
    for (const std::int32_t vertex : incision.vertices)
      packed.at_front.push_back(std::ranges::binary_search(incision.front, vertex) ? 1 : 0);
    packed.first_of_incision.push_back(static_cast<std::int32_t>(packed.on_incision.size()));
  }
  return packed;
}

Material unpack(const PackedMaterial& packed, std::int32_t nodes) {
  const std::size_t riders = packed.rider_nodes.size() / 4;
  if (packed.rider_nodes.size() != 4 * riders || packed.rider_weights.size() != 4 * riders ||
      packed.vertices.size() != 4 * packed.cut.size() ||
      packed.at_front.size() != packed.on_incision.size()) {
    refuse("lists that do not fit together");
  }
  check_first(packed.first, packed.hosts.size(), packed.cut.size());
  check_first(packed.first_of_incision, packed.incisions.size(), packed.on_incision.size());
  check_vertices(corners_of(packed.vertices), nodes, static_cast<std::int32_t>(riders));
  check_vertices(packed.on_incision, nodes, static_cast<std::int32_t>(riders));
  Material material;
  for (std::size_t r = 0; r < riders; ++r) {
    Rider rider;
    for (std::size_t k = 0; k < 4; ++k) {
      const std::int32_t node = packed.rider_nodes[4 * r + k];
      if (node >= nodes) refuse("riders on nodes that are not there");
      if (node < 0) break;
      rider.node[k] = node;
      rider.weight[k] = packed.rider_weights[4 * r + k];
      ++rider.count;
    }
    material.riders.push_back(rider);
  }
  for (std::size_t i = 0; i < packed.hosts.size(); ++i) {
    std::vector<MaterialTetra>& list = material.cells[packed.hosts[i]];
    for (auto t = static_cast<std::size_t>(packed.first[i]);
         t < static_cast<std::size_t>(packed.first[i + 1]); ++t) {
      MaterialTetra tetra;
      std::copy_n(packed.vertices.begin() + static_cast<std::ptrdiff_t>(4 * t), 4, tetra.vertices.begin());
      tetra.cut = static_cast<std::uint8_t>(packed.cut[t]);
      list.push_back(tetra);
    }
  }
  for (std::size_t i = 0; i < packed.incisions.size(); ++i) {
    Incision incision{packed.incisions[i]};
    for (auto v = static_cast<std::size_t>(packed.first_of_incision[i]);
         v < static_cast<std::size_t>(packed.first_of_incision[i + 1]); ++v) {
      incision.vertices.push_back(packed.on_incision[v]);
      if (packed.at_front[v] != 0) incision.front.push_back(packed.on_incision[v]);
    }
    material.incisions.push_back(std::move(incision));
  }
  return material;
}

}  // namespace tissu
