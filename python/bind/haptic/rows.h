#pragma once

/// Reports of ticks as arrays, for what runs and what records ticks.

#include <cstdint>
#include <vector>

#include "haptic/arrays.h"
#include "tissu/haptic/stepped_loop.h"

namespace tissu::haptic::bind {

/// "free", "contact", …
const char* name_of(State state);
const char* name_of(Reason reason);
/// "ok", "none", "broken" or "gone"; refuses another word.
DeviceStatus status_of(const std::string& name);
/// One report and its command: numbers, words and (n,) arrays.
py::dict to_dict(const TickReport& report, const Command& command);
/// Name -> array with a row for each tick.
py::dict to_columns(const std::vector<LoopRow>& rows);

}  // namespace tissu::haptic::bind
