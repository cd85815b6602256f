/// What touches what in a running simulation, and obstacles that are led live.

#include "bind.h"
#include "tissu/contact/audit.h"
#include "tissu/simulation/simulation.h"

namespace tissu::bind {
namespace {

using Doubles = Array<double>;

const Contact& contact_of(const Simulation& simulation) {
  if (const Contact* contact = simulation.world().contact()) return *contact;
  throw ParameterError("found a scene without contacts; one with `contacts` is accepted.");
}

std::size_t at(double number) { return static_cast<std::size_t>(number); }

/// The vertices of all surfaces where they are now, three numbers each.
std::vector<double> places_of(const Contact& contact, const State& state) {
  std::vector<double> places(3 * contact.surfaces().vertices().size());
  contact.place_vertices(state, state.time, places);
  return places;
}

/// The surfaces of both sides: that of the vertex or first edge, and the other.
std::array<std::int32_t, 2> sides(const Contact& contact, const ContactNumbers& c) {
  const auto surface = [&](double vertex) { return contact.surfaces().vertices()[at(vertex)].surface; };
  std::array<std::int32_t, 2> both = {surface(c.vertex[0]), -1};
  if (c.kind == ContactNumbers::kPlane) {
    both[1] = static_cast<std::int32_t>(contact.description().bodies.size() + at(c.b));
  }
  for (std::size_t k = 1; k < 4; ++k) {
    if (c.vertex[k] >= 0.0 && c.beta[k] <= 0.0) both[1] = surface(c.vertex[k]);
  }
  return both;
}

/// Arrays with a row for each contact of the latest step.
py::dict contacts(const Simulation& simulation) {
  const Contact& contact = contact_of(simulation);
  const State& state = simulation.state();
  const ContactTable table = contact.table(state);
  const std::vector<double> places = places_of(contact, state);
  const auto m = static_cast<py::ssize_t>(table.size());
  py::array_t<std::int32_t> pairs(m), surfaces({m, py::ssize_t{2}}), nodes({m, py::ssize_t{4}});
  py::array_t<double> weights({m, py::ssize_t{4}}), points({m, py::ssize_t{3}}), normals({m, py::ssize_t{3}}),
      forces({m, py::ssize_t{3}}), gaps(m);
  py::array_t<bool> sliding(m);
  for (py::ssize_t i = 0; i < m; ++i) {
    const ContactNumbers c = table[static_cast<std::size_t>(i)];
    const std::array<std::int32_t, 2> both = sides(contact, c);
    Vec3 r = vector_of(c.fixed);
    Vec3 point = Vec3::Zero();
    pairs.mutable_at(i) = static_cast<std::int32_t>(c.pair);
    for (py::ssize_t k = 0; k < 4; ++k) {
      const auto corner = static_cast<std::size_t>(k);
      const bool there = c.vertex[corner] >= 0.0;
      nodes.mutable_at(i, k) = there ? contact.surfaces().vertices()[at(c.vertex[corner])].node : -1;
      weights.mutable_at(i, k) = c.beta[corner];
      if (!there) continue;
      const Vec3 place = block(ConstReals(places), static_cast<std::int32_t>(c.vertex[corner]));
      if (contact.surfaces().vertices()[at(c.vertex[corner])].row >= 0) r += c.beta[corner] * place;
      if (c.beta[corner] > 0.0) point += c.beta[corner] * place;
    }
    for (py::ssize_t k = 0; k < 2; ++k) surfaces.mutable_at(i, k) = both[static_cast<std::size_t>(k)];
    for (py::ssize_t k = 0; k < 3; ++k) {
      points.mutable_at(i, k) = point[k];
      normals.mutable_at(i, k) = c.normal[static_cast<std::size_t>(k)];
      forces.mutable_at(i, k) = c.push[static_cast<std::size_t>(k)];
    }
    gaps.mutable_at(i) = vector_of(c.normal).dot(r) - c.apart;
    sliding.mutable_at(i) = c.sliding != 0.0;
  }
  py::dict found;
  found["pairs"] = pairs;
  found["surfaces"] = surfaces;
  found["nodes"] = nodes;
  found["weights"] = weights;
  found["points"] = points;
  found["normals"] = normals;
  found["gaps"] = gaps;
  found["forces"] = forces;
  found["sliding"] = sliding;
  return found;
}

std::vector<std::string> surface_names(const Simulation& simulation) {
  std::vector<std::string> names;
  for (const SurfaceSet::Surface& surface : contact_of(simulation).surfaces().surfaces()) {
    names.push_back(surface.name);
  }
  return names;
}

py::array_t<double> array_of(const Vec3& vector) { return py::array_t<double>(3, vector.data()); }

py::tuple force_on(const Simulation& simulation, std::int32_t surface) {
  const Contact::Wrench wrench = contact_of(simulation).force_on(surface, simulation.state());
  return py::make_tuple(array_of(wrench.force), array_of(wrench.moment));
}

py::list crossings_of(const Simulation& simulation) {
  py::list found;
  for (const Crossing& crossing : crossings(contact_of(simulation), simulation.state())) {
    found.append(py::make_tuple(crossing.surface, crossing.other, crossing.edge, crossing.triangle));
  }
  return found;
}

std::int32_t obstacle_of(const Contact& contact, const std::string& name) {
  const std::int32_t obstacle = contact.obstacle_named(name);
  if (obstacle < 0) throw ParameterError("found no obstacle named \"" + name + "\".");
  return obstacle;
}

/// Where the origin of an obstacle is.
py::array_t<double> obstacle_place(const Simulation& simulation, const std::string& name) {
  const Contact& contact = contact_of(simulation);
  const std::int32_t obstacle = obstacle_of(contact, name);
  const Vec3& origin = contact.description().obstacles[static_cast<std::size_t>(obstacle)].origin;
  return array_of(contact.place_of(obstacle, origin, simulation.state(), simulation.state().time));
}

void lead_obstacle(Simulation& simulation, const std::string& name, const Doubles& displacement, double angle,
                   const Doubles& axis, const Doubles& center, double over) {
  const Pose pose{to_vec3(center, "center"), to_vec3(displacement, "displacement"),
                  to_vec3(axis, "axis").normalized(), angle};
  contact_of(simulation).lead_to(name, pose, over, simulation.state());
}

}  // namespace

void bind_contact_state(py::class_<Simulation>& simulation) {
  using py::arg;
  simulation.def("contacts", &contacts)
      .def("contact_surfaces", &surface_names)
      .def("contact_force_on", &force_on, arg("surface"))
      .def("crossings", &crossings_of)
      .def("obstacle_place", &obstacle_place, arg("name"))
      .def("lead_obstacle", &lead_obstacle, py::kw_only(), arg("name"), arg("displacement"), arg("angle"),
           arg("axis"), arg("center"), arg("over"))
      .def(
          "release_obstacle",
          [](Simulation& s, const std::string& name, double over) {
            contact_of(s).release(name, over, s.state());
          },
          py::kw_only(), arg("name"), arg("over"))
      .def(
          "is_obstacle_led",
          [](const Simulation& s, const std::string& name) {
            return contact_of(s).is_led_live(name, s.state());
          },
          arg("name"));
}

}  // namespace tissu::bind
