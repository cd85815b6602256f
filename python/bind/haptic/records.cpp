#include "haptic/records.h"

#include <array>

namespace tissu::haptic::bind {
namespace {

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
