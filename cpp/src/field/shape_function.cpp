#include "tissu/field/shape_function.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "shape_checks.h"
#include "shape_row.h"
#include "tissu/base/error.h"

namespace tissu {
namespace {

// Name, neighbours, complete, interpolates, takes a radius, takes neighbours, needs a grid, meaning.
constexpr std::array kInfos{
    ShapeFunctionInfo{
        "shepard", 4, "constant", true, false, true, false,
        "Inverse distance to a power: any frames, weights between 0 and 1, flat at each frame."},
    ShapeFunctionInfo{"wendland", 4, "constant", false, true, true, false,
                      "A smooth bump of finite support around each frame, normalised: any frames, weights "
                      "between 0 and 1, no cusps."},
    ShapeFunctionInfo{"cubic_spline", 4, "constant", false, true, true, false,
                      "The cubic B-spline around each frame, normalised: as wendland, flatter at the frame."},
    ShapeFunctionInfo{"linear", 4, "linear", true, false, false, false,
                      "Barycentric coordinates of a tetrahedron of near frames: constant gradients, a jump "
                      "where the tetrahedron changes."},
    ShapeFunctionInfo{
        "trilinear", 8, "linear", true, false, false, true,
        "Products of linear functions along the axes of a grid of frames: continuous everywhere."},
    ShapeFunctionInfo{"moving_least_squares", 12, "linear", false, true, true, false,
                      "The plane that fits the near frames best, seen through Wendland's window: any frames, "
                      "weights that may be negative."},
};
using Make = std::unique_ptr<ShapeFunction> (*)(const ShapeRequest&);
constexpr std::array<Make, kInfos.size()> kMakes{make_shepard, make_wendland,  make_cubic_spline,
                                                 make_linear,  make_trilinear, make_moving_least_squares};

/// Writes a row to its place, frames ascending. False where a number of it is not finite.
bool put(const ShapeRow& row, std::size_t point, std::vector<std::size_t>& order, FrameWeights& all) {
  const std::size_t k = row.frames.size();
  order.resize(k);
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::sort(order, {}, [&](std::size_t i) { return row.frames[i]; });
  bool finite = true;
  for (std::size_t n = 0; n < k; ++n) {
    const std::size_t place = point * k + n;
    all.frames[place] = row.frames[order[n]];
    all.weights[place] = row.weights[order[n]];
    Eigen::Map<Vec3>(all.gradients.data() + 3 * place) = row.gradients[order[n]];
    finite = finite && std::isfinite(all.weights[place]) && row.gradients[order[n]].allFinite();
  }
  return finite;
}

/// The rows of all points. All points that are wrong are counted, the first is named.
FrameWeights rows(ShapeFunction& function, ConstReals points, const std::string& where,
                  const FieldNames& names) {
  const auto count = static_cast<std::int32_t>(points.size() / 3);
  const auto size = static_cast<std::size_t>(count) * static_cast<std::size_t>(function.neighbours());
  FrameWeights all{function.neighbours(), std::vector<std::int32_t>(size), std::vector<double>(size),
                   std::vector<double>(3 * size)};
  ShapeRow row;
  std::vector<std::size_t> order;
  std::int32_t wrong = 0;
  std::int32_t first = 0;
  std::string problem;
  for (std::int32_t s = 0; s < count; ++s) {
    row.resize(function.neighbours());
    std::string found = function.fill(block(points, s), row);
    if (found.empty() && put(row, static_cast<std::size_t>(s), order, all)) continue;
    if (wrong++ > 0) continue;
    first = s;
    problem =
        found.empty() ? "has weights that are not finite; move it or the frames near it" : std::move(found);
  }
  if (wrong == 0) return all;
  const std::string others = wrong > 1 ? ", the first of " + std::to_string(wrong) + " such," : "";
  throw MeshError(where + names.point + " " + std::to_string(first) + " at " + at(block(points, first)) +
                  others + " " + problem + ".");
}

}  // namespace

std::span<const ShapeFunctionInfo> all_shape_functions() { return kInfos; }

const ShapeFunctionInfo* find_shape_function(std::string_view name) {
  const auto* found = std::ranges::find(kInfos, name, &ShapeFunctionInfo::name);
  return found == kInfos.end() ? nullptr : &*found;
}

FrameWeights shape_weights(const ShapeFunctionUse& use, ConstReals frames, ConstReals points,
                           const FieldNames& names) {
  const std::string where = message_start(names);
  const ShapeFunctionInfo& info = check_use(use, where);
  check_positions(frames, "frame", where);
  check_positions(points, names.point, where);
  if (frames.empty()) {
    throw ParameterError(where + "found no frames; the shape function " + use.name + " needs one at least.");
  }
  const Nearest nearest(frames);
  check_distinct(frames, nearest, where);
  const auto make = kMakes[static_cast<std::size_t>(&info - kInfos.data())];
  const std::unique_ptr<ShapeFunction> function = make({info, use, frames, nearest, where});
  return rows(*function, points, where, names);
}

}  // namespace tissu
