#pragma once

#include <string>
#include <string_view>

namespace tissu {

struct CorotationalOptions {
  static constexpr std::string_view kName = "corotational";
  std::string rotation = "polar";       ///< small, frame or polar
  std::string tangent = "approximate";  ///< approximate or exact
};

}  // namespace tissu
