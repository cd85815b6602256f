#pragma once

/// Equilibrium of bodies that touch: what finds it at one share of a load.

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "tissu/contact/implicit_contact.h"
#include "tissu/step/equilibrium.h"

namespace tissu {

class StaticContact {
 public:
  /// By the method of contact that the world has.
  static std::unique_ptr<StaticContact> make(Equilibrium& equilibrium, Profile& profile);
  virtual ~StaticContact() = default;
  StaticContact(const StaticContact&) = delete;
  StaticContact& operator=(const StaticContact&) = delete;

  /// The largest part of a path on which no obstacle is led by more than half a mean edge.
  [[nodiscard]] double largest_part(const LoadPath& path, const State& start) const;
  /// Equilibrium at the share `to`, from `state`, which stands at the share `from`; at most `most` of
  /// Newton's iterations. False: none was found, `reason` says why, and the state is undefined.
  bool find(const LoadPath& path, double from, double to, int most, State& state, StepReport& report);
  [[nodiscard]] const std::string& reason() const { return reason_; }
  /// Whether it gave up because its search did not end.
  [[nodiscard]] bool found_no_end() const { return found_no_end_; }
  /// Whether the state that was found is a saddle of the energy of what does not rub.
  [[nodiscard]] bool is_unstable() const { return is_unstable_; }

 protected:
  StaticContact(Equilibrium& equilibrium, Profile& profile, ContactMethod method);

  /// Of `find`, after which errors are reasons.
  virtual bool seek(const LoadPath& path, double from, double to, int most, State& state,
                    StepReport& report) = 0;
  /// What is led goes where it stands at the share `to`, and pushes what is in its way. `held_` is `state`
  /// with its led rows there; contact knows the matrix of `state` without contacts.
  void begin(const LoadPath& path, double from, double to, State& state);
  double look(const State& at);
  int hold_back(State& to);
  /// So much of the mass stands beside the tangent that no node feels it beside its own stiffness.
  void measure_mass();
  /// `no_end`: the search did not end; an equilibrium may exist all the same.
  bool give_up(std::string_view why, bool no_end = false);
  [[nodiscard]] const World& world() const { return equilibrium_.world(); }
  [[nodiscard]] static std::string_view moves_on();

  Equilibrium& equilibrium_;
  Profile& profile_;
  std::unique_ptr<ImplicitContact> contact_;
  State start_;    ///< of the part, at the time at which what is led stands there
  State held_;     ///< to where no way is cut
  bool is_loose_;  ///< there are bodies, or separate parts, that supports do not hold
  bool is_unstable_ = false;
  double farthest_ = 0.0;  ///< that a loose body goes at once [m]
  std::vector<double> blocks_;
  std::vector<double> way_;

 private:
  std::string reason_;
  bool found_no_end_ = false;
  std::size_t detection_row_;
  std::size_t travel_row_;
};

}  // namespace tissu
