#pragma once

/// A block with one volume ratio for each patch, for every element, law and instruction set.

#include <gtest/gtest.h>

#include <ostream>
#include <string>

#include "../corotational/corotational_sample.h"
#include "tissu/law/generated/all.h"
#include "tissu/model/dilatation/mean_dilatation.h"

namespace tissu::test {

struct DilatationCase {
  std::string element;
  std::string law;
  Isa isa;
};

inline std::string text(const DilatationCase& c) {
  return c.element + "_" + c.law + "_" + std::string(name(c.isa));
}
inline void PrintTo(const DilatationCase& c, std::ostream* out) { *out << text(c); }
inline std::string dilatation_name(const testing::TestParamInfo<DilatationCase>& info) {
  return text(info.param);
}

/// Every law on every element for the set that runs here by itself; for the others one law.
inline std::vector<DilatationCase> dilatation_cases() {
  std::vector<DilatationCase> cases;
  for (const Isa isa : available_isas()) {
    for (const char* element : {"tetra", "hexahedron", "wedge", "pyramid"}) {
      BaseLaws::for_each([&](auto tag) {
        const std::string law(decltype(tag)::template Of<double>::kName);
        if (isa == choose_isa() || law == "stable_neo_hooke") cases.push_back({element, law, isa});
      });
    }
  }
  return cases;
}

/// A box of 3 x 2 x 2 distorted grid cells, with fibres in those of neo-Hooke.
class DilatationTest : public testing::TestWithParam<DilatationCase> {
 protected:
  CellBox box_ = cell_box(GetParam().element, {3, 2, 2}, 0.1);
  Random random_{11};

  std::int32_t nodes() const { return static_cast<std::int32_t>(box_.positions.size() / 3); }
  std::size_t cells() const {
    return box_.cells.size() / static_cast<std::size_t>(find_element(GetParam().element)->nodes);
  }
  bool is_linear() const { return GetParam().law == "hooke"; }

  /// All of a law's parameters at their typical values, times 1 to 1.5.
  LawParameters varied(std::string_view law, unsigned seed, bool vary) const {
    Random random(seed);
    LawParameters result;
    for (const LawParameter& p : find_law(law)->parameters) {
      auto& values = result[std::string(p.name)];
      for (std::size_t e = 0; e < (vary ? cells() : 1); ++e) {
        const double factor = p.name == "poisson" ? 1.0 : 1.25 + random.number(0.25);
        values.push_back(p.typical * (vary ? factor : 1.0));
      }
    }
    return result;
  }
  /// `vary`: parameters that differ from cell to cell.
  ElasticBlock block(bool vary = true) const {
    ElasticBlock block;
    block.body = "body";
    block.element = GetParam().element;
    block.law = GetParam().law;
    block.cells = box_.cells;
    block.parameters = varied(block.law, 5, vary);
    if (block.law == "neo_hooke") block.reinforcements = {{"fibre", varied("fibre", 6, vary)}};
    block.density = {2.0};
    block.model = MeanDilatationOptions{};
    return block;
  }
  MeanDilatation made(ElasticBlock block) const {
    return {std::move(block), box_.positions, GetParam().isa, Threads(1)};
  }
  Elastic continuum(ElasticBlock block) const {
    block.model = {};
    return {std::move(block), box_.positions, GetParam().isa, Threads(1)};
  }

  State affine(const Mat3& F, const Vec3& shift = Vec3::Zero()) const {
    State state;
    state.positions = box_.positions;
    for (std::int32_t i = 0; i < nodes(); ++i) {
      tissu::block(Reals(state.positions), i) = F * tissu::block(ConstReals(box_.positions), i) + shift;
    }
    state.velocities.assign(state.positions.size(), 0.0);
    return state;
  }
  /// Strains of up to 30 %, a turn where the law is blind to it, and nodes out of place. Fibres, whose
  /// tangent jumps where they go slack, are stretched.
  State any_state(double out_of_place = 0.06) {
    const Mat3 turn = is_linear() ? Mat3(Mat3::Identity()) : random_.rotation().toRotationMatrix();
    Mat3 stretch = Mat3::Identity();
    const Vec3 along(0.6, -0.48, 0.64);
    if (GetParam().law == "neo_hooke") stretch = 0.9 * stretch + 0.6 * along * along.transpose();
    return moved(affine(turn * (Mat3::Identity() + random_.matrix(0.12)) * stretch, random_.vector()),
                 random_.numbers(box_.positions.size(), out_of_place), 1.0);
  }
};

}  // namespace tissu::test
