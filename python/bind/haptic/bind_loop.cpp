/// Ticks one by one, and the stepped loop.

#include <memory>
#include <utility>

#include "haptic/rows.h"
#include "tissu/haptic/simulated_device.h"
#include "tissu/haptic/stepped_loop.h"

namespace tissu::haptic::bind {
namespace {

/// A tick and what it remembers, fed by hand.
struct Ticks {
  explicit Ticks(const Settings& given) : settings(given), memory(start(given)) { check(given, 0.0); }

  py::dict tick(const Counts& counts, int flags, std::uint64_t tag, std::int64_t time_ns,
                std::uint32_t sequence, const std::string& read, const std::string& written,
                std::int64_t now_ns, std::int32_t late, const LocalModel* model) {
    TickInput input;
    input.read = status_of(read);
    input.written = status_of(written);
    input.sample = {counts, time_ns, sequence, static_cast<std::uint16_t>(flags), tag};
    input.now_ns = now_ns;
    input.late = late;
    input.model = model;
    TickReport report;
    const Command command = haptic::tick(kinematics, settings, input, memory, report);
    return to_dict(report, command);
  }

  Settings settings;
  Memory memory;
  TrocarKinematics kinematics{};
};

/// A stepped loop beside what it needs; the device is the caller's.
struct OwnLoop {
  OwnLoop(Device& device, const Settings& settings) : device(&device), loop(device, kinematics, settings) {}

  py::dict run(std::int64_t n) {
    std::vector<LoopRow> rows;
    rows.reserve(static_cast<std::size_t>(std::max<std::int64_t>(0, n)));
    auto* simulated = dynamic_cast<SimulatedDevice*>(device);
    std::vector<double> joints, energies;
    {
      const py::gil_scoped_release released;
      for (std::int64_t i = 0; i < n; ++i) {
        LoopRow row;
        loop.step(row);
        rows.push_back(row);
        if (simulated == nullptr) continue;
        const Joints& q = simulated->joints();
        joints.insert(joints.end(), q.data(), q.data() + kJoints);
        const DeviceEnergy e = simulated->energy();
        energies.insert(energies.end(), {e.kinetic, e.potential, e.motor, e.hand, e.friction});
      }
    }
    py::dict columns = to_columns(rows);
    if (simulated != nullptr) {
      columns["joints"] =
          py::array_t<double>({static_cast<py::ssize_t>(n), py::ssize_t{kJoints}}, joints.data());
      columns["energy"] = py::array_t<double>({static_cast<py::ssize_t>(n), py::ssize_t{5}}, energies.data());
    }
    return columns;
  }

  Device* device;
  TrocarKinematics kinematics{};
  SteppedLoop loop;
};

}  // namespace

void bind_loop(py::module_& m) {
  using py::arg;
  py::class_<Ticks>(m, "Ticks")
      .def(py::init<const Settings&>(), arg("settings"))
      .def(
          "set",
          [](Ticks& t, const Settings& settings) {
            check(settings, 0.0);
            t.settings = settings;
          },
          arg("settings"))
      .def("tick", &Ticks::tick, py::kw_only(), arg("counts"), arg("flags"), arg("tag") = 0,
           arg("time_ns") = 0, arg("sequence") = 0, arg("read") = "ok", arg("written") = "ok",
           arg("now_ns") = 0, arg("late") = 0, arg("model") = nullptr);
  py::class_<OwnLoop>(m, "SteppedLoop")
      .def(py::init<Device&, const Settings&>(), arg("device"), arg("settings"), py::keep_alive<1, 2>())
      .def(
          "set", [](OwnLoop& l, const Settings& settings) { l.loop.set(settings); }, arg("settings"))
      .def(
          "publish", [](OwnLoop& l, const LocalModel& model) { l.loop.publish(model); }, arg("model"))
      .def(
          "be_late", [](OwnLoop& l, std::int32_t ticks) { l.loop.be_late(ticks); }, arg("ticks"))
      .def("run", &OwnLoop::run, arg("ticks"))
      .def_property_readonly("time", [](const OwnLoop& l) { return l.loop.time(); })
      .def_property_readonly("state", [](const OwnLoop& l) { return name_of(l.loop.memory().state); })
      .def_property_readonly("reason", [](const OwnLoop& l) { return name_of(l.loop.memory().reason); });
  py::list states;
  for (int i = 0; i < 7; ++i) states.append(name_of(static_cast<State>(i)));
  py::list reasons;
  for (int i = 0; i < 10; ++i) reasons.append(name_of(static_cast<Reason>(i)));
  m.attr("STATES") = py::tuple(states);
  m.attr("REASONS") = py::tuple(reasons);
}

}  // namespace tissu::haptic::bind
