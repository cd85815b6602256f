#include "loops.h"
#include "tissu/base/batch.h"
#include "tissu/law/tensor.h"

namespace tissu::TISSU_KERNELS {
namespace {

/// Enough to fill two units with a latency of four cycles.
constexpr int kChains = 12;

double multiply_adds(std::size_t repeats, double* sink) {
  Batch chain[kChains];
  for (int i = 0; i < kChains; ++i) chain[i] = Batch(sink[0] + i);
  const Batch factor(sink[1]);
  const Batch shift(sink[2]);
  for (std::size_t r = 0; r < repeats; ++r) {
    TISSU_UNROLL
    for (int i = 0; i < kChains; ++i) chain[i] = chain[i] * factor + shift;
  }
  Batch sum(0.0);
  for (int i = 0; i < kChains; ++i) sum += chain[i];
  for (int lane = 0; lane < kWidth; ++lane) sink[3] += sum[lane];
  return static_cast<double>(repeats) * kChains * kWidth * 2.0;
}

void triad(const double* b, const double* c, double s, double* a, std::size_t count) {
  const Batch factor(s);
  for (std::size_t i = 0; i < count; i += 8) {
    TISSU_UNROLL
    for (std::size_t k = 0; k < 8; k += kWidth) {
      (Batch::load(b + i + k) + factor * Batch::load(c + i + k)).store(a + i + k);
    }
  }
}

}  // namespace

bench::MachineKernels machine_loops() { return {&multiply_adds, &triad}; }

}  // namespace tissu::TISSU_KERNELS
