#include "tissu/model/line_section.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "tissu/base/error.h"

namespace tissu {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr int kTerms = 200;  ///< odd ones: what is left of the series is below 1e-11 of its sum

double fourth(double value) { return value * value * value * value; }

SectionConstants round(double area, double poisson) {
  const double inertia = area * area / (4.0 * kPi);
  const double k = 6.0 * (1.0 + poisson) / (7.0 + 6.0 * poisson);
  return {inertia, inertia, 2.0 * inertia, k, k};
}

SectionConstants rectangle(double up, double across, double poisson) {
  const double k = 10.0 * (1.0 + poisson) / (12.0 + 11.0 * poisson);
  const double area = up * across;
  return {area * up * up / 12.0, area * across * across / 12.0, rectangle_torsion(up, across), k, k};
}

SectionConstants tube(double outer, double inner, double poisson) {
  const double inertia = kPi / 4.0 * (fourth(outer) - fourth(inner));
  const double m2 = inner * inner / (outer * outer);
  const double square = (1.0 + m2) * (1.0 + m2);
  const double k =
      6.0 * (1.0 + poisson) * square / ((7.0 + 6.0 * poisson) * square + (20.0 + 12.0 * poisson) * m2);
  return {inertia, inertia, 2.0 * inertia, k, k};
}

}  // namespace

double rectangle_torsion(double side, double other) {
  const double a = std::max(side, other);
  const double b = std::min(side, other);
  double sum = 0.0;
  for (int n = 2 * kTerms - 1; n > 0; n -= 2) {
    sum += std::tanh(n * kPi * a / (2.0 * b)) / (fourth(n) * n);
  }
  return a * b * b * b * (1.0 / 3.0 - 64.0 / (fourth(kPi) * kPi) * (b / a) * sum);
}

SectionConstants section_constants(const LineSection& section, double area, double poisson) {
  const auto& s = section.sizes;
  switch (section.shape) {
    case LineSection::Shape::rectangle:
      return rectangle(s[0], s[1], poisson);
    case LineSection::Shape::tube:
      return tube(s[0], s[1], poisson);
    case LineSection::Shape::general:
      return {s[0], s[1], s[2], s[3], s[4]};
    case LineSection::Shape::round:
      break;
  }
  return round(area, poisson);
}

LineSection::Shape section_shape(std::string_view name) {
  using enum LineSection::Shape;
  if (name == "round") return round;
  if (name == "rectangle") return rectangle;
  if (name == "tube") return tube;
  if (name == "general") return general;
  throw ParameterError("found a section named \"" + std::string(name) +
                       "\"; round, rectangle, tube and general are accepted.");
}

}  // namespace tissu
