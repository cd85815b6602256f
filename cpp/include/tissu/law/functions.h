#pragma once

/// What energies are written in and <cmath> does not have; batches bring their own, found beside their type.

namespace tissu {

/// max(x, 0)
inline double positive(double x) { return x > 0.0 ? x : 0.0; }

/// 1 where x > 0, else 0: the derivative of positive(x).
inline double step(double x) { return x > 0.0 ? 1.0 : 0.0; }

}  // namespace tissu
