/// What acts on the bodies of a world from outside, and the links between them.

#include "builder.h"
#include "checks.h"
#include "tissu/force/frame_weight.h"
#include "tissu/force/grabs.h"
#include "tissu/force/gravity.h"
#include "tissu/force/instruments.h"
#include "tissu/force/links.h"
#include "tissu/force/load.h"

namespace tissu {

void WorldBuilder::add_loads() {
  auto& forces = world_.forces_;
  if (description_.gravity) {
    const std::vector<double>& pulled = description_.consistent_weight ? weights_ : world_.mass_.nodal();
    forces.push_back(std::make_unique<Gravity>(pulled, *description_.gravity));
    if (!moments_.empty()) {
      forces.push_back(std::make_unique<FrameWeight>(world_.frames(), moments_, *description_.gravity));
    }
  }
  for (const LoadDescription& load : description_.loads) add_load(load);
  for (const PressureDescription& pressure : description_.pressures) add_pressure(pressure);
  if (description_.links) forces.push_back(std::make_unique<Links>());
  if (description_.grabbing) forces.push_back(std::make_unique<Grabs>());
  if (description_.instruments) forces.push_back(std::make_unique<Instruments>());
  if (description_.pressing) forces.push_back(std::make_unique<Grabs>(Grabs::kPresses));
}

void WorldBuilder::add_load(const LoadDescription& load) {
  const Body& on = world_.body(load.body);
  check_size("load \"" + load.name + "\"", load.forces.size(), 3 * load.nodes.size());
  check_table("load \"" + load.name + "\"", load.history.times, load.history.factors.size());
  auto nodes = shifted(load.nodes, on.first_node, on.node_count, "load \"" + load.name + "\"");
  if (load.moments) nodes = rotations_of(on, nodes, "load \"" + load.name + "\"");
  auto model = std::make_unique<NodalLoad>(load.name, std::move(nodes), load.forces, load.history);
  model->set_left(load.left, load.along_normals);
  world_.forces_.push_back(std::move(model));
}

void WorldBuilder::add_pressure(const PressureDescription& pressure) {
  const Body& on = world_.body(pressure.body);
  check_table("pressure \"" + pressure.name + "\"", pressure.history.times, pressure.history.factors.size());
  PressedFaces pressed = faces_of(pressure, on);
  world_.forces_.push_back(std::make_unique<Pressure>(pressure.name, std::move(pressed.faces),
                                                      pressure.pressure, pressure.history,
                                                      std::move(pressed.carried), std::move(pressed.parts)));
}

PressedFaces faces_of(const PressureDescription& pressure, const Body& on) {
  PressedFaces pressed{pressure.faces, pressure.carried, pressure.parts};
  for (FaceCells& some : pressed.faces) {
    some.nodes =
        shifted(std::move(some.nodes), on.first_node, on.node_count, "pressure \"" + pressure.name + "\"");
  }
  for (CarriedFace& face : pressed.carried) {
    for (auto& point : face) {
      for (CarriedNode& one : point) one.node += on.first_node;
    }
  }
  for (FacePart& part : pressed.parts) {
    for (std::int32_t& node : part.nodes) node += on.first_node;
  }
  return pressed;
}

}  // namespace tissu
