#pragma once

/// The largest step for which an explicit method is stable.

#include <complex>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "tissu/base/profile.h"
#include "tissu/step/frequency.h"

namespace tissu {

/// What an explicit method multiplies the amplitude of a vibration by in a step of h; `growth` [1/s] is what
/// it may: methods that make every undamped vibration grow have a limit only in that sense.
struct Amplification {
  /// Largest |eigenvalue| of one step of x'' = -omega^2 x - damping x'.
  double (*factor)(double h, double omega, double damping);
  double growth = 0.0;
};

/// The largest h whose factor stays within 1 + growth for the fastest vibration and for the most damped
/// motion [s]; infinite where nothing is stiff or damped.
double largest_stable_step(const Amplification& method, const Vibration& vibration);

/// Eigenvalues of x'' = -omega^2 x - damping x'.
std::pair<std::complex<double>, std::complex<double>> eigenvalues(double omega, double damping);

/// Watches how far a world's cells have been deformed since its vibration was measured.
class StableStep {
 public:
  void prepare(const World& world, Profile& profile);
  /// Something beside the world's forces adds to every vibration: to omega^2 the square of a frequency, and
  /// damping [1/s].
  void stiffen(double frequency, double damping);
  /// The limit at `state`: measured again when it is not known, when something is coupled that was not, or,
  /// looked at every few steps, when an edge of a cell has changed so much of its length that half of what
  /// the steps taken leave of the limit may be gone: by a fiftieth at least, by a twentieth at most.
  double limit(const Amplification& method, const State& state);
  /// The step that is taken below the limit [s].
  void take(double h) { share_ = limit_ > 0.0 ? h / limit_ : 1.0; }
  /// The smallest limit of the last one or two thousand steps, up to the latest `limit`. A step that goes up
  /// and down with the stiffness of a body that vibrates gives it energy, even below each limit: a symplectic
  /// method keeps that of one step only.
  [[nodiscard]] double lasting() const;

  /// The world is stiffer or softer than what was measured: the next limit is measured anew.
  void forget() { limit_ = 0.0; }
  /// Whether nodes of a body go so far beside each other, or turn so far, that a cell may have been turned
  /// inside out.
  [[nodiscard]] bool may_invert(const State& from, const State& to) const;

  void append_memory(std::vector<double>& memory) const;
  void restore(ConstReals memory);

 private:
  /// The largest change of an edge since it was measured, as a share of it; once it is beyond `enough`, any
  /// number that is.
  [[nodiscard]] double deformed(const State& state, double enough) const;
  void look(const Amplification& method, const State& state);
  /// A number that changes with the couplings: which rows, how stiff.
  [[nodiscard]] double coupled(const State& state);
  void measure(const Amplification& method, const State& state);
  void find_shortest();
  /// Lowers the limit to that of everything that is damped less than the fastest vibration.
  void heed_less_damped(const Amplification& method, const State& state, const Vibration& fastest);
  /// The largest stable step of a vibration, with what was added to all of them and without.
  [[nodiscard]] double bearable(const Amplification& method, Vibration vibration) const;

  const World* world_ = nullptr;
  Profile* profile_ = nullptr;
  std::size_t row_ = 0;
  double more_frequency_ = 0.0;
  double more_damping_ = 0.0;
  double limit_ = 0.0;         ///< 0: not known
  double age_ = 0.0;           ///< steps since the lengths were looked at
  double time_ = 0.0;          ///< of the state that was asked about last
  double steps_ = 0.0;         ///< in this thousand
  double least_ = 0.0;         ///< limit in it, …
  double least_before_ = 0.0;  ///< … and in the one before
  double share_ = 1.0;         ///< of the limit that the latest step took
  double sensitivity_ = 1.0;   ///< relative change of the limit over that of an edge, as was found
  std::vector<std::int32_t> edges_;
  std::vector<double> lengths_;
  double shortest_ = 0.0;  ///< of these
  double coupled_ = 0.0;   ///< when it was measured
  Couplings couplings_;
};

}  // namespace tissu
