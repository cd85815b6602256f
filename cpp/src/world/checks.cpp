#include "checks.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <functional>

#include "tissu/base/error.h"
#include "tissu/base/number_text.h"

namespace tissu {

void check_table(const std::string& where, const std::vector<double>& times, std::size_t values) {
  if (times.size() != values) {
    throw ParameterError(where + " has " + std::to_string(times.size()) + " times and " +
                         std::to_string(values) + " values; give one value for each time.");
  }
  if (!std::ranges::is_sorted(times, std::less_equal<>())) {
    throw ParameterError(where + " has times that do not ascend; give each later than the one before.");
  }
}

void check_size(const std::string& where, std::size_t found, std::size_t accepted) {
  if (found == accepted) return;
  throw ParameterError(where + " has " + std::to_string(found) + " numbers where " +
                       std::to_string(accepted) + " are needed, three for each node.");
}

void check_frame(const FrameDescription& frame, std::size_t number) {
  const std::string where = "frame " + std::to_string(number);
  if (!(frame.mass > 0.0) || !std::isfinite(frame.mass)) {
    throw ParameterError(where + " has a mass of " + number_text(frame.mass) +
                         " kg; it must be positive and finite.");
  }
  const Eigen::LLT<Mat3> factor(frame.inertia);
  if (!frame.inertia.allFinite() || !frame.inertia.isApprox(frame.inertia.transpose()) ||
      factor.info() != Eigen::Success) {
    throw ParameterError(where + " has an inertia that is not symmetric and positive definite.");
  }
}

void check_inertia(const std::string& body, std::int32_t node, const Mat3& inertia) {
  const Eigen::LLT<Mat3> factor(inertia);
  const double least = factor.info() == Eigen::Success ? factor.matrixLLT().diagonal().minCoeff() : 0.0;
  if (inertia.allFinite() && least * least > 1e-12 * inertia.trace()) return;
  throw MeshError("body \"" + body + "\": frame " + std::to_string(node) +
                  " has no inertia about some axis: too few integration points listen to it, or all on one "
                  "line; take more points, or give lines and sheets their section.");
}

void refuse_massless(const Body& body, const std::vector<double>& masses, const FixedDofs& fixed) {
  std::int32_t missing = 0;
  std::int32_t example = 0;
  for (std::int32_t i = 0; i < body.node_count; ++i) {
    const auto node = static_cast<std::size_t>(body.first_node + i);
    if (masses[node] > 0.0 || fixed.masks()[node] == FixedDofs::kAllAxes) continue;
    if (missing++ == 0) example = i;
  }
  if (missing > 0) {
    throw MeshError("body \"" + body.name + "\" has " + std::to_string(missing) +
                    " nodes that no cell uses or whose mass is not positive (the first is node " +
                    std::to_string(example) + "); drop them from the mesh.");
  }
}

void refuse_touched(const Body& body, const BodyModel& model, const WorldDescription& description,
                    const FixedDofs& fixed) {
  const auto refuse = [&](std::int32_t node, const std::string& why) {
    const auto eliminated = model.eliminated();
    if (!std::ranges::binary_search(eliminated, node)) return;
    throw ParameterError("node " + std::to_string(node - body.first_node) + " of body \"" + body.name +
                         "\" is eliminated by the model " + std::string(model_name(model.block().model)) +
                         ", and " + why + "; keep it.");
  };
  for (const BodyModel* other : body.models) {
    if (other == &model) continue;
    for (const std::int32_t node : other->block().cells) refuse(node, "belongs to other cells too");
  }
  for (const std::int32_t row : fixed.rows()) refuse(row, "is held or led");
  for (const LoadDescription& load : description.loads) {
    if (load.body != body.name) continue;
    for (const std::int32_t node : load.nodes) refuse(node + body.first_node, "carries " + load.name);
  }
  for (const PressureDescription& pressure : description.pressures) {
    if (pressure.body != body.name) continue;
    for (const FaceCells& faces : pressure.faces) {
      for (const std::int32_t node : faces.nodes) refuse(node + body.first_node, "carries " + pressure.name);
    }
  }
  if (!description.contact) return;
  for (const SurfaceDescription& surface : description.contact->bodies) {
    if (surface.name != body.name) continue;
    for (const std::int32_t node : surface.riders.node) {
      refuse(node + body.first_node, "carries a surface in contact");
    }
    for (const auto& triangle : surface.triangles) {
      for (const std::int32_t node : triangle) {
        if (node >= 0) refuse(node + body.first_node, "lies on a surface in contact");
      }
    }
  }
}

}  // namespace tissu
