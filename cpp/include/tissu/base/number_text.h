#pragma once

#include <array>
#include <charconv>
#include <cstdio>
#include <string>

namespace tissu {

/// A number for messages: as it was given where that is short, else four digits of it.
inline std::string number_text(double value) {
  std::array<char, 32> text{};
  constexpr std::ptrdiff_t kShort = 8;
  const auto [end, error] = std::to_chars(text.data(), text.data() + text.size(), value);
  if (error == std::errc() && end - text.data() <= kShort) return {text.data(), end};
  (void)std::snprintf(text.data(), text.size(), "%.4g", value);
  return text.data();
}

}  // namespace tissu
