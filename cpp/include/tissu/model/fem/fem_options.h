#pragma once

#include <string_view>

namespace tissu {

struct FemOptions {
  static constexpr std::string_view kName = "fem";
  bool fused = true;  ///< kernels made for this element and law where there are such; else those of its shape
};

}  // namespace tissu
