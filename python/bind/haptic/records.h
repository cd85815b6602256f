#pragma once

/// What a run wrote down of its ticks, as arrays.

#include <vector>

#include "haptic/arrays.h"
#include "tissu/haptic/run.h"

namespace tissu::haptic::bind {

py::dict to_dict(const TimingReport& report);
/// Columns of a list of records: an array for each field.
py::dict to_columns(const std::vector<TickRecord>& records);

}  // namespace tissu::haptic::bind
