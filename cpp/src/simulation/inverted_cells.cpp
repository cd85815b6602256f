#include "tissu/simulation/inverted_cells.h"

#include <algorithm>
#include <utility>

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
  return model.block().frames.empty() && model.points(state).empty() && !cell.points.empty();
}

/// Whether a cell is inside out at a point of either rule.
bool is_inverted(const World& world, const State& state, const BodyModel& model, std::size_t cell,
                 const ReferenceCell& own, const ReferenceCell& full) {
  const std::int32_t* nodes = model.block().cells.data() + cell * static_cast<std::size_t>(full.nodes);
  return is_inverted(own, world.shape_positions(), state.positions, nodes) ||
         is_inverted(full, world.shape_positions(), state.positions, nodes);
}

void add_inverted(const World& world, const State& state, const BodyModel& model, std::int32_t first,
                  std::vector<std::int32_t>& found) {
  const ElasticBlock& block = model.block();
  const ReferenceCell own = reference_cell(block.element, block.quadrature);
  const ReferenceCell full = reference_cell(block.element, "full");
  const bool by_points = full.dimension == 3 && has_points(model, state, full);
  std::vector<double> means;
  if (!by_points) means = model.fields(state).volume_ratio;
  const auto cells = static_cast<std::size_t>(model.cell_count());
  for (std::size_t e = 0; e < cells; ++e) {
    const bool inverted =
        by_points ? is_inverted(world, state, model, e, own, full) : e < means.size() && means[e] <= 0.0;
    if (!inverted) continue;
    found.push_back(block.cell_numbers.empty() ? first + static_cast<std::int32_t>(e)
                                               : block.cell_numbers[e]);
  }
}

/// Calls f(model) for each model of each body.
template <class Function>
void for_models(const World& world, Function&& f) {
  for (const Body& body : world.bodies()) {
    for (const BodyModel* model : body.models) f(*model);
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

InversionCheck::InversionCheck(const World& world) {
  const State& rest = world.rest_state();
  for_models(world, [&](const BodyModel& model) {
    const ElasticBlock& block = model.block();
    Rules rules{
        reference_cell(block.element, block.quadrature), reference_cell(block.element, "full"), {}, {}};
    const bool has_own = has_points(model, rest, rules.full);
    rules.by_points = has_own && rules.full.dimension == 3;
    if (has_own && rules.full.dimension < 3) rules.thin.emplace(block, world.isa());
    rules_.push_back(std::move(rules));
  });
}

bool InversionCheck::Rules::any(const World& world, const State& state, const BodyModel& model,
                                Scratch& scratch) const {
  if (thin) return thin->least(model.block(), world.shape_positions(), state.positions) <= 0.0;
  if (!by_points) return model.least_volume_ratio(state, scratch) <= 0.0;
  const auto cells = static_cast<std::size_t>(model.cell_count());
  for (std::size_t e = 0; e < cells; ++e) {
    if (is_inverted(world, state, model, e, own, full)) return true;
  }
  return false;
}

bool InversionCheck::any(const World& world, const State& state) {
  std::size_t next = 0;
  bool found = false;
  for_models(world, [&](const BodyModel& model) {
    const Rules& rules = rules_[next++];
    found = found || rules.any(world, state, model, scratch_);
  });
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
