#include "tissu/base/parallel.h"

#ifdef TISSU_STD_THREADS
#include <algorithm>
#include <thread>
#elif defined(_OPENMP)
#include <omp.h>
#endif

namespace tissu {

#ifdef TISSU_STD_THREADS

/// The same shares as OpenMP's static schedule, on threads that are made and joined for each loop: slow, but
/// a thread sanitizer knows what comes before what.
void Threads::share(int threads, std::int32_t count, void (*call)(void*, std::int32_t), void* called) {
  const auto run = [=](std::int32_t begin, std::int32_t end) {
    for (std::int32_t i = begin; i < end; ++i) call(called, i);
  };
  const std::int32_t each = (count + threads - 1) / threads;
  std::vector<std::jthread> others;
  for (std::int32_t begin = each; begin < count; begin += each) {
    others.emplace_back(run, begin, std::min(begin + each, count));
  }
  run(0, std::min(each, count));
}

int available_threads() { return std::max(1, static_cast<int>(std::thread::hardware_concurrency())); }

#else

void Threads::share(int threads, std::int32_t count, void (*call)(void*, std::int32_t), void* called) {
#ifdef _OPENMP
#pragma omp parallel for schedule(static) num_threads(threads)
#else
  (void)threads;
#endif
  for (std::int32_t i = 0; i < count; ++i) call(called, i);
}

int available_threads() {
#ifdef _OPENMP
  return omp_get_num_procs();
#else
  return 1;
#endif
}

#endif

}  // namespace tissu
