#pragma once

#include <cstdio>
#include <string>

namespace tissu {

/// Four digits of a number, for messages.
inline std::string number_text(double value) {
  char buffer[32];
  (void)std::snprintf(buffer, sizeof buffer, "%.4g", value);
  return buffer;
}

}  // namespace tissu
