#pragma once

/// Shape functions w_i(X) of frames (bosman2014 equation 3): how much a point of the rest shape listens to
/// each of a few frames near it.
///
/// A row of weights depends on the point and on the frames alone, never on the other points. Its gradients
/// are the derivatives of its weights, with all that depends on the point: the normalisation, and the support
/// where that follows the point. They hold while the point keeps its neighbours; where the k-th and the next
/// frame are as far, the lower number is the neighbour.

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "tissu/base/vec.h"

namespace tissu {

struct ShapeFunctionInfo {
  std::string_view name;
  int neighbours;  ///< k unless the user asks for another
  std::string_view
      complete;              ///< "constant": sum w_i = 1; "linear": sum w_i x_i = X too, within what x_i span
  bool interpolates;         ///< w_i is one at frame i and zero at the others
  bool takes_radius;         ///< of its support
  bool takes_neighbours;     ///< else their number follows from what the frames span
  bool needs_grid;           ///< of frames
  std::string_view meaning;  ///< one sentence
};

/// Every shape function.
std::span<const ShapeFunctionInfo> all_shape_functions();

/// Null when there is none of this name.
const ShapeFunctionInfo* find_shape_function(std::string_view name);

struct ShapeFunctionUse {
  std::string name = "shepard";
  int neighbours = 0;  ///< k nearest frames of each point; 0: the function's own
  /// Support of a windowed function, the same everywhere [m]. 0: R = 1.25 (sum_j d_j^8)^(1/8) of the
  /// distances d_j to the k neighbours, a smooth maximum, so that all k count wherever the point is.
  double radius = 0.0;
  double power = 2.0;  ///< of Shepard's distance, above 1: at 1 the weights have a cusp at each frame
};

/// Frames a point listens to, and how much: rows of one length, padded with nothing.
struct FrameWeights {
  int neighbours = 0;                ///< k, of each point
  std::vector<std::int32_t> frames;  ///< [point][k], ascending in a row
  std::vector<double> weights;       ///< [point][k], sum to one
  std::vector<double> gradients;     ///< [point][k][3] dw/dX at rest [1/m], sum to zero
};

/// What messages call things.
struct FieldNames {
  std::string body;  ///< empty: no body is named
  std::string point = "integration point";
};

/// The weights of `frames` at `points`, three coordinates each [m]. Throws ParameterError for what the user
/// asks for, MeshError for frames and points that do not suit the function.
FrameWeights shape_weights(const ShapeFunctionUse& use, ConstReals frames, ConstReals points,
                           const FieldNames& names = {});

}  // namespace tissu
