#pragma once

/// Parallel loops whose result does not depend on the number of threads: the work is cut into the same pieces
/// whatever that number is, and what the pieces give is put together in the order of the pieces.

#include <algorithm>
#include <cstdint>
#include <type_traits>
#include <vector>

namespace tissu {

class Threads {
 public:
  explicit Threads(int count = 1) : count_(count < 1 ? 1 : count) {}
  [[nodiscard]] int count() const { return count_; }

  /// f(i) for i in [0, count). The calls must not touch each other's data.
  template <class Function>
  void for_each(std::int32_t count, Function&& f) const {
    if (count_ == 1 || count < 2) {
      for (std::int32_t i = 0; i < count; ++i) f(i);
      return;
    }
    using Called = std::remove_reference_t<Function>;
    share(
        count_, count, [](void* called, std::int32_t i) { (*static_cast<Called*>(called))(i); },
        const_cast<void*>(static_cast<const void*>(&f)));  // NOLINT(cppcoreguidelines-pro-type-const-cast)
  }

  /// f(begin, end) over [0, count) in pieces. How long they are depends on the number of threads, so that
  /// all of them have work until the end: nothing that f gives may depend on where a piece begins.
  template <class Function>
  void for_pieces(std::int32_t count, Function&& f) const {
    const std::int32_t size =
        count_ == 1 ? kPiece : std::clamp(count / (kShares * count_) + 1, kLeast, kPiece);
    for_each((count + size - 1) / size,
             [&](std::int32_t p) { f(p * size, std::min(count, (p + 1) * size)); });
  }

  /// The sum of f(begin, end) over the pieces of [0, count), added in their order. `partial` is scratch.
  template <class Function>
  double sum(std::int32_t count, std::vector<double>& partial, Function&& f) const {
    const std::int32_t n = pieces(count);
    if (partial.size() < static_cast<std::size_t>(n)) partial.resize(static_cast<std::size_t>(n));
    for_each(
        n, [&](std::int32_t p) { partial[static_cast<std::size_t>(p)] = f(begin_of(p), end_of(p, count)); });
    double total = 0.0;
    for (std::int32_t p = 0; p < n; ++p) total += partial[static_cast<std::size_t>(p)];
    return total;
  }

  static constexpr std::int32_t kPiece = 512;  ///< rows of one piece of a sum; part of the result's bits
  static constexpr std::int32_t pieces(std::int32_t count) { return (count + kPiece - 1) / kPiece; }
  static constexpr std::int32_t begin_of(std::int32_t piece) { return piece * kPiece; }
  static constexpr std::int32_t end_of(std::int32_t piece, std::int32_t count) {
    return piece * kPiece + kPiece < count ? piece * kPiece + kPiece : count;
  }

 private:
  /// call(called, i) for i in [0, count), shared out over threads that all loops of the process have in
  /// common, or on the thread that calls where another loop has them.
  static void share(int threads, std::int32_t count, void (*call)(void*, std::int32_t), void* called);
  static constexpr std::int32_t kShares = 4;  ///< pieces of a loop that each thread has, at least …
  static constexpr std::int32_t kLeast = 64;  ///< … if they are not shorter than this
  int count_;
};

/// Processors that this process may run on.
int available_threads();

}  // namespace tissu
