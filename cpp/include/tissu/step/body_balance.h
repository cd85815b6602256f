#pragma once

/// What acts on each body in a step, and what the step has left of it.

#include <vector>

#include "tissu/assembly/fixed_dofs.h"
#include "tissu/base/vec.h"
#include "tissu/world/world.h"

namespace tissu {

/// A body that acts little may stand beside one that is heavy: norms over the whole world would not see it.
/// Rows of rotations are left out, as their unit is another.
class BodyBalance {
 public:
  void prepare(const World& world);
  /// What acts from outside: `push` [s] times the force [N], one row for each node.
  void set_external(double push, ConstReals force);
  /// Impulses [N s] at all rows before those of held rows are cleared: of these, reactions count as acting.
  void set_reactions(const FixedDofs& fixed, ConstReals impulses);
  void clear_reactions();
  /// What contacts give, as `set_external` has it.
  void set_contacts(double push, ConstReals force);
  /// On some body the imbalance is more than `floor` [N s] and `share` times what acts there: the largest of
  /// the impulses from outside, of contacts and of reactions, and the change of momentum.
  [[nodiscard]] bool leaves_more(double share, double floor, ConstReals imbalance,
                                 ConstReals momentum_change) const;

 private:
  struct Row {
    std::size_t first = 0;  ///< of its nodes' numbers
    std::size_t count = 0;
    double external = 0.0;   ///< [N s]
    double contacts = 0.0;   ///< [N s]
    double reactions = 0.0;  ///< [N s]
  };
  std::vector<Row> bodies_;
};

}  // namespace tissu
