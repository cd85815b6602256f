/// Cuts of a running simulation: blades, plans that are made, and what is there afterwards.

#include <algorithm>

#include "bind.h"
#include "tissu/edit/body_totals.h"
#include "tissu/edit/cut/anchors.h"
#include "tissu/edit/cut/material_mesh.h"
#include "tissu/edit/cut_body.h"
#include "tissu/edit/repair_body.h"
#include "tissu/edit/topology.h"
#include "tissu/simulation/simulation.h"

namespace tissu::bind {
namespace {

template <class T>
Array<T> to_array(const std::vector<T>& values) {
  Array<T> result(static_cast<py::ssize_t>(values.size()));
  std::ranges::copy(values, result.mutable_data());
  return result;
}

Array<double> to_array(const Vec3& v) { return to_array(std::vector<double>{v.x(), v.y(), v.z()}); }

template <class T>
std::span<const T> numbers(const Array<T>& array) {
  return {array.data(), static_cast<std::size_t>(array.size())};
}

py::dict to_dict(const BodyTotals& totals) {
  py::dict result;
  result["volume"] = totals.volume;
  result["mass"] = totals.mass;
  result["momentum"] = to_array(totals.momentum);
  result["angular_momentum"] = to_array(totals.angular_momentum);
  result["kinetic"] = totals.kinetic;
  result["elastic"] = totals.elastic;
  return result;
}

py::dict to_dict(const CutPlan& plan) {
  py::dict result;
  result["cells_cut"] = plan.cells_cut;
  result["cells_new"] = plan.born.size();
  result["cells_gone"] = plan.gone.size();
  result["nodes_new"] = plan.nodes.size();
  result["faces_opened"] = plan.faces_opened;
  result["area"] = plan.area;
  result["rest_area"] = plan.rest_area;
  std::vector<std::int32_t> copied;
  for (const BornNode& node : plan.nodes)
    if (node.copied >= 0 && node.copied < plan.first_node) copied.push_back(node.copied);
  result["copied"] = to_array(copied);
  std::vector<std::pair<std::int32_t, std::string>> unresolved;
  unresolved.reserve(plan.unresolved.size());
  for (const auto& [cell, reason] : plan.unresolved) unresolved.emplace_back(cell, words(reason));
  result["unresolved"] = unresolved;
  result["parts_nothing"] = plan.parts_nothing;
  result["bridges"] = plan.bridges();
  result["nodes_moved"] = plan.moved.size();
  return result;
}

py::dict to_dict(const Simulation::Edited& edited) {
  py::dict result = to_dict(edited.plan);
  result["relaid"] = edited.relaid;
  result["least_quality"] = edited.least_quality;
  result["before"] = to_dict(edited.before);
  result["after"] = to_dict(edited.after);
  return result;
}

py::dict cut(Simulation& simulation, const std::string& body, const Sweep& sweep, double t0, bool refine,
             bool divide, bool snap, bool depth, const Ints& still) {
  return to_dict(simulation.cut(body, sweep,
                                {.t0 = t0,
                                 .refine = refine,
                                 .divide = divide,
                                 .snap = snap,
                                 .depth = depth,
                                 .still = to_vector(still)}));
}

py::dict repair(Simulation& simulation, const std::string& body, double below, std::int32_t most, double jump,
                const Ints& still, const Ints& regions, const Ints& goes_on) {
  const Simulation::Repaired repaired = simulation.repair(body, {.below = below,
                                                                 .most = most,
                                                                 .jump = jump,
                                                                 .still = to_vector(still),
                                                                 .regions = to_vector(regions),
                                                                 .goes_on = to_vector(goes_on)});
  py::dict result = to_dict(repaired);
  const RepairCounts& counts = repaired.counts;
  py::dict made;
  made["collapses"] = counts.collapses;
  made["flips"] = counts.flips;
  made["moves"] = counts.moves;
  made["bad_before"] = counts.bad_before;
  made["bad_after"] = counts.bad_after;
  made["least_quality_before"] = counts.least_before;
  made["least_quality_after"] = counts.least_after;
  result["repairs"] = made;
  return result;
}

py::dict ablate(Simulation& simulation, const std::string& body, const Ints& cells) {
  return to_dict(simulation.ablate(body, to_vector(cells)));
}

/// The nodes (v, 4) of each vertex, -1 beyond the last, and their weights (v, 4).
void add_riders(const std::vector<Rider>& vertices, py::dict& result) {
  Ints nodes({static_cast<py::ssize_t>(vertices.size()), py::ssize_t{4}});
  Doubles weights({static_cast<py::ssize_t>(vertices.size()), py::ssize_t{4}});
  for (std::size_t v = 0; v < vertices.size(); ++v) {
    for (std::size_t k = 0; k < 4; ++k) {
      const bool rides = static_cast<std::int32_t>(k) < vertices[v].count;
      nodes.mutable_at(static_cast<py::ssize_t>(v), static_cast<py::ssize_t>(k)) =
          rides ? vertices[v].node[k] : -1;
      weights.mutable_at(static_cast<py::ssize_t>(v), static_cast<py::ssize_t>(k)) =
          rides ? vertices[v].weight[k] : 0.0;
    }
  }
  result["nodes"] = nodes;
  result["weights"] = weights;
}

py::dict surface(const Simulation& simulation, const std::string& body) {
  const auto cut = cut_state(simulation.world(), body);
  const MaterialSurface found = material_surface(cut->hosts, cut->material);
  py::dict result;
  add_riders(found.vertices, result);
  Ints triangles({static_cast<py::ssize_t>(found.triangles.size()), py::ssize_t{3}});
  for (std::size_t t = 0; t < found.triangles.size(); ++t)
    std::ranges::copy(found.triangles[t], triangles.mutable_data(static_cast<py::ssize_t>(t)));
  result["triangles"] = triangles;
  result["cell"] = to_array(found.cell);
  Ints lines({static_cast<py::ssize_t>(found.lines.size()), py::ssize_t{2}});
  for (std::size_t l = 0; l < found.lines.size(); ++l)
    std::ranges::copy(found.lines[l], lines.mutable_data(static_cast<py::ssize_t>(l)));
  result["lines"] = lines;
  result["line_cell"] = to_array(found.line_cell);
  result["vertex_node"] = to_array(found.vertex_node);
  py::array_t<bool> opened(static_cast<py::ssize_t>(found.cut.size()));
  std::ranges::transform(found.cut, opened.mutable_data(), [](char c) { return c != 0; });
  result["cut"] = opened;
  return result;
}

py::dict material(const Simulation& simulation, const std::string& body) {
  const auto cut = cut_state(simulation.world(), body);
  const MaterialMesh found = material_mesh(cut->hosts, cut->material);
  py::dict result;
  add_riders(found.vertices, result);
  result["vertex_node"] = to_array(found.vertex_node);
  result["cell"] = to_array(found.cell);
  py::list blocks;
  for (const CellBlock& block : found.blocks) {
    Ints nodes({static_cast<py::ssize_t>(block.size()), static_cast<py::ssize_t>(info(block.type).nodes)});
    std::ranges::copy(block.nodes, nodes.mutable_data());
    blocks.append(py::make_tuple(std::string(info(block.type).name), nodes));
  }
  result["blocks"] = blocks;
  return result;
}

/// Cells, volume, and whether supports hold nodes on all axes, of each connected part.
py::list found_pieces(const Simulation& simulation, const std::string& name) {
  const Body& body = simulation.world().body(name);
  const auto cut = cut_state(simulation.world(), name);
  const std::vector<std::int32_t>& rows = simulation.world().fixed().rows();
  const std::vector<std::uint8_t>& masks = simulation.world().fixed().masks();
  std::vector<std::pair<std::int32_t, std::uint8_t>> held;  // cells with a held node, and its axes
  for (auto row = std::ranges::lower_bound(rows, body.first_node);
       row != rows.end() && *row < body.first_node + body.node_count; ++row) {
    for (const std::int32_t cell : cut->hosts.cells_at(*row - body.first_node)) {
      held.emplace_back(cell, masks[static_cast<std::size_t>(*row)]);
    }
  }
  py::list result;
  for (const Piece& piece : simulation.pieces(name)) {
    unsigned axes = 0;
    for (const auto& [cell, mask] : held) {
      if ((axes & FixedDofs::kAllAxes) == FixedDofs::kAllAxes) break;
      if (std::ranges::binary_search(piece.cells, cell)) axes |= mask;
    }
    const bool on_all = (axes & FixedDofs::kAllAxes) == FixedDofs::kAllAxes;
    result.append(py::make_tuple(to_array(piece.cells), piece.volume, on_all));
  }
  return result;
}

/// Cells of the body in ascending number: (type, numbers, origins, shares, nodes (k, n)) of runs of one type.
py::list body_cells(const Simulation& simulation, const std::string& name) {
  const auto cut = cut_state(simulation.world(), name);
  const Hosts& hosts = cut->hosts;
  const std::vector<std::int32_t> all = hosts.numbers();
  py::list runs;
  for (std::size_t begin = 0, end = 0; begin < all.size(); begin = end) {
    const CellType type = hosts.type(all[begin]);
    while (end < all.size() && hosts.type(all[end]) == type) ++end;
    std::vector<std::int32_t> numbers(all.begin() + static_cast<std::ptrdiff_t>(begin),
                                      all.begin() + static_cast<std::ptrdiff_t>(end));
    std::vector<std::int32_t> origins;
    std::vector<double> shares;
    Ints nodes({static_cast<py::ssize_t>(end - begin), static_cast<py::ssize_t>(info(type).nodes)});
    std::int32_t* to = nodes.mutable_data();
    for (const std::int32_t number : numbers) {
      origins.push_back(hosts.origin(number));
      shares.push_back(hosts.share(number));
      to = std::ranges::copy(hosts.nodes(number), to).out;
    }
    runs.append(py::make_tuple(std::string(info(type).name), to_array(numbers), to_array(origins),
                               to_array(shares), nodes));
  }
  return runs;
}

/// The first day's node of each node of the body; -1 of those that a blade put on an edge.
Ints roots(const Simulation& simulation, const std::string& name) {
  const auto cut = cut_state(simulation.world(), name);
  std::vector<std::int32_t> found(static_cast<std::size_t>(cut->hosts.node_count()));
  for (std::size_t node = 0; node < found.size(); ++node)
    found[node] = std::max(cut->hosts.root(static_cast<std::int32_t>(node)), -1);
  return to_array(found);
}

/// Places at rest (n, 3) of the nodes of the body, and the nodes of the first day between which each is.
py::tuple made_of(const Simulation& simulation, const std::string& name) {
  const auto cut = cut_state(simulation.world(), name);
  Doubles places({static_cast<py::ssize_t>(cut->hosts.node_count()), py::ssize_t{3}});
  std::ranges::copy(cut->hosts.rest(), places.mutable_data());
  std::vector<Rider> riders;
  for (std::int32_t node = 0; node < cut->hosts.node_count(); ++node) {
    const std::int32_t root = cut->hosts.root(node);
    riders.push_back(Rider{{root, -1, -1, -1}, {1.0, 0.0, 0.0, 0.0}, 1});
    if (root < 0) riders.back() = cut->hosts.points()[static_cast<std::size_t>(-1 - root)];
  }
  py::dict result;
  add_riders(riders, result);
  return py::make_tuple(places, py::object(result["nodes"]), py::object(result["weights"]));
}

/// Anchors of points (m, 3) in a body: whether they are inside (m,), nodes (m, 4), weights (m, 4), offsets.
py::tuple anchored(const Simulation& simulation, const std::string& name, const Doubles& points) {
  const auto cut = cut_state(simulation.world(), name);
  const auto first = 3 * static_cast<std::size_t>(simulation.world().body(name).first_node);
  const ConstReals x = ConstReals(simulation.state().positions)
                           .subspan(first, 3 * static_cast<std::size_t>(cut->hosts.node_count()));
  const std::vector<Anchor> found =
      anchors(cut->hosts, cut->material, x, numbers(with_columns(points, 3, "points")));
  std::vector<Rider> riders;
  py::array_t<bool> inside(static_cast<py::ssize_t>(found.size()));
  Doubles offsets({static_cast<py::ssize_t>(found.size()), py::ssize_t{3}});
  for (std::size_t i = 0; i < found.size(); ++i) {
    riders.push_back(found[i].rider);
    inside.mutable_data()[i] = found[i].inside;
    std::copy_n(found[i].offset.data(), 3, offsets.mutable_data(static_cast<py::ssize_t>(i)));
  }
  py::dict result;
  add_riders(riders, result);
  return py::make_tuple(inside, py::object(result["nodes"]), py::object(result["weights"]), offsets);
}

std::shared_ptr<World> edited_like(const World& fresh, const Simulation& simulation) {
  return std::const_pointer_cast<World>(with_topologies(fresh, topologies(simulation.world())));
}

}  // namespace

void bind_cut(py::class_<Simulation>& simulation) {
  using py::arg;
  simulation
      .def("cut", &cut, py::kw_only(), arg("body"), arg("sweep"), arg("t0"), arg("refine"), arg("divide"),
           arg("snap"), arg("depth"), arg("still"))
      .def("repair", &repair, py::kw_only(), arg("body"), arg("below"), arg("most"), arg("jump"),
           arg("still"), arg("regions"), arg("goes_on"))
      .def(
          "require_repair",
          [](const Simulation& s, const std::string& body) { refuse_unrepaired(s.world(), body); },
          arg("body"))
      .def("ablate", &ablate, py::kw_only(), arg("body"), arg("cells"))
      .def("anchors", &anchored, py::kw_only(), arg("body"), arg("points"))
      .def(
          "require_parting",
          [](const Simulation& s, const std::string& body) {
            const WorldDescription& description = *s.world().description();
            refuse_unparted(description,
                            *std::ranges::find(description.bodies, body, &BodyDescription::name));
          },
          arg("body"))
      .def("material_surface", &surface, arg("body"))
      .def("material_mesh", &material, arg("body"))
      .def(
          "incisions",
          [](const Simulation& s, const std::string& body) {
            const auto cut = cut_state(s.world(), body);
            std::vector<std::int32_t> found;
            for (const Incision& incision : cut->material.incisions) found.push_back(incision.number);
            return found;
          },
          arg("body"))
      .def(
          "divided",
          [](const Simulation& s, const std::string& body) {
            const Material& material = cut_state(s.world(), body)->material;
            return !material.cells.empty() || !material.incisions.empty();
          },
          arg("body"))
      .def(
          "moved",
          [](const Simulation& s, const std::string& body) {
            const WorldDescription* description = s.world().description();
            return description != nullptr &&
                   std::ranges::any_of(description->bodies, [&](const BodyDescription& one) {
                     return one.name == body && one.moved;
                   });
          },
          arg("body"))
      .def("pieces", &found_pieces, arg("body"))
      .def("body_cells", &body_cells, arg("body"))
      .def("roots", &roots, arg("body"))
      .def("made_of", &made_of, arg("body"))
      .def(
          "mass", [](const Simulation& s, const std::string& name) { return material_mass(s.world(), name); },
          arg("body"))
      .def(
          "cell_count",
          [](const Simulation& s, const std::string& name) {
            std::int32_t count = 0;
            for (const BodyModel* model : s.world().body(name).models) count += model->cell_count();
            return count;
          },
          arg("body"))
      .def(
          "totals",
          [](const Simulation& s, const std::string& body) {
            return to_dict(totals(s.world(), s.state(), body));
          },
          arg("body"))
      .def(
          "edited_like_now", [](const Simulation& s, const World& fresh) { return edited_like(fresh, s); },
          arg("fresh"))
      .def("prepare_edits", &Simulation::prepare_edits)
      .def("mark", &Simulation::mark)
      .def("rewind", &Simulation::rewind, arg("mark"));
}

}  // namespace tissu::bind
