#pragma once

/// The const model: what a scene compiles into. A step reads it; only an editor makes a new one.

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "tissu/assembly/fixed_dofs.h"
#include "tissu/assembly/mass.h"
#include "tissu/assembly/sparsity.h"
#include "tissu/force/force_model.h"
#include "tissu/force/links.h"
#include "tissu/model/body_model.h"
#include "tissu/viscosity/prony.h"
#include "tissu/world/description.h"

namespace tissu {

struct Body {
  std::string name;
  std::int32_t first_node;
  std::int32_t node_count;
  std::vector<const BodyModel*> models;
  std::int32_t first_frame = -1;  ///< number of its first node's frame; -1: its nodes have no rotation
};

class World {
 public:
  /// Builds everything that a step needs; refuses a description that cannot be simulated.
  explicit World(WorldDescription description) : World(std::move(description), nullptr) {}
  /// The world that comes of removing cells from `before`, whose models hand over what stays as it is.
  World(WorldDescription description, const World* before);

  [[nodiscard]] std::int32_t blocks() const { return static_cast<std::int32_t>(rest_positions_.size() / 3); }
  [[nodiscard]] const std::vector<Body>& bodies() const { return bodies_; }
  [[nodiscard]] const Body& body(std::string_view name) const;
  [[nodiscard]] const std::vector<double>& rest_positions() const { return rest_positions_; }
  [[nodiscard]] const Mass& mass() const { return mass_; }
  [[nodiscard]] const std::vector<Frame>& frames() const { return mass_.frames(); }
  [[nodiscard]] const FixedDofs& fixed() const { return fixed_; }
  [[nodiscard]] const std::vector<std::unique_ptr<ForceModel>>& forces() const { return forces_; }
  [[nodiscard]] const Sparsity& sparsity() const { return sparsity_; }
  [[nodiscard]] Isa isa() const { return isa_; }
  [[nodiscard]] Threads threads() const { return threads_; }
  /// Every stiffness, and the mass, is the same for every state.
  [[nodiscard]] bool is_linear() const;
  /// The links that may be changed between steps, null when the description asks for none.
  [[nodiscard]] Links* links() const { return links_; }
  /// What it was built from, null unless the description asks for editing.
  [[nodiscard]] const WorldDescription* description() const {
    return description_ ? &*description_ : nullptr;
  }
  /// Diagonal of the box around the rest positions [m].
  [[nodiscard]] double extent() const { return extent_; }

  /// All bodies at rest at time zero.
  [[nodiscard]] State rest_state() const;
  /// Materials that remember write into the memory what the step that led here adds to it.
  void remember(State& state) const;
  /// The memory of a state of another world, for those cells that this one has as well.
  void carry_memory(const World& before, State& state) const;

 private:
  void add_bodies(const WorldDescription& description, const World* before);
  std::vector<Frame> add_frames(const WorldDescription& description);
  [[nodiscard]] std::vector<std::int32_t> shared_nodes(const BodyDescription& description) const;
  void add_inertias(const std::vector<Mat3>& inertias, std::vector<Frame>& frames) const;
  /// The blocks of the rotations of some nodes; refuses those of a body whose nodes have none.
  [[nodiscard]] std::vector<std::int32_t> rotations_of(const Body& body, std::vector<std::int32_t> nodes,
                                                       const std::string& where) const;
  void add_viscosity(const BodyDescription& body, const Body& made);
  void add_external(const WorldDescription& description);
  void add_fixed(const WorldDescription& description);
  void hold_eliminated(const WorldDescription& description);

  std::vector<Body> bodies_;
  std::vector<double> rest_positions_;
  std::vector<Quaternion> rest_rotations_;
  std::vector<Vec3> rest_spins_;
  std::vector<Vec3> rest_speeds_;
  Isa isa_;
  Threads threads_;
  Mass mass_;
  std::vector<double>
      weights_;                ///< sum_g w_g rho N_a of each node [kg]; equal to the mass for linear elements
  std::vector<Vec3> moments_;  ///< of the weight of each frame, in its axes [kg m]; empty unless asked for
  FixedDofs fixed_;
  std::vector<std::unique_ptr<ForceModel>> forces_;
  Links* links_ = nullptr;
  std::vector<const Prony*> prony_;  ///< what remembers
  std::size_t memory_size_ = 0;
  Sparsity sparsity_;
  std::optional<WorldDescription> description_;
  double extent_ = 0.0;
};

}  // namespace tissu
