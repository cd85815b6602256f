#pragma once

/// Small dense algebra: fixed-size vectors and matrices come from Eigen, long arrays are spans of doubles
/// that hold one 3-vector after the other.

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstddef>
#include <cstdint>
#include <span>

namespace tissu {

using Vec3 = Eigen::Vector3d;
using Mat3 = Eigen::Matrix3d;
using Quaternion = Eigen::Quaterniond;

using Reals = std::span<double>;             ///< n 3-vectors, 3 n numbers, read and write
using ConstReals = std::span<const double>;  ///< the same, read only

/// The 3-vector number `i` of an array of 3-vectors.
inline Eigen::Map<Vec3> block(Reals values, std::int32_t i) {
  return Eigen::Map<Vec3>(values.data() + 3 * static_cast<std::ptrdiff_t>(i));
}
inline Eigen::Map<const Vec3> block(ConstReals values, std::int32_t i) {
  return Eigen::Map<const Vec3>(values.data() + 3 * static_cast<std::ptrdiff_t>(i));
}

}  // namespace tissu
