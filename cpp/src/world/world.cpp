#include "tissu/world/world.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include "checks.h"
#include "tissu/base/error.h"
#include "tissu/force/frame_weight.h"
#include "tissu/force/gravity.h"
#include "tissu/force/load.h"
#include "tissu/model/models.h"
#include "tissu/viscosity/rayleigh.h"

namespace tissu {
namespace {

[[noreturn]] void unknown_body(std::string_view name) {
  throw ParameterError("there is no body \"" + std::string(name) + "\" in this world.");
}

std::vector<std::int32_t> shifted(std::vector<std::int32_t> nodes, std::int32_t first, std::int32_t count,
                                  const std::string& where) {
  for (std::int32_t& node : nodes) {
    if (node < 0 || node >= count) {
      throw ParameterError(where + " names node " + std::to_string(node) + "; the body has nodes 0 to " +
                           std::to_string(count - 1) + ".");
    }
    node += first;
  }
  return nodes;
}

/// Numbers from the body's own nodes on are those of nodes that it shares with others.
std::vector<std::int32_t> with_shared(std::vector<std::int32_t> nodes, const Body& made,
                                      const std::vector<std::int32_t>& shared) {
  const auto count = made.node_count + static_cast<std::int32_t>(shared.size());
  for (std::int32_t& node : nodes) {
    if (node >= made.node_count && node < count) {
      node = shared[static_cast<std::size_t>(node - made.node_count)] - made.first_node;
    } else if (node < 0 || node >= count) {
      throw ParameterError("body \"" + made.name + "\" names node " + std::to_string(node) +
                           "; the body has nodes 0 to " + std::to_string(count - 1) + ".");
    }
    node += made.first_node;
  }
  return nodes;
}

/// Diagonal of the box around the nodes and the origins of frames; the blocks of rotations are no positions.
double box_diagonal(const std::vector<double>& positions, const std::vector<Frame>& frames) {
  std::vector<char> is_rotation(positions.size() / 3, 0);
  for (const Frame& frame : frames) is_rotation[static_cast<std::size_t>(frame.rotation)] = 1;
  Eigen::AlignedBox3d box;
  for (std::size_t i = 0; i < is_rotation.size(); ++i) {
    if (is_rotation[i] == 0) box.extend(Vec3(block(ConstReals(positions), static_cast<std::int32_t>(i))));
  }
  return box.isEmpty() ? 0.0 : box.diagonal().norm();
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

/// The frame at each block of the unknown, -1 where there is none.
std::vector<std::int32_t> frames_at_blocks(const std::vector<Frame>& frames, std::int32_t blocks) {
  std::vector<std::int32_t> result(static_cast<std::size_t>(blocks), -1);
  for (std::size_t k = 0; k < frames.size(); ++k)
    result[static_cast<std::size_t>(frames[k].block)] = static_cast<std::int32_t>(k);
  return result;
}

/// A model works on its body's cells as one: their affine cells are not set apart.
bool keeps_cells_together(const ElasticBlock& block) {
  return block.model.name == "condensed" || block.model.name == "frames";
}

/// The body's blocks with node numbers of the world, affine cells apart from others.
std::vector<ElasticBlock> blocks_of(const BodyDescription& body, const Body& made,
                                    const std::vector<std::int32_t>& shared, ConstReals rest_positions,
                                    const std::optional<Vec3>& gravity) {
  std::vector<ElasticBlock> blocks;
  std::int32_t first_cell = 0;
  for (ElasticBlock elastic : body.elastic) {
    elastic.body = body.name;
    elastic.cells = with_shared(std::move(elastic.cells), made, shared);
    elastic.model.kept = shifted(std::move(elastic.model.kept), made.first_node, made.node_count,
                                 "the model of body \"" + body.name + "\"");
    if (gravity) elastic.model.gravity = *gravity;
    const ElementInfo* element = find_element(elastic.element);
    const auto cells =
        element == nullptr ? 0 : static_cast<std::int32_t>(elastic.cells.size()) / element->nodes;
    if (keeps_cells_together(elastic)) {
      blocks.push_back(std::move(elastic));
      first_cell += cells;
      continue;
    }
    for (ElasticBlock& part : split_affine(std::move(elastic), first_cell, rest_positions)) {
      blocks.push_back(std::move(part));
    }
    first_cell += cells;
  }
  return blocks;
}

}  // namespace

BodyDescription& WorldDescription::body(std::string_view name) {
  const auto found = std::ranges::find(bodies, name, &BodyDescription::name);
  if (found == bodies.end()) unknown_body(name);
  return *found;
}

World::World(WorldDescription description, const World* before)
    : isa_(isa_of(description)), threads_(threads_of(description)) {
  add_bodies(description, before);
  add_external(description);
  if (description.links) {
    auto links = std::make_unique<Links>();
    links_ = links.get();
    forces_.push_back(std::move(links));
  }
  fixed_ = FixedDofs(blocks());
  add_fixed(description);
  hold_eliminated(description);
  for (const Body& body : bodies_) refuse_massless(body, mass_.nodal(), fixed_);
  SparsityBuilder builder(blocks());
  for (const auto& model : forces_) model->couple(builder);
  sparsity_ = builder.build();
  for (const auto& model : forces_) model->bind(sparsity_);
  extent_ = box_diagonal(rest_positions_, frames());
  if (description.editable) description_ = std::move(description);
}

void World::add_bodies(const WorldDescription& description, const World* before) {
  for (const BodyDescription& body : description.bodies) {
    if (std::ranges::find(bodies_, body.name, &Body::name) != bodies_.end()) {
      throw ParameterError("two bodies are called \"" + body.name + "\"; give each its own name.");
    }
    bodies_.push_back({body.name, blocks(), static_cast<std::int32_t>(body.positions.size() / 3), {}, -1});
    rest_positions_.insert(rest_positions_.end(), body.positions.begin(), body.positions.end());
  }
  std::vector<Frame> frames = add_frames(description);
  const std::vector<std::int32_t> frame_at = frames_at_blocks(frames, blocks());
  const auto first_rotation =
      frames.empty() ? 0 : frames.back().rotation - static_cast<std::int32_t>(frames.size()) + 1;

  std::vector<double> masses(static_cast<std::size_t>(blocks()), 0.0);
  for (const Frame& frame : frames) masses[static_cast<std::size_t>(frame.block)] = frame.mass;
  weights_ = masses;
  std::vector<Mat3> inertias(frames.size(), Mat3::Zero());
  if (description.gravity && description.consistent_weight) moments_.assign(frames.size(), Vec3::Zero());
  for (std::size_t i = 0; i < description.bodies.size(); ++i) {
    const BodyDescription& body = description.bodies[i];
    Body& made = bodies_[i];
    std::vector<double> own(masses.size(), 0.0);
    std::vector<std::unique_ptr<ForceModel>> models;
    const std::vector<std::int32_t> shared = shared_nodes(body);
    for (ElasticBlock& elastic : blocks_of(body, made, shared, rest_positions_, description.gravity)) {
      if (!frames.empty()) {
        elastic.first_rotation = first_rotation;
        for (const std::int32_t node : elastic.cells)
          elastic.frames.push_back(frame_at[static_cast<std::size_t>(node)]);
      }
      auto model = before == nullptr ? nullptr : edited_model(before->body(body.name).models, elastic);
      if (model == nullptr) model = make_model(std::move(elastic), rest_positions_, isa_, threads_);
      model->add_masses(own);
      model->add_inertias(inertias);
      if (description.gravity && description.consistent_weight) model->add_moments(moments_);
      model->add_weights(weights_);
      made.models.push_back(model.get());
      models.push_back(std::move(model));
    }
    for (std::size_t n = 0; n < own.size(); ++n) masses[n] += own[n];
    if (body.rayleigh) {
      forces_.push_back(
          std::make_unique<Rayleigh>(std::move(models), own, body.rayleigh->mass, body.rayleigh->stiffness));
    } else {
      for (auto& model : models) forces_.push_back(std::move(model));
    }
    add_viscosity(body, made);
  }
  add_inertias(inertias, frames);
  mass_ = Mass(std::move(masses), std::move(frames));
}

/// Rigid bodies that stand alone, then the nodes of bodies that are frames, whose rotations stand together.
std::vector<Frame> World::add_frames(const WorldDescription& description) {
  const std::int32_t first = blocks();
  rest_positions_.resize(rest_positions_.size() + 6 * description.frames.size(), 0.0);
  std::vector<Frame> frames;
  for (const FrameDescription& frame : description.frames) {
    check_frame(frame, frames.size());
    const auto at = first + 2 * static_cast<std::int32_t>(frames.size());
    frames.push_back({at, at + 1, frame.mass, frame.inertia});
    block(Reals(rest_positions_), frames.back().block) = frame.position;
    rest_rotations_.push_back(frame.rotation.normalized());
    rest_speeds_.push_back(frame.velocity);
    rest_spins_.push_back(frame.angular_velocity);
  }
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    if (!description.bodies[i].frames) continue;
    bodies_[i].first_frame = static_cast<std::int32_t>(frames.size());
    for (std::int32_t node = 0; node < bodies_[i].node_count; ++node) {
      frames.push_back({bodies_[i].first_node + node, blocks() + node, 0.0, Mat3::Zero()});
    }
    const auto count = static_cast<std::size_t>(bodies_[i].node_count);
    rest_positions_.resize(rest_positions_.size() + 3 * count, 0.0);
    rest_rotations_.resize(frames.size(), Quaternion::Identity());
    rest_speeds_.resize(frames.size(), Vec3::Zero());
    rest_spins_.resize(frames.size(), Vec3::Zero());
  }
  return frames;
}

std::vector<std::int32_t> World::shared_nodes(const BodyDescription& description) const {
  std::vector<std::int32_t> nodes;
  for (const SharedNode& shared : description.shared) {
    const Body& other = body(shared.body);
    nodes.push_back(shifted({shared.node}, other.first_node, other.node_count,
                            "what body \"" + description.name + "\" shares with \"" + other.name + "\"")
                        .front());
  }
  return nodes;
}

/// Inertias that the models gave to the frames of their bodies.
void World::add_inertias(const std::vector<Mat3>& inertias, std::vector<Frame>& frames) const {
  for (std::size_t k = 0; k < frames.size(); ++k) frames[k].inertia += inertias[k];
  for (const Body& body : bodies_) {
    for (std::int32_t i = 0; body.first_frame >= 0 && i < body.node_count; ++i) {
      check_inertia(body.name, i, frames[static_cast<std::size_t>(body.first_frame + i)].inertia);
    }
  }
}

void World::add_external(const WorldDescription& description) {
  if (description.gravity) {
    const std::vector<double>& pulled = description.consistent_weight ? weights_ : mass_.nodal();
    forces_.push_back(std::make_unique<Gravity>(pulled, *description.gravity));
    if (!moments_.empty())
      forces_.push_back(std::make_unique<FrameWeight>(frames(), moments_, *description.gravity));
  }
  for (const LoadDescription& load : description.loads) {
    const Body& on = body(load.body);
    check_size("load \"" + load.name + "\"", load.forces.size(), 3 * load.nodes.size());
    check_table("load \"" + load.name + "\"", load.history.times, load.history.factors.size());
    auto nodes = shifted(load.nodes, on.first_node, on.node_count, "load \"" + load.name + "\"");
    if (load.moments) nodes = rotations_of(on, nodes, "load \"" + load.name + "\"");
    forces_.push_back(std::make_unique<NodalLoad>(load.name, std::move(nodes), load.forces, load.history));
  }
  for (const PressureDescription& pressure : description.pressures) {
    const Body& on = body(pressure.body);
    check_table("pressure \"" + pressure.name + "\"", pressure.history.times,
                pressure.history.factors.size());
    auto faces = pressure.faces;
    for (FaceCells& some : faces) {
      some.nodes =
          shifted(std::move(some.nodes), on.first_node, on.node_count, "pressure \"" + pressure.name + "\"");
    }
    forces_.push_back(
        std::make_unique<Pressure>(pressure.name, std::move(faces), pressure.pressure, pressure.history));
  }
}

void World::add_fixed(const WorldDescription& description) {
  for (const FixedNodes& fixed : description.fixed) {
    const Body& on = body(fixed.body);
    const auto nodes =
        shifted(fixed.nodes, on.first_node, on.node_count, "a fixed part of body \"" + on.name + "\"");
    const std::string where = "the motion of body \"" + on.name + "\"";
    check_table(where, fixed.motion.times, fixed.motion.displacements.size());
    check_table(where, fixed.motion.times, fixed.motion.angles.size());
    if (!fixed.positions.empty()) check_size(where, fixed.positions.size(), 3 * fixed.nodes.size());
    std::vector<double> start = rest_positions_;
    for (std::size_t i = 0; i < fixed.positions.size() / 3; ++i) {
      block(Reals(start), nodes[i]) = block(ConstReals(fixed.positions), static_cast<std::int32_t>(i));
    }
    if (fixed.translations) fixed_.add(nodes, start, fixed.axes, fixed.motion);
    if (!fixed.rotations) continue;
    std::vector<std::int32_t> numbers;
    numbers.reserve(nodes.size());
    for (const std::int32_t node : nodes) numbers.push_back(on.first_frame + node - on.first_node);
    fixed_.add_rotations(rotations_of(on, nodes, where), numbers, rest_rotations_, fixed.motion);
  }
}

std::vector<std::int32_t> World::rotations_of(const Body& body, std::vector<std::int32_t> nodes,
                                              const std::string& where) const {
  if (body.first_frame < 0) {
    throw ParameterError(where + " names rotations of body \"" + body.name +
                         "\", whose nodes have none; only nodes that are frames do.");
  }
  for (std::int32_t& node : nodes) {
    node = frames()[static_cast<std::size_t>(body.first_frame + node - body.first_node)].rotation;
  }
  return nodes;
}

/// Eliminated nodes are no unknowns: they are held for the solver, and their model says where they are.
void World::hold_eliminated(const WorldDescription& description) {
  for (const Body& body : bodies_) {
    for (const BodyModel* model : body.models) {
      const auto eliminated = model->eliminated();
      if (eliminated.empty()) continue;
      refuse_touched(body, *model, description, fixed_);
      fixed_.add(eliminated, rest_positions_, FixedDofs::kAllAxes, {});
    }
  }
}

const Body& World::body(std::string_view name) const {
  const auto found = std::ranges::find(bodies_, name, &Body::name);
  if (found == bodies_.end()) unknown_body(name);
  return *found;
}

bool World::is_linear() const {
  return frames().empty() && links_ == nullptr &&
         std::ranges::all_of(forces_, [](const auto& model) { return model->has_constant_stiffness(); });
}

State World::rest_state() const {
  State state;
  state.positions = rest_positions_;
  state.velocities.assign(rest_positions_.size(), 0.0);
  state.rotations = rest_rotations_;
  state.memory.assign(memory_size_, 0.0);
  for (std::size_t k = 0; k < frames().size(); ++k) {
    block(Reals(state.velocities), frames()[k].block) = rest_speeds_[k];
    block(Reals(state.velocities), frames()[k].block + 1) = rest_spins_[k];
  }
  fixed_.clear(state.velocities);
  return state;
}

}  // namespace tissu
