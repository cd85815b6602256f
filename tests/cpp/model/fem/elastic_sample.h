#pragma once

/// An elastic block for every element, quadrature, law and instruction set there is.

#include <gtest/gtest.h>

#include <ostream>
#include <string>

#include "../../force/verbs.h"
#include "../../world/sample_worlds.h"
#include "tissu/model/fem/elastic.h"

namespace tissu::test {

struct ElasticCase {
  std::string law;
  Split split;
  std::string quadrature;
  Isa isa;
};

inline std::string text(const ElasticCase& c) {
  return c.law + (c.split == Split::none ? "_hexahedron_" : "_tetra_") + c.quadrature + "_" +
         std::string(name(c.isa));
}

inline void PrintTo(const ElasticCase& c, std::ostream* out) { *out << text(c); }

inline std::string case_name(const testing::TestParamInfo<ElasticCase>& info) { return text(info.param); }

inline std::vector<ElasticCase> elastic_cases() {
  std::vector<ElasticCase> cases;
  for (const Isa isa : available_isas()) {
    for (const char* law : {"hooke", "stvk"}) {
      cases.push_back({law, Split::six, "full", isa});
      cases.push_back({law, Split::none, "full", isa});
      cases.push_back({law, Split::none, "over", isa});
    }
  }
  return cases;
}

/// A distorted box of 3 x 2 x 2 grid cells, with parameters that differ from cell to cell. 12 hexahedra leave
/// lanes that only pad; 72 tetrahedra leave none.
class ElasticTest : public testing::TestWithParam<ElasticCase> {
 protected:
  static constexpr double kYoung = 3.0;

  Mesh mesh_ = distorted_box({3, 2, 2}, GetParam().split, 0.12);
  Random random_{11};

  ElasticBlock block() {
    ElasticBlock block = elastic_block(mesh_.blocks[0], {.law = GetParam().law, .young = kYoung});
    block.quadrature = GetParam().quadrature;
    return block;
  }
  ElasticBlock varied_block() {
    ElasticBlock varied = block();
    Random random(12);
    for (auto* values : {&varied.parameters["young"], &varied.parameters["poisson"], &varied.density})
      values->clear();
    for (std::int32_t i = 0; i < mesh_.cell_count(); ++i) {
      varied.parameters["young"].push_back(kYoung + random.number());
      varied.parameters["poisson"].push_back(0.2 + random.number(0.2));
      varied.density.push_back(2.0 + random.number());
    }
    return varied;
  }
  Elastic made(ElasticBlock block) { return made_for(std::move(block), GetParam().isa); }
  Elastic made_for(ElasticBlock block, Isa isa) {
    return {std::move(block), mesh_.positions, isa, Threads(1)};
  }

  bool is_stvk() const { return GetParam().law == "stvk"; }
  State rest() const {
    State state;
    state.positions = mesh_.positions;
    state.velocities.assign(mesh_.positions.size(), 0.0);
    return state;
  }
  /// Nodes moved by up to a fifth of a cell's edge.
  State any_state() { return moved(rest(), random_.numbers(mesh_.positions.size(), 0.2), 1.0); }
  /// x = F X + shift
  State affine(const Mat3& F, const Vec3& shift = Vec3::Zero()) const {
    State state = rest();
    for (std::int32_t i = 0; i < mesh_.node_count(); ++i) {
      tissu::block(Reals(state.positions), i) = F * mesh_.node(i) + shift;
    }
    return state;
  }
};

}  // namespace tissu::test
