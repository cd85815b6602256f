/// Contact while a simulation runs: what presses, with which force, what crosses, and obstacles that are led.

#include <algorithm>
#include <cmath>

#include "bind.h"
#include "tissu/contact/audit.h"
#include "tissu/simulation/simulation.h"

namespace tissu::bind {
namespace {

const Contact& contact_of(const Simulation& simulation) {
  if (simulation.world().contact() == nullptr) throw ParameterError("this world has no contact.");
  return *simulation.world().contact();
}

std::int32_t surface_named(const Contact& contact, const std::string& name) {
  const auto& surfaces = contact.surfaces().surfaces();
  for (std::size_t i = 0; i < surfaces.size(); ++i) {
    if (surfaces[i].name == name) return static_cast<std::int32_t>(i);
  }
  throw ParameterError("found \"" + name + "\", which meets nothing in this world.");
}

template <class T>
py::array_t<T> rows(std::size_t count, py::ssize_t columns) {
  return py::array_t<T>({static_cast<py::ssize_t>(count), columns});
}

/// Where the force on a contact's vertex number k acts. Without friction it is along the normal: its moment
/// on the surface of a sheet or line is that on the middle.
Vec3 pressed_at(const Contact& contact, const ContactNumbers& c, std::size_t k, const State& state) {
  const auto& vertex = contact.surfaces().vertices()[static_cast<std::size_t>(c.vertex[k])];
  const Vec3 place = contact.touched(c, k, state);
  const bool rubs = contact.description().pairs[static_cast<std::size_t>(c.pair)].friction > 0.0;
  return vertex.is_soft() && !rubs ? Vec3(place + contact.outward(c, k)) : place;
}

/// Surfaces (m, 2), nodes (m, 4) where -1 is none and lower ones are points that nodes carry, weights (m, 4),
/// point, normal, gap, force, sliding, area.
py::tuple contacts(const Simulation& simulation) {
  const Contact& contact = contact_of(simulation);
  const ContactTable table = contact.table(simulation.state());
  const std::size_t count = table.size();
  py::array_t<std::int32_t> surfaces = rows<std::int32_t>(count, 2);
  py::array_t<std::int32_t> nodes = rows<std::int32_t>(count, 4);
  py::array_t<double> weights = rows<double>(count, 4);
  py::array_t<double> points = rows<double>(count, 3);
  py::array_t<double> normals = rows<double>(count, 3);
  py::array_t<double> forces = rows<double>(count, 3);
  py::array_t<double> gaps(static_cast<py::ssize_t>(count));
  py::array_t<double> areas(static_cast<py::ssize_t>(count));
  py::array_t<bool> sliding(static_cast<py::ssize_t>(count));
  const auto& vertices = contact.surfaces().vertices();
  const auto bodies = static_cast<std::int32_t>(contact.description().bodies.size());
  for (std::size_t i = 0; i < count; ++i) {
    const ContactNumbers c = table[i];
    const auto row = static_cast<py::ssize_t>(i);
    const Vec3 n = vector_of(c.normal);
    Vec3 point = Vec3::Zero();
    double positive = 0.0;
    std::int32_t other = -1;
    for (std::size_t k = 0; k < 4; ++k) {
      const auto at = static_cast<py::ssize_t>(k);
      nodes.mutable_at(row, at) = -1;
      weights.mutable_at(row, at) = c.beta[k];
      if (c.vertex[k] < 0.0) continue;
      const auto& vertex = vertices[static_cast<std::size_t>(c.vertex[k])];
      nodes.mutable_at(row, at) = vertex.node < 0 ? vertex.node - 1 : vertex.node;
      if (k == 0) surfaces.mutable_at(row, 0) = vertex.surface;
      if (c.beta[k] < 0.0) other = vertex.surface;
      if (c.beta[k] <= 0.0) continue;
      positive += c.beta[k];
      point += c.beta[k] * pressed_at(contact, c, k, simulation.state());
    }
    if (c.kind == ContactNumbers::kPlane) other = bodies + static_cast<std::int32_t>(c.b);
    surfaces.mutable_at(row, 1) = other;
    point /= positive;
    for (py::ssize_t k = 0; k < 3; ++k) {
      points.mutable_at(row, k) = point[k];
      normals.mutable_at(row, k) = n[k];
      forces.mutable_at(row, k) = c.push[static_cast<std::size_t>(k)];
    }
    gaps.mutable_at(row) = n.dot(vector_of(c.place)) - c.apart;
    areas.mutable_at(row) = c.area;
    sliding.mutable_at(row) = c.sliding != 0.0;
  }
  return py::make_tuple(surfaces, nodes, weights, points, normals, gaps, forces, sliding, areas);
}

py::list surface_names(const Simulation& simulation) {
  py::list names;
  for (const auto& surface : contact_of(simulation).surfaces().surfaces()) names.append(surface.name);
  return names;
}

py::tuple force_on(const Simulation& simulation, const std::string& name) {
  const Contact::Wrench wrench = simulation.contact_force_on(surface_named(contact_of(simulation), name));
  return py::make_tuple(py::array_t<double>(3, wrench.force.data()),
                        py::array_t<double>(3, wrench.moment.data()));
}

/// Surface and its edge (-1: a vertex alone), other surface and its triangle (-1: a plane).
py::list crossing_list(const Simulation& simulation) {
  py::list found;
  for (const Crossing& c : crossings(contact_of(simulation), simulation.state())) {
    found.append(py::make_tuple(c.surface, c.edge, c.other, c.triangle));
  }
  return found;
}

/// Both surfaces, and how far their thicknesses are inside each other.
py::list overlap_list(const Simulation& simulation) {
  py::list found;
  for (const auto& [pair, depth] : overlaps(contact_of(simulation), simulation.state())) {
    found.append(py::make_tuple(pair.first, pair.second, depth));
  }
  return found;
}

void lead_obstacle(Simulation& simulation, const std::string& name, const Doubles& displacement, double angle,
                   const Doubles& axis, const Doubles& center, double over) {
  const Pose pose{to_vec3(center, "center"), to_vec3(displacement, "displacement"),
                  to_vec3(axis, "axis").normalized(), angle};
  contact_of(simulation).lead_to(name, pose, over, simulation.state());
}

/// Where the points of an obstacle at rest are now.
py::array_t<double> obstacle_places(const Simulation& simulation, const std::string& name,
                                    const Doubles& rest) {
  const Contact& contact = contact_of(simulation);
  const std::int32_t obstacle = contact.obstacle_named(name);
  if (obstacle < 0)
    throw ParameterError("found obstacle \"" + name +
                         "\", which this world does not have; the name of one of its obstacles is accepted.");
  std::vector<double> places = to_vector(with_columns(rest, 3, "rest"));
  for (std::int32_t i = 0; i < static_cast<std::int32_t>(places.size() / 3); ++i) {
    const Vec3 point = block(ConstReals(places), i);
    block(Reals(places), i) = contact.place_of(obstacle, point, simulation.state(), simulation.state().time);
  }
  return py::array_t<double>({static_cast<py::ssize_t>(places.size() / 3), py::ssize_t{3}}, places.data());
}

/// The rigid body that carries a free obstacle.
const SurfaceCarrier& carrier_of(const Simulation& simulation, const std::string& name) {
  const Contact& contact = contact_of(simulation);
  const std::int32_t obstacle = contact.obstacle_named(name);
  const SurfaceCarrier* carrier = obstacle < 0 ? nullptr : contact.carrier_of(obstacle);
  if (carrier == nullptr) {
    throw ParameterError("found obstacle \"" + name +
                         "\", which has no mass; its motion is the path on which it is led.");
  }
  return *carrier;
}

/// Position of its centre of mass, rotation (3, 3) from rest, velocity and angular velocity.
py::tuple obstacle_motion(const Simulation& simulation, const std::string& name) {
  const SurfaceCarrier& carrier = carrier_of(simulation, name);
  const State& state = simulation.state();
  const auto three = [](const Vec3& v) { return py::array_t<double>(3, v.data()); };
  const Mat3 R = state.rotations[static_cast<std::size_t>(carrier.frame)].toRotationMatrix();
  py::array_t<double> rotation({py::ssize_t{3}, py::ssize_t{3}});
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) rotation.mutable_at(i, j) = R(i, j);
  }
  return py::make_tuple(three(block(ConstReals(state.positions), carrier.row)), rotation,
                        three(block(ConstReals(state.velocities), carrier.row)),
                        three(block(ConstReals(state.velocities), carrier.rotation)));
}

void set_obstacle_velocity(Simulation& simulation, const std::string& name, const Doubles& velocity,
                           const Doubles& angular_velocity) {
  const SurfaceCarrier& carrier = carrier_of(simulation, name);
  block(Reals(simulation.state().velocities), carrier.row) = to_vec3(velocity, "velocity");
  block(Reals(simulation.state().velocities), carrier.rotation) =
      to_vec3(angular_velocity, "angular_velocity");
}

/// Of an obstacle at rest: vertices (v, 3), triangles (t, 3), edges (e, 2), points (p,), radii (v,) or none,
/// its origin and, of a plane, its normal.
py::tuple obstacle_surface(const Simulation& simulation, const std::string& name) {
  const Contact& contact = contact_of(simulation);
  const std::int32_t number = contact.obstacle_named(name);
  if (number < 0)
    throw ParameterError("found obstacle \"" + name +
                         "\", which this world does not have; the name of one of its obstacles is accepted.");
  const ObstacleDescription& obstacle = contact.description().obstacles[static_cast<std::size_t>(number)];
  const SurfaceDescription& surface = obstacle.surface;
  const auto count = [](const auto& some) { return static_cast<py::ssize_t>(some.size()); };
  py::array_t<double> vertices({count(surface.vertices) / 3, py::ssize_t{3}}, surface.vertices.data());
  py::array_t<std::int32_t> triangles = rows<std::int32_t>(surface.triangles.size(), 3);
  py::array_t<std::int32_t> edges = rows<std::int32_t>(surface.edges.size(), 2);
  for (std::size_t i = 0; i < surface.triangles.size(); ++i) {
    std::ranges::copy(surface.triangles[i], triangles.mutable_data() + 3 * i);
  }
  for (std::size_t i = 0; i < surface.edges.size(); ++i) {
    std::ranges::copy(surface.edges[i], edges.mutable_data() + 2 * i);
  }
  py::object normal = py::none();
  if (obstacle.plane) normal = py::array_t<double>(3, obstacle.normal.data());
  return py::make_tuple(vertices, triangles, edges,
                        py::array_t<std::int32_t>(count(surface.points), surface.points.data()),
                        py::array_t<double>(count(surface.radius), surface.radius.data()),
                        py::array_t<double>(3, obstacle.origin.data()), normal);
}

/// The surface of a body that meets others, as it is now, by the numbers of its nodes: triangles (t, 3),
/// edges (e, 2), radii (n,) or none, and whether it is closed.
py::tuple contact_surface(const Simulation& simulation, const std::string& body) {
  const auto& bodies = contact_of(simulation).description().bodies;
  const auto found = std::ranges::find(bodies, body, &SurfaceDescription::name);
  if (found == bodies.end()) throw ParameterError("found body \"" + body + "\", which meets nothing here.");
  py::array_t<std::int32_t> triangles = rows<std::int32_t>(found->triangles.size(), 3);
  py::array_t<std::int32_t> edges = rows<std::int32_t>(found->edges.size(), 2);
  for (std::size_t i = 0; i < found->triangles.size(); ++i) {
    std::ranges::copy(found->triangles[i], triangles.mutable_data() + 3 * i);
  }
  for (std::size_t i = 0; i < found->edges.size(); ++i) {
    std::ranges::copy(found->edges[i], edges.mutable_data() + 2 * i);
  }
  const py::array_t<double> radius(static_cast<py::ssize_t>(found->radius.size()), found->radius.data());
  return py::make_tuple(triangles, edges, radius, found->closed);
}

/// Area at rest that belongs to each node of a body, up to the last one of its surface [m2]: a third of the
/// triangles at it. What nodes carry gives them its own by the sizes of their weights.
py::array_t<double> contact_areas(const Simulation& simulation, const std::string& body) {
  const Contact& contact = contact_of(simulation);
  const std::int32_t number = surface_named(contact, body);
  const SurfaceSet& surfaces = contact.surfaces();
  std::vector<double> areas;
  const auto add = [&](std::int32_t n, double area) {
    const auto node = static_cast<std::size_t>(n);
    if (node >= areas.size()) areas.resize(node + 1, 0.0);
    areas[node] += area;
  };
  const std::int32_t first = surfaces.surfaces()[static_cast<std::size_t>(number)].first_row;
  const std::int32_t end = first + simulation.world().body(body).node_count;
  for (const SurfaceVertex& vertex : surfaces.vertices()) {
    if (vertex.surface != number) continue;
    if (vertex.rider < 0) {
      add(vertex.node, vertex.area);
    } else {
      for (const RiderPart& part : surfaces.parts(vertex)) {
        if (part.row < first || part.row >= end) continue;  // of another body
        add(part.row - first, std::abs(part.weight) * vertex.area);
      }
    }
  }
  return py::array_t<double>(static_cast<py::ssize_t>(areas.size()), areas.data());
}

/// The vertices of a body's surface: their numbers (n,), ascending, where they are at rest (n, 3), and now.
py::tuple contact_vertices(const Simulation& simulation, const std::string& body) {
  const Contact& contact = contact_of(simulation);
  const auto& of = contact.surfaces().surfaces()[static_cast<std::size_t>(surface_named(contact, body))];
  const auto count = static_cast<std::size_t>(of.last_vertex - of.first_vertex);
  py::array_t<std::int32_t> numbers(static_cast<py::ssize_t>(count));
  py::array_t<double> rest = rows<double>(count, 3);
  py::array_t<double> now = rows<double>(count, 3);
  for (std::int32_t v = of.first_vertex; v < of.last_vertex; ++v) {
    const auto place = 3 * static_cast<std::size_t>(v - of.first_vertex);
    numbers.mutable_at(v - of.first_vertex) = contact.surfaces().vertices()[static_cast<std::size_t>(v)].node;
    std::ranges::copy(block(ConstReals(contact.surfaces().rest()), v), rest.mutable_data() + place);
    std::ranges::copy(contact.place(v, simulation.state()), now.mutable_data() + place);
  }
  return py::make_tuple(numbers, rest, now);
}

/// Points of a body's surface that nodes carry: their numbers as `contacts` has them (p,), ascending, the
/// first of each in the lists (p + 1,), nodes, those of other bodies below zero, and weights.
py::tuple contact_riders(const Simulation& simulation, const std::string& body) {
  const auto& bodies = contact_of(simulation).description().bodies;
  const auto found = std::ranges::find(bodies, body, &SurfaceDescription::name);
  if (found == bodies.end()) throw ParameterError("found body \"" + body + "\", which meets nothing here.");
  SurfaceRiders riders = found->riders;
  const std::int32_t count = simulation.world().body(body).node_count;
  for (std::int32_t& node : riders.node) node = node < count ? node : -1;
  std::vector<std::int32_t> numbers = riders.vertex;
  for (std::int32_t& number : numbers) number -= number < 0 ? 1 : 0;
  const auto ints = [](const std::vector<std::int32_t>& list) {
    return py::array_t<std::int32_t>(static_cast<py::ssize_t>(list.size()), list.data());
  };
  return py::make_tuple(
      ints(numbers), ints(riders.begin), ints(riders.node),
      py::array_t<double>(static_cast<py::ssize_t>(riders.weight.size()), riders.weight.data()));
}

}  // namespace

void bind_contact_run(py::class_<Simulation>& simulation) {
  using py::arg;
  simulation.def("contacts", &contacts)
      .def("contact_surfaces", &surface_names)
      .def("contact_force_on", &force_on, arg("name"))
      .def("crossings", &crossing_list)
      .def("overlaps", &overlap_list)
      .def("obstacle_motion", &obstacle_motion, arg("name"))
      .def("set_obstacle_velocity", &set_obstacle_velocity, arg("name"), arg("velocity"),
           arg("angular_velocity"))
      .def("obstacle_places", &obstacle_places, py::kw_only(), arg("name"), arg("rest"))
      .def("obstacle_surface", &obstacle_surface, arg("name"))
      .def("contact_surface", &contact_surface, arg("body"))
      .def("contact_areas", &contact_areas, arg("body"))
      .def("contact_riders", &contact_riders, arg("body"))
      .def("contact_vertices", &contact_vertices, arg("body"))
      .def("lead_obstacle", &lead_obstacle, py::kw_only(), arg("name"), arg("displacement"), arg("angle"),
           arg("axis"), arg("center"), arg("over"))
      .def(
          "is_obstacle_led_live",
          [](const Simulation& s, const std::string& name) {
            return contact_of(s).is_led_live(name, s.state());
          },
          arg("name"))
      .def(
          "release_obstacle",
          [](Simulation& s, const std::string& name, double over) {
            contact_of(s).release(name, over, s.state());
          },
          py::kw_only(), arg("name"), arg("over"));
}

}  // namespace tissu::bind
