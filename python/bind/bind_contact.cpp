/// What touches what: surfaces, obstacles and pairs, added to the description of a world.

#include <algorithm>
#include <array>
#include <optional>
#include <string_view>
#include <tuple>
#include <utility>

#include "bind.h"
#include "motion.h"
#include "tissu/contact/merged_parts.h"
#include "tissu/world/description.h"

namespace tissu::bind {
namespace {

template <class Kind, std::size_t n>
using Words = std::array<std::pair<std::string_view, Kind>, n>;

constexpr Words<ContactMethod, 5> kMethods = {{{"augmented", ContactMethod::augmented},
                                               {"barrier", ContactMethod::barrier},
                                               {"penalty", ContactMethod::penalty},
                                               {"impulse", ContactMethod::impulse},
                                               {"geometric", ContactMethod::geometric}}};
constexpr Words<BroadPhaseKind, 5> kBroadPhases = {{{"hierarchy", BroadPhaseKind::hierarchy},
                                                    {"sweep_and_prune", BroadPhaseKind::sweep_and_prune},
                                                    {"grid", BroadPhaseKind::grid},
                                                    {"octree", BroadPhaseKind::octree},
                                                    {"fcl", BroadPhaseKind::fcl}}};

constexpr Words<PenaltyLaw, 2> kPenalties = {
    {{"linear", PenaltyLaw::linear}, {"reciprocal", PenaltyLaw::reciprocal}}};

template <class Kind, std::size_t n>
Kind named(const Words<Kind, n>& words, const std::string& name, const char* what) {
  for (const auto& [word, kind] : words) {
    if (word == name) return kind;
  }
  throw ParameterError("found the " + std::string(what) + " '" + name + "', which is not known.");
}

template <class Kind, std::size_t n>
std::string name_of(const Words<Kind, n>& words, Kind wanted) {
  for (const auto& [word, kind] : words) {
    if (kind == wanted) return std::string(word);
  }
  return {};
}

ContactDescription& contact_of(WorldDescription& world) {
  if (!world.contact) throw ParameterError("set_contact comes before surfaces, obstacles and pairs.");
  return *world.contact;
}

template <std::size_t n>
std::vector<std::array<std::int32_t, n>> to_rows(const Ints& array, const char* name) {
  with_columns(array, static_cast<py::ssize_t>(n), name);
  std::vector<std::array<std::int32_t, n>> rows(static_cast<std::size_t>(array.shape(0)));
  for (std::size_t i = 0; i < rows.size(); ++i) std::copy_n(array.data() + i * n, n, rows[i].begin());
  return rows;
}

SurfaceDescription to_surface(const std::string& name, const Doubles& vertices, const Ints& triangles,
                              const Ints& edges, const Ints& points, const Doubles& radius, bool closed) {
  SurfaceDescription surface;
  surface.name = name;
  surface.vertices = to_vector(with_columns(vertices, 3, "vertices"));
  surface.triangles = to_rows<3>(triangles, "triangles");
  surface.edges = to_rows<2>(edges, "edges");
  surface.points = to_vector(points);
  surface.radius = to_vector(radius);
  surface.closed = closed;
  return surface;
}

/// Numbers of the vertices that nodes carry, ascending; of each the first in the lists, and the end; nodes;
/// weights; arms of frames, three numbers each, or none; nodes of other bodies.
using Riders =
    std::tuple<Ints, Ints, Ints, Doubles, Doubles, std::vector<std::pair<std::string, std::int32_t>>>;

SurfaceRiders to_riders(const Riders& given, std::int32_t own) {
  const auto& [vertex, begin, node, weight, arm, others] = given;
  SurfaceRiders riders{to_vector(vertex), to_vector(begin), to_vector(node),
                       to_vector(weight), to_vector(arm),   {}};
  for (const auto& [body, number] : others) riders.others.push_back({body, number});
  const std::int32_t nodes = own + static_cast<std::int32_t>(others.size());
  const auto ends = static_cast<std::int32_t>(riders.node.size());
  const bool whole = riders.begin.size() == riders.vertex.size() + 1 && riders.begin.front() == 0 &&
                     riders.begin.back() == ends && riders.weight.size() == riders.node.size() &&
                     (riders.arm.empty() || riders.arm.size() == 3 * riders.node.size());
  if (!whole || !std::ranges::is_sorted(riders.begin) || !std::ranges::is_sorted(riders.vertex)) {
    throw ParameterError("found lists of riders whose lengths do not fit together.");
  }
  if (std::ranges::any_of(riders.node, [&](std::int32_t n) { return n < 0 || n >= nodes; })) {
    throw ParameterError("found riders on nodes that are not there.");
  }
  for (std::size_t i = 0; !riders.arm.empty() && i + 1 < riders.begin.size(); ++i) {
    if (riders.begin[i + 1] - riders.begin[i] <= static_cast<std::int32_t>(kMostFrames)) continue;
    throw ParameterError("found a vertex that more than " + std::to_string(kMostFrames) +
                         " frames and nodes carry; so many at most are accepted.");
  }
  return riders;
}

/// A number that no rider has is a node.
void require_vertices(const SurfaceDescription& surface, std::int32_t nodes) {
  for (const auto& triangle : surface.triangles) {
    for (const std::int32_t v : triangle) {
      if (v < nodes && (v >= 0 || std::ranges::binary_search(surface.riders.vertex, v))) continue;
      throw ParameterError("found vertex " + std::to_string(v) + " in a triangle of the surface of \"" +
                           surface.name + "\", which is not there.");
    }
  }
}

/// Times, displacements, angles, center and axis of a motion.
using Path = std::tuple<Doubles, Doubles, Doubles, Doubles, Doubles>;

Motion motion_of(const std::optional<Path>& path) {
  if (!path) return {};
  const auto& [times, displacements, angles, center, axis] = *path;
  return to_motion(times, displacements, angles, center, axis);
}

void set_contact(WorldDescription& world, const std::string& method, const std::string& broad_phase,
                 const std::string& penalty, int iterations, bool travel) {
  ContactDescription contact;
  contact.method = named(kMethods, method, "contact method");
  contact.broad_phase = named(kBroadPhases, broad_phase, "broad phase");
  contact.penalty = named(kPenalties, penalty, "penalty");
  contact.iterations = iterations;
  contact.travel = travel;
  world.contact = std::move(contact);
}

/// Mass, inertia about the origin, velocity and angular velocity of a rigid body.
using Rigid = std::tuple<double, Doubles, Doubles, Doubles>;

FrameDescription frame_of(const Rigid& rigid, const Vec3& origin) {
  const auto& [mass, inertia, velocity, angular_velocity] = rigid;
  if (inertia.ndim() != 2 || inertia.shape(0) != 3 || inertia.shape(1) != 3) {
    throw ParameterError("the inertia of an obstacle has 3 rows and 3 columns.");
  }
  FrameDescription frame;
  frame.position = origin;
  frame.mass = mass;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) frame.inertia(i, j) = inertia.at(i, j);
  }
  frame.velocity = to_vec3(velocity, "velocity");
  frame.angular_velocity = to_vec3(angular_velocity, "angular_velocity");
  return frame;
}

void add_obstacle(WorldDescription& world, const std::string& name, const Doubles& vertices,
                  const Ints& triangles, const Ints& edges, const Ints& points, const Doubles& radius,
                  bool closed, const Doubles& origin, const std::optional<Path>& motion,
                  const std::optional<Rigid>& rigid) {
  ObstacleDescription obstacle;
  obstacle.surface = to_surface(name, vertices, triangles, edges, points, radius, closed);
  obstacle.origin = to_vec3(origin, "origin");
  obstacle.motion = motion_of(motion);
  ContactDescription& contact = contact_of(world);
  if (rigid) {
    obstacle.frame = static_cast<std::int32_t>(world.frames.size());
    world.frames.push_back(frame_of(*rigid, obstacle.origin));
  }
  contact.obstacles.push_back(std::move(obstacle));
}

void add_plane(WorldDescription& world, const std::string& name, const Doubles& normal, const Doubles& origin,
               const std::optional<Path>& motion) {
  ObstacleDescription obstacle;
  obstacle.surface.name = name;
  obstacle.plane = true;
  const Vec3 direction = to_vec3(normal, "normal");
  if (!(direction.norm() > 0.0)) throw ParameterError("the normal of a plane must not be zero.");
  obstacle.normal = direction.normalized();
  obstacle.origin = to_vec3(origin, "origin");
  obstacle.motion = motion_of(motion);
  contact_of(world).obstacles.push_back(std::move(obstacle));
}

void add_pair(WorldDescription& world, std::int32_t a, std::int32_t b, double friction, double gap,
              std::optional<double> restitution, std::optional<double> stiffness, const Ints& nodes) {
  contact_of(world).pairs.push_back({a, b, friction, gap, restitution, stiffness, to_vector(nodes)});
}

template <std::size_t n>
py::array_t<std::int32_t> rows_of(const std::vector<std::array<std::int32_t, n>>& rows) {
  py::array_t<std::int32_t> array({static_cast<py::ssize_t>(rows.size()), static_cast<py::ssize_t>(n)});
  for (std::size_t i = 0; i < rows.size(); ++i) std::copy_n(rows[i].begin(), n, array.mutable_data() + i * n);
  return array;
}

template <class T>
py::array_t<T> array_of(const std::vector<T>& values) {
  return py::array_t<T>(static_cast<py::ssize_t>(values.size()), values.data());
}

py::array_t<double> array_of(const Vec3& vector) { return py::array_t<double>(3, vector.data()); }

py::dict surface_of(const SurfaceDescription& surface) {
  py::dict found;
  found["name"] = surface.name;
  found["vertices"] = array_of(surface.vertices).attr("reshape")(-1, 3);
  found["triangles"] = rows_of(surface.triangles);
  found["edges"] = rows_of(surface.edges);
  found["points"] = array_of(surface.points);
  found["radius"] = array_of(surface.radius);
  found["closed"] = surface.closed;
  return found;
}

py::dict obstacle_of(const ObstacleDescription& obstacle) {
  py::dict found = surface_of(obstacle.surface);
  found["plane"] = obstacle.plane;
  found["normal"] = array_of(obstacle.normal);
  found["origin"] = array_of(obstacle.origin);
  found["times"] = array_of(obstacle.motion.times);
  found["angles"] = array_of(obstacle.motion.angles);
  py::list displacements;
  for (const Vec3& displacement : obstacle.motion.displacements) displacements.append(array_of(displacement));
  found["displacements"] = displacements;
  return found;
}

/// The description as it stands, for tests; None without contact.
py::object described_contact(const WorldDescription& world) {
  if (!world.contact) return py::none();
  const ContactDescription& contact = *world.contact;
  py::dict found;
  py::list bodies, obstacles, pairs;
  for (const SurfaceDescription& body : contact.bodies) bodies.append(surface_of(body));
  for (const ObstacleDescription& obstacle : contact.obstacles) obstacles.append(obstacle_of(obstacle));
  for (const ContactPair& pair : contact.pairs) {
    pairs.append(py::make_tuple(pair.a, pair.b, pair.friction, pair.gap, pair.restitution, pair.stiffness,
                                array_of(pair.nodes)));
  }
  found["bodies"] = bodies;
  found["obstacles"] = obstacles;
  found["pairs"] = pairs;
  found["method"] = name_of(kMethods, contact.method);
  found["broad_phase"] = name_of(kBroadPhases, contact.broad_phase);
  found["penalty"] = name_of(kPenalties, contact.penalty);
  found["iterations"] = contact.iterations;
  found["travel"] = contact.travel;
  return found;
}

}  // namespace

void bind_contact(py::class_<WorldDescription>& builder) {
  using py::arg;
  builder
      .def("set_contact", &set_contact, py::kw_only(), arg("method"), arg("broad_phase"), arg("penalty"),
           arg("iterations"), arg("travel"))
      .def(
          "add_contact_surface",
          [](WorldDescription& world, const std::string& body, const Ints& triangles, const Ints& edges,
             const Doubles& radius, bool closed, const std::optional<Riders>& riders) {
            const Doubles none(std::vector<py::ssize_t>{0, 3});
            const BodyDescription& of = world.body(body);
            const auto nodes = static_cast<std::int32_t>(of.positions.size() / 3);
            SurfaceDescription surface = to_surface(of.name, none, triangles, edges, Ints(0), radius, closed);
            if (riders) surface.riders = to_riders(*riders, nodes);
            require_vertices(surface, nodes);
            contact_of(world).bodies.push_back(std::move(surface));
          },
          py::kw_only(), arg("body"), arg("triangles"), arg("edges"), arg("radius"), arg("closed"),
          arg("riders").none(true))
      .def("add_obstacle", &add_obstacle, py::kw_only(), arg("name"), arg("vertices"), arg("triangles"),
           arg("edges"), arg("points"), arg("radius"), arg("closed"), arg("origin"), arg("motion").none(true),
           arg("rigid").none(true))
      .def("add_plane", &add_plane, py::kw_only(), arg("name"), arg("normal"), arg("origin"),
           arg("motion").none(true))
      .def("add_contact_pair", &add_pair, py::kw_only(), arg("a"), arg("b"), arg("friction"), arg("gap"),
           arg("restitution").none(true), arg("stiffness").none(true), arg("nodes"))
      .def("described_contact", &described_contact);
}

}  // namespace tissu::bind
