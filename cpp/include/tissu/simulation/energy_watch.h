#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "tissu/step/state_mark.h"
#include "tissu/world/world.h"

namespace tissu {

struct Energy {
  double kinetic = 0.0;
  double elastic = 0.0;
  double potential = 0.0;  ///< of gravity and loads
  [[nodiscard]] double total() const { return kinetic + elastic + potential; }
};

Energy energy_of(const World& world, const State& state, Scratch& scratch);

/// Watches the energy of a scene in which nothing can add any while it steps: no led nodes, no pressure, no
/// load that changes with time, no material that remembers, no obstacle that is led. Grabs and links, which
/// change between steps alone, are springs whose energy counts. A method that gives a moving body more energy
/// than it had is not stable there, however well its steps converge. Contacts give a little: what is inside
/// its gap comes out of it, in a step at the soonest.
class EnergyWatch {
 public:
  /// Whether energy can only be kept or lost in that world.
  static bool can_watch(const World& world);
  /// Whether damping may give energy to a body that turns freely (ForceModel::may_drive_turns).
  static bool may_be_driven(const World& world);

  /// Before and after a step. What is written into the state between two steps, into its memory too, is no
  /// gain; what it takes away, as a release of a stretched grab does, may be what was gained before.
  void begin(const World& world, const State& state);
  void end(const World& world, const State& state);
  /// The latest end did not come: that step was refused.
  void take_back();
  /// In steps of h contacts may give that much: M (gap / h)^2 of the whole mass and the widest gap.
  void allow_contacts(const World& world, double h);
  /// A growth of less than the whole mass has that goes 1e-10 of the scene's extent in a step of h is that of
  /// round-off: a grab of a body at rest has its point where the target is, to the last digit but one.
  void ignore_round_off(const World& world, double h);
  /// The energy gained since the first step, less what contacts may give, over the largest kinetic and
  /// elastic energy before it grew, or over what contacts may give or what is ignored, if that is more.
  [[nodiscard]] double growth() const {
    const double whole = std::max({largest_, allowed_, ignored_});
    return whole > 0.0 ? (gained_ - allowed_) / whole : 0.0;
  }

  /// The same of a gain in a share of the step, in which contacts come out of their gap faster.
  [[nodiscard]] double growth_by(double gain, double share) const {
    const double allowed = allowed_ / (share * share);
    const double whole = std::max({largest_, allowed, ignored_});
    return whole > 0.0 ? (gain - allowed) / whole : 0.0;
  }

  /// Four numbers with which another watch goes on from `state`: the three sums, and whether the latest step
  /// ended there …
  [[nodiscard]] std::vector<double> reference(const State& state) const;
  static constexpr std::size_t kReferences = 4;
  /// … and back.
  void restore(ConstReals reference, const State& state);

  static constexpr double kReported = 0.1;  ///< growth above which a step is reported as not converged, …
  static constexpr double kRefused = 10.0;  ///< … and above which the simulation has diverged
  /// A sentence for a growth above the share that is reported.
  [[nodiscard]] std::string say(const World& world) const;

 private:
  [[nodiscard]] bool is_end(const State& state) const;
  void set_end(const State& state);

  Scratch scratch_;
  StateMark end_;       ///< of the latest step
  Memory memory_;       ///< there: a load that was changed since has another energy
  double total_ = 0.0;  ///< energy there, or at the start of this one
  double gained_ = 0.0;
  double largest_ = 0.0;
  double gained_before_ = 0.0;   ///< the latest end
  double largest_before_ = 0.0;  ///< … too
  double allowed_ = 0.0;         ///< that contacts may give
  double ignored_ = 0.0;
};

}  // namespace tissu
