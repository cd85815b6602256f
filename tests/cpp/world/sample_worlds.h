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
Mesh distorted_box(std::array<int, 3> cells, Split split, double amount);

ElasticBlock elastic_block(const CellBlock& cells, const Material& material);

BodyDescription body_of(const Mesh& mesh, const Material& material = {}, std::string name = "body");

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
std::vector<std::int32_t> nodes_at(const Mesh& mesh, int axis, double value);

FixedNodes fixed(std::vector<std::int32_t> nodes, std::uint8_t axes = FixedDofs::kAllAxes);

std::unique_ptr<LinearSolver> conjugate_gradient(double tolerance = 1e-13);

std::unique_ptr<Integrator> implicit_euler(int iterations = 1, double tolerance = 1e-12);

Simulation simulate(WorldDescription description, std::unique_ptr<Integrator> integrator,
                    std::unique_ptr<LinearSolver> solver = std::make_unique<Cholesky>());

/// Every instruction set that this machine and this build both have.
std::vector<Isa> available_isas();

/// The links of a simulation, or of a state of a world.
inline LinkTable links(Simulation& simulation) { return LinkTable(simulation.memory(Links::kMemory)); }
inline LinkTable links(const World& world, State& state) {
  return LinkTable(memory_of(world, state, Links::kMemory));
}

}  // namespace tissu::test
