#include "haptic/settings.h"

#include <cstring>
#include <functional>

namespace tissu::haptic::bind {
namespace {

/// A field of the settings by its name: how it is read from Python, and how it is given.
struct Field {
  const char* name;
  std::function<void(Settings&, const py::handle&)> set;
  std::function<py::object(Settings&)> get;
};

/// A number; `at` gives the place of it in settings.
template <class At>
Field number(const char* name, At at) {
  using T = std::decay_t<decltype(at(std::declval<Settings&>()))>;
  return {name, [at](Settings& s, const py::handle& value) { at(s) = value.cast<T>(); },
          [at](Settings& s) -> py::object { return py::cast(at(s)); }};
}

/// A vector of fixed length.
template <class At>
Field vector(const char* name, At at) {
  using T = std::decay_t<decltype(at(std::declval<Settings&>()))>;
  return {name, [at, name](Settings& s, const py::handle& value) { at(s) = to_matrix<T>(value.cast<Doubles>(), name); },
          [at](Settings& s) -> py::object { return to_array(at(s)); }};
}

std::vector<Field> device_fields() {
  return {
      number("run", [](Settings& s) -> auto& { return s.run; }),
      number("acknowledged", [](Settings& s) -> auto& { return s.acknowledged; }),
      number("tag", [](Settings& s) -> auto& { return s.tag; }),
      number("period", [](Settings& s) -> auto& { return s.period; }),
      vector("count_size", [](Settings& s) -> auto& { return s.count_size; }),
      number("grip_size", [](Settings& s) -> auto& { return s.grip_size; }),
      number("turn_counts", [](Settings& s) -> auto& { return s.turn_counts; }),
      vector("viscous", [](Settings& s) -> auto& { return s.friction.viscous; }),
      vector("coulomb", [](Settings& s) -> auto& { return s.friction.coulomb; }),
      vector("low", [](Settings& s) -> auto& { return s.joints.low; }),
      vector("high", [](Settings& s) -> auto& { return s.joints.high; }),
      vector("efficiency", [](Settings& s) -> auto& { return s.transmission.efficiency; }),
      vector("compensated", [](Settings& s) -> auto& { return s.transmission.coulomb; }),
      number("compensation", [](Settings& s) -> auto& { return s.transmission.share; }),
      number("tool_mass", [](Settings& s) -> auto& { return s.tool_mass; }),
      number("tool_centre", [](Settings& s) -> auto& { return s.tool_centre; }),
      vector("gravity", [](Settings& s) -> auto& { return s.gravity; }),
      vector("homing_torque", [](Settings& s) -> auto& { return s.homing_torque; }),
      number("homing_still", [](Settings& s) -> auto& { return s.homing_still; }),
  };
}

std::vector<Field> coupling_fields() {
  return {
      vector("stiffness", [](Settings& s) -> auto& { return s.stiffness; }),
      vector("damping", [](Settings& s) -> auto& { return s.damping; }),
      vector("torque_limit", [](Settings& s) -> auto& { return s.limits.torque; }),
      number("force_limit", [](Settings& s) -> auto& { return s.limits.force; }),
      number("slew", [](Settings& s) -> auto& { return s.limits.slew; }),
      number("speed_limit", [](Settings& s) -> auto& { return s.limits.speed; }),
      number("tank_start", [](Settings& s) -> auto& { return s.tank.start; }),
      number("tank_cap", [](Settings& s) -> auto& { return s.tank.cap; }),
      number("tank_credit", [](Settings& s) -> auto& { return s.tank.credit; }),
      number("tank_gate", [](Settings& s) -> auto& { return s.tank.gate; }),
      number("sweeps", [](Settings& s) -> auto& { return s.sweeps.sweeps; }),
      number("tolerance", [](Settings& s) -> auto& { return s.sweeps.tolerance; }),
      number("ramp", [](Settings& s) -> auto& { return s.ramp; }),
      number("stale", [](Settings& s) -> auto& { return s.stale; }),
      number("stall", [](Settings& s) -> auto& { return s.stall; }),
      number("fade", [](Settings& s) -> auto& { return s.fade; }),
  };
}

const std::vector<Field>& fields_of_settings() {
  static const std::vector<Field> kFields = [] {
    std::vector<Field> all = device_fields();
    for (Field& field : coupling_fields()) all.push_back(std::move(field));
    return all;
  }();
  return kFields;
}

/// A column of numbers: one of each record.
template <class T, class Get>
py::array column(const std::vector<TickRecord>& records, Get get) {
  py::array_t<T> made(static_cast<py::ssize_t>(records.size()));
  T* to = made.mutable_data();
  for (const TickRecord& record : records) *to++ = static_cast<T>(get(record));
  return made;
}

/// A column of several numbers: a row for each record.
template <class T, class Get>
py::array columns(const std::vector<TickRecord>& records, py::ssize_t width, Get get) {
  py::array_t<T> made({static_cast<py::ssize_t>(records.size()), width});
  T* to = made.mutable_data();
  for (const TickRecord& record : records) {
    for (py::ssize_t k = 0; k < width; ++k) *to++ = static_cast<T>(get(record)[static_cast<std::size_t>(k)]);
  }
  return made;
}

}  // namespace

Settings settings_of(const py::dict& fields) {
  Settings settings;
  for (const auto& [key, value] : fields) {
    const auto name = key.cast<std::string>();
    bool known = false;
    for (const Field& field : fields_of_settings()) {
      if (name != field.name) continue;
      field.set(settings, value);
      known = true;
    }
    if (!known) throw ParameterError("found the setting '" + name + "', which ticks do not have; leave it out.");
  }
  return settings;
}

py::dict to_dict(const Settings& settings) {
  Settings copy = settings;
  py::dict made;
  for (const Field& field : fields_of_settings()) made[field.name] = field.get(copy);
  return made;
}

py::dict to_dict(const TickReport& report) {
  using py::arg;
  py::dict made;
  made["tick"] = report.tick;
  made["state"] = static_cast<int>(report.state);
  made["reason"] = static_cast<int>(report.reason);
  made["q"] = to_array(report.q);
  made["speed"] = to_array(report.speed);
  made["grip"] = report.grip;
  made["torque"] = to_array(report.torque);
  made["force"] = to_array(report.force);
  made["contacts"] = report.contacts;
  made["stored"] = report.stored;
  made["share"] = report.share;
  made["stiffness"] = report.stiffness;
  made["tank"] = report.tank;
  made["given_out"] = report.given_out;
  made["sweeps"] = report.sweeps;
  made["change"] = report.change;
  made["model_age"] = report.model_age;
  made["stale"] = report.stale;
  made["limited"] = report.limited;
  made["slewed"] = report.slewed;
  made["clock_back"] = report.clock_back;
  made["stamp"] = report.stamp;
  made["disagreement"] = report.disagreement;
  made["tag"] = report.tag;
  return made;
}

py::dict to_dict(const TimingReport& report) {
  py::dict made;
  made["count"] = report.count;
  made["p50"] = report.p50;
  made["p99"] = report.p99;
  made["p999"] = report.p999;
  made["max"] = report.max;
  return made;
}

py::dict to_columns(const std::vector<TickRecord>& r) {
  constexpr auto kWide = static_cast<py::ssize_t>(kChannels);
  py::dict made;
  made["number"] = column<std::int64_t>(r, [](const TickRecord& t) { return t.number; });
  made["offered"] = column<std::uint64_t>(r, [](const TickRecord& t) { return t.offered; });
  made["settings"] = column<std::uint32_t>(r, [](const TickRecord& t) { return t.settings; });
  made["read"] = column<std::uint8_t>(r, [](const TickRecord& t) { return t.read; });
  made["written"] = column<std::uint8_t>(r, [](const TickRecord& t) { return t.written; });
  made["counts"] = columns<std::int32_t>(r, kWide, [](const TickRecord& t) { return t.sample.counts; });
  made["time_ns"] = column<std::int64_t>(r, [](const TickRecord& t) { return t.sample.time_ns; });
  made["sequence"] = column<std::uint32_t>(r, [](const TickRecord& t) { return t.sample.sequence; });
  made["flags"] = column<std::uint16_t>(r, [](const TickRecord& t) { return t.sample.flags; });
  made["tag"] = column<std::uint64_t>(r, [](const TickRecord& t) { return t.sample.tag; });
  made["command"] = columns<double>(r, kWide, [](const TickRecord& t) { return t.command.torque; });
  made["enable"] = column<bool>(r, [](const TickRecord& t) { return t.command.enable; });
  const auto joints = [](const Joints& j) { return std::array<double, kJoints>{j[0], j[1], j[2], j[3]}; };
  made["q"] = columns<double>(r, kJoints, [&](const TickRecord& t) { return joints(t.report.q); });
  made["torque"] = columns<double>(r, kJoints, [&](const TickRecord& t) { return joints(t.report.torque); });
  made["force"] = columns<double>(r, 3, [](const TickRecord& t) {
    return std::array<double, 3>{t.report.force[0], t.report.force[1], t.report.force[2]};
  });
  made["state"] = column<std::uint8_t>(r, [](const TickRecord& t) { return t.report.state; });
  made["reason"] = column<std::uint8_t>(r, [](const TickRecord& t) { return t.report.reason; });
  made["stored"] = column<double>(r, [](const TickRecord& t) { return t.report.stored; });
  made["share"] = column<double>(r, [](const TickRecord& t) { return t.report.share; });
  made["tank"] = column<double>(r, [](const TickRecord& t) { return t.report.tank; });
  made["given_out"] = column<double>(r, [](const TickRecord& t) { return t.report.given_out; });
  return made;
}

}  // namespace tissu::haptic::bind
