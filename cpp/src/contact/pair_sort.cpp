#include "contact/pair_sort.h"

namespace tissu {
namespace {

constexpr std::ptrdiff_t kFew = 32;  ///< numbers that insertion sorts faster

void sort_few(std::int32_t* begin, const std::int32_t* end) {
  for (std::int32_t* at = begin + 1; at < end; ++at) {
    const std::int32_t moved = *at;
    std::int32_t* to = at;
    for (; to > begin && to[-1] > moved; --to) *to = to[-1];
    *to = moved;
  }
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
    std::int32_t* const low = second_.data() + at;
    std::int32_t* const high = second_.data() + end;
    if (high - low > kFew) {
      std::sort(low, high);
    } else if (high - low > 1) {
      sort_few(low, high);
    }
    for (; at < end; ++at) sorted[at] = {a, second_[at]};
  }
}

}  // namespace tissu
