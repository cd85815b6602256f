#include "tissu/simulation/inverted_cells.h"

#include <algorithm>

#include "tissu/element/reference_cell.h"

namespace tissu {
namespace {

constexpr std::size_t kNamed = 5;  ///< cells in a sentence

/// det dx/dxi of a volume cell at a point of its rule.
double jacobian(const ReferenceCell::Point& point, ConstReals x, const std::int32_t* nodes) {
  Mat3 J = Mat3::Zero();
  for (std::size_t a = 0; a < point.gradients.size(); ++a) {
    const auto& g = point.gradients[a];
    J += block(x, nodes[a]) * Vec3(g[0], g[1], g[2]).transpose();
  }
  return J.determinant();
}

bool is_inverted(const ReferenceCell& cell, ConstReals rest, ConstReals x, const std::int32_t* nodes) {
  return std::ranges::any_of(cell.points, [&](const ReferenceCell::Point& point) {
    return jacobian(point, x, nodes) * jacobian(point, rest, nodes) <= 0.0;
  });
}

/// Whether its cells have quadrature points of their own that move with their nodes' places alone.
bool has_points(const BodyModel& model, const State& state, const ReferenceCell& cell) {
  return model.eliminated().empty() && model.block().frames.empty() && model.points(state).empty() &&
         cell.dimension == 3 && !cell.points.empty();
}

void add_inverted(const World& world, const State& state, const BodyModel& model, std::int32_t first,
                  std::vector<std::int32_t>& found) {
  const ElasticBlock& block = model.block();
  const ReferenceCell own = reference_cell(block.element, block.quadrature);
  const ReferenceCell full = reference_cell(block.element, "full");
  const bool by_points = has_points(model, state, full);
  std::vector<double> means;
  if (!by_points) means = model.fields(state).volume_ratio;
  const auto cells = static_cast<std::size_t>(model.cell_count());
  for (std::size_t e = 0; e < cells; ++e) {
    bool inverted = e < means.size() && means[e] <= 0.0;
    if (by_points) {
      const std::int32_t* nodes = block.cells.data() + e * static_cast<std::size_t>(full.nodes);
      for (const ReferenceCell* cell : {&own, &full}) {
        inverted = inverted || is_inverted(*cell, world.rest_positions(), state.positions, nodes);
      }
    }
    if (!inverted) continue;
    found.push_back(block.cell_numbers.empty() ? first + static_cast<std::int32_t>(e)
                                               : block.cell_numbers[e]);
  }
}

}  // namespace

std::vector<std::int32_t> inverted_cells(const World& world, const State& state, const Body& body) {
  std::vector<std::int32_t> found;
  std::int32_t first = 0;
  for (const BodyModel* model : body.models) {
    add_inverted(world, state, *model, first, found);
    first += model->cell_count();
  }
  std::ranges::sort(found);
  return found;
}

std::string say_inverted(const World& world, const State& state) {
  std::string text;
  for (const Body& body : world.bodies()) {
    const std::vector<std::int32_t> found = inverted_cells(world, state, body);
    if (found.empty()) continue;
    text += text.empty() ? "" : "; ";
    text += std::to_string(found.size()) + (found.size() == 1 ? " cell of body \"" : " cells of body \"") +
            body.name + (found.size() == 1 ? "\" is inside out (" : "\" are inside out (");
    for (std::size_t i = 0; i < std::min(found.size(), kNamed); ++i) {
      text += (i > 0 ? ", " : "") + std::to_string(found[i]);
    }
    text += found.size() > kNamed ? ", ...)" : ")";
  }
  if (!text.empty()) {
    text +=
        ": this equilibrium is not a deformation of the body; take a law with a barrier against lost volume "
        "(neo_hooke), finer cells there, or less load";
  }
  return text;
}

}  // namespace tissu
