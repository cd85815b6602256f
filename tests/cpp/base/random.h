#pragma once

/// Numbers that look random and are the same on every machine.

#include <random>
#include <vector>

#include "tissu/base/vec.h"

namespace tissu::test {

class Random {
 public:
  explicit Random(unsigned seed) : engine_(seed) {}

  /// Uniform in (-scale, scale).
  double number(double scale = 1.0) {
    return scale * (2.0 * static_cast<double>(engine_()) / 4294967296.0 - 1.0);
  }
  std::vector<double> numbers(std::size_t count, double scale = 1.0) {
    std::vector<double> values(count);
    for (double& v : values) v = number(scale);
    return values;
  }
  Vec3 vector(double scale = 1.0) { return {number(scale), number(scale), number(scale)}; }
  Mat3 matrix(double scale = 1.0) {
    Mat3 m;
    for (int i = 0; i < 9; ++i) m(i) = number(scale);
    return m;
  }
  Quaternion rotation() { return Quaternion(number(), number(), number(), number()).normalized(); }

 private:
  std::mt19937 engine_;
};

}  // namespace tissu::test
