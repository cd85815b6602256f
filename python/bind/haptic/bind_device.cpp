/// Devices, the simulated one, and the hand on it.

#include "haptic/properties.h"
#include "tissu/haptic/simulated_device.h"

namespace tissu::haptic::bind {
namespace {

py::dict info_dict(const DeviceInfo& info) {
  py::dict made;
  made["axes"] = info.axes;
  made["count_size"] = py::array_t<double>(kChannels, info.count_size.data());
  made["torque_limit"] = py::array_t<double>(kChannels, info.torque_limit.data());
  made["turn_counts"] = info.turn_counts;
  made["rate"] = info.rate;
  made["delay"] = info.delay;
  made["torque_confirmed"] = info.torque_confirmed;
  return made;
}

HandSettings make_hand(const std::vector<double>& times, const Doubles& tips,
                       const std::vector<double>& psi) {
  const bool shaped = tips.ndim() == 2 && tips.shape(1) == 3 &&
                      tips.shape(0) == static_cast<py::ssize_t>(times.size()) && psi.size() == times.size();
  if (!shaped) throw ParameterError("A path has times (n,), tips (n, 3) and psi (n,).");
  HandSettings hand;
  for (std::size_t i = 0; i < times.size(); ++i) {
    const double* at = tips.data() + 3 * i;
    hand.path.push_back({times[i], {at[0], at[1], at[2]}, psi[i]});
  }
  return hand;
}

void bind_hand(py::module_& m) {
  using py::arg;
  py::class_<HandSettings> bound(m, "Hand");
  bound.def(py::init(&make_hand), arg("times"), arg("tips"), arg("psi"));
  bound.def("check", [](const HandSettings& hand) { const Hand made(hand); });
  bound.def(
      "wanted",
      [](const HandSettings& hand, double time) {
        const Hand::Wanted w = Hand(hand).wanted(time);
        return py::make_tuple(to_array(w.tip), to_array(w.velocity), w.psi, w.rate);
      },
      arg("time"));
  number_property(bound, "smooth", TISSU_AT(smooth));
  number_property(bound, "mass", TISSU_AT(mass));
  number_property(bound, "stiffness", TISSU_AT(stiffness));
  number_property(bound, "damping", TISSU_AT(damping));
  number_property(bound, "turn_stiffness", TISSU_AT(turn_stiffness));
  number_property(bound, "turn_damping", TISSU_AT(turn_damping));
  number_property(bound, "tremor", TISSU_AT(tremor));
  number_property(bound, "lets_go", TISSU_AT(lets_go));
  number_property(bound, "seed", TISSU_AT(seed));
}

void bind_mechanism(py::module_& m) {
  py::class_<MechanismSettings> bound(m, "Mechanism");
  bound.def(py::init<>());
  number_property(bound, "mass", TISSU_AT(inertia.mass));
  number_property(bound, "centre", TISSU_AT(inertia.centre));
  number_property(bound, "across", TISSU_AT(inertia.across));
  number_property(bound, "axial", TISSU_AT(inertia.axial));
  vector_property(bound, "cradle", TISSU_AT(inertia.cradle));
  vector_property(bound, "viscous", TISSU_AT(friction.viscous));
  vector_property(bound, "coulomb", TISSU_AT(friction.coulomb));
  vector_property(bound, "presliding", TISSU_AT(presliding));
  vector_property(bound, "efficiency", TISSU_AT(efficiency));
  vector_property(bound, "blend", TISSU_AT(blend));
  number_property(bound, "roller_force", TISSU_AT(roller_force));
  number_property(bound, "encoder_on_motor", TISSU_AT(encoder_on_motor));
  vector_property(bound, "low", TISSU_AT(low));
  vector_property(bound, "high", TISSU_AT(high));
  vector_property(bound, "stop_stiffness", TISSU_AT(stop_stiffness));
  vector_property(bound, "gravity", TISSU_AT(gravity));
}

void bind_line(py::module_& m) {
  py::class_<LineSettings> bound(m, "Line");
  bound.def(py::init<>());
  number_property(bound, "period", TISSU_AT(period));
  number_property(bound, "substeps", TISSU_AT(substeps));
  number_property(bound, "count_size", TISSU_AT(count_size));
  number_property(bound, "torque_limit", TISSU_AT(torque_limit));
  number_property(bound, "torque_bits", TISSU_AT(torque_bits));
  number_property(bound, "motor_lag", TISSU_AT(motor_lag));
  number_property(bound, "delay", TISSU_AT(delay));
  number_property(bound, "jitter", TISSU_AT(jitter));
  number_property(bound, "lost", TISSU_AT(lost));
  number_property(bound, "misread_tag", TISSU_AT(misread_tag));
  number_property(bound, "unknown_zero", TISSU_AT(unknown_zero));
  number_property(bound, "seed", TISSU_AT(seed));
}

void bind_simulated(py::class_<SimulatedDevice, Device>& bound) {
  using py::arg;
  bound
      .def(py::init([](const Doubles& q, const MechanismSettings& mechanism, const LineSettings& line,
                       const std::optional<HandSettings>& hand) {
             std::optional<Hand> held;
             if (hand) held.emplace(*hand);
             return std::make_unique<SimulatedDevice>(mechanism, line, std::move(held),
                                                      to_matrix<Joints>(q, "q"));
           }),
           arg("q"), arg("mechanism") = MechanismSettings{}, arg("line") = LineSettings{},
           arg("hand") = std::nullopt)
      .def("set_tool", &SimulatedDevice::set_tool, arg("tag"), arg("tool_in"))
      .def(
          "plan_tools",
          [](SimulatedDevice& d, const std::vector<std::pair<double, std::uint64_t>>& changes) {
            std::vector<ToolChange> planned;
            planned.reserve(changes.size());
            for (const auto& [time, tag] : changes) planned.push_back({time, tag});
            d.plan_tools(std::move(planned));
          },
          arg("changes"))
      .def("set_fault", &SimulatedDevice::set_fault, arg("fault"))
      .def("unplug", &SimulatedDevice::unplug)
      .def("plug_in", &SimulatedDevice::plug_in)
      .def("jump", &SimulatedDevice::jump, arg("channel"), arg("counts"))
      .def("step_clock", &SimulatedDevice::step_clock, arg("ns"))
      .def(
          "push",
          [](SimulatedDevice& d, const Doubles& q, const Doubles& v) {
            d.push(to_matrix<Joints>(q, "q"), to_matrix<Joints>(v, "v"));
          },
          arg("q"), arg("v"))
      .def(
          "aim",
          [](SimulatedDevice& d, const Doubles& tip, double psi, double over) {
            d.aim(to_matrix<Vec3>(tip, "tip"), psi, over);
          },
          arg("tip"), arg("psi"), arg("over"))
      .def("follow", &SimulatedDevice::follow)
      .def_property_readonly("time", &SimulatedDevice::time)
      .def_property_readonly("joints", [](const SimulatedDevice& d) { return to_array(d.joints()); })
      .def_property_readonly("rates", [](const SimulatedDevice& d) { return to_array(d.rates()); })
      .def_property_readonly("motor_torque",
                             [](const SimulatedDevice& d) { return to_array(d.motor_torque()); })
      .def_property_readonly("hand_force", [](const SimulatedDevice& d) { return to_array(d.hand_force()); })
      .def_property_readonly("zero", [](const SimulatedDevice& d) { return to_array(d.zero()); });
}

}  // namespace

void bind_device(py::module_& m) {
  py::class_<Device>(m, "Device").def("info", [](const Device& d) { return info_dict(d.info()); });
  bind_hand(m);
  bind_mechanism(m);
  bind_line(m);
  py::class_<SimulatedDevice, Device> bound(m, "SimulatedDevice");
  bind_simulated(bound);
}

}  // namespace tissu::haptic::bind
