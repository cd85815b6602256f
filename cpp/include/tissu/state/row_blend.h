#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "tissu/base/vec.h"

namespace tissu {

/// A row of the unknown that takes over what lies between up to four others.
struct RowBlend {
  std::int32_t to = 0;
  std::array<std::int32_t, 4> from{-1, -1, -1, -1};  ///< -1 beyond the last
  std::array<double, 4> weight{};                    ///< their sum is 1
};

/// values[to] = sum w values[from], three numbers each.
void blend_rows(std::span<const RowBlend> blends, Reals values);

}  // namespace tissu
