#include "machine.h"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <ctime>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

#include "base/kernel_choice.h"
#include "loops.h"
#include "tissu/base/array.h"
#include "tissu/base/parallel.h"

namespace tissu::bench {
namespace {

constexpr double kTriadBytes = 3.0 * sizeof(double);
constexpr std::size_t kRepeats = 200'000;
constexpr std::chrono::milliseconds kSearch{
    200};  ///< for each limit, so that one try at least is undisturbed

/// Three arrays of the triad, of which every thread has a part of its own.
class Triad {
 public:
  Triad(std::size_t count, int threads)
      : threads_(threads),
        part_(count / static_cast<std::size_t>(threads) / 8 * 8),
        a_(count, 0.0),
        b_(count, 1.0),
        c_(count, 2.0) {}
  /// Several times in one go, so that neither the clock nor the start of the threads counts.
  void run(std::size_t times) {
    threads_.for_each(threads_.count(), [&](std::int32_t thread) {
      const std::size_t begin = part_ * static_cast<std::size_t>(thread);
      for (std::size_t i = 0; i < times; ++i) {
        machine_kernels(choose_isa())
            .triad(b_.data() + begin, c_.data() + begin, 0.5, a_.data() + begin, part_);
      }
    });
  }
  /// Moved by one time of a run.
  [[nodiscard]] double bytes() const { return static_cast<double>(part_) * threads_.count() * kTriadBytes; }

 private:
  Threads threads_;
  std::size_t part_;
  AlignedVector<double> a_, b_, c_;
};

/// A short triad is repeated until it is as long as that of L3.
std::size_t times_of(std::size_t count) { return std::max<std::size_t>(1, kTriadL3 / count); }

/// Operations done on all threads together.
double multiply_adds(int threads) {
  struct alignas(kCacheLine) Sink {
    double values[4] = {1.0, 0.999, 0.001, 0.0};
  };
  std::vector<Sink> sinks(static_cast<std::size_t>(threads));
  std::vector<double> done(static_cast<std::size_t>(threads));
  Threads(threads).for_each(threads, [&](std::int32_t thread) {
    const auto i = static_cast<std::size_t>(thread);
    done[i] = machine_kernels(choose_isa()).multiply_adds(kRepeats, sinks[i].values);
  });
  benchmark::DoNotOptimize(sinks.data());
  return std::accumulate(done.begin(), done.end(), 0.0);
}

/// Seconds of the processor for one thread, whom others may keep waiting, and by the clock for several.
double now(int threads) {
  std::timespec time{};
  (void)clock_gettime(threads == 1 ? CLOCK_THREAD_CPUTIME_ID : CLOCK_MONOTONIC, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

/// The shortest time of a call [s].
template <class Function>
double shortest(int threads, Function&& f) {
  double best = 1e30;
  const auto end = std::chrono::steady_clock::now() + kSearch;
  while (std::chrono::steady_clock::now() < end) {
    const double start = now(threads);
    f();
    benchmark::ClobberMemory();
    best = std::min(best, now(threads) - start);
  }
  return best;
}

double triad_rate(std::size_t count, int threads) {
  Triad triad(count, threads);
  const std::size_t times = times_of(count);
  return static_cast<double>(times) * triad.bytes() / shortest(threads, [&] { triad.run(times); });
}

Limits measured(int threads) {
  const double seconds = shortest(threads, [&] { (void)multiply_adds(threads); });
  return {threads, multiply_adds(threads) / seconds,
          triad_rate(kTriadL2 * static_cast<std::size_t>(threads), threads), triad_rate(kTriadL3, threads),
          triad_rate(kTriadMemory, threads)};
}

void multiply_add_row(benchmark::State& run, int threads) {
  double done = 0.0;
  for (auto _ : run) done += multiply_adds(threads);
  run.counters["GFLOP/s"] = benchmark::Counter(done * 1e-9, benchmark::Counter::kIsRate);
}

void triad_row(benchmark::State& run, int threads) {
  const auto count = static_cast<std::size_t>(run.range(0));
  Triad triad(count, threads);
  const std::size_t times = times_of(count);
  for (auto _ : run) {
    triad.run(times);
    benchmark::ClobberMemory();
  }
  run.counters["GB/s"] = benchmark::Counter(static_cast<double>(times) * triad.bytes() * 1e-9,
                                            benchmark::Counter::kIsIterationInvariantRate);
}

}  // namespace

MachineKernels machine_kernels(Isa isa) { return TISSU_KERNELS_OF(isa, machine_loops()); }

double Limits::bandwidth(double bytes) const {
  if (bytes <= kTriadBytes * kTriadL2 * threads) return l2;
  return bytes <= 2.0 * kTriadBytes * kTriadL3 ? l3 : memory;
}

const Limits& limits(int threads) {
  if (threads == 1) {
    static const Limits one = measured(1);
    return one;
  }
  static const Limits two = measured(2);
  return two;
}

void add_limit_rows() {
  for (const int threads : {1, 2}) {
    const std::string on = threads == 1 ? "" : ", 2 threads";
    std::vector<benchmark::internal::Benchmark*> rows;
    rows.push_back(benchmark::RegisterBenchmark(
        ("limit/multiply-add" + on).c_str(), [=](benchmark::State& run) { multiply_add_row(run, threads); }));
    const std::pair<std::string, std::size_t> triads[] = {
        {"limit/triad from L2", kTriadL2 * static_cast<std::size_t>(threads)},
        {"limit/triad from L3", kTriadL3},
        {"limit/triad from memory", kTriadMemory}};
    for (const auto& [name, count] : triads) {
      rows.push_back(benchmark::RegisterBenchmark((name + on).c_str(),
                                                  [=](benchmark::State& run) { triad_row(run, threads); }));
      rows.back()->Arg(static_cast<std::int64_t>(count));
    }
    if (threads == 1) continue;
    for (auto* row : rows) row->UseRealTime();
  }
}

}  // namespace tissu::bench
