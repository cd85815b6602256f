#include "tissu/world/world.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include "builder.h"
#include "checks.h"
#include "tissu/base/error.h"
#include "tissu/cell/chunk_plan.h"
#include "tissu/element/reference_cell.h"

namespace tissu {
namespace {

/// Of the rows of a matrix whose bodies may be cut: a share of their blocks, for the neighbours that an edit
/// gives them.
constexpr double kEditableRoom = 0.25;

[[noreturn]] void unknown_body(std::string_view name) {
  throw ParameterError("there is no body \"" + std::string(name) + "\" in this world.");
}

/// The instruction set asked for, or the best; one that this machine lacks is refused.
Isa isa_of(const WorldDescription& description) {
  if (!description.isa) return choose_isa();
  if (runs_here(*description.isa)) return *description.isa;
  throw ParameterError("the instruction set " + std::string(name(*description.isa)) +
                       " cannot run here; leave it open, or use baseline.");
}

Threads threads_of(const WorldDescription& description) {
  constexpr int kMost = 256;
  if (description.threads >= 1 && description.threads <= kMost) return Threads(description.threads);
  throw ParameterError("found " + std::to_string(description.threads) + " threads; 1 to " +
                       std::to_string(kMost) + " are accepted, and more than the machine's " +
                       std::to_string(available_threads()) + " are of no use.");
}

/// The numbers of the cells of a block; `next` is the first of a block whose cells have none. Points without
/// a mesh stay without numbers, because no edit names them.
std::vector<std::int32_t> numbers_of(const ElasticBlock& block, std::int32_t next) {
  if (!block.cell_numbers.empty()) return block.cell_numbers;
  const ElementInfo* element = find_element(block.element);
  if (element == nullptr) return {};
  std::vector<std::int32_t> numbers(block.cells.size() / static_cast<std::size_t>(element->nodes));
  std::iota(numbers.begin(), numbers.end(), next);
  return numbers;
}

/// Numbers the cells of a body, and on the first day keeps what its blocks are edited by. A block has become
/// one model, or two.
void keep_plans(const std::vector<const BodyModel*>& models, BodyDescription& body) {
  std::int32_t next = 0;
  for (ElasticBlock& block : body.elastic) {
    block.cell_numbers = numbers_of(block, next);
    next += static_cast<std::int32_t>(block.cell_numbers.size());
    if (!block.plans.empty()) continue;
    for (const BodyModel* model : models) {
      for (const auto& plan : model->block().plans) {
        if (std::ranges::any_of(block.cell_numbers, [&](std::int32_t number) { return plan->has(number); }))
          block.plans.push_back(plan);
      }
    }
  }
}

}  // namespace

Eigen::AlignedBox3d box_of(const std::vector<double>& positions, const std::vector<Frame>& frames) {
  std::vector<char> is_rotation(positions.size() / 3, 0);
  for (const Frame& frame : frames) is_rotation[static_cast<std::size_t>(frame.rotation)] = 1;
  Eigen::AlignedBox3d box;
  for (std::size_t i = 0; i < is_rotation.size(); ++i) {
    if (is_rotation[i] == 0) box.extend(Vec3(block(ConstReals(positions), static_cast<std::int32_t>(i))));
  }
  return box;
}

double diagonal_of(const Eigen::AlignedBox3d& box) { return box.isEmpty() ? 0.0 : box.diagonal().norm(); }

BodyDescription& WorldDescription::body(std::string_view name) {
  const auto found = std::ranges::find(bodies, name, &BodyDescription::name);
  if (found == bodies.end()) unknown_body(name);
  return *found;
}

World::World(WorldDescription description) : World(std::move(description), nullptr) {}

World::World(WorldDescription description, const World* before, bool cells_are_new) {
  WorldBuilder(*this, description, before, cells_are_new).build();
  if (!description.editable) return;
  for (std::size_t i = 0; i < bodies_.size(); ++i) keep_plans(bodies_[i].models, description.bodies[i]);
  description.separated.clear();
  description_ = std::move(description);
}

WorldBuilder::WorldBuilder(World& world, const WorldDescription& description, const World* before,
                           bool cells_are_new)
    : world_(world), description_(description), before_(before), cells_are_new_(cells_are_new) {}

void WorldBuilder::build() {
  world_.isa_ = isa_of(description_);
  world_.threads_ = threads_of(description_);
  add_bodies();
  add_loads();
  add_supports();
  add_contact();
  for (const Body& body : world_.bodies_) refuse_massless(body, world_.mass_.nodal(), world_.fixed_);
  lay_pattern();
  list_run_time();
  set_rest();
  separate_surfaces();
  world_.extent_ = diagonal_of(box_of(world_.rest_positions(), world_.frames()));
}

void WorldBuilder::lay_pattern() {
  SparsityBuilder builder(world_.blocks());
  for (const auto& model : world_.forces_) model->couple(builder);
  world_.sparsity_ = builder.build(description_.editable ? kEditableRoom : 0.0);
  for (const auto& model : world_.forces_) model->bind(world_.sparsity_);
}

void WorldBuilder::list_run_time() {
  for (const auto& model : world_.forces_) {
    const RunTime verbs = model->run_time();
    if (verbs.begins) world_.run_time_.beginning.push_back(model.get());
    if (verbs.couples) world_.run_time_.coupling.push_back(model.get());
    if (verbs.remembers) world_.run_time_.remembering.push_back(model.get());
    model->claim_memory(world_.memory_);
  }
  world_.fixed_.claim_memory(world_.memory_);
}

/// The positions and rotations of the state at rest are there already.
void WorldBuilder::set_rest() {
  State& rest = world_.rest_;
  rest.velocities.assign(rest.positions.size(), 0.0);
  rest.memory = world_.memory_.at_rest();
  const std::vector<Frame>& frames = world_.frames();
  for (std::size_t k = 0; k < frames.size(); ++k) {
    block(Reals(rest.velocities), frames[k].block) = speeds_[k];
    block(Reals(rest.velocities), frames[k].rotation) = spins_[k];
  }
  world_.fixed_.clear(rest.velocities);
}

const Body& World::body(std::string_view name) const {
  const auto found = std::ranges::find(bodies_, name, &Body::name);
  if (found == bodies_.end()) unknown_body(name);
  return *found;
}

State World::shape_state() const {
  State state = rest_;
  state.positions = shape_positions();
  return state;
}

bool World::is_linear() const {
  return frames().empty() &&
         std::ranges::all_of(forces_, [](const auto& model) { return model->has_constant_stiffness(); });
}

}  // namespace tissu
