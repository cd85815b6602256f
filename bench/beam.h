#pragma once

/// The beam that SOFA publishes its figures on: a regular grid of 40 x 10 x 10 nodes over 16 x 4 x 4 m, six
/// tetrahedra a cell (18,954), E = 2 kPa, nu = 0.3, 50 kg, one end face held, gravity, Rayleigh 0.1 and 0.1,
/// backward Euler of 10 ms with 20 iterations of conjugate gradient.

#include "tissu/world/description.h"

namespace tissu::bench {

struct Beam {
  std::array<int, 3> cells = {39, 9, 9};
  Vec3 size = {16.0, 4.0, 4.0};
  std::string element = "tetra";
  std::string law = "stvk";
  ModelOptions model;
  double young = 2e3;
  double poisson = 0.3;
  double mass = 50.0;
  bool rayleigh = true;
  int threads = 1;
};

WorldDescription describe(const Beam& beam);

}  // namespace tissu::bench
