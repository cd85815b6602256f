#pragma once

/// Small bodies and worlds that the tests of several rooms look at.

#include <cstdlib>
#include <memory>
#include <string>

#include "../base/random.h"
#include "tissu/base/error.h"
#include "tissu/force/links.h"
#include "tissu/mesh/box.h"
#include "tissu/simulation/simulation.h"
#include "tissu/solve/cholesky.h"
#include "tissu/solve/conjugate_gradient.h"
#include "tissu/step/implicit_euler.h"
#include "tissu/step/static_equilibrium.h"

namespace tissu::test {

struct Material {
  std::string law = "stvk";
  double young = 3.0;
  double poisson = 0.3;
  double density = 2.0;
};

/// A box whose nodes, on its surface too, are moved by up to `amount` along each axis.
inline Mesh distorted_box(std::array<int, 3> cells, Split split, double amount) {
  Mesh mesh = box_mesh(Vec3(0.3, -0.2, 0.1), Vec3(cells[0], cells[1], cells[2]), cells, split);
  Random random(7);
  for (double& x : mesh.positions) x += random.number(amount);
  return mesh;
}

inline ElasticBlock elastic_block(const CellBlock& cells, const Material& material) {
  ElasticBlock block;
  block.body = "body";
  block.element = info(cells.type).name;
  block.law = material.law;
  block.cells = cells.nodes;
  block.parameters["young"] = {material.young};
  block.parameters["poisson"] = {material.poisson};
  block.density = {material.density};
  return block;
}

inline BodyDescription body_of(const Mesh& mesh, const Material& material = {}, std::string name = "body") {
  BodyDescription body;
  body.name = std::move(name);
  body.positions = mesh.positions;
  for (const CellBlock& cells : mesh.blocks) body.elastic.push_back(elastic_block(cells, material));
  return body;
}

/// Numbers of the nodes whose position satisfies `is_in`.
template <class Predicate>
std::vector<std::int32_t> nodes_where(const Mesh& mesh, Predicate&& is_in) {
  std::vector<std::int32_t> nodes;
  for (std::int32_t i = 0; i < mesh.node_count(); ++i) {
    if (is_in(mesh.node(i))) nodes.push_back(i);
  }
  return nodes;
}

/// Nodes of one coordinate plane, to 1e-9 m.
inline std::vector<std::int32_t> nodes_at(const Mesh& mesh, int axis, double value) {
  return nodes_where(mesh, [=](const Vec3& x) { return std::abs(x[axis] - value) < 1e-9; });
}

inline FixedNodes fixed(std::vector<std::int32_t> nodes, std::uint8_t axes = FixedDofs::kAllAxes) {
  FixedNodes result;
  result.body = "body";
  result.nodes = std::move(nodes);
  result.axes = axes;
  return result;
}

inline std::unique_ptr<LinearSolver> conjugate_gradient(double tolerance = 1e-13) {
  return std::make_unique<ConjugateGradient>(ConjugateGradient::Settings{tolerance, 5000});
}

inline std::unique_ptr<Integrator> implicit_euler(int iterations = 1, double tolerance = 1e-12) {
  return std::make_unique<ImplicitEuler>(NewtonSettings{iterations, tolerance});
}

inline Simulation simulate(WorldDescription description, std::unique_ptr<Integrator> integrator,
                           std::unique_ptr<LinearSolver> solver = std::make_unique<Cholesky>()) {
  return {std::make_shared<const World>(std::move(description)), std::move(integrator), std::move(solver)};
}

/// Every instruction set that this machine and this build both have.
inline std::vector<Isa> available_isas() {
  const char* was = std::getenv("TISSU_ISA");
  const std::string before = was == nullptr ? "" : was;
  std::vector<Isa> result;
  for (const Isa isa : {Isa::baseline, Isa::avx2, Isa::avx512}) {
    setenv("TISSU_ISA", std::string(name(isa)).c_str(), 1);
    try {
      result.push_back(choose_isa());
    } catch (const ParameterError&) {  // it does not run here
    }
  }
  if (was == nullptr) {
    unsetenv("TISSU_ISA");
  } else {
    setenv("TISSU_ISA", before.c_str(), 1);
  }
  return result;
}

/// The links of a simulation, or of a state of a world.
inline LinkTable links(Simulation& simulation) { return LinkTable(simulation.memory(Links::kMemory)); }
inline LinkTable links(const World& world, State& state) {
  return LinkTable(memory_of(world, state, Links::kMemory));
}

}  // namespace tissu::test
