#pragma once

/// What a scene is made from, before it is one.

#include <functional>

#include "tissu/mesh/mesh.h"
#include "tissu/simulation/simulation.h"
#include "tissu/solve/conjugate_gradient.h"
#include "tissu/step/integrator.h"

namespace tissu::effects {

inline const Vec3 kSize(0.2, 0.1, 0.1);  // m

/// A bar as a mesh and as the only body of a world, and how it is stepped.
struct Bar {
  explicit Bar(int n);

  [[nodiscard]] BodyDescription& body() { return world.bodies.front(); }
  [[nodiscard]] ElasticBlock& cells() { return body().elastic.front(); }
  /// Nodes at one end.
  [[nodiscard]] std::vector<std::int32_t> end(double x) const;
  /// A second bar beside it, which the model carries.
  void add_body(std::string_view model, std::string_view law);
  /// More cells of the body, with the law of its first.
  ElasticBlock& add_cells(std::string_view element, std::vector<std::int32_t> nodes);

  Mesh mesh;
  WorldDescription world;
  double h = 1e-3;  ///< [s]
  /// Ten iterations whatever the residual: what an effect adds is its own work, not that of a solver that
  /// meets another matrix.
  ConjugateGradient::Settings solver{1e-300, 10};
  std::unique_ptr<Integrator> integrator;           ///< null: implicit Euler, linearised once
  std::function<void(Simulation&)> once = nullptr;  ///< when the simulation is made
  std::function<void(Simulation&)> before = nullptr;
};

/// Effects, each of which is put on a bar.
void step_explicitly(Bar& bar);
void hold(Bar& bar);
void lead(Bar& bar);
void lead_live(Bar& bar);
void pull_nodes(Bar& bar);
void pull_faces(Bar& bar);
void press(Bar& bar);
void add_sheets(Bar& bar);
void add_lines(Bar& bar);
void add_fibres(Bar& bar);
void add_hexahedra(Bar& bar);
void add_frame(Bar& bar);
void add_link(Bar& bar);
void add_grab(Bar& bar);
void remove_a_cell_each_step(Bar& bar);
void squeeze_each_step(Bar& bar);
void touch_plane(Bar& bar);
void rub_plane(Bar& bar);
void spring_from_plane(Bar& bar);
void strike_plane(Bar& bar);
void correct_at_plane(Bar& bar);
void keep_off_plane(Bar& bar);
/// A second bar that lies on it and may go through it.
void lay_bar_above(Bar& bar);
void touch_bar(Bar& bar);
void touch_itself(Bar& bar);

}  // namespace tissu::effects
