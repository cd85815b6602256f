#pragma once

#include <string_view>

namespace tissu {

struct MassSpringOptions {
  static constexpr std::string_view kName = "mass-spring";
  bool equal_masses = false;  ///< the same mass at every node
};

struct MassLinkOptions {
  static constexpr std::string_view kName = "mass-link";
};

struct MassTensorOptions {
  static constexpr std::string_view kName = "mass-tensor";
};

}  // namespace tissu
