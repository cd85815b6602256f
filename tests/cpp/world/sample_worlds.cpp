#include "sample_worlds.h"

#include <utility>

namespace tissu::test {

Mesh distorted_box(std::array<int, 3> cells, Split split, double amount) {
  Mesh mesh = box_mesh(Vec3(0.3, -0.2, 0.1), Vec3(cells[0], cells[1], cells[2]), cells, split);
  Random random(7);
  for (double& x : mesh.positions) x += random.number(amount);
  return mesh;
}

ElasticBlock elastic_block(const CellBlock& cells, const Material& material) {
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

BodyDescription body_of(const Mesh& mesh, const Material& material, std::string name) {
  BodyDescription body;
  body.name = std::move(name);
  body.positions = mesh.positions;
  for (const CellBlock& cells : mesh.blocks) body.elastic.push_back(elastic_block(cells, material));
  return body;
}

std::vector<std::int32_t> nodes_at(const Mesh& mesh, int axis, double value) {
  return nodes_where(mesh, [=](const Vec3& x) { return std::abs(x[axis] - value) < 1e-9; });
}

FixedNodes fixed(std::vector<std::int32_t> nodes, std::uint8_t axes) {
  FixedNodes result;
  result.body = "body";
  result.nodes = std::move(nodes);
  result.axes = axes;
  return result;
}

std::unique_ptr<LinearSolver> conjugate_gradient(double tolerance) {
  return std::make_unique<ConjugateGradient>(ConjugateGradient::Settings{tolerance, 5000});
}

std::unique_ptr<Integrator> implicit_euler(int iterations, double tolerance) {
  return std::make_unique<ImplicitEuler>(NewtonSettings{iterations, tolerance});
}

Simulation simulate(WorldDescription description, std::unique_ptr<Integrator> integrator,
                    std::unique_ptr<LinearSolver> solver) {
  return {std::make_shared<const World>(std::move(description)), std::move(integrator), std::move(solver)};
}

std::vector<Isa> available_isas() {
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

}  // namespace tissu::test
