#pragma once

/// What acts on each connected part in a step, and what the step has left of it on each body.

#include <vector>

#include "tissu/base/vec.h"
#include "tissu/step/parts.h"
#include "tissu/world/world.h"

namespace tissu {

/// A body on which little acts may stand beside one that is heavy: norms over the whole world would not see
/// it. What accelerates a part of a free body as a whole, as weight does, neither turns nor strains it, and
/// does not count. A body is held if one of its parts is: what was cut off it is judged with the rest. Rows
/// of rotations are left out, as their unit is another.
class PartBalance {
 public:
  void prepare(const World& world);  ///< which has to stay where it is
  [[nodiscard]] const std::vector<ConnectedPart>& parts() const { return parts_; }
  /// What acts from outside: `push` [s] times the force [N], one row for each node; neither contacts nor
  /// reactions act yet.
  void set_external(double push, ConstReals force);
  /// What contacts give, in the same way.
  void set_contacts(double push, ConstReals force);
  /// Velocities of supports against the mean of those of their part, which strain it: zero in all other rows.
  void lay_strained(ConstReals given, Reals out) const;
  /// The impulses [N s] of supports at the start of the step, and what such strains add to them in it: of
  /// held rows, the smaller of their norms acts. A drift strains nothing, whatever the supports bear.
  void set_reactions(ConstReals reactions, ConstReals strained);
  /// Of what acts on a body: more than that is much.
  struct Shares {
    double held = 1.0;  ///< on bodies that are held somewhere
    double free = 1.0;
  };
  /// On some body the imbalance is more than `floor` [N s] and that share of what acts there.
  [[nodiscard]] bool leaves_more(Shares shares, double floor, ConstReals imbalance,
                                 ConstReals momentum_change) const;
  /// On a part: the largest of the impulses from outside, of contacts and of reactions, and the change of
  /// momentum [N s].
  [[nodiscard]] double acting(std::size_t part, ConstReals momentum_change) const;

 private:
  /// Squares of norms [N^2 s^2].
  struct Acting {
    double external = 0.0;
    double contacts = 0.0;
    double reactions = 0.0;
    double momentum = 0.0;
    [[nodiscard]] double norm() const;  ///< of the largest [N s]
  };
  struct OfBody {
    std::vector<std::size_t> parts;
    bool is_held = false;
  };
  [[nodiscard]] Acting all_acting(std::size_t part, ConstReals momentum_change) const;
  /// The square of the norm of impulses on a part, on a free body without what accelerates it as a whole.
  [[nodiscard]] double square_of(std::size_t part, ConstReals impulses) const;

  const World* world_ = nullptr;
  std::vector<ConnectedPart> parts_;
  std::vector<Acting> acting_;      ///< on each
  std::vector<char> on_held_body_;  ///< each
  std::vector<OfBody> bodies_;
};

}  // namespace tissu
