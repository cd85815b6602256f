#include "beam.h"

#include "tissu/mesh/box.h"

namespace tissu::bench {

WorldDescription describe(const Beam& beam) {
  const bool tetra = beam.element == "tetra";
  Mesh mesh = box_mesh(Vec3::Zero(), beam.size, beam.cells, tetra ? Split::six : Split::none);
  FixedNodes held;
  held.body = "beam";
  for (std::int32_t i = 0; i < mesh.node_count(); ++i) {
    if (mesh.node(i).x() < 1e-9) held.nodes.push_back(i);
  }
  ElasticBlock elastic;
  elastic.element = beam.element;
  elastic.law = beam.law;
  elastic.model = beam.model;
  elastic.cells = mesh.blocks.front().nodes;
  elastic.parameters = {{"young", {beam.young}}, {"poisson", {beam.poisson}}};
  elastic.density = {beam.mass / beam.size.prod()};

  BodyDescription body;
  body.name = "beam";
  body.positions = std::move(mesh.positions);
  body.elastic.push_back(std::move(elastic));
  if (beam.rayleigh) body.rayleigh = RayleighDamping{0.1, 0.1};
  WorldDescription description;
  description.bodies.push_back(std::move(body));
  description.fixed.push_back(std::move(held));
  description.gravity = Vec3(0.0, -9.81, 0.0);
  description.threads = beam.threads;
  return description;
}

}  // namespace tissu::bench
