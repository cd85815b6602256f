#pragma once

/// The point, line, plane or space that positions span.

#include "tissu/base/vec.h"

namespace tissu {

struct AffineSpan {
  int dimension;    ///< 0 to 3
  Mat3 axes;        ///< orthonormal columns; the first `dimension` span it, the others are normal to it
  double flatness;  ///< least extent within the span over the greatest, 1 at best
};

/// By the axes of the scatter sum_i (x_i - c)(x_i - c)^T about the mean c. A direction in which the positions
/// extend less than a millionth of their greatest extent is not a part of the span.
AffineSpan affine_span(const Eigen::Ref<const Eigen::Matrix3Xd>& positions);

}  // namespace tissu
