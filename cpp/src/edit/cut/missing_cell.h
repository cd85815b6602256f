#pragma once

/// What is said of a cell that an edit names and that is not there.

#include <cstdint>
#include <string>
#include <string_view>

#include "tissu/base/error.h"

namespace tissu {

inline ParameterError missing_cell(std::int32_t number, std::string_view body = {}) {
  const std::string of = body.empty() ? "" : " of body \"" + std::string(body) + "\"";
  return ParameterError("found cell " + std::to_string(number) + of +
                        "; the numbers of cells that were not removed are accepted (remaining_cells).");
}

}  // namespace tissu
