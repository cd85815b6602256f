#include "tissu/base/parallel.h"

#ifdef _OPENMP
#include <omp.h>
#endif

namespace tissu {

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

}  // namespace tissu
