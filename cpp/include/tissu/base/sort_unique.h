#pragma once

#include <algorithm>

namespace tissu {

/// Sorts values, and keeps each of them once.
template <class Values>
void sort_unique(Values& values) {
  std::ranges::sort(values);
  values.erase(std::ranges::unique(values).begin(), values.end());
}

}  // namespace tissu
