#include "bind.h"
#include "tissu/simulation/simulation.h"

namespace tissu::bind {
namespace {

py::array_t<std::int32_t> led_nodes(const Simulation& simulation, const std::string& name) {
  const std::vector<std::int32_t> nodes = simulation.world().fixed().nodes_of(name);
  return py::array_t<std::int32_t>(static_cast<py::ssize_t>(nodes.size()), nodes.data());
}

py::array_t<double> led_target(const Simulation& simulation, const std::string& name) {
  const std::vector<double> target = simulation.world().fixed().target_of(name, simulation.state());
  return py::array_t<double>({static_cast<py::ssize_t>(target.size() / 3), py::ssize_t{3}}, target.data());
}

void lead_rigidly(Simulation& simulation, const std::string& name, const Doubles& displacement, double angle,
                  const Doubles& axis, const Doubles& center, double over) {
  const Pose pose{to_vec3(center, "center"), to_vec3(displacement, "displacement"),
                  to_vec3(axis, "axis").normalized(), angle};
  simulation.world().fixed().lead_to(name, pose, over, simulation.state());
}

void lead_nodes(Simulation& simulation, const std::string& name, const Doubles& positions, double over) {
  simulation.world().fixed().lead_to(name, to_vector(with_columns(positions, 3, "positions")), over,
                                     simulation.state());
}

}  // namespace

void bind_lead(py::class_<Simulation>& simulation) {
  using py::arg;
  simulation.def("led_nodes", &led_nodes, arg("name"))
      .def("led_target", &led_target, arg("name"))
      .def(
          "is_led_live",
          [](const Simulation& s, const std::string& name) {
            return s.world().fixed().is_led_live(name, s.state());
          },
          arg("name"))
      .def("lead_rigidly", &lead_rigidly, py::kw_only(), arg("name"), arg("displacement"), arg("angle"),
           arg("axis"), arg("center"), arg("over"))
      .def("lead_nodes", &lead_nodes, py::kw_only(), arg("name"), arg("positions"), arg("over"))
      .def(
          "release_lead",
          [](Simulation& s, const std::string& name, double over) {
            s.world().fixed().release(name, over, s.state());
          },
          py::kw_only(), arg("name"), arg("over"));
}

}  // namespace tissu::bind
