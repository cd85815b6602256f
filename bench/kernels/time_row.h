#pragma once

#include <benchmark/benchmark.h>

namespace tissu::bench {

/// Makes a row measure for at least so long [s]: by the clock where there are several threads, while one
/// thread is judged by the processor time that it had, whatever else the machine does.
inline void time_row(benchmark::internal::Benchmark* row, int threads, double seconds) {
  row->MinTime(seconds);
  if (threads > 1) row->UseRealTime();
}

}  // namespace tissu::bench
