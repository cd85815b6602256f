#include <algorithm>
#include <numeric>
#include <utility>

#include "builder.h"
#include "checks.h"
#include "tissu/base/error.h"
#include "tissu/model/models.h"
#include "tissu/viscosity/rayleigh.h"

/// The bodies of a world: their nodes and frames, the models of their cells, masses and inertias.

namespace tissu {
namespace {

constexpr double kOfNothing = 1e-20;  ///< inertia of a frame that is held and has no material [kg m2]

/// Of the chunks of a body that may be cut: the cells and copies of nodes that an edit makes stand in the
/// chunk of the cell that they come from.
constexpr double kEditableFill = 0.75;

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

/// The frame at each block of the unknown, -1 where there is none.
std::vector<std::int32_t> frames_at_blocks(const std::vector<Frame>& frames, std::int32_t blocks) {
  std::vector<std::int32_t> result(static_cast<std::size_t>(blocks), -1);
  for (std::size_t k = 0; k < frames.size(); ++k)
    result[static_cast<std::size_t>(frames[k].block)] = static_cast<std::int32_t>(k);
  return result;
}

/// Cells with numbers, and chunks with room.
void make_editable(ElasticBlock& block, std::int32_t first_cell, std::int32_t cells) {
  block.fill = kEditableFill;
  if (!block.cell_numbers.empty()) return;
  block.cell_numbers.resize(static_cast<std::size_t>(cells));
  std::iota(block.cell_numbers.begin(), block.cell_numbers.end(), first_cell);
}

/// A model works on its body's cells as one: their affine cells are not set apart.
bool keeps_cells_together(const ElasticBlock& block) {
  return std::holds_alternative<CondensedOptions>(block.model) ||
         std::holds_alternative<FramesOptions>(block.model);
}

}  // namespace

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

/// The body's blocks with node numbers of the world, affine cells apart from others.
std::vector<ElasticBlock> WorldBuilder::blocks_of(const BodyDescription& body, const Body& made) const {
  const std::vector<std::int32_t> shared = shared_nodes(body);
  std::vector<ElasticBlock> blocks;
  std::int32_t first_cell = 0;
  for (ElasticBlock elastic : body.elastic) {
    elastic.body = body.name;
    elastic.cells = with_shared(std::move(elastic.cells), made, shared);
    if (auto* condensed = std::get_if<CondensedOptions>(&elastic.model)) {
      condensed->kept = shifted(std::move(condensed->kept), made.first_node, made.node_count,
                                "the model of body \"" + body.name + "\"");
      if (description_.gravity) condensed->gravity = *description_.gravity;
    }
    const ElementInfo* element = find_element(elastic.element);
    const auto cells =
        element == nullptr ? 0 : static_cast<std::int32_t>(elastic.cells.size()) / element->nodes;
    if (description_.editable) make_editable(elastic, first_cell, cells);
    if (keeps_cells_together(elastic)) {
      blocks.push_back(std::move(elastic));
      first_cell += cells;
      continue;
    }
    for (ElasticBlock& part : split_affine(std::move(elastic), first_cell, world_.rest_positions())) {
      blocks.push_back(std::move(part));
    }
    first_cell += cells;
  }
  return blocks;
}

void WorldBuilder::add_bodies() {
  place_bodies();
  std::vector<Frame> frames = add_frames();
  masses_.assign(static_cast<std::size_t>(world_.blocks()), 0.0);
  for (const Frame& frame : frames) masses_[static_cast<std::size_t>(frame.block)] = frame.mass;
  weights_ = masses_;
  inertias_.assign(frames.size(), Mat3::Zero());
  if (description_.gravity && description_.consistent_weight) moments_.assign(frames.size(), Vec3::Zero());
  for (std::size_t i = 0; i < description_.bodies.size(); ++i) {
    add_models(description_.bodies[i], world_.bodies_[i], frames);
    add_viscosity(description_.bodies[i], world_.bodies_[i]);
  }
  add_inertias(frames);
  world_.mass_ = Mass(std::move(masses_), std::move(frames));
}

void WorldBuilder::place_bodies() {
  for (const BodyDescription& body : description_.bodies) {
    if (std::ranges::find(world_.bodies_, body.name, &Body::name) != world_.bodies_.end()) {
      throw ParameterError("two bodies are called \"" + body.name + "\"; give each its own name.");
    }
    const auto nodes = static_cast<std::int32_t>(body.positions.size() / 3);
    world_.bodies_.push_back({body.name, world_.blocks(), nodes, {}, -1, body.room});
    std::vector<double>& positions = world_.rest_.positions;
    positions.insert(positions.end(), body.positions.begin(), body.positions.end());
    for (std::int32_t spare = 0; spare < body.room; ++spare)
      positions.insert(positions.end(), body.positions.begin(), body.positions.begin() + 3);
  }
}

void WorldBuilder::add_models(const BodyDescription& description, Body& made,
                              const std::vector<Frame>& frames) {
  const std::vector<std::int32_t> frame_at = frames_at_blocks(frames, world_.blocks());
  const auto first_rotation =
      frames.empty() ? 0 : frames.back().rotation - static_cast<std::int32_t>(frames.size()) + 1;
  std::vector<double> own(masses_.size(), 0.0);
  std::vector<std::unique_ptr<ForceModel>> models;
  for (ElasticBlock& elastic : blocks_of(description, made)) {
    if (!frames.empty()) {
      elastic.first_rotation = first_rotation;
      for (const std::int32_t node : elastic.cells)
        elastic.frames.push_back(frame_at[static_cast<std::size_t>(node)]);
    }
    std::unique_ptr<BodyModel> model;
    if (before_ != nullptr && !cells_are_new_) {
      model = edited_model(before_->body(description.name).models, elastic);
    }
    if (model == nullptr) {
      model = make_model(std::move(elastic), world_.rest_positions(), world_.isa_, world_.threads_);
    }
    model->add_masses(own);
    model->add_inertias(inertias_);
    if (!moments_.empty()) model->add_moments(moments_);
    model->add_weights(weights_);
    made.models.push_back(model.get());
    models.push_back(std::move(model));
  }
  for (std::size_t n = 0; n < own.size(); ++n) masses_[n] += own[n];
  if (description.rayleigh) {
    world_.forces_.push_back(std::make_unique<Rayleigh>(std::move(models), own, description.rayleigh->mass,
                                                        description.rayleigh->stiffness));
  } else {
    for (auto& model : models) world_.forces_.push_back(std::move(model));
  }
}

/// Rigid bodies that stand alone, then the nodes of bodies that are frames, whose rotations stand together.
std::vector<Frame> WorldBuilder::add_frames() {
  std::vector<double>& positions = world_.rest_.positions;
  const std::int32_t first = world_.blocks();
  positions.resize(positions.size() + 6 * description_.frames.size(), 0.0);
  std::vector<Frame> frames;
  for (const FrameDescription& frame : description_.frames) {
    check_frame(frame, frames.size());
    const auto at = first + 2 * static_cast<std::int32_t>(frames.size());
    frames.push_back({at, at + 1, frame.mass, frame.inertia, true});
    block(Reals(positions), frames.back().block) = frame.position;
    world_.rest_.rotations.push_back(frame.rotation.normalized());
    speeds_.push_back(frame.velocity);
    spins_.push_back(frame.angular_velocity);
  }
  add_node_frames(frames);
  return frames;
}

void WorldBuilder::add_node_frames(std::vector<Frame>& frames) {
  for (std::size_t i = 0; i < world_.bodies_.size(); ++i) {
    if (!description_.bodies[i].frames) continue;
    Body& body = world_.bodies_[i];
    const std::int32_t first = world_.blocks();
    body.first_frame = static_cast<std::int32_t>(frames.size());
    const std::int32_t count = body.node_count + body.room;
    for (std::int32_t node = 0; node < count; ++node) {
      frames.push_back({body.first_node + node, first + node, 0.0, Mat3::Zero()});
    }
    State& rest = world_.rest_;
    rest.positions.resize(rest.positions.size() + 3 * static_cast<std::size_t>(count), 0.0);
    rest.rotations.resize(frames.size(), Quaternion::Identity());
    speeds_.resize(frames.size(), Vec3::Zero());
    spins_.resize(frames.size(), Vec3::Zero());
  }
}

std::vector<std::int32_t> WorldBuilder::shared_nodes(const BodyDescription& description) const {
  std::vector<std::int32_t> nodes;
  for (const SharedNode& shared : description.shared) {
    const Body& other = world_.body(shared.body);
    nodes.push_back(shifted({shared.node}, other.first_node, other.node_count,
                            "what body \"" + description.name + "\" shares with \"" + other.name + "\"")
                        .front());
  }
  return nodes;
}

/// Inertias that the models gave to the frames of their bodies. One that no point listens to has none, nor a
/// mass: it is refused as a node without mass, unless it is held. Then it gets one that has an inverse.
void WorldBuilder::add_inertias(std::vector<Frame>& frames) const {
  for (std::size_t k = 0; k < frames.size(); ++k) frames[k].inertia += inertias_[k];
  for (const Body& body : world_.bodies_) {
    for (std::int32_t i = 0; body.first_frame >= 0 && i < body.node_count; ++i) {
      Mat3& inertia = frames[static_cast<std::size_t>(body.first_frame + i)].inertia;
      if (inertia.isZero(0.0)) {
        inertia.diagonal().setConstant(kOfNothing);
        continue;
      }
      check_inertia(body.name, i, inertia);
    }
  }
}

}  // namespace tissu
