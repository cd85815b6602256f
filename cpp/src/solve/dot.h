#pragma once

#include <span>
#include <vector>

#include "tissu/base/parallel.h"

namespace tissu {

/// Sums over pieces of rows, of products taken in double.
template <class T>
double dot(const Threads& threads, std::span<const T> a, std::span<const T> b, std::vector<double>& partial) {
  return threads.sum(
      static_cast<std::int32_t>(a.size() / 3), partial, [&](std::int32_t begin, std::int32_t end) {
        double sum = 0.0;
        for (auto i = 3 * static_cast<std::size_t>(begin); i < 3 * static_cast<std::size_t>(end); ++i) {
          sum += static_cast<double>(a[i]) * static_cast<double>(b[i]);
        }
        return sum;
      });
}

}  // namespace tissu
