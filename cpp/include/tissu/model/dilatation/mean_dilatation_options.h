#pragma once

#include <string_view>

namespace tissu {

struct MeanDilatationOptions {
  static constexpr std::string_view kName = "mean-dilatation";
};

}  // namespace tissu
