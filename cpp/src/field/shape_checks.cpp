#include "shape_checks.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "tissu/base/error.h"

namespace tissu {
namespace {

constexpr double kCoincident = 1e-9;

std::string number(double value) {
  std::ostringstream text;
  text.precision(6);
  text << value;
  return text.str();
}

std::string all_names() {
  std::string names;
  for (const ShapeFunctionInfo& info : all_shape_functions()) {
    names += (names.empty() ? "" : ", ") + std::string(info.name);
  }
  return names;
}

}  // namespace

std::string message_start(const FieldNames& names) {
  return names.body.empty() ? "" : "body \"" + names.body + "\": ";
}

std::string at(const Vec3& x) {
  std::string text = "(";
  for (int i = 0; i < 3; ++i) text.append(i > 0 ? ", " : "").append(number(x[i]));
  return text.append(") m");
}

const ShapeFunctionInfo& check_use(const ShapeFunctionUse& use, const std::string& where) {
  const ShapeFunctionInfo* info = find_shape_function(use.name);
  if (!info) {
    throw ParameterError(where + "found the shape function \"" + use.name + "\"; there are " + all_names() +
                         ".");
  }
  if (use.neighbours < 0) {
    throw ParameterError(where + "found " + std::to_string(use.neighbours) +
                         " neighbours of the shape function " + use.name +
                         "; accepted are 1 and more, or 0 for its own number.");
  }
  if (!std::isfinite(use.radius) || use.radius < 0.0) {
    throw ParameterError(where + "the shape function " + use.name + " has a radius of " + number(use.radius) +
                         " m; accepted is a positive one, or 0 for one that follows the neighbours.");
  }
  if (use.radius > 0.0 && !info->takes_radius) {
    throw ParameterError(where + "the shape function " + use.name + " has a radius of " + number(use.radius) +
                         " m and takes none; leave it out.");
  }
  if (!std::isfinite(use.power) || use.power <= 1.0) {
    throw ParameterError(where + "the shape function " + use.name + " has a power of " + number(use.power) +
                         "; accepted is above 1, where its weights have a gradient at each frame.");
  }
  return *info;
}

void check_positions(ConstReals positions, const std::string& what, const std::string& where) {
  if (positions.size() % 3 != 0) {
    throw ParameterError(where + "found " + std::to_string(positions.size()) + " coordinates of " + what +
                         "s; give three for each.");
  }
  const auto* wrong = std::ranges::find_if(positions.data(), positions.data() + positions.size(),
                                           [](double x) { return !std::isfinite(x); });
  if (wrong == positions.data() + positions.size()) return;
  const auto i = static_cast<std::int32_t>((wrong - positions.data()) / 3);
  throw ParameterError(where + what + " " + std::to_string(i) + " is at " + at(block(positions, i)) +
                       "; give finite coordinates.");
}

void check_distinct(ConstReals frames, const Nearest& nearest, const std::string& where) {
  const Eigen::Map<const Eigen::Matrix3Xd> x(frames.data(), 3, nearest.count());
  const double extent = (x.rowwise().maxCoeff() - x.rowwise().minCoeff()).norm();
  std::vector<Nearest::Found> found;
  for (std::int32_t i = 0; i < nearest.count() && nearest.count() > 1; ++i) {
    nearest.find(x.col(i), 2, found);
    if (std::sqrt(found[1].squared) > kCoincident * extent) continue;
    const std::int32_t other = found[0].number == i ? found[1].number : found[0].number;
    throw MeshError(where + "frames " + std::to_string(std::min(i, other)) + " and " +
                    std::to_string(std::max(i, other)) + " coincide at " + at(x.col(i)) +
                    "; remove one of them.");
  }
}

}  // namespace tissu
