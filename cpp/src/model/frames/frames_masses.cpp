/// The masses and inertias that frames take from their points.

#include <algorithm>
#include <cmath>
#include <span>

#include "tissu/model/frames/frames.h"

namespace tissu {

double Frames::density(std::size_t point) const {
  return of_cell(block_.density,
                 points_.cells.empty() ? static_cast<std::int32_t>(point) : points_.cells[point]);
}

/// What a point has on its own is that of a cube of the volume that it has in a whole cell, so that the
/// copies of a cell that was cut have the inertia of the cell together.
double Frames::own_turning(std::size_t point) const {
  if (!points_.turning.empty()) return points_.turning[point];
  if (points_.dimension < 3) return 0.0;
  const double share = points_.cells.empty() ? 1.0 : of_cell(block_.share, points_.cells[point]);
  return std::pow(points_.volumes[point] / share, 2.0 / 3.0) / 6.0;
}

template <class Function>
void Frames::for_neighbours(Function&& f) const {
  const auto k = static_cast<std::size_t>(points_.neighbours);
  for (std::size_t s = 0; s < points_.volumes.size(); ++s) {
    const std::span<const double> w(points_.weights.data() + s * k, k);
    const bool squares = std::ranges::min(w) < 0.0;
    const auto weight = [&](double value) { return squares ? value * value : value; };
    double sum = 0.0;
    for (const double value : w) sum += weight(value);
    for (std::size_t a = 0; a < k; ++a) f(s * k + a, density(s) * points_.volumes[s], weight(w[a]) / sum);
  }
}

void Frames::add_masses(std::vector<double>& nodal) const {
  for_neighbours([&](std::size_t at, double mass, double share) {
    nodal[static_cast<std::size_t>(points_.frames[at])] += share * mass;
  });
}

void Frames::add_weights(std::vector<double>& nodal) const {
  for_neighbours([&](std::size_t at, double mass, double /*share*/) {
    nodal[static_cast<std::size_t>(points_.frames[at])] += points_.weights[at] * mass;
  });
}

void Frames::add_inertias(std::vector<Mat3>& of_frames) const {
  for_neighbours([&](std::size_t at, double mass, double share) {
    const Vec3 l = tissu::block(ConstReals(levers_), static_cast<std::int32_t>(at));
    const double own = own_turning(at / static_cast<std::size_t>(points_.neighbours));
    const std::int32_t frame = numbers_[static_cast<std::size_t>(listened_[at])];
    if (frame < 0) return;
    of_frames[static_cast<std::size_t>(frame)] +=
        share * mass * ((l.squaredNorm() + own) * Mat3::Identity() - l * l.transpose());
  });
}

void Frames::add_moments(std::vector<Vec3>& of_frames) const {
  for_neighbours([&](std::size_t at, double mass, double /*share*/) {
    const std::int32_t frame = numbers_[static_cast<std::size_t>(listened_[at])];
    if (frame < 0) return;
    of_frames[static_cast<std::size_t>(frame)] +=
        points_.weights[at] * mass * tissu::block(ConstReals(levers_), static_cast<std::int32_t>(at));
  });
}

}  // namespace tissu
