#pragma once

/// A corotational block for every element, rotation, tangent and instruction set, on straight and distorted
/// cells.

#include <gtest/gtest.h>

#include <ostream>
#include <string>

#include "../../force/verbs.h"
#include "../../world/sample_worlds.h"
#include "tissu/model/corotational/corotational.h"
#include "tissu/model/fem/elastic.h"
#include "tissu/model/models.h"

namespace tissu::test {

struct CorotationalCase {
  std::string element;
  std::string rotation;
  std::string tangent;
  double distorted;  ///< up to how much a node of the unit cells is moved
  Isa isa;
};

inline std::string text(const CorotationalCase& c) {
  return c.element + "_" + c.rotation + "_" + c.tangent + (c.distorted > 0.0 ? "_distorted_" : "_") +
         std::string(name(c.isa));
}
inline void PrintTo(const CorotationalCase& c, std::ostream* out) { *out << text(c); }
inline std::string case_name(const testing::TestParamInfo<CorotationalCase>& info) {
  return text(info.param);
}

/// All of them for the set that runs here by itself; for the others distorted cells with the exact tangent.
inline std::vector<CorotationalCase> corotational_cases() {
  std::vector<CorotationalCase> cases;
  for (const Isa isa : available_isas()) {
    for (const char* element : {"tetra", "hexahedron", "wedge", "pyramid"}) {
      for (const char* rotation : {"small", "frame", "polar"}) {
        for (const char* tangent : {"approximate", "exact"}) {
          for (const double distorted : {0.0, 0.1}) {
            const CorotationalCase made{element, rotation, tangent, distorted, isa};
            if (isa == choose_isa() || (distorted > 0.0 && made.tangent == "exact")) cases.push_back(made);
          }
        }
      }
    }
  }
  return cases;
}
/// Those with this rotation or tangent, or without.
inline std::vector<CorotationalCase> corotational_cases(std::string_view word, bool with) {
  std::vector<CorotationalCase> cases = corotational_cases();
  std::erase_if(cases,
                [&](const CorotationalCase& c) { return (c.rotation == word || c.tangent == word) != with; });
  return cases;
}

/// Nodes of a cell of each element in a grid cell with corners numbered as a hexahedron, 8 its centre.
inline std::vector<std::vector<int>> pieces(const std::string& element) {
  if (element == "wedge") return {{0, 1, 2, 4, 5, 6}, {0, 2, 3, 4, 6, 7}};
  return {{0, 1, 2, 3, 8}, {4, 7, 6, 5, 8}, {0, 4, 5, 1, 8},
          {3, 2, 6, 7, 8}, {0, 3, 7, 4, 8}, {1, 5, 6, 2, 8}};
}

/// A box of unit cells, all of one element.
struct CellBox {
  std::vector<double> positions;
  std::vector<std::int32_t> cells;
};

inline CellBox cell_box(const std::string& element, std::array<int, 3> grid, double distorted) {
  const Split split = element == "tetra" ? Split::six : Split::none;
  const Mesh mesh = box_mesh(Vec3(0.3, -0.2, 0.1), Vec3(grid[0], grid[1], grid[2]), grid, split);
  CellBox box{mesh.positions, mesh.blocks.front().nodes};
  if (element == "wedge" || element == "pyramid") {
    box.cells.clear();
    const std::vector<std::int32_t>& corners = mesh.blocks.front().nodes;
    for (std::size_t first = 0; first < corners.size(); first += 8) {
      std::array<std::int32_t, 9> nodes{};
      for (std::size_t k = 0; k < 8; ++k) nodes[k] = corners[first + k];
      if (element == "pyramid") {
        nodes[8] = static_cast<std::int32_t>(box.positions.size() / 3);
        const Vec3 centre = 0.5 * (mesh.node(nodes[0]) + mesh.node(nodes[6]));
        box.positions.insert(box.positions.end(), centre.data(), centre.data() + 3);
      }
      for (const std::vector<int>& piece : pieces(element)) {
        for (const int k : piece) box.cells.push_back(nodes[static_cast<std::size_t>(k)]);
      }
    }
  }
  Random random(7);
  for (double& x : box.positions) x += random.number(distorted);
  return box;
}

inline ElasticBlock corotational_block(const CellBox& box, const std::string& element) {
  ElasticBlock block;
  block.body = "body";
  block.element = element;
  block.law = "hooke";
  block.cells = box.cells;
  block.parameters = {{"young", {3.0}}, {"poisson", {0.3}}};
  block.density = {2.0};
  block.model = CorotationalOptions{};
  return block;
}

class CorotationalTest : public testing::TestWithParam<CorotationalCase> {
 protected:
  CellBox box_ = cell_box(GetParam().element, {3, 2, 1}, GetParam().distorted);
  Random random_{11};
  const Mat3 turn_ = Eigen::AngleAxisd(2.9, Vec3(0.48, -0.6, 0.64)).toRotationMatrix();

  bool has(std::string_view word) const { return GetParam().rotation == word || GetParam().tangent == word; }
  /// The force is the gradient of the energy, and the tangent its derivative, whatever `tangent` says.
  bool conserves() const { return has("small") || has("polar") || has("exact"); }
  ElasticBlock block() const {
    ElasticBlock made = corotational_block(box_, GetParam().element);
    made.model = CorotationalOptions{.rotation = GetParam().rotation, .tangent = GetParam().tangent};
    return made;
  }
  std::size_t cells() const {
    return box_.cells.size() / static_cast<std::size_t>(find_element(GetParam().element)->nodes);
  }
  std::int32_t nodes() const { return static_cast<std::int32_t>(box_.positions.size() / 3); }
  ElasticBlock varied_block() const {
    ElasticBlock varied = block();
    Random random(12);
    for (auto* values : {&varied.parameters["young"], &varied.parameters["poisson"]}) values->clear();
    for (std::size_t i = 0; i < cells(); ++i) {
      varied.parameters["young"].push_back(3.0 + random.number());
      varied.parameters["poisson"].push_back(0.2 + random.number(0.2));
    }
    return varied;
  }
  Corotational made(ElasticBlock block, int threads = 1) const {
    return {std::move(block), box_.positions, GetParam().isa, Threads(threads)};
  }
  State rest() const {
    State state;
    state.positions = box_.positions;
    state.velocities.assign(box_.positions.size(), 0.0);
    return state;
  }
  State affine(const Mat3& F, const Vec3& shift = Vec3::Zero()) const {
    State state = rest();
    for (std::int32_t i = 0; i < nodes(); ++i) {
      tissu::block(Reals(state.positions), i) = F * tissu::block(ConstReals(box_.positions), i) + shift;
    }
    return state;
  }
  /// Nodes moved by up to `amount` of a cell's edge, then the body turned (but for `small`).
  State any_state(double amount = 0.15) {
    State state = moved(rest(), random_.numbers(box_.positions.size(), amount), 1.0);
    if (has("small")) return state;
    for (std::int32_t i = 0; i < nodes(); ++i) {
      const Vec3 x = turn_ * tissu::block(ConstReals(state.positions), i);
      tissu::block(Reals(state.positions), i) = x;
    }
    return state;
  }
};

}  // namespace tissu::test
