#include "ascending_memory.h"

#include <sys/mman.h>

#include <algorithm>
#include <cstddef>
#include <cstdlib>
#include <new>

namespace tissu::effects {
namespace {

constexpr std::size_t kReserved = std::size_t{8} << 30U;  ///< addresses; memory is taken when it is touched
constexpr std::size_t kPage = 4096;
constexpr std::size_t kSmall = 256;  ///< bytes: copies of so few do not look where they begin

std::byte* begin = nullptr;
std::byte* next = nullptr;

void* take(std::size_t size, std::size_t alignment) {
  size = std::max<std::size_t>(size, 1);
  if (begin != nullptr) {
    if (size > kSmall) alignment = std::max(alignment, kPage);
    const auto offset = static_cast<std::size_t>(next - begin);
    const std::size_t at = (offset + alignment - 1) / alignment * alignment;
    if (at + size > kReserved) throw std::bad_alloc();
    next = begin + at + size;
    return begin + at;
  }
  void* block = std::aligned_alloc(alignment, (size + alignment - 1) / alignment * alignment);
  if (block == nullptr) throw std::bad_alloc();
  return block;
}

void give(void* block) {
  auto* const byte = static_cast<std::byte*>(block);
  if (begin == nullptr || byte < begin || byte >= begin + kReserved) std::free(block);
}

}  // namespace

void let_memory_ascend() {
  void* const reserved =
      mmap(nullptr, kReserved, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
  if (reserved == MAP_FAILED) throw std::bad_alloc();
  begin = next = static_cast<std::byte*>(reserved);
}

}  // namespace tissu::effects

void* operator new(std::size_t size) { return tissu::effects::take(size, __STDCPP_DEFAULT_NEW_ALIGNMENT__); }
void* operator new(std::size_t size, std::align_val_t alignment) {
  return tissu::effects::take(size, static_cast<std::size_t>(alignment));
}
void operator delete(void* block) noexcept { tissu::effects::give(block); }
void operator delete(void* block, std::size_t /*size*/) noexcept { tissu::effects::give(block); }
void operator delete(void* block, std::align_val_t /*alignment*/) noexcept { tissu::effects::give(block); }
void operator delete(void* block, std::size_t /*size*/, std::align_val_t /*alignment*/) noexcept {
  tissu::effects::give(block);
}
