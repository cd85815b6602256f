#include <memory>
#include <string>
#include <vector>

#include "haptic/arrays.h"
#include "tissu/haptic/device.h"
#include "tissu/haptic/frame.h"
#include "tissu/haptic/plugin_device.h"
#include "tissu/haptic/replay_device.h"
#include "tissu/haptic/serial_device.h"
#include "tissu/haptic/shared_memory_device.h"
#include "tissu/haptic/udp_device.h"

namespace tissu::haptic::bind {
namespace {

py::dict to_dict(const Sample& sample) {
  py::dict made;
  made["counts"] = sample.counts;
  made["time_ns"] = sample.time_ns;
  made["sequence"] = sample.sequence;
  made["flags"] = sample.flags;
  made["tag"] = sample.tag;
  return made;
}

DeviceInfo info_of(const Channels& count_size, const Channels& torque_limit, double rate, double delay) {
  DeviceInfo info;
  info.count_size = count_size;
  info.torque_limit = torque_limit;
  info.rate = rate;
  info.delay = delay;
  return info;
}

/// A column of records: as many numbers for each of `rows` records as are wanted.
template <class T>
class Column {
 public:
  Column(const py::dict& columns, const char* name, std::size_t rows, std::size_t width = 1)
      : values_(columns[name].cast<Values>()), width_(width) {
    if (static_cast<std::size_t>(values_.size()) == rows * width) return;
    throw ParameterError(std::string("the column ") + name + " has " + std::to_string(values_.size()) +
                         " numbers; " + std::to_string(rows * width) + " are accepted: record again.");
  }
  T operator()(std::size_t row, std::size_t k = 0) const { return values_.data()[width_ * row + k]; }

 private:
  using Values = py::array_t<T, py::array::c_style | py::array::forcecast>;
  Values values_;
  std::size_t width_;
};

/// A device out of columns of records, as `take_records` of a run gives them.
std::unique_ptr<Device> replayed(const py::dict& columns) {
  const std::size_t rows = py::len(columns["read"]);
  const Column<std::uint8_t> read(columns, "read", rows), written(columns, "written", rows);
  const Column<std::int32_t> counts(columns, "counts", rows, kChannels);
  const Column<std::int64_t> time(columns, "time_ns", rows);
  const Column<std::uint32_t> sequence(columns, "sequence", rows);
  const Column<std::uint16_t> flags(columns, "flags", rows);
  const Column<std::uint64_t> tag(columns, "tag", rows);
  std::vector<Answered> answers(rows);
  for (std::size_t k = 0; k < rows; ++k) {
    Answered& one = answers[k];
    one.read = static_cast<DeviceStatus>(read(k));
    one.written = static_cast<DeviceStatus>(written(k));
    for (std::size_t c = 0; c < kChannels; ++c) one.sample.counts[c] = counts(k, c);
    one.sample.time_ns = time(k);
    one.sample.sequence = sequence(k);
    one.sample.flags = flags(k);
    one.sample.tag = tag(k);
  }
  return std::make_unique<ReplayDevice>(std::move(answers));
}

py::tuple read(Device& device) {
  Sample sample;
  const DeviceStatus status = device.read(sample);
  return py::make_tuple(static_cast<int>(status), to_dict(sample));
}

int write(Device& device, const Channels& torque, bool enable, std::uint32_t sequence, int watchdog_ms) {
  return static_cast<int>(device.write({torque, sequence, static_cast<std::uint16_t>(watchdog_ms), enable}));
}

void bind_openers(py::module_& m) {
  using py::arg;
  const auto unlocked = py::call_guard<py::gil_scoped_release>();
  m.def(
      "open_udp",
      [](const std::string& host, int port, double wait, const Channels& count_size,
         const Channels& torque_limit, double rate, double delay) -> std::unique_ptr<Device> {
        return open_udp_device({host, port, wait, info_of(count_size, torque_limit, rate, delay)});
      },
      py::kw_only(), arg("host"), arg("port"), arg("wait"), arg("count_size"), arg("torque_limit"),
      arg("rate"), arg("delay"), unlocked);
  m.def(
      "open_serial",
      [](const std::string& path, int baud, double wait, const Channels& count_size,
         const Channels& torque_limit, double rate, double delay) -> std::unique_ptr<Device> {
        return open_serial_device({path, baud, wait, info_of(count_size, torque_limit, rate, delay)});
      },
      py::kw_only(), arg("path"), arg("baud"), arg("wait"), arg("count_size"), arg("torque_limit"),
      arg("rate"), arg("delay"), unlocked);
  m.def(
      "open_shared_memory",
      [](const std::string& name, double wait, const Channels& count_size, const Channels& torque_limit,
         double rate, double delay) -> std::unique_ptr<Device> {
        return open_shared_memory_device({name, wait, info_of(count_size, torque_limit, rate, delay)});
      },
      py::kw_only(), arg("name"), arg("wait"), arg("count_size"), arg("torque_limit"), arg("rate"),
      arg("delay"), unlocked);
  m.def(
      "open_plugin",
      [](const std::string& library, const std::string& address) -> std::unique_ptr<Device> {
        return open_plugin_device(library, address);
      },
      py::kw_only(), arg("library"), arg("address"), unlocked);
  m.def("replayed", &replayed, arg("columns"));
}

}  // namespace

void bind_wire(py::module_& m) {
  using py::arg;
  m.def("read", &read, arg("device"));
  m.def("write", &write, arg("device"), arg("torque"), py::kw_only(), arg("enable") = true,
        arg("sequence") = 0, arg("watchdog_ms") = 20);
  bind_openers(m);
  m.def(
      "crc32",
      [](const py::bytes& bytes) {
        const auto text = static_cast<std::string>(bytes);
        const std::vector<std::uint8_t> values(text.begin(), text.end());
        return crc32(values);
      },
      arg("bytes"));
}

}  // namespace tissu::haptic::bind
