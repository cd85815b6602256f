#include <map>

#include "bind.h"
#include "interruption.h"
#include "specs.h"
#include "tissu/edit/remove_cells.h"
#include "tissu/simulation/inverted_cells.h"
#include "tissu/simulation/simulation.h"
#include "tissu/step/frequency.h"

namespace tissu::bind {
namespace {

py::dict to_dict(const Energy& energy) {
  py::dict result;
  result["kinetic"] = energy.kinetic;
  result["elastic"] = energy.elastic;
  result["potential"] = energy.potential;
  result["total"] = energy.total();
  return result;
}

/// A field of all models of a body; left out where one of them does not know it.
void add_field(py::dict& result, const char* name, const std::vector<CellFields>& models,
               std::vector<double> CellFields::*field) {
  std::vector<double> all;
  for (const CellFields& model : models) {
    const std::vector<double>& values = model.*field;
    if (values.empty()) return;
    all.insert(all.end(), values.begin(), values.end());
  }
  result[name] = py::array_t<double>(static_cast<py::ssize_t>(all.size()), all.data());
}

py::dict cell_fields(const Simulation& simulation, const std::string& name) {
  std::vector<CellFields> models;
  for (const BodyModel* model : simulation.world().body(name).models) {
    models.push_back(model->fields(simulation.state()));
  }
  py::dict result;
  add_field(result, "von_mises", models, &CellFields::von_mises);
  add_field(result, "energy_density", models, &CellFields::energy_density);
  add_field(result, "volume_ratio", models, &CellFields::volume_ratio);
  return result;
}

py::list profile_rows(Simulation& simulation) {
  py::list rows;
  for (const Profile::Row& row : simulation.profile().rows()) {
    rows.append(py::make_tuple(row.effect, row.stage, row.calls, row.seconds));
  }
  return rows;
}

py::tuple body_range(const Simulation& simulation, const std::string& name) {
  const Body& body = simulation.world().body(name);
  return py::make_tuple(body.first_node, body.node_count);
}

/// Rotation matrices (n, 3, 3) of a body's nodes, which are frames; none where they are not.
py::array_t<double> rotations(const Simulation& simulation, const std::string& name) {
  const Body& body = simulation.world().body(name);
  const py::ssize_t count = body.first_frame < 0 ? 0 : body.node_count;
  py::array_t<double> result({count, py::ssize_t{3}, py::ssize_t{3}});
  auto values = result.mutable_unchecked<3>();
  for (py::ssize_t i = 0; i < count; ++i) {
    const Mat3 R =
        simulation.state().rotations[static_cast<std::size_t>(body.first_frame + i)].toRotationMatrix();
    for (py::ssize_t r = 0; r < 3; ++r) {
      for (py::ssize_t c = 0; c < 3; ++c) values(i, r, c) = R(r, c);
    }
  }
  return result;
}

/// Where the integration points of a body of frames are (p, 3).
py::array_t<double> points(const Simulation& simulation, const std::string& name) {
  std::vector<double> all;
  for (const BodyModel* model : simulation.world().body(name).models) {
    const std::vector<double> some = model->points(simulation.state());
    all.insert(all.end(), some.begin(), some.end());
  }
  return py::array_t<double>({static_cast<py::ssize_t>(all.size() / 3), py::ssize_t{3}}, all.data());
}

}  // namespace

/// Of bind_snapshot.cpp, bind_lead.cpp, bind_contact_run.cpp, bind_cut.cpp, bind_point_fields.cpp and
/// bind_matrices.cpp.
void bind_snapshot(py::class_<Simulation>& simulation);
void bind_lead(py::class_<Simulation>& simulation);
void bind_contact_run(py::class_<Simulation>& simulation);
void bind_cut(py::class_<Simulation>& simulation);
void bind_sweep(py::module_& m);
void bind_point_fields(py::class_<Simulation>& simulation);
void bind_matrices(py::class_<Simulation>& simulation);

void bind_simulation(py::module_& m) {
  using py::arg;
  bind_sweep(m);
  py::class_<Simulation> simulation(m, "Simulation");
  simulation
      .def(py::init([](const std::shared_ptr<World>& world, const IntegratorSpec& integrator,
                       const SolverSpec* solver) {
             return std::make_unique<Simulation>(world, integrator.make(),
                                                 solver == nullptr ? nullptr : solver->make());
           }),
           py::kw_only(), arg("world"), arg("integrator"), arg("solver").none(true))
      .def("step", &step_interruptibly, arg("dt"))
      .def("prepare_ahead", &Simulation::prepare_ahead, arg("dt"), py::call_guard<py::gil_scoped_release>())
      .def_property(
          "time", [](const Simulation& s) { return s.state().time; },
          [](Simulation& s, double time) {
            s.state().memory_time += time - s.state().time;
            s.state().time = time;
          })
      .def_property_readonly("integrator_name",
                             [](const Simulation& s) { return std::string(s.integrator().name()); })
      .def_property_readonly("solver_name",
                             [](const Simulation& s) {
                               return s.solver() == nullptr ? std::string() : std::string(s.solver()->name());
                             })
      .def_property_readonly("positions",
                             [](const py::object& self) {
                               auto& s = self.cast<Simulation&>();
                               return view_of(s.state().positions, 0, s.world().blocks(), self);
                             })
      .def_property_readonly("velocities",
                             [](const py::object& self) {
                               auto& s = self.cast<Simulation&>();
                               return view_of(s.state().velocities, 0, s.world().blocks(), self);
                             })
      .def("keep_held_velocities", &Simulation::keep_held_velocities)
      .def("forget_forces", &Simulation::forget_forces)
      .def("forget_stable_step", &Simulation::forget_stable_step)
      .def("rotations", &rotations, arg("body"))
      .def("points", &points, arg("body"))
      .def("body_range", &body_range, arg("body"))
      .def("energy", [](const Simulation& s) { return to_dict(s.energy()); })
      .def("cell_fields", &cell_fields, arg("body"))
      .def(
          "inverted_cells",
          [](const Simulation& s, const std::string& name) {
            const std::vector<std::int32_t> cells =
                inverted_cells(s.world(), s.state(), s.world().body(name));
            return py::array_t<std::int32_t>(static_cast<py::ssize_t>(cells.size()), cells.data());
          },
          arg("body"))
      .def("profile_rows", &profile_rows)
      .def("profile_solves",
           [](Simulation& s) {
             const Profile::Solves& solves = s.profile().solves();
             return py::make_tuple(solves.solves, solves.iterations, solves.preparations, solves.failures,
                                   solves.residual, solves.work);
           })
      .def("profile_steps", [](Simulation& s) { return s.profile().steps(); })
      .def("profile_step_seconds",
           [](Simulation& s) {
             const auto& seconds = s.profile().step_seconds();
             return py::array_t<double>(static_cast<py::ssize_t>(seconds.size()), seconds.data());
           })
      .def("profile_worst",
           [](Simulation& s) {
             const Profile::Worst& worst = s.profile().worst();
             return py::make_tuple(worst.step, worst.seconds, worst.solves, worst.iterations,
                                   worst.preparations, worst.row_seconds);
           })
      .def("profile_clear", [](Simulation& s) { s.profile().clear(); })
      .def(
          "remove_cells",
          [](Simulation& s, const std::string& body, const Array<std::int32_t>& cells) {
            const std::vector<std::int32_t> numbers = to_vector(cells);
            s.remove_cells(body, numbers);
          },
          py::kw_only(), arg("body"), arg("cells"))
      .def(
          "replace_world",
          [](Simulation& s, const std::shared_ptr<World>& world) {
            s.replace_world(world);
            s.forget_solves();  // as a simulation of the new scene would begin
          },
          py::kw_only(), arg("world"))
      .def_property_readonly(
          "world", [](const Simulation& s) { return std::const_pointer_cast<World>(s.shared_world()); })
      .def("settle", &Simulation::settle)
      .def("reactions",
           [](const Simulation& s) {
             const std::vector<double> forces = s.reactions();
             return py::array_t<double>({static_cast<py::ssize_t>(forces.size() / 3), py::ssize_t{3}},
                                        forces.data());
           })
      .def("solver_account",
           [](const Simulation& s) { return s.solver() == nullptr ? std::string() : s.solver()->account(); })
      .def("solver_bytes",
           [](const Simulation& s) { return s.solver() == nullptr ? 0 : s.solver()->bytes(); })
      .def("stable_step", &Simulation::stable_step)
      .def("largest_frequency", [](const Simulation& s) { return largest_frequency(s.world(), s.state()); })
      .def(
          "remaining_cells",
          [](const Simulation& s, const std::string& body) {
            const std::vector<std::int32_t> cells = remaining_cells(s.world(), body);
            return py::array_t<std::int32_t>(static_cast<py::ssize_t>(cells.size()), cells.data());
          },
          arg("body"));
  bind_snapshot(simulation);
  bind_lead(simulation);
  bind_contact_run(simulation);
  bind_cut(simulation);
  bind_point_fields(simulation);
  bind_matrices(simulation);
}

}  // namespace tissu::bind
