#pragma once

#include <string_view>

namespace tissu {

struct ShellOptions {
  static constexpr std::string_view kName = "shell";
  double drilling = 1.0;  ///< ShellSection::drilling
};

}  // namespace tissu
