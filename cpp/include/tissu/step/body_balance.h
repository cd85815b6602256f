#pragma once

/// What acts on each body in a step, and what the step has left of it.

#include <vector>

#include "tissu/assembly/fixed_dofs.h"
#include "tissu/base/vec.h"
#include "tissu/world/world.h"

namespace tissu {

/// A body that acts little may stand beside one that is heavy: norms over the whole world would not see it.
/// What accelerates a free body as a whole, as weight does, neither turns nor strains it, and does not count.
/// Rows of rotations are left out, as their unit is another.
class BodyBalance {
 public:
  void prepare(const World& world);  ///< which has to stay where it is
  /// What acts from outside: `push` [s] times the force [N], one row for each node.
  void set_external(double push, ConstReals force);
  /// Impulses [N s] at all rows before those of held rows are cleared: of these, reactions count as acting.
  void set_reactions(const FixedDofs& fixed, ConstReals impulses);
  void clear_reactions();
  /// What contacts give, as `set_external` has it.
  void set_contacts(double push, ConstReals force);
  /// Of what acts on a body: more than that is much.
  struct Shares {
    double held = 1.0;  ///< on bodies that are held somewhere
    double free = 1.0;
  };
  /// On some body the imbalance is more than `floor` [N s] and that share of what acts there: the largest of
  /// the impulses from outside, of contacts and of reactions, and the change of momentum.
  [[nodiscard]] bool leaves_more(Shares shares, double floor, ConstReals imbalance,
                                 ConstReals momentum_change) const;

 private:
  struct Row {
    std::size_t first = 0;  ///< of its nodes' numbers
    std::size_t count = 0;
    double mass = 0.0;       ///< [kg] of a body that is free; zero of one that is held somewhere
    double external = 0.0;   ///< [N s]
    double contacts = 0.0;   ///< [N s]
    double reactions = 0.0;  ///< [N s]
  };
  /// The norm of impulses of a body without what accelerates it as a whole.
  [[nodiscard]] double norm_of(const Row& body, ConstReals impulses) const;

  const World* world_ = nullptr;
  std::vector<Row> bodies_;
};

}  // namespace tissu
