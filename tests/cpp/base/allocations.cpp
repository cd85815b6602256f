#include "allocations.h"

#include <cstdlib>

namespace tissu::test {

constinit std::atomic<bool> counting{false};
constinit std::atomic<long> allocations{0};

#ifdef TISSU_COUNTS_ALLOCATIONS
namespace {
void note() {
  if (counting.load(std::memory_order_relaxed)) allocations.fetch_add(1, std::memory_order_relaxed);
}
}  // namespace
#endif

}  // namespace tissu::test

#ifdef TISSU_COUNTS_ALLOCATIONS
// The C library's own allocators, under the names that it keeps for programs that put themselves before them.
extern "C" {
void* __libc_malloc(std::size_t size);                           // NOLINT(bugprone-reserved-identifier)
void* __libc_calloc(std::size_t count, std::size_t size);        // NOLINT(bugprone-reserved-identifier)
void* __libc_realloc(void* old, std::size_t size);               // NOLINT(bugprone-reserved-identifier)
void* __libc_memalign(std::size_t alignment, std::size_t size);  // NOLINT(bugprone-reserved-identifier)

[[gnu::visibility("default")]] void* malloc(std::size_t size) {
  tissu::test::note();
  return __libc_malloc(size);
}
[[gnu::visibility("default")]] void* calloc(std::size_t count, std::size_t size) {
  tissu::test::note();
  return __libc_calloc(count, size);
}
[[gnu::visibility("default")]] void* realloc(void* old, std::size_t size) {
  tissu::test::note();
  return __libc_realloc(old, size);
}
[[gnu::visibility("default")]] void* aligned_alloc(std::size_t alignment, std::size_t size) {
  tissu::test::note();
  return __libc_memalign(alignment, size);
}
}
#endif
