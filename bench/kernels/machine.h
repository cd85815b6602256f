#pragma once

/// What the machine can do at most, measured beside the kernels: multiply-adds from registers, and the triad
/// a = b + s c from every level of memory.

#include <cstddef>

#include "tissu/base/isa.h"

namespace tissu::bench {

/// The loops of one instruction set.
struct MachineKernels {
  /// `repeats` times twelve independent multiply-adds of a batch; returns their number of operations.
  double (*multiply_adds)(std::size_t repeats, double* sink);
  void (*triad)(const double* b, const double* c, double s, double* a, std::size_t count);
};
MachineKernels machine_kernels(Isa isa);

/// The best of many short tries, each part on all of the threads at once.
struct Limits {
  int threads;
  double flops;   ///< [1/s], a multiply-add counts two
  double l2;      ///< [bytes/s] of the triad, the store counted once
  double l3;      ///< [bytes/s]
  double memory;  ///< [bytes/s]

  /// The rate at which a working set of so many bytes can be read.
  [[nodiscard]] double bandwidth(double bytes) const;
};
/// Measured on the first call for one thread, and for two.
const Limits& limits(int threads = 1);

/// Doubles in one array of the triad that stays in L2 (of each thread, which has its own), in L3, in memory.
inline constexpr std::size_t kTriadL2 = std::size_t{12} << 10;
inline constexpr std::size_t kTriadL3 = std::size_t{256} << 10;
inline constexpr std::size_t kTriadMemory = std::size_t{8} << 20;

/// How long a row of this folder is measured at least [s]: there are hundreds.
inline constexpr double kMinTime = 0.05;

/// Adds the rows "limit/..." of one thread and "limit/..., 2 threads".
void add_limit_rows();

}  // namespace tissu::bench
