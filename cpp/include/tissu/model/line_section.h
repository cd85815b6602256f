#pragma once

/// Sections of rods, lines of frames: what they resist bending, twist and shear with.
///
/// Shear factors: Cowper, The shear coefficient in Timoshenko's beam theory, J. Appl. Mech. 33(2), 1966,
/// table 1:
///   round k = 6 (1 + nu) / (7 + 6 nu),   rectangle k = 10 (1 + nu) / (12 + 11 nu),
///   tube, m = inner / outer radius,
///        k = 6 (1 + nu) (1 + m^2)^2 / ((7 + 6 nu) (1 + m^2)^2 + (20 + 12 nu) m^2).
/// Torsion of a rectangle of sides a >= b: Saint-Venant's series (Timoshenko and Goodier, Theory of
/// Elasticity, section 109),
///   J = a b^3 (1 / 3 - 64 / pi^5 (b / a) sum_{n odd} tanh(n pi a / 2 b) / n^5).

#include <array>
#include <cstdint>
#include <string_view>

#include "tissu/base/vec.h"

namespace tissu {

struct LineSection {
  enum class Shape : std::uint8_t { round, rectangle, tube, general };
  Shape shape = Shape::round;
  /// rectangle: side along `up` and the other one; tube: outer and inner radius; general: the numbers of
  /// SectionConstants; round: none, the area says all.
  std::array<double, 5> sizes{};
  Vec3 up =
      Vec3::Zero();  ///< one axis of the section, where it is not across a line as it stands; round: any
};

struct SectionConstants {
  double inertia_up;      ///< int u^2 dA [m4], u along `up`: resists deflection along `up`
  double inertia_across;  ///< along the other axis
  double torsion;         ///< J [m4]
  double shear_up;        ///< shear factor along `up`
  double shear_across;
};

/// Of a section of this area [m2], of a material of this Poisson's ratio, which shear factors take.
SectionConstants section_constants(const LineSection& section, double area, double poisson);
/// Of a rectangle [m4].
double rectangle_torsion(double side, double other);
/// The shape of this name; refuses others.
LineSection::Shape section_shape(std::string_view name);

}  // namespace tissu
