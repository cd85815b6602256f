#include <memory>
#include <optional>

#include "haptic/arrays.h"
#include "tissu/haptic/simulated_device.h"

namespace tissu::haptic::bind {
namespace {

/// A hand along a path: rows of time [s] and place (x, y, z) [m].
Hand hand_of(const Doubles& path, bool smooth, double mass, double stiffness, double damping, double tremor,
             double lets_go, std::uint64_t seed) {
  if (path.ndim() != 2 || path.shape(1) != 4) throw ParameterError("path must have the shape (n, 4).");
  HandSettings settings;
  for (py::ssize_t k = 0; k < path.shape(0); ++k) {
    const double* row = path.data() + 4 * k;
    settings.path.push_back({row[0], {row[1], row[2], row[3]}, 0.0});
  }
  settings.smooth = smooth;
  settings.mass = mass;
  settings.stiffness = stiffness;
  settings.damping = damping;
  settings.tremor = tremor;
  settings.lets_go = lets_go;
  settings.seed = seed;
  return Hand(std::move(settings));
}

/// Where the tip of a hand's path begins, or 100 mm deep.
Joints first_joints(const std::optional<Hand>& hand) {
  const Vec3 tip = hand ? hand->settings().path.front().tip : Vec3(0.0, 0.0, 0.1);
  return Fulcrum().joints(tip);
}

std::shared_ptr<SimulatedDevice> simulated(const std::optional<Hand>& hand, double period, const Channels& count_size,
                                           const Channels& torque_limit, double delay, double jitter, double lost,
                                           double misread_tag, bool homed, std::uint64_t seed) {
  LineSettings line;
  line.period = period;
  line.count_size = count_size;
  line.torque_limit = torque_limit;
  line.delay = delay;
  line.jitter = jitter;
  line.lost = lost;
  line.misread_tag = misread_tag;
  line.unknown_zero = !homed;
  line.seed = seed;
  return std::make_shared<SimulatedDevice>(MechanismSettings{}, line, hand, first_joints(hand));
}

}  // namespace

void bind_simulated(py::module_& m) {
  using py::arg;
  py::class_<Hand>(m, "Hand")
      .def(py::init(&hand_of), py::kw_only(), arg("path"), arg("smooth"), arg("mass"), arg("stiffness"),
           arg("damping"), arg("tremor"), arg("lets_go"), arg("seed"));
  py::class_<SimulatedDevice, Device, std::shared_ptr<SimulatedDevice>>(m, "SimulatedDevice")
      .def(py::init(&simulated), py::kw_only(), arg("hand"), arg("period"), arg("count_size"), arg("torque_limit"),
           arg("delay"), arg("jitter"), arg("lost"), arg("misread_tag"), arg("homed"), arg("seed"))
      .def("time", &SimulatedDevice::time)
      .def("joints", [](const SimulatedDevice& d) { return to_array(d.joints()); })
      .def("rates", [](const SimulatedDevice& d) { return to_array(d.rates()); })
      .def("motor_torque", [](const SimulatedDevice& d) { return to_array(d.motor_torque()); })
      .def("hand_force", [](const SimulatedDevice& d) { return to_array(d.hand_force()); })
      .def("set_tool", &SimulatedDevice::set_tool, arg("tag"), arg("inside"))
      .def("set_fault", &SimulatedDevice::set_fault, arg("fault"))
      .def("unplug", &SimulatedDevice::unplug)
      .def("plug_in", &SimulatedDevice::plug_in)
      .def("jump", &SimulatedDevice::jump, arg("channel"), arg("counts"))
      .def("step_clock", &SimulatedDevice::step_clock, arg("ns"));
}

}  // namespace tissu::haptic::bind
