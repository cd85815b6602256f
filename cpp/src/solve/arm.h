#pragma once

/// The ways that the automatic solver has, and what each costs.

#include <array>
#include <cstddef>
#include <string_view>

namespace tissu {

/// A conjugate gradient with one of four preconditioners, or a factor of the matrix itself.
enum class Arm : unsigned char { block_jacobi, incomplete_cholesky, multigrid, stale_cholesky, cholesky };
inline constexpr std::size_t kArms = 5;
inline constexpr std::array<Arm, kArms> kAllArms = {Arm::block_jacobi, Arm::incomplete_cholesky,
                                                    Arm::multigrid, Arm::stale_cholesky, Arm::cholesky};

template <class T>
using ForArms = std::array<T, kArms>;
inline std::size_t number(Arm arm) { return static_cast<std::size_t>(arm); }
/// As a scene names it.
std::string_view name_of(Arm arm);

/// Work (work.h) of an arm: predicted, or counted where it was used.
struct Cost {
  double making = 0.0;   ///< of a preconditioner or a factor, …
  double share = 0.0;    ///< … which so many solves need anew, 0 to 1
  double solving = 0.0;  ///< the rest of a solve
  double once = 0.0;     ///< of what a new pattern asks for: an ordering, aggregates

  [[nodiscard]] double rate() const { return solving + share * making; }
  [[nodiscard]] double first() const { return solving + making + once; }
};

}  // namespace tissu
