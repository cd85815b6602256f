#include "shape_row.h"

#include <cmath>
#include <sstream>

#include "tissu/base/error.h"

namespace tissu {

void ShapeRow::resize(int neighbours) {
  const auto k = static_cast<std::size_t>(neighbours);
  frames.assign(k, 0);
  weights.assign(k, 0.0);
  gradients.assign(k, Vec3::Zero());
}

Neighbourhood::Neighbourhood(const ShapeRequest& request)
    : frames_(request.frames),
      nearest_(request.nearest),
      neighbours_(request.use.neighbours == 0 ? request.info.neighbours : request.use.neighbours),
      offsets_(3, neighbours_),
      distances_(neighbours_) {
  if (neighbours_ <= nearest_.count()) return;
  throw ParameterError(request.where + "found " + std::to_string(nearest_.count()) +
                       " frames where the shape function " + request.use.name + " has " +
                       std::to_string(neighbours_) +
                       " neighbours for each point; add frames or ask for fewer neighbours.");
}

void Neighbourhood::move_to(const Vec3& x, ShapeRow& row) {
  nearest_.find(x, neighbours_, found_);
  for (int i = 0; i < neighbours_; ++i) {
    const Nearest::Found& found = found_[static_cast<std::size_t>(i)];
    row.frames[static_cast<std::size_t>(i)] = found.number;
    offsets_.col(i) = x - block(frames_, found.number);
    distances_[i] = std::sqrt(found.squared);
  }
}

void check_implied_neighbours(const ShapeRequest& request, int implied, std::string_view because) {
  const int asked = request.use.neighbours;
  if (asked == 0 || asked == implied || asked == request.info.neighbours) return;
  throw ParameterError(request.where + "the shape function " + request.use.name + " is asked for " +
                       std::to_string(asked) + " neighbours; it has " + std::to_string(implied) + ", since " +
                       std::string(because) + "; leave the number out.");
}

std::string unreached(double distance, double radius) {
  return "is reached by no frame: the nearest is " + metres(distance) + " away, the support ends at " +
         metres(radius) + "; ask for a greater radius or add frames";
}

std::string metres(double value) {
  std::ostringstream text;
  text.precision(6);
  text << value << " m";
  return text.str();
}

}  // namespace tissu
