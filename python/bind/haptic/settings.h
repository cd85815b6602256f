#pragma once

/// What a tick is given and says, from and to dictionaries of Python.

#include "haptic/arrays.h"
#include "tissu/haptic/run.h"

namespace tissu::haptic::bind {

/// Settings of the fields that are named, the others with their defaults. Throws `ParameterError` for an unknown name.
Settings settings_of(const py::dict& fields);
/// All fields of settings by their names.
py::dict to_dict(const Settings& settings);
py::dict to_dict(const TickReport& report);
py::dict to_dict(const TimingReport& report);
/// Columns of a list of records: an array for each field.
py::dict to_columns(const std::vector<TickRecord>& records);

}  // namespace tissu::haptic::bind
