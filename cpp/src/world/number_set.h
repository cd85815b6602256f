#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace tissu {

/// Numbers from 0, each once.
class NumberSet {
 public:
  void add(std::int32_t number) {
    const auto place = static_cast<std::size_t>(number);
    if (place >= has_.size()) has_.resize(2 * place + 1, 0);
    if (std::exchange(has_[place], char{1}) == 0) all_.push_back(number);
  }
  std::span<const std::int32_t> ascending() {
    std::ranges::sort(all_);
    return all_;
  }
  void clear() {
    for (const std::int32_t number : all_) has_[static_cast<std::size_t>(number)] = 0;
    all_.clear();
  }

 private:
  std::vector<char> has_;
  std::vector<std::int32_t> all_;
};

}  // namespace tissu
