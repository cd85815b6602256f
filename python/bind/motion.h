#pragma once

/// A path on which nodes or obstacles are led, from arrays.

#include "bind.h"
#include "tissu/assembly/fixed_dofs.h"

namespace tissu::bind {

/// `displacements` (t, 3) [m] and `angles` (t,) [rad] at `times` (t,) [s]; a rotation about `axis`, of any
/// length but zero, through `center` [m].
inline Motion to_motion(const Array<double>& times, const Array<double>& displacements,
                        const Array<double>& angles, const Array<double>& center, const Array<double>& axis) {
  with_columns(displacements, 3, "displacements");
  if (times.size() == 0 || displacements.shape(0) != times.size() || angles.size() != times.size()) {
    throw ParameterError(
        "a motion needs as many displacements and angles as it has times, and at least one.");
  }
  const Vec3 direction = to_vec3(axis, "axis");
  if (!(direction.norm() > 0.0)) throw ParameterError("the axis of a rotation must not be zero.");
  Motion motion{to_vector(times), {}, to_vector(angles), to_vec3(center, "center"), direction.normalized()};
  for (py::ssize_t i = 0; i < displacements.shape(0); ++i) {
    motion.displacements.emplace_back(displacements.at(i, 0), displacements.at(i, 1), displacements.at(i, 2));
  }
  return motion;
}

}  // namespace tissu::bind
