#pragma once

/// Radial windows phi(r), r = d / R, which end with their slope at r = 1.

#include "tissu/base/vec.h"

namespace tissu {

struct WindowValue {
  double phi;
  double slope;  ///< phi'(r) / r, finite at r = 0
};
using Window = WindowValue (*)(double r);

/// Wendland's C2 function of three dimensions (Wendland, Piecewise polynomial, positive definite and
/// compactly supported radial functions of minimal degree, Adv. Comput. Math. 4, 1995): phi = (1 - r)^4 (4 r
/// + 1), phi' = -20 r (1 - r)^3.
WindowValue wendland_window(double r);

/// The cubic B-spline (Monaghan and Lattanzio, A refined particle method for astrophysical problems, Astron.
/// Astrophys. 149, 1985) without its factor: phi = 2/3 - 4 r^2 + 4 r^3 up to r = 1/2, then 4/3 (1 - r)^3.
WindowValue cubic_spline_window(double r);

/// phi_i and dphi_i/dX [1/m] of the neighbours of a point.
struct WindowValues {
  Eigen::VectorXd phi;
  Eigen::Matrix3Xd gradients;
};

/// Of a point with offsets X - x_i from its neighbours, their lengths d_i, and the radius R [m] of
/// ShapeFunctionUse: dphi_i/dX = phi'(r_i)/r_i ((X - x_i) / R^2 - r_i^2 dR/dX / R).
void evaluate_window(Window window, double radius, const Eigen::Matrix3Xd& offsets,
                     const Eigen::VectorXd& distances, WindowValues& values);

}  // namespace tissu
