#pragma once

/// Frames and points for the tests of shape functions, and the sums their rows must satisfy.

#include <algorithm>
#include <numeric>

#include "../base/random.h"
#include "tissu/field/shape_function.h"

namespace tissu::test {

constexpr double kSpacing = 0.01;  ///< between frames [m]

/// counts[a] frames along axis a, each moved by up to `jitter` spacings within the axes it has several along.
inline std::vector<double> frame_lattice(std::array<int, 3> counts, double jitter) {
  Random random(7);
  std::vector<double> frames;
  for (int k = 0; k < counts[2]; ++k) {
    for (int j = 0; j < counts[1]; ++j) {
      for (int i = 0; i < counts[0]; ++i) {
        const std::array<int, 3> place{i, j, k};
        for (std::size_t a = 0; a < 3; ++a) {
          const double moved = counts[a] > 1 ? random.number(jitter) : 0.0;
          frames.push_back(kSpacing * (place[a] + moved));
        }
      }
    }
  }
  return frames;
}

/// What a function can be given: a lattice, jittered unless it needs a grid.
inline std::vector<double> sample_frames(const ShapeFunctionInfo& info,
                                         std::array<int, 3> counts = {5, 4, 4}) {
  return frame_lattice(counts, info.needs_grid ? 0.0 : 0.3);
}

/// Points of the lattice's box, at its middle along an axis with one frame.
inline std::vector<double> sample_points(std::size_t count, std::array<int, 3> counts = {5, 4, 4}) {
  Random random(11);
  std::vector<double> points;
  for (std::size_t i = 0; i < count; ++i) {
    for (const int n : counts) points.push_back(kSpacing * (n - 1) * (0.5 + random.number(0.5)));
  }
  return points;
}

inline ShapeFunctionUse use_of(const ShapeFunctionInfo& info) { return {.name = std::string(info.name)}; }

/// The row of one point.
struct RowView {
  const FrameWeights& all;
  std::size_t point;
  std::size_t size() const { return static_cast<std::size_t>(all.neighbours); }
  std::size_t place(std::size_t i) const { return point * size() + i; }
  std::int32_t frame(std::size_t i) const { return all.frames[place(i)]; }
  double weight(std::size_t i) const { return all.weights[place(i)]; }
  Vec3 gradient(std::size_t i) const { return Eigen::Map<const Vec3>(&all.gradients[3 * place(i)]); }

  double weight_of(std::int32_t number) const {
    double sum = 0.0;
    for (std::size_t i = 0; i < size(); ++i) sum += frame(i) == number ? weight(i) : 0.0;
    return sum;
  }
  double sum() const {
    double total = 0.0;
    for (std::size_t i = 0; i < size(); ++i) total += weight(i);
    return total;
  }
  Vec3 gradient_sum() const {
    Vec3 total = Vec3::Zero();
    for (std::size_t i = 0; i < size(); ++i) total += gradient(i);
    return total;
  }
  /// sum_i w_i x_i and its gradient sum_i x_i (x) dw_i/dX: X and the identity where linearly complete.
  Vec3 position(ConstReals frames) const {
    Vec3 total = Vec3::Zero();
    for (std::size_t i = 0; i < size(); ++i) total += weight(i) * block(frames, frame(i));
    return total;
  }
  Mat3 position_gradient(ConstReals frames) const {
    Mat3 total = Mat3::Zero();
    for (std::size_t i = 0; i < size(); ++i) total += block(frames, frame(i)) * gradient(i).transpose();
    return total;
  }
  std::vector<std::int32_t> numbers() const {
    const auto first = all.frames.begin() + static_cast<std::ptrdiff_t>(place(0));
    return {first, first + static_cast<std::ptrdiff_t>(size())};
  }
};

inline std::string parameter_name(const ShapeFunctionInfo& info) { return std::string(info.name); }

}  // namespace tissu::test
