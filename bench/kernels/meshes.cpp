#include "meshes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <random>
#include <string>

#include "tissu/element/generated/all.h"
#include "tissu/mesh/box.h"

namespace tissu::bench {
namespace {

constexpr double kStep = 0.01;   // [m]
constexpr double kJitter = 0.1;  // of a step

using Cut = std::vector<std::vector<std::size_t>>;

/// How one grid cell, with corners numbered as a hexahedron, is filled. The middle of the cell is node 8.
const std::map<std::string_view, Cut> kCuts = {
    {"line", {{0, 1}}},
    {"triangle", {{0, 1, 2}, {0, 2, 3}}},
    {"quad", {{0, 1, 2, 3}}},
    {"tetra", {{0, 1, 2, 6}, {0, 2, 3, 6}, {0, 3, 7, 6}, {0, 7, 4, 6}, {0, 4, 5, 6}, {0, 5, 1, 6}}},
    {"hexahedron", {{0, 1, 2, 3, 4, 5, 6, 7}}},
    {"wedge", {{0, 1, 2, 4, 5, 6}, {0, 2, 3, 4, 6, 7}}},
    {"pyramid",
     {{0, 1, 2, 3, 8}, {4, 7, 6, 5, 8}, {0, 4, 5, 1, 8}, {3, 2, 6, 7, 8}, {0, 3, 7, 4, 8}, {1, 5, 6, 2, 8}}},
};

/// The family of an element is the part of its name before the number of its nodes.
std::string_view family_of(std::string_view element) {
  return element.substr(0, element.find_first_of("0123456789"));
}

/// A grid of cells that hold about `count` elements; a membrane and lines have one layer, whose upper nodes
/// are left out.
std::array<int, 3> grid_for(int dimension, int count, std::size_t each) {
  const double cells = static_cast<double>(count) / static_cast<double>(each);
  const int n = std::max(1, static_cast<int>(std::lround(std::pow(cells, dimension == 2 ? 0.5 : 1.0 / 3.0))));
  return {n, n, dimension == 2 ? 1 : n};
}

void jitter(const Mesh& grid, std::array<int, 3> cells, std::vector<double>& positions) {
  std::mt19937 engine(1);
  for (std::size_t i = 0; i < positions.size(); ++i) {
    const double amount = 2.0 * static_cast<double>(engine()) / 4294967296.0 - 1.0;
    const Vec3 x = grid.node(static_cast<std::int32_t>(i / 3));
    bool inside = true;
    for (int axis = 0; axis < (cells[2] == 1 ? 2 : 3); ++axis) {
      const double end = cells[static_cast<std::size_t>(axis)] * kStep;
      inside = inside && x[axis] > 0.5 * kStep && x[axis] < end - 0.5 * kStep;
    }
    if (inside) positions[i] += kJitter * kStep * amount;
  }
}

/// The corners of every element, and their positions; nodes that no element uses are not kept.
ElementMesh linear_mesh(const Cut& cut, int dimension, int count) {
  const std::array<int, 3> cells = grid_for(dimension, count, cut.size());
  Mesh grid = box_mesh(Vec3::Zero(), kStep * Vec3(cells[0], cells[1], cells[2]), cells, Split::none);
  std::vector<double> positions = grid.positions;
  jitter(grid, cells, positions);
  ElementMesh mesh;
  mesh.nodes_per_cell = static_cast<int>(cut.front().size());
  std::map<std::int32_t, std::int32_t> number;
  for (std::int32_t c = 0; c < grid.cell_count(); ++c) {
    const auto corners = grid.blocks.front().cell(c);
    Vec3 middle = Vec3::Zero();
    for (const std::int32_t corner : corners) middle += block(ConstReals(positions), corner) / 8.0;
    for (const auto& element : cut) {
      for (const std::size_t local : element) {
        const std::int32_t name = local == 8 ? grid.node_count() + c : corners[local];
        const Vec3 x = local == 8 ? middle : Vec3(block(ConstReals(positions), name));
        const auto [at, is_new] = number.try_emplace(name, mesh.node_count());
        if (is_new) mesh.positions.insert(mesh.positions.end(), x.data(), x.data() + 3);
        mesh.cells.push_back(at->second);
      }
    }
  }
  return mesh;
}

/// The value at every node of E of the shape functions of the corners.
template <class E, class Corners>
std::vector<std::vector<double>> corner_values() {
  std::vector<std::vector<double>> values;
  for (const auto& xi : E::nodes) {
    const auto N = Corners::values(xi);
    values.emplace_back(N.begin(), N.end());
  }
  return values;
}

/// The same elements with all their nodes: each is a mean of corners, and the same one for the same corners.
ElementMesh with_nodes(const ElementMesh& linear, const std::vector<std::vector<double>>& weights) {
  ElementMesh mesh;
  mesh.nodes_per_cell = static_cast<int>(weights.size());
  std::map<std::vector<std::int32_t>, std::int32_t> number;
  for (std::size_t first = 0; first < linear.cells.size();
       first += static_cast<std::size_t>(linear.nodes_per_cell)) {
    for (const auto& weight : weights) {
      std::vector<std::int32_t> key;
      Vec3 x = Vec3::Zero();
      for (std::size_t a = 0; a < weight.size(); ++a) {
        if (std::abs(weight[a]) < 1e-12) continue;
        key.push_back(linear.cells[first + a]);
        x += weight[a] * block(ConstReals(linear.positions), key.back());
      }
      std::ranges::sort(key);
      const auto [at, is_new] = number.try_emplace(key, mesh.node_count());
      if (is_new) mesh.positions.insert(mesh.positions.end(), x.data(), x.data() + 3);
      mesh.cells.push_back(at->second);
    }
  }
  return mesh;
}

}  // namespace

ElementMesh element_mesh(std::string_view element, int count) {
  ElementMesh mesh;
  for_each_element([&]<class E>(E) {
    if (E::kName != element) return;
    for_each_element([&]<class Corners>(Corners) {
      if (Corners::kName != family_of(element)) return;
      if constexpr (Corners::kDimension == E::kDimension) {
        mesh = linear_mesh(kCuts.at(Corners::kName), E::kDimension, count);
        if constexpr (E::kNodes != Corners::kNodes) mesh = with_nodes(mesh, corner_values<E, Corners>());
      }
    });
  });
  return mesh;
}

std::vector<double> deformed(const ElementMesh& mesh) {
  std::vector<double> x = mesh.positions;
  for (std::int32_t i = 0; i < mesh.node_count(); ++i) {
    const auto X = block(ConstReals(mesh.positions), i);
    block(Reals(x), i) +=
        Vec3(0.04 * X.x() + 0.03 * X.y(), 0.02 * X.z() - 0.1 * X.x() * X.x(), -0.02 * X.z());
  }
  return x;
}

}  // namespace tissu::bench
