#include "haptic/arrays.h"
#include "tissu/haptic/kinematics.h"

namespace tissu::haptic::bind {

void bind_kinematics(py::module_& m) {
  using py::arg;
  m.def(
      "rotation",
      [](const Doubles& q) { return to_array(TrocarKinematics().rotation(to_matrix<Joints>(q, "q"))); },
      arg("q"));
  m.def(
      "point",
      [](const Doubles& q, const Doubles& l) {
        return to_array(TrocarKinematics().point(to_matrix<Joints>(q, "q"), to_matrix<Vec3>(l, "l")));
      },
      arg("q"), arg("l"));
  m.def(
      "jacobian",
      [](const Doubles& q, const Doubles& l) {
        return to_array(TrocarKinematics().jacobian(to_matrix<Joints>(q, "q"), to_matrix<Vec3>(l, "l")));
      },
      arg("q"), arg("l"));
  m.def("turns", [](const Doubles& q) { return to_array(tool_turns(to_matrix<Joints>(q, "q"))); }, arg("q"));
  m.def(
      "joints_of",
      [](const Doubles& R, const Doubles& x, const Doubles& l) {
        return to_array(joints_of(to_matrix<Mat3>(R, "R"), to_matrix<Vec3>(x, "x"), to_matrix<Vec3>(l, "l")));
      },
      py::kw_only(), arg("R"), arg("x"), arg("l"));
  m.def(
      "axis_torques",
      [](const Doubles& q, const Doubles& f) {
        return to_array(axis_torques(to_matrix<Joints>(q, "q"), to_matrix<Vec3>(f, "f")));
      },
      arg("q"), arg("f"));
  m.def("unwrapped", &unwrapped, arg("psi"), arg("before"));
  py::class_<Fulcrum>(m, "Fulcrum")
      .def(py::init<double>(), arg("least_depth") = 0.02)
      .def(
          "joints",
          [](const Fulcrum& f, const Doubles& p) { return to_array(f.joints(to_matrix<Vec3>(p, "p"))); },
          arg("p"))
      .def(
          "force",
          [](const Fulcrum& f, const Doubles& q, const Doubles& tau) {
            return to_array(f.force(to_matrix<Joints>(q, "q"), to_matrix<Joints>(tau, "tau")));
          },
          arg("q"), arg("tau"));
}

}  // namespace tissu::haptic::bind
