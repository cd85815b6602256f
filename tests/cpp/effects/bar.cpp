#include "bar.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

#include "tissu/edit/remove_cells.h"
#include "tissu/force/grabs.h"
#include "tissu/force/links.h"
#include "tissu/mesh/box.h"
#include "tissu/mesh/topology.h"

namespace tissu::effects {
namespace {

constexpr double kYoung = 1e4;     // Pa
constexpr double kDensity = 1e3;   // kg/m3
constexpr double kThin = 1e-4;     // m, of sheets
constexpr double kSection = 1e-6;  // m2, of lines

ElasticBlock block_of(std::string_view element, std::string_view law, std::vector<std::int32_t> cells) {
  ElasticBlock block;
  block.element = element;
  block.law = law;
  block.cells = std::move(cells);
  block.parameters = {{"young", {kYoung}}, {"poisson", {0.3}}};
  block.density = {kDensity};
  return block;
}

/// The faces of the surface; `at` an end of the bar, those of that end.
std::vector<std::int32_t> faces(const Mesh& mesh, const double* at = nullptr) {
  std::vector<std::int32_t> nodes;
  for (const auto& face : boundary_surface(mesh).triangles) {
    bool wanted = true;
    for (const std::int32_t node : face) {
      wanted = wanted && (at == nullptr || std::abs(mesh.node(node).x() - *at) < 1e-9);
    }
    if (wanted) nodes.insert(nodes.end(), face.begin(), face.end());
  }
  return nodes;
}

void load(Bar& bar, std::vector<std::int32_t> nodes, std::vector<double> forces) {
  bar.world.loads.push_back({"load", "bar", std::move(nodes), std::move(forces), {}});
}

}  // namespace

Bar::Bar(int n) : mesh(box_mesh(Vec3::Zero(), kSize, {4 * n, 2 * n, 2 * n}, Split::six)) {
  world.bodies.emplace_back();
  body().name = "bar";
  body().positions = mesh.positions;
  body().elastic.push_back(block_of("tetra", "stvk", mesh.blocks.front().nodes));
}

std::vector<std::int32_t> Bar::end(double x) const {
  std::vector<std::int32_t> nodes;
  for (std::int32_t i = 0; i < mesh.node_count(); ++i) {
    if (std::abs(mesh.node(i).x() - x) < 1e-9) nodes.push_back(i);
  }
  return nodes;
}

void Bar::add_body(std::string_view model, std::string_view law) {
  BodyDescription other = body();
  other.name = "other";
  other.elastic.front().law = law;
  other.elastic.front().model = options_named(model);
  world.bodies.push_back(std::move(other));
}

ElasticBlock& Bar::add_cells(std::string_view element, std::vector<std::int32_t> nodes) {
  body().elastic.push_back(block_of(element, "stvk", std::move(nodes)));
  return body().elastic.back();
}

void hold(Bar& bar) {
  FixedNodes held;
  held.body = "bar";
  held.nodes = bar.end(0.0);
  bar.world.fixed.push_back(std::move(held));
}

/// One end moves a centimetre and turns by a tenth within a second.
void lead(Bar& bar) {
  hold(bar);
  bar.world.fixed.back().motion = {{0.0, 1.0}, {Vec3::Zero(), Vec3(0.01, 0.0, 0.0)}, {0.0, 0.1}};
}

/// One end has a live target.
void lead_live(Bar& bar) {
  hold(bar);
  bar.world.fixed.back().name = "end";
  bar.once = [](Simulation& simulation) {
    Pose pose;
    pose.angle = 0.1;
    simulation.world().fixed().lead_to("end", pose, 1.0, simulation.state());
  };
}

void pull_nodes(Bar& bar) {
  std::vector<std::int32_t> nodes = bar.end(kSize.x());
  std::vector<double> forces(3 * nodes.size(), 1e-3);
  load(bar, std::move(nodes), std::move(forces));
}

/// A traction of 10 Pa, summed into the nodes as a scene's is.
void pull_faces(Bar& bar) {
  std::vector<double> areas(static_cast<std::size_t>(bar.mesh.node_count()), 0.0);
  add_areas({"triangle", faces(bar.mesh, &kSize.x())}, bar.mesh.positions, areas);
  std::vector<std::int32_t> nodes = bar.end(kSize.x());
  std::vector<double> forces;
  for (const std::int32_t node : nodes) {
    forces.insert(forces.end(), {10.0 * areas[static_cast<std::size_t>(node)], 0.0, 0.0});
  }
  load(bar, std::move(nodes), std::move(forces));
}

void press(Bar& bar) {
  bar.world.pressures.push_back({"pressure", "bar", {{"triangle", faces(bar.mesh)}}, 10.0, {}});
}

void add_sheets(Bar& bar) { bar.add_cells("triangle", faces(bar.mesh)).cross_section = {kThin}; }

/// Along the edges of the bar's faces.
void add_lines(Bar& bar) {
  const std::vector<std::int32_t> corners = faces(bar.mesh);
  std::vector<std::int32_t> nodes;
  for (std::size_t i = 0; i < corners.size(); i += 3) {
    nodes.insert(nodes.end(), {corners[i], corners[i + 1]});
  }
  bar.add_cells("line", std::move(nodes)).cross_section = {kSection};
}

void add_fibres(Bar& bar) {
  bar.cells().reinforcements = {{"fibre",
                                 {{"k1", {1e3}},
                                  {"k2", {1.0}},
                                  {"direction_x", {1.0}},
                                  {"direction_y", {0.0}},
                                  {"direction_z", {0.0}}}}};
}

/// Beside the tetrahedra, of the same body.
void add_hexahedra(Bar& bar) {
  const Mesh more = box_mesh(Vec3(2.0 * kSize.x(), 0.0, 0.0), kSize, {4, 2, 2}, Split::none);
  std::vector<std::int32_t> nodes = more.blocks.front().nodes;
  for (std::int32_t& node : nodes) node += bar.mesh.node_count();
  bar.body().positions.insert(bar.body().positions.end(), more.positions.begin(), more.positions.end());
  bar.add_cells("hexahedron", std::move(nodes));
}

void add_frame(Bar& bar) {
  FrameDescription frame;
  frame.angular_velocity = Vec3(1.0, 2.0, 3.0);
  bar.world.frames.push_back(frame);
}

void add_link(Bar& bar) {
  bar.world.links = true;
  bar.once = [](Simulation& simulation) {
    LinkTable(simulation.memory(Links::kMemory))
        .add({0}, {simulation.world().body("bar").node_count - 1}, 1.0);
  };
}

void add_grab(Bar& bar) {
  bar.world.grabbing = true;
  bar.once = [](Simulation& simulation) {
    GrabTable(simulation.memory(Grabs::kMemory)).add(1, {{{0, 0.5}, {1, 0.5}}}, Vec3::Zero(), 1.0);
  };
}

void remove_a_cell_each_step(Bar& bar) {
  bar.world.editable = true;
  bar.before = [next = 0](Simulation& simulation) mutable {
    const std::int32_t cell = next++;
    simulation.replace_world(
        remove_cells(simulation.world(), simulation.state(), "bar", std::span(&cell, 1)));
  };
}

/// To a third of its length, so that the matrix of a long step is not positive definite.
void squeeze_each_step(Bar& bar) {
  bar.h = 0.05;
  bar.before = [](Simulation& simulation) {
    State& state = simulation.state();
    state.positions = simulation.world().rest_positions();
    for (std::size_t i = 0; i < state.positions.size(); i += 3) state.positions[i] *= 0.3;
    std::ranges::fill(state.velocities, 0.0);
  };
}

}  // namespace tissu::effects
