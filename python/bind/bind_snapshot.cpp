#include <algorithm>
#include <string>
#include <utility>

#include "bind.h"
#include "tissu/simulation/simulation.h"

namespace tissu::bind {
namespace {

template <class T>
Array<T> to_array(const std::vector<T>& values) {
  Array<T> result(static_cast<py::ssize_t>(values.size()));
  std::ranges::copy(values, result.mutable_data());
  return result;
}

/// x, y, z, w of each, one after the other.
std::vector<double> numbers_of(const std::vector<Quaternion>& rotations) {
  std::vector<double> result;
  for (const Quaternion& rotation : rotations) {
    result.insert(result.end(), rotation.coeffs().data(), rotation.coeffs().data() + 4);
  }
  return result;
}

std::vector<Quaternion> rotations_of(const std::vector<double>& numbers) {
  std::vector<Quaternion> result;
  for (std::size_t i = 0; i + 4 <= numbers.size(); i += 4) {
    Quaternion rotation;
    std::copy_n(numbers.data() + i, 4, rotation.coeffs().data());
    result.push_back(rotation);
  }
  return result;
}

/// What models remember, list after list.
std::vector<double> joined(const Memory& memory) {
  std::vector<double> all;
  for (const std::vector<double>& one : memory) all.insert(all.end(), one.begin(), one.end());
  return all;
}

std::vector<std::int32_t> sizes_of(const Memory& memory) {
  std::vector<std::int32_t> sizes;
  for (const std::vector<double>& one : memory) sizes.push_back(static_cast<std::int32_t>(one.size()));
  return sizes;
}

/// The same lists again; refuses sizes that are not those of the numbers.
Memory split(const std::vector<double>& numbers, const std::vector<std::int32_t>& sizes) {
  Memory memory;
  std::size_t next = 0;
  for (const std::int32_t size : sizes) {
    const std::size_t end = next + static_cast<std::size_t>(std::max(size, 0));
    if (size < 0 || end > numbers.size()) break;
    memory.emplace_back(numbers.begin() + static_cast<std::ptrdiff_t>(next),
                        numbers.begin() + static_cast<std::ptrdiff_t>(end));
    next = end;
  }
  if (memory.size() == sizes.size() && next == numbers.size()) return memory;
  throw ParameterError(
      "the snapshot remembers " + std::to_string(numbers.size()) +
      " numbers, which is not what its lists add up to; restore a snapshot as it was taken.");
}

/// Calls f(name, list) for every list of a body that was cut.
template <class Body, class Function>
void for_cut_lists(Body& body, Function&& f) {
  f("origins_", body.origins);
  f("nodes_", body.nodes);
  f("copies_of_", body.copies_of);
  f("bare_", body.bare);
  f("rider_nodes_", body.material.rider_nodes);
  f("material_hosts_", body.material.hosts);
  f("material_first_", body.material.first);
  f("material_vertices_", body.material.vertices);
  f("material_cut_", body.material.cut);
  f("incisions_", body.material.incisions);
  f("first_of_incision_", body.material.first_of_incision);
  f("on_incision_", body.material.on_incision);
  f("at_front_", body.material.at_front);
}

void add_cut(const BodyTopology& body, const std::string& number, py::dict& result) {
  for_cut_lists(body, [&](const char* name, const std::vector<std::int32_t>& list) {
    result[py::str(name + number)] = to_array(list);
  });
  result[py::str("shares_" + number)] = to_array(body.shares);
  result[py::str("rider_weights_" + number)] = to_array(body.material.rider_weights);
  result[py::str("next_cell_" + number)] = body.next_cell;
  if (!body.rest.empty()) result[py::str("rest_" + number)] = to_array(body.rest);
  if (body.point_nodes.empty()) return;
  result[py::str("point_nodes_" + number)] = to_array(body.point_nodes);
  result[py::str("point_weights_" + number)] = to_array(body.point_weights);
}

py::dict to_dict(const Snapshot& snapshot) {
  py::dict result;
  const State& state = snapshot.state;
  result["time"] = state.time;
  result["time_before"] = snapshot.time_before;
  result["load_factor"] = state.load_factor;
  result["memory_time"] = state.memory_time;
  result["settled"] = snapshot.settled;
  result["positions"] = to_array(state.positions);
  result["velocities"] = to_array(state.velocities);
  result["velocities_before"] = to_array(snapshot.velocities_before);
  if (!snapshot.straining.empty()) result["straining"] = to_array(snapshot.straining);
  result["rotations"] = to_array(numbers_of(state.rotations));
  result["memory"] = to_array(joined(state.memory));
  result["memory_sizes"] = to_array(sizes_of(state.memory));
  result["integrator"] = to_array(snapshot.integrator);
  result["energy_watch"] = to_array(snapshot.energy_watch);
  for (std::size_t i = 0; i < snapshot.bodies.size(); ++i) {
    const BodyTopology& body = snapshot.bodies[i];
    const std::string number = std::to_string(i);
    result[py::str("body_" + number)] = body.body;
    result[py::str("cells_" + number)] = to_array(body.cells);
    result[py::str("loose_nodes_" + number)] = to_array(body.loose_nodes);
    result[py::str("places_" + number)] = to_array(body.places);
    if (body.was_cut()) add_cut(body, number, result);
  }
  return result;
}

template <class T>
T value(const py::dict& from, const std::string& name) {
  if (!from.contains(name.c_str())) throw ParameterError("the snapshot has no \"" + name + "\".");
  return from[name.c_str()].cast<T>();
}

std::vector<double> doubles(const py::dict& from, const std::string& name) {
  return to_vector(value<Doubles>(from, name));
}

std::vector<std::int32_t> integers(const py::dict& from, const std::string& name) {
  return to_vector(value<Array<std::int32_t>>(from, name));
}

void read_cut(const py::dict& from, const std::string& number, BodyTopology& body) {
  for_cut_lists(
      body, [&](const char* name, std::vector<std::int32_t>& list) { list = integers(from, name + number); });
  body.shares = doubles(from, "shares_" + number);
  body.material.rider_weights = doubles(from, "rider_weights_" + number);
  body.next_cell = value<std::int32_t>(from, "next_cell_" + number);
  if (from.contains(("rest_" + number).c_str())) body.rest = doubles(from, "rest_" + number);
  if (!from.contains(("point_nodes_" + number).c_str())) return;
  body.point_nodes = integers(from, "point_nodes_" + number);
  body.point_weights = doubles(from, "point_weights_" + number);
}

Snapshot from_dict(const py::dict& from) {
  Snapshot snapshot;
  State& state = snapshot.state;
  state.time = value<double>(from, "time");
  snapshot.time_before = value<double>(from, "time_before");
  state.load_factor = value<double>(from, "load_factor");
  state.memory_time = value<double>(from, "memory_time");
  snapshot.settled = value<bool>(from, "settled");
  state.positions = doubles(from, "positions");
  state.velocities = doubles(from, "velocities");
  snapshot.velocities_before = doubles(from, "velocities_before");
  if (from.contains("straining")) snapshot.straining = doubles(from, "straining");
  state.rotations = rotations_of(doubles(from, "rotations"));
  state.memory = split(doubles(from, "memory"), to_vector(value<Array<std::int32_t>>(from, "memory_sizes")));
  snapshot.integrator = doubles(from, "integrator");
  snapshot.energy_watch = doubles(from, "energy_watch");
  for (std::size_t i = 0; from.contains(("body_" + std::to_string(i)).c_str()); ++i) {
    const std::string number = std::to_string(i);
    BodyTopology body;
    body.body = value<std::string>(from, "body_" + number);
    body.cells = integers(from, "cells_" + number);
    body.loose_nodes = integers(from, "loose_nodes_" + number);
    body.places = doubles(from, "places_" + number);
    if (from.contains(("origins_" + number).c_str())) read_cut(from, number, body);
    snapshot.bodies.push_back(std::move(body));
  }
  return snapshot;
}

py::array_t<double> remembered(Simulation& simulation, const std::string& name) {
  return to_array(simulation.memory(name));
}

/// Puts other numbers in the place of what the state remembers; refuses those that no model can read.
void set_remembered(Simulation& simulation, const std::string& name, const Doubles& numbers) {
  std::vector<double>& place = simulation.memory(name);
  std::vector<double> before = std::exchange(place, to_vector(numbers));
  try {
    check_memory(simulation.world(), simulation.state());
  } catch (...) {
    place = std::move(before);
    throw;
  }
}

/// Nodes of a body that are not unknowns, and those that are held or led on all axes.
py::tuple unfree_nodes(const Simulation& simulation, const std::string& name) {
  const Body& body = simulation.world().body(name);
  std::vector<std::int32_t> eliminated;
  for (const BodyModel* model : body.models) {
    for (const std::int32_t node : model->eliminated()) eliminated.push_back(node - body.first_node);
  }
  std::vector<std::int32_t> held;
  const std::vector<std::uint8_t>& masks = simulation.world().fixed().masks();
  for (std::int32_t node = 0; node < body.node_count; ++node) {
    if (masks[static_cast<std::size_t>(body.first_node + node)] == FixedDofs::kAllAxes) held.push_back(node);
  }
  return py::make_tuple(to_array(eliminated), to_array(held));
}

/// First frame of a body among those of the world, -1 where its nodes are none, and its rotations' first
/// block.
py::tuple frames_of(const Simulation& simulation, const std::string& name) {
  const Body& body = simulation.world().body(name);
  if (body.first_frame < 0) return py::make_tuple(-1, -1);
  const Frame& first = simulation.world().frames()[static_cast<std::size_t>(body.first_frame)];
  return py::make_tuple(body.first_frame, first.rotation);
}

}  // namespace

void bind_snapshot(py::class_<Simulation>& simulation) {
  simulation.def("remembered", &remembered, py::arg("name"))
      .def("set_remembered", &set_remembered, py::arg("name"), py::arg("numbers"))
      .def("unfree_nodes", &unfree_nodes, py::arg("body"))
      .def("frames_of", &frames_of, py::arg("body"))
      .def("snapshot", [](Simulation& s) { return to_dict(s.snapshot()); })
      .def(
          "restore", [](Simulation& s, const py::dict& snapshot) { s.restore(from_dict(snapshot)); },
          py::arg("snapshot"));
}

}  // namespace tissu::bind
