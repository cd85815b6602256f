#include "machine.h"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>

#include "loops.h"
#include "tissu/base/array.h"

namespace tissu::bench {
namespace {

constexpr double kTriadBytes = 3.0 * sizeof(double);
constexpr std::size_t kRepeats = 200'000;

/// Three arrays of the triad.
struct Arrays {
  explicit Arrays(std::size_t count) : a(count, 0.0), b(count, 1.0), c(count, 2.0) {}
  AlignedVector<double> a, b, c;
  void run() { machine_kernels(choose_isa()).triad(b.data(), c.data(), 0.5, a.data(), a.size()); }
};

double multiply_adds() {
  double sink[4] = {1.0, 0.999, 0.001, 0.0};
  const double done = machine_kernels(choose_isa()).multiply_adds(kRepeats, sink);
  benchmark::DoNotOptimize(sink[3]);
  return done;
}

/// The shortest time of a call [s] in about 50 ms.
template <class Function>
double shortest(Function&& f) {
  using Clock = std::chrono::steady_clock;
  double best = 1e30;
  const auto end = Clock::now() + std::chrono::milliseconds(50);
  while (Clock::now() < end) {
    const auto start = Clock::now();
    f();
    benchmark::ClobberMemory();
    best = std::min(best, std::chrono::duration<double>(Clock::now() - start).count());
  }
  return best;
}

/// Short triads are repeated, so that the clock does not count.
double triad_rate(std::size_t count) {
  Arrays arrays(count);
  const std::size_t times = std::max<std::size_t>(1, kTriadL3 / count);
  const double seconds = shortest([&] {
    for (std::size_t i = 0; i < times; ++i) arrays.run();
  });
  return static_cast<double>(count * times) * kTriadBytes / seconds;
}

void multiply_add_row(benchmark::State& run) {
  double done = 0.0;
  for (auto _ : run) done += multiply_adds();
  run.counters["GFLOP/s"] = benchmark::Counter(done * 1e-9, benchmark::Counter::kIsRate);
}

void triad_row(benchmark::State& run) {
  Arrays arrays(static_cast<std::size_t>(run.range(0)));
  for (auto _ : run) {
    arrays.run();
    benchmark::ClobberMemory();
  }
  run.counters["GB/s"] = benchmark::Counter(static_cast<double>(run.range(0)) * kTriadBytes * 1e-9,
                                            benchmark::Counter::kIsIterationInvariantRate);
}

}  // namespace

MachineKernels machine_kernels(Isa isa) {
#if defined(__x86_64__)
  if (isa == Isa::avx512) return avx512::machine_loops();
  if (isa == Isa::avx2) return avx2::machine_loops();
#endif
  (void)isa;
  return baseline::machine_loops();
}

double Limits::bandwidth(double bytes) const {
  if (bytes <= kTriadBytes * kTriadL2) return l2;
  return bytes <= 2.0 * kTriadBytes * kTriadL3 ? l3 : memory;
}

const Limits& limits() {
  static const Limits measured = [] {
    const double seconds = shortest([] { (void)multiply_adds(); });
    return Limits{multiply_adds() / seconds, triad_rate(kTriadL2), triad_rate(kTriadL3),
                  triad_rate(kTriadMemory)};
  }();
  return measured;
}

void add_limit_rows() {
  benchmark::RegisterBenchmark("limit/multiply-add", multiply_add_row);
  const std::pair<const char*, std::size_t> triads[] = {{"limit/triad from L2", kTriadL2},
                                                        {"limit/triad from L3", kTriadL3},
                                                        {"limit/triad from memory", kTriadMemory}};
  for (const auto& [name, count] : triads) {
    benchmark::RegisterBenchmark(name, triad_row)->Arg(static_cast<std::int64_t>(count));
  }
}

}  // namespace tissu::bench
