#include "haptic/rows.h"

#include <array>

namespace tissu::haptic::bind {
namespace {

constexpr std::array<const char*, 7> kStates{"off", "homing", "empty", "free", "contact", "held", "fault"};
constexpr std::array<const char*, 10> kReasons{"none",       "reads_failed",  "writes_failed", "device_fault",
                                               "not_finite", "model_stalled", "too_fast",      "tag_changed",
                                               "late",       "ends_not_found"};
constexpr std::array<const char*, 4> kStatuses{"ok", "none", "broken", "gone"};

/// A column of numbers: `at` gives the one of a row.
template <class At>
void add_numbers(py::dict& columns, const char* name, const std::vector<LoopRow>& rows, At at) {
  using Value = std::decay_t<decltype(at(rows.front()))>;
  py::array_t<Value> column(static_cast<py::ssize_t>(rows.size()));
  for (std::size_t i = 0; i < rows.size(); ++i) column.mutable_data()[i] = at(rows[i]);
  columns[name] = column;
}

/// A column of vectors with n numbers.
template <class At>
void add_vectors(py::dict& columns, const char* name, const std::vector<LoopRow>& rows, std::size_t n,
                 At at) {
  using Value = std::decay_t<decltype(at(rows.front())[0])>;
  py::array_t<Value> column({static_cast<py::ssize_t>(rows.size()), static_cast<py::ssize_t>(n)});
  Value* to = column.mutable_data();
  for (const LoopRow& row : rows) {
    for (std::size_t j = 0; j < n; ++j) *to++ = at(row)[static_cast<std::ptrdiff_t>(j)];
  }
  columns[name] = column;
}

#define TISSU_REPORTED(field) [](const LoopRow& row) { return row.report.field; }
#define TISSU_REPORTED_VECTOR(field) [](const LoopRow& row) -> const auto& { return row.report.field; }

void add_motion(py::dict& columns, const std::vector<LoopRow>& rows) {
  add_numbers(columns, "tick", rows, TISSU_REPORTED(tick));
  add_numbers(columns, "state", rows, [](const LoopRow& row) { return static_cast<int>(row.report.state); });
  add_numbers(columns, "reason", rows,
              [](const LoopRow& row) { return static_cast<int>(row.report.reason); });
  add_vectors(columns, "counts", rows, kChannels, [](const LoopRow& row) { return row.counts.data(); });
  add_vectors(columns, "q", rows, kJoints, TISSU_REPORTED_VECTOR(q));
  add_vectors(columns, "speed", rows, kJoints, TISSU_REPORTED_VECTOR(speed));
  add_vectors(columns, "torque", rows, kJoints, TISSU_REPORTED_VECTOR(torque));
  add_vectors(columns, "command", rows, kChannels,
              [](const LoopRow& row) { return row.command.torque.data(); });
  add_numbers(columns, "enable", rows, [](const LoopRow& row) { return row.command.enable; });
  add_vectors(columns, "force", rows, 3, TISSU_REPORTED_VECTOR(force));
  add_numbers(columns, "tag", rows, TISSU_REPORTED(tag));
  add_numbers(columns, "clock_back", rows, TISSU_REPORTED(clock_back));
}

void add_coupling(py::dict& columns, const std::vector<LoopRow>& rows) {
  add_numbers(columns, "contacts", rows, TISSU_REPORTED(contacts));
  add_numbers(columns, "stored", rows, TISSU_REPORTED(stored));
  add_numbers(columns, "share", rows, TISSU_REPORTED(share));
  add_numbers(columns, "stiffness", rows, TISSU_REPORTED(stiffness));
  add_numbers(columns, "tank", rows, TISSU_REPORTED(tank));
  add_numbers(columns, "given_out", rows, TISSU_REPORTED(given_out));
  add_numbers(columns, "sweeps", rows, TISSU_REPORTED(sweeps));
  add_numbers(columns, "change", rows, TISSU_REPORTED(change));
  add_numbers(columns, "model_age", rows, TISSU_REPORTED(model_age));
  add_numbers(columns, "stale", rows, TISSU_REPORTED(stale));
  add_numbers(columns, "limited", rows, TISSU_REPORTED(limited));
  add_numbers(columns, "slewed", rows, TISSU_REPORTED(slewed));
  add_numbers(columns, "stamp", rows, TISSU_REPORTED(stamp));
  add_numbers(columns, "disagreement", rows, TISSU_REPORTED(disagreement));
}

}  // namespace

const char* name_of(State state) { return kStates.at(static_cast<std::size_t>(state)); }
const char* name_of(Reason reason) { return kReasons.at(static_cast<std::size_t>(reason)); }

DeviceStatus status_of(const std::string& name) {
  for (std::size_t i = 0; i < kStatuses.size(); ++i) {
    if (name == kStatuses[i]) return static_cast<DeviceStatus>(i);
  }
  throw ParameterError("The status of a device is '" + name + "'; ok, none, broken and gone are accepted.");
}

py::dict to_columns(const std::vector<LoopRow>& rows) {
  py::dict columns;
  add_motion(columns, rows);
  add_coupling(columns, rows);
  return columns;
}

py::dict to_dict(const TickReport& report, const Command& command) {
  py::dict made;
  LoopRow row{report, command, {}};
  for (const auto& [name, column] : to_columns({row})) made[name] = column[py::int_(0)];
  made.attr("pop")("counts");
  made["state"] = name_of(report.state);
  made["reason"] = name_of(report.reason);
  made["grip"] = report.grip;
  made["sequence"] = command.sequence;
  made["watchdog_ms"] = command.watchdog_ms;
  return made;
}

}  // namespace tissu::haptic::bind
