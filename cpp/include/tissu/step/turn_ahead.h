#pragma once

/// Where turning parts go by themselves in a step.

#include <vector>

#include "tissu/step/part_balance.h"

namespace tissu {

/// How a method comes to the base of its equation from the start of the step,
///   x + velocity x' + acceleration x'' + way (x - x(-since)).
struct Past {
  double velocity = 0.0;      ///< [s]
  double acceleration = 0.0;  ///< [s2]
  double way = 0.0;
  double since = 0.0;  ///< [s]
};

/// What is linear in the displacements of a step strains a part that turns by an angle a, by a^2 / 2. So
/// forces are linearised where the part stands if it goes on as a rigid body: its strains are those of the
/// start of the step there, and what is left is of second order in what deforms it further or changes its
/// spin.
class TurnAhead {
 public:
  void prepare(const World& world, const PartBalance& balance);  ///< which have to stay where they are
  /// A step that ends at the time `end`, with an equation at the time of `base`, where velocities lead from
  /// the base in `move` seconds: at the end, or half-way on straight lines.
  struct Way {
    const State& start;
    const State& base;
    double move;
    double end;
    Past past;
  };
  /// Moves parts that turn on from the start: `at` is the base with these parts on their way, `ahead` the
  /// velocities that lead from the base to `at`, zero where nothing turns, and v the guess that leads to `at`
  /// and on as the part deforms. `given` has the velocities of supports. `rigid` are the velocities that the
  /// method gives to a part which goes on, and has come, as a rigid body; empty: they are not needed. False:
  /// nothing turns, and nothing was written.
  bool lay(const Way& way, ConstReals given, State& at, std::vector<double>& ahead, std::vector<double>& v,
           Reals rigid) const;

 private:
  const World* world_ = nullptr;
  const PartBalance* balance_ = nullptr;
  std::vector<std::size_t> turning_;  ///< parts that supports allow a rotation
};

}  // namespace tissu
