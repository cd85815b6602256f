#pragma once

/// The const model: what a scene compiles into, as data. A step reads it; only an editor, between two steps,
/// makes a new one. The sources build_*.cpp build it.

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "tissu/assembly/fixed_dofs.h"
#include "tissu/assembly/mass.h"
#include "tissu/assembly/sparsity.h"
#include "tissu/contact/contact.h"
#include "tissu/force/force_model.h"
#include "tissu/model/body_model.h"
#include "tissu/world/description.h"

namespace tissu {

struct Body {
  std::string name;
  std::int32_t first_node;
  std::int32_t node_count;
  std::vector<const BodyModel*> models;
  std::int32_t first_frame = -1;  ///< number of its first node's frame; -1: its nodes have no rotation
  std::int32_t room = 0;          ///< held rows without mass after its nodes, for those that edits make
};

/// The models that have a verb of a running world (RunTime).
struct RunTimeModels {
  std::vector<const ForceModel*> beginning;
  std::vector<const ForceModel*> coupling;
  std::vector<const ForceModel*> remembering;
};

class World {
 public:
  /// Builds everything that a step needs; refuses a description that cannot be simulated.
  explicit World(WorldDescription description);
  /// The world that comes of an edit of `before`: of removing cells, where its models hand over what stays as
  /// it is, or of one after which cells are new.
  World(WorldDescription description, const World* before, bool cells_are_new = false);

  [[nodiscard]] std::int32_t blocks() const { return static_cast<std::int32_t>(rest_.positions.size() / 3); }
  [[nodiscard]] const std::vector<Body>& bodies() const { return bodies_; }
  [[nodiscard]] const Body& body(std::string_view name) const;
  [[nodiscard]] const std::vector<double>& rest_positions() const { return rest_.positions; }
  /// Where cells have their rest shapes, as bodies are described: contact moves surfaces apart before time
  /// zero, so that rest positions are others.
  [[nodiscard]] const std::vector<double>& shape_positions() const {
    return shape_.empty() ? rest_.positions : shape_;
  }
  [[nodiscard]] const Mass& mass() const { return mass_; }
  [[nodiscard]] const std::vector<Frame>& frames() const { return mass_.frames(); }
  [[nodiscard]] const FixedDofs& fixed() const { return fixed_; }
  [[nodiscard]] const std::vector<std::unique_ptr<ForceModel>>& forces() const { return forces_; }
  /// One of the forces; null in a world where nothing touches.
  [[nodiscard]] const Contact* contact() const { return contact_; }
  [[nodiscard]] const RunTimeModels& run_time() const { return run_time_; }
  /// What its states remember.
  [[nodiscard]] const MemoryPlaces& memory() const { return memory_; }
  [[nodiscard]] const Sparsity& sparsity() const { return sparsity_; }
  [[nodiscard]] Isa isa() const { return isa_; }
  [[nodiscard]] Threads threads() const { return threads_; }
  /// Every stiffness, and the mass, is the same for every state.
  [[nodiscard]] bool is_linear() const;
  /// What it was built from, null unless the description asks for editing.
  [[nodiscard]] const WorldDescription* description() const {
    return description_ ? &*description_ : nullptr;
  }
  /// Diagonal of the box around the rest positions [m].
  [[nodiscard]] double extent() const { return extent_; }
  /// All bodies at rest at time zero, nothing remembered.
  [[nodiscard]] const State& rest_state() const { return rest_; }
  /// The same where cells have their rest shapes.
  [[nodiscard]] State shape_state() const;

 private:
  friend class WorldBuilder;
  friend class WorldEdit;
  std::vector<Body> bodies_;
  State rest_;
  std::vector<double> shape_;  ///< of a world with contact; else empty
  Isa isa_{};
  Threads threads_;
  Mass mass_;
  FixedDofs fixed_;
  std::vector<std::unique_ptr<ForceModel>> forces_;
  const Contact* contact_ = nullptr;
  RunTimeModels run_time_;
  MemoryPlaces memory_;
  Sparsity sparsity_;
  std::optional<WorldDescription> description_;
  double extent_ = 0.0;
};

}  // namespace tissu
