#include "mixed_body.h"

#include <array>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "tissu/mesh/box.h"

namespace tissu::bench {
namespace {

constexpr std::array<int, 3> kCells = {23, 8, 8};
constexpr double kSize = 0.01;  // of a grid cell [m]

using Cut = std::vector<std::vector<std::size_t>>;

/// How a grid cell is filled by cells of one type. Corners are those of a hexahedron; 8 is its middle.
struct Filling {
  std::string element;
  Cut cut;
};

/// Grid cells whose number along x is below `end`.
struct Segment {
  int end;
  std::vector<Filling> fillings;
};

/// The last faces of pyramids towards the tetrahedra are cut as those are, along the corners 1 and 6.
const std::vector<Segment> kSegments = {
    {15, {{"hexahedron", {{0, 1, 2, 3, 4, 5, 6, 7}}}}},
    {19, {{"wedge", {{0, 1, 2, 4, 5, 6}, {0, 2, 3, 4, 6, 7}}}}},
    {20,
     {{"pyramid", {{0, 1, 2, 3, 8}, {4, 7, 6, 5, 8}, {0, 4, 5, 1, 8}, {3, 2, 6, 7, 8}, {0, 3, 7, 4, 8}}},
      {"tetra", {{1, 5, 6, 8}, {1, 6, 2, 8}}}}},
    {23, {{"tetra", {{0, 1, 2, 6}, {0, 2, 3, 6}, {0, 3, 7, 6}, {0, 7, 4, 6}, {0, 4, 5, 6}, {0, 5, 1, 6}}}}}};

const std::vector<Filling>& fillings_at(int x) {
  for (const Segment& segment : kSegments) {
    if (x < segment.end) return segment.fillings;
  }
  return kSegments.back().fillings;
}

/// Node numbers of the cells of each type; middles that a cut asks for are added to the positions.
std::map<std::string, std::vector<std::int32_t>> cells_of(Mesh& grid) {
  std::map<std::string, std::vector<std::int32_t>> cells;
  for (std::int32_t c = 0; c < grid.cell_count(); ++c) {
    const auto corners = grid.blocks.front().cell(c);
    std::int32_t middle = -1;
    for (const Filling& filling : fillings_at(c % kCells[0])) {
      for (const auto& cell : filling.cut) {
        for (const std::size_t local : cell) {
          if (local == 8 && middle < 0) {
            Vec3 x = Vec3::Zero();
            for (const std::int32_t corner : corners) x += grid.node(corner) / 8.0;
            middle = grid.node_count();
            grid.positions.insert(grid.positions.end(), x.data(), x.data() + 3);
          }
          cells[filling.element].push_back(local == 8 ? middle : corners[local]);
        }
      }
    }
  }
  return cells;
}

}  // namespace

WorldDescription mixed_body(int threads) {
  Mesh grid = box_mesh(Vec3::Zero(), kSize * Vec3(kCells[0], kCells[1], kCells[2]), kCells, Split::none);
  FixedNodes held;
  held.body = "mixed";
  for (std::int32_t i = 0; i < grid.node_count(); ++i) {
    if (grid.node(i).x() < 0.5 * kSize) held.nodes.push_back(i);
  }
  BodyDescription body;
  body.name = "mixed";
  for (auto& [element, nodes] : cells_of(grid)) {
    ElasticBlock block;
    block.element = element;
    block.law = "stvk";
    block.cells = std::move(nodes);
    block.parameters = {{"young", {5e3}}, {"poisson", {0.45}}};
    block.density = {1000.0};
    body.elastic.push_back(std::move(block));
  }
  body.positions = std::move(grid.positions);
  WorldDescription description;
  description.bodies.push_back(std::move(body));
  description.fixed.push_back(std::move(held));
  description.gravity = Vec3(0.0, -9.81, 0.0);
  description.threads = threads;
  return description;
}

}  // namespace tissu::bench
