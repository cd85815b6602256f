#include "contact/pair_sort.h"

#include <array>

namespace tissu {
namespace {

constexpr std::size_t kFew = 64;  ///< numbers whose ranks are counted faster than they are sorted

/// Pairs of a with a few b, all different: the rank of one is how many are smaller. No branch depends on
/// them.
void write_few(std::int32_t a, const std::int32_t* b, std::size_t count, BoxPair* sorted) {
  std::array<std::int32_t, kFew> rank{};
  for (std::size_t j = 0; j < count; ++j) {
    const std::int32_t other = b[j];
    for (std::size_t i = 0; i < count; ++i) rank[i] += other < b[i] ? 1 : 0;
  }
  for (std::size_t i = 0; i < count; ++i) sorted[rank[i]] = {a, b[i]};
}

}  // namespace

void PairSort::sort(std::span<const BoxPair> found, std::int32_t primitives, std::vector<BoxPair>& sorted) {
  sorted.resize(found.size());
  if (found.empty()) return;
  second_.resize(std::max(second_.size(), found.size()));
  end_.assign(static_cast<std::size_t>(primitives) + 1, 0);
  for (const BoxPair& pair : found) ++end_[static_cast<std::size_t>(pair.a) + 1];
  for (std::size_t a = 0; a + 1 < end_.size(); ++a) end_[a + 1] += end_[a];
  for (const BoxPair& pair : found) second_[end_[static_cast<std::size_t>(pair.a)]++] = pair.b;
  std::size_t at = 0;
  for (std::int32_t a = 0; a < primitives; ++a) {
    const std::size_t end = end_[static_cast<std::size_t>(a)];
    std::int32_t* const b = second_.data() + at;
    if (end - at <= kFew) {
      write_few(a, b, end - at, sorted.data() + at);
      at = end;
      continue;
    }
    std::sort(b, second_.data() + end);
    for (; at < end; ++at) sorted[at] = {a, second_[at]};
  }
}

}  // namespace tissu
