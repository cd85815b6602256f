#include "resident.h"

#include <fstream>

#if defined(__GLIBC__)
#include <malloc.h>
#include <unistd.h>
#endif

namespace tissu::bench {

double resident_bytes() {
#if defined(__GLIBC__)
  malloc_trim(0);
  std::ifstream pages("/proc/self/statm");
  double size = 0.0;
  double resident = 0.0;
  if (pages >> size >> resident) return resident * static_cast<double>(sysconf(_SC_PAGESIZE));
#endif
  return 0.0;
}

}  // namespace tissu::bench
