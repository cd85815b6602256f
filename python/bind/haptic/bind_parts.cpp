/// What a tick is made of, one by one: the tank, limits, the transmission and windowed speeds.

#include "haptic/properties.h"
#include "tissu/haptic/limits.h"
#include "tissu/haptic/tank.h"
#include "tissu/haptic/transmission.h"
#include "tissu/haptic/velocity.h"

namespace tissu::haptic::bind {
namespace {

TorqueLimits limits_of(const Doubles& torque, double force, double slew) {
  TorqueLimits limits;
  limits.torque = to_matrix<Joints>(torque, "torque_limit");
  limits.force = force;
  limits.slew = slew;
  return limits;
}

double windowed_speed(const std::vector<double>& positions, double count_size, double period) {
  PositionWindow window;
  for (const double q : positions) window.add(q);
  return window.speed(count_size, period);
}

struct BoundTank {
  TankSettings settings;
  Tank tank;
};

void bind_tank(py::module_& m) {
  using py::arg;
  py::class_<BoundTank> bound(m, "Tank");
  bound
      .def(py::init([](double start, double cap, double credit) {
             BoundTank t{{start, cap, credit, true}, {}};
             t.tank.fill(t.settings);
             return t;
           }),
           py::kw_only(), arg("start") = 1e-3, arg("cap") = 5e-3, arg("credit") = 0.8)
      .def(
          "settle",
          [](BoundTank& t, double work, double stored, double dissipated) {
            t.tank.settle(t.settings, work, stored, dissipated);
          },
          py::kw_only(), arg("work"), arg("stored"), arg("dissipated"))
      .def(
          "pay", [](BoundTank& t, double more) { return t.tank.pay(t.settings, more); }, arg("more"))
      .def(
          "observe", [](BoundTank& t, double period) { t.tank.observe(t.settings, period); }, arg("period"))
      .def(
          "damping",
          [](const BoundTank& t, const Doubles& viscous, const Doubles& v, const Doubles& slow,
             double period) {
            return to_array(t.tank.damping(to_matrix<Joints>(viscous, "viscous"), to_matrix<Joints>(v, "v"),
                                           to_matrix<Joints>(slow, "slow"), period));
          },
          py::kw_only(), arg("viscous"), arg("v"), arg("slow"), arg("period"));
  number_property(bound, "energy", TISSU_AT(tank.energy));
  number_property(bound, "given_out", TISSU_AT(tank.given_out));
  number_property(bound, "stiffness", TISSU_AT(tank.stiffness));
  number_property(bound, "trips", TISSU_AT(tank.trips));
}

}  // namespace

void bind_parts(py::module_& m) {
  using py::arg;
  bind_tank(m);
  m.def(
      "saturated",
      [](const Doubles& q, const Doubles& tau, const Doubles& torque_limit, double force_limit) {
        return to_array(saturated(limits_of(torque_limit, force_limit, 1.0), to_matrix<Joints>(q, "q"),
                                  to_matrix<Joints>(tau, "tau")));
      },
      py::kw_only(), arg("q"), arg("tau"), arg("torque_limit"), arg("force_limit"));
  m.def(
      "slewed",
      [](const Doubles& before, const Doubles& tau, const Doubles& torque_limit, double slew) {
        return to_array(slewed(limits_of(torque_limit, 1.0, slew), to_matrix<Joints>(before, "before"),
                               to_matrix<Joints>(tau, "tau")));
      },
      py::kw_only(), arg("before"), arg("tau"), arg("torque_limit"), arg("slew"));
  m.def(
      "motor_torques",
      [](const Doubles& tau, const Doubles& v, const Doubles& slow, const Doubles& efficiency,
         const Doubles& coulomb, double share) {
        const Transmission transmission{to_matrix<Joints>(efficiency, "efficiency"),
                                        to_matrix<Joints>(coulomb, "coulomb"), share};
        transmission.check();
        return to_array(transmission.motor(to_matrix<Joints>(tau, "tau"), to_matrix<Joints>(v, "v"),
                                           to_matrix<Joints>(slow, "slow")));
      },
      py::kw_only(), arg("tau"), arg("v"), arg("slow"), arg("efficiency"), arg("coulomb"), arg("share"));
  m.def("windowed_speed", &windowed_speed, arg("positions"), py::kw_only(), arg("count_size"), arg("period"));
}

}  // namespace tissu::haptic::bind
