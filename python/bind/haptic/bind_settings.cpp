/// What the controller decides, flat: the structs inside Settings as attributes of one class.

#include "haptic/properties.h"
#include "tissu/haptic/tick.h"

namespace tissu::haptic::bind {
namespace {

using Bound = py::class_<Settings>;

void bind_device_part(Bound& bound) {
  number_property(bound, "period", TISSU_AT(period));
  vector_property(bound, "count_size", TISSU_AT(count_size));
  number_property(bound, "grip_size", TISSU_AT(grip_size));
  number_property(bound, "turn_counts", TISSU_AT(turn_counts));
  vector_property(bound, "viscous", TISSU_AT(friction.viscous));
  vector_property(bound, "coulomb", TISSU_AT(friction.coulomb));
  vector_property(bound, "efficiency", TISSU_AT(transmission.efficiency));
  vector_property(bound, "compensated", TISSU_AT(transmission.coulomb));
  number_property(bound, "compensation", TISSU_AT(transmission.share));
  number_property(bound, "tool_mass", TISSU_AT(tool_mass));
  number_property(bound, "tool_centre", TISSU_AT(tool_centre));
  vector_property(bound, "gravity", TISSU_AT(gravity));
  vector_property(bound, "end_low", TISSU_AT(ends.low));
  vector_property(bound, "end_high", TISSU_AT(ends.high));
  vector_property(bound, "homing_torque", TISSU_AT(homing_torque));
  number_property(bound, "homing_still", TISSU_AT(homing_still));
}

void bind_coupling_part(Bound& bound) {
  vector_property(bound, "stiffness", TISSU_AT(stiffness));
  vector_property(bound, "damping", TISSU_AT(damping));
  vector_property(bound, "joint_low", TISSU_AT(joints.low));
  vector_property(bound, "joint_high", TISSU_AT(joints.high));
  vector_property(bound, "torque_limit", TISSU_AT(limits.torque));
  number_property(bound, "force_limit", TISSU_AT(limits.force));
  number_property(bound, "slew", TISSU_AT(limits.slew));
  number_property(bound, "speed_limit", TISSU_AT(limits.speed));
  number_property(bound, "tank_start", TISSU_AT(tank.start));
  number_property(bound, "tank_cap", TISSU_AT(tank.cap));
  number_property(bound, "tank_credit", TISSU_AT(tank.credit));
  number_property(bound, "tank_gate", TISSU_AT(tank.gate));
  number_property(bound, "sweeps", TISSU_AT(sweeps.sweeps));
  number_property(bound, "tolerance", TISSU_AT(sweeps.tolerance));
}

void bind_supervision_part(Bound& bound) {
  number_property(bound, "run", TISSU_AT(run));
  number_property(bound, "acknowledged", TISSU_AT(acknowledged));
  number_property(bound, "tag", TISSU_AT(tag));
  number_property(bound, "ramp", TISSU_AT(ramp));
  number_property(bound, "stale", TISSU_AT(stale));
  number_property(bound, "stall", TISSU_AT(stall));
  number_property(bound, "fade", TISSU_AT(fade));
}

}  // namespace

void bind_settings(py::module_& m) {
  Bound bound(m, "Settings");
  bound.def(py::init<>())
      .def("copy", [](const Settings& s) { return Settings(s); })
      .def("check", [](const Settings& s, double delay) { check(s, delay); }, py::arg("delay"));
  bind_device_part(bound);
  bind_coupling_part(bound);
  bind_supervision_part(bound);
  m.def(
      "passive_stiffness",
      [](const Doubles& viscous, const Doubles& coulomb, const Doubles& count_size, double period,
         double delay, double margin) {
        const JointFriction friction{to_matrix<Joints>(viscous, "viscous"),
                                     to_matrix<Joints>(coulomb, "coulomb")};
        return to_array(
            passive_stiffness(friction, to_matrix<Joints>(count_size, "count_size"), period, delay, margin));
      },
      py::kw_only(), py::arg("viscous"), py::arg("coulomb"), py::arg("count_size"), py::arg("period"),
      py::arg("delay"), py::arg("margin") = 0.8);
}

}  // namespace tissu::haptic::bind
