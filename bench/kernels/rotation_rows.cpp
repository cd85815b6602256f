#include "rotation_rows.h"

#include <benchmark/benchmark.h>

#include <memory>
#include <random>
#include <string>
#include <vector>

#include "base/kernel_choice.h"
#include "loops.h"
#include "machine.h"
#include "tissu/base/array.h"
#include "tissu/base/isa.h"
#include "tissu/base/vec.h"

namespace tissu::bench {
namespace {

constexpr std::size_t kLanes = 8;

RotationKernels kernels() { return TISSU_KERNELS_OF(choose_isa(), rotation_loops()); }

/// Turned any way and deformed by some ten percent; every eighth is flat where that is asked for.
AlignedVector<double> gradients(std::size_t groups, bool flat) {
  std::mt19937 engine(1);
  const auto number = [&] { return 2.0 * static_cast<double>(engine()) / 4294967296.0 - 1.0; };
  AlignedVector<double> F(groups * 9 * kLanes);
  for (std::size_t i = 0; i < groups * kLanes; ++i) {
    Quaternion turn(number(), number(), number(), number());
    turn.normalize();
    Mat3 U = Mat3::Identity();
    for (Eigen::Index k = 0; k < 9; ++k) U.data()[k] += 0.1 * number();
    if (flat && i % kLanes == 0) U.col(0).setZero();
    const Mat3 made = turn.toRotationMatrix() * U;
    for (std::size_t k = 0; k < 9; ++k) {
      F[i / kLanes * 9 * kLanes + k * kLanes + i % kLanes] =
          made(static_cast<Eigen::Index>(k / 3), static_cast<Eigen::Index>(k % 3));
    }
  }
  return F;
}

void rotation(benchmark::State& run, const RotationRow& row, int count) {
  using benchmark::Counter;
  const std::size_t groups = static_cast<std::size_t>(count) / kLanes;
  const AlignedVector<double> F = gradients(groups, row.flat);
  AlignedVector<double> R(F.size(), 0.0);
  for (auto _ : run) {
    row.run(F.data(), groups, R.data());
    benchmark::ClobberMemory();
  }
  constexpr auto kRate = Counter::kIsIterationInvariantRate;
  const auto elements = static_cast<double>(groups * kLanes);
  const auto bytes = static_cast<double>((F.size() + R.size()) * sizeof(double));
  run.counters["elements"] = elements;
  run.counters["elements/s"] = Counter(elements, kRate);
  run.counters["of bandwidth"] = Counter(bytes / limits().bandwidth(bytes), kRate);
  if (row.operations == 0.0) return;
  run.counters["flop/element"] = row.operations;
  run.counters["of peak"] = Counter(row.operations * elements / limits().flops, kRate);
}

}  // namespace

void add_rotation_rows(int count) {
  for (const RotationRow& row : kernels()) {
    benchmark::RegisterBenchmark((std::string("rotation/") + row.name).c_str(), [=](benchmark::State& run) {
      rotation(run, row, count);
    })->MinTime(kMinTime);
  }
}

}  // namespace tissu::bench
