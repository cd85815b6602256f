#include "window.h"

#include <cmath>

namespace tissu {
namespace {

constexpr double kReach = 1.25;  ///< R over the distance of a neighbour much farther than the others

struct Support {
  double R;       ///< [m]
  Vec3 gradient;  ///< dR/dX
};

// R = c m S^(1/8), S = sum_j t_j^8, t_j = d_j / m, m the greatest distance;
// dR/dX = c S^(-7/8) sum_j t_j^6 (X - x_j) / m.
Support support(double radius, const Eigen::Matrix3Xd& offsets, const Eigen::VectorXd& distances) {
  if (radius > 0.0) return {radius, Vec3::Zero()};
  const double m = distances.maxCoeff();
  if (!(m > 0.0)) return {1.0, Vec3::Zero()};  // at the only neighbour: its weight is one whatever R
  double S = 0.0;
  Vec3 sum = Vec3::Zero();
  for (Eigen::Index j = 0; j < distances.size(); ++j) {
    const double t6 = std::pow(distances[j] / m, 6);
    S += t6 * (distances[j] / m) * (distances[j] / m);
    sum += t6 * offsets.col(j) / m;
  }
  return {kReach * m * std::pow(S, 0.125), kReach * std::pow(S, -0.875) * sum};
}

}  // namespace

WindowValue wendland_window(double r) {
  if (r >= 1.0) return {0.0, 0.0};
  const double s = 1.0 - r;
  return {s * s * s * s * (4.0 * r + 1.0), -20.0 * s * s * s};
}

WindowValue cubic_spline_window(double r) {
  if (r >= 1.0) return {0.0, 0.0};
  if (r <= 0.5) return {2.0 / 3.0 - 4.0 * r * r * (1.0 - r), -8.0 + 12.0 * r};
  const double s = 1.0 - r;
  return {4.0 / 3.0 * s * s * s, -4.0 * s * s / r};
}

void evaluate_window(Window window, double radius, const Eigen::Matrix3Xd& offsets,
                     const Eigen::VectorXd& distances, WindowValues& values) {
  const auto [R, dR] = support(radius, offsets, distances);
  values.phi.resize(distances.size());
  values.gradients.resize(3, distances.size());
  for (Eigen::Index i = 0; i < distances.size(); ++i) {
    const double r = distances[i] / R;
    const auto [phi, slope] = window(r);
    values.phi[i] = phi;
    values.gradients.col(i) = slope / R * (offsets.col(i) / R - r * r * dR);
  }
}

}  // namespace tissu
