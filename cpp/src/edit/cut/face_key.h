#pragma once

/// Faces by their vertices, in tables of open addresses.

#include <array>
#include <cstddef>
#include <cstdint>

namespace tissu {

using FaceKey = std::array<std::int32_t, 3>;  ///< vertices, ascending

inline std::size_t hash_of(const FaceKey& key) {
  std::uint64_t h = 0;
  for (const std::int32_t v : key) {
    h = (h ^ static_cast<std::uint32_t>(v)) * 0x9E3779B97F4A7C15U;
    h ^= h >> 29U;
  }
  return static_cast<std::size_t>(h);
}

}  // namespace tissu
