#pragma once

/// Exact answers about a state: what crosses, and how things that touch are moved apart at the start.

#include <array>
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "tissu/assembly/fixed_dofs.h"
#include "tissu/base/error.h"
#include "tissu/contact/contact.h"

namespace tissu {

/// An edge that goes through a triangle, or a vertex behind a plane. Numbers below -1 are points that nodes
/// carry: -2 - r is the vertex -1 - r of the surface.
struct Crossing {
  std::int32_t surface;                  ///< of the edge, of the vertex
  std::int32_t other;                    ///< of the triangle, of the plane
  std::array<std::int32_t, 2> edge;      ///< nodes of their body or obstacle; -1: a vertex alone
  std::array<std::int32_t, 3> triangle;  ///< nodes of theirs; -1: a plane
};

/// All crossings of pairs that the scene says meet, in the order of the features; signs are exact.
std::vector<Crossing> crossings(const Contact& contact, const State& state);

/// Whether one of some primitives crosses another, or has a vertex behind a plane; of pairs that the scene
/// says meet. `some`: of each primitive, whether it is one of them.
bool any_crosses(const Contact& contact, const State& state, std::span<const std::uint8_t> some);

/// Of surfaces whose half thicknesses overlap: how far at most [m], by the lower number of a surface and the
/// higher one. Of things without thickness `crossings` says all.
using Depths = std::map<std::pair<std::int32_t, std::int32_t>, double>;
Depths overlaps(const Contact& contact, const State& state);

/// Surfaces overlap at the start, where they must begin apart.
class OverlapError : public ParameterError {
 public:
  OverlapError(const std::string& message, std::string places)
      : ParameterError(message), places_(std::move(places)) {}
  [[nodiscard]] const std::string& places() const { return places_; }  ///< names of both, and how much

 private:
  std::string places_;
};

/// Rows of the unknown that follow each other.
struct RowRange {
  std::int32_t first;
  std::int32_t last;  ///< one past them
};

/// Moves apart what touches, or overlaps by no more than the gap, along outward normals. Free obstacles, and
/// bodies with rows in `loose`, move as a whole, by as much as the pile that they are in needs; nodes of
/// other bodies move one by one, by at most the gap. Other obstacles and given rows stay. Refuses bodies that
/// overlap more, by their middles or their thicknesses (OverlapError).
void separate(const Contact& contact, const FixedDofs& fixed, std::span<const RowRange> loose, State& start);

}  // namespace tissu
