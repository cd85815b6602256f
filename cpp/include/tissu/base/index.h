#pragma once

#include <cstddef>
#include <cstdint>

namespace tissu {

/// The number of a node, cell or row, which is not negative, as the index of a container.
inline std::size_t at(std::int32_t i) { return static_cast<std::size_t>(i); }

}  // namespace tissu
