#pragma once

/// The models that are other forms of linear tetrahedra, each with its laws and for every instruction set.

#include <gtest/gtest.h>

#include <algorithm>
#include <ostream>
#include <string>
#include <utility>

#include "../../force/verbs.h"
#include "../../world/sample_worlds.h"
#include "tissu/model/models.h"

namespace tissu::test {

// Both forms sum some hundred products, each rounded to 1e-16, of numbers at most ten times their sum.
inline constexpr double kEqual = 1e-12;

struct ModelCase {
  const char* model;
  const char* law;
  Isa isa;
};

inline std::string text(const ModelCase& c) {
  std::string model = c.model;
  std::ranges::replace(model, '-', '_');
  return model + "_" + c.law + "_" + std::string(name(c.isa));
}
inline void PrintTo(const ModelCase& c, std::ostream* out) { *out << text(c); }

inline std::vector<ModelCase> tetra_models() {
  std::vector<ModelCase> all;
  for (const Isa isa : available_isas()) {
    all.push_back({"mass-link", "stvk", isa});
    all.push_back({"mass-link", "neo_hooke", isa});
    all.push_back({"mass-tensor", "hooke", isa});
    all.push_back({"mass-tensor", "stvk", isa});
  }
  return all;
}

/// 90 distorted tetrahedra, the last lanes of them only there to pad, whose parameters differ from cell to
/// cell.
class TetraModelsTest : public testing::TestWithParam<ModelCase> {
 protected:
  Mesh mesh_ = distorted_box({5, 3, 1}, Split::six, 0.1);
  Random random_{17};

  bool is_tensor() const { return std::string_view(GetParam().model) == "mass-tensor"; }
  bool is_linear() const { return std::string_view(GetParam().law) == "hooke"; }
  bool is_polynomial() const { return std::string_view(GetParam().law) != "neo_hooke"; }

  ElasticBlock block(const char* model) const {
    ElasticBlock block = elastic_block(mesh_.blocks[0], {.law = GetParam().law});
    block.model = options_named(model);
    Random random(12);
    for (auto* values : {&block.parameters["young"], &block.parameters["poisson"], &block.density}) {
      values->clear();
    }
    for (std::int32_t i = 0; i < mesh_.cell_count(); ++i) {
      block.parameters["young"].push_back(3.0 + random.number());
      block.parameters["poisson"].push_back(0.25 + random.number(0.2));
      block.density.push_back(2.0 + random.number());
    }
    return block;
  }
  std::unique_ptr<BodyModel> made(const char* model, int threads = 1) const {
    return make_model(block(model), mesh_.positions, GetParam().isa, Threads(threads));
  }
  std::unique_ptr<BodyModel> made() const { return made(GetParam().model); }
  std::unique_ptr<BodyModel> continuum() const { return made("fem"); }

  State rest() const {
    State state;
    state.positions = mesh_.positions;
    state.velocities.assign(mesh_.positions.size(), 0.0);
    return state;
  }
  State affine(const Mat3& F, const Vec3& shift = Vec3::Zero()) const {
    State state = rest();
    for (std::int32_t i = 0; i < mesh_.node_count(); ++i) {
      tissu::block(Reals(state.positions), i) = F * mesh_.node(i) + shift;
    }
    return state;
  }
  /// Strains of up to 30 %, a turn, and nodes out of place. The terms of the expanded polynomial grow with
  /// the fourth power of displacements, their sum with strains: a turn by a sixth of a circle moves nodes by
  /// 5 m, a tenth of that is moderate.
  State any_state() {
    const double angle = random_.number(is_tensor() ? 0.1 : 1.0);
    const Mat3 turn = Eigen::AngleAxisd(angle, random_.vector().normalized()).toRotationMatrix();
    const Mat3 F = turn * (Mat3::Identity() + random_.matrix(0.15));
    return moved(affine(F, random_.vector(0.5)), random_.numbers(mesh_.positions.size(), 0.08), 1.0);
  }
};

}  // namespace tissu::test
