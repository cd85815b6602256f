#include "bind.h"
#include "tissu/simulation/matrices.h"
#include "tissu/simulation/simulation.h"

namespace tissu::bind {
namespace {

/// Rows, columns and values (b, 3, 3), row by row, of the blocks that are not all zero.
py::tuple to_blocks(const AssembledMatrix& made) {
  const BlockMatrix& matrix = *made.blocks;
  std::vector<std::int32_t> rows;
  std::vector<std::int32_t> columns;
  std::vector<double> values;
  const auto add = [&](std::int32_t row, std::int32_t column, const double* by_column) {
    rows.push_back(row);
    columns.push_back(column);
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) values.push_back(by_column[3 * j + i]);
    }
  };
  const Sparsity& sparsity = matrix.sparsity();
  for (std::int32_t row = 0; row < sparsity.rows(); ++row) {
    for (auto slot = sparsity.begin_of(row); slot < sparsity.end_of(row); ++slot)
      add(row, sparsity.column[static_cast<std::size_t>(slot)], matrix.values() + 9 * slot);
  }
  made.couplings.for_blocks(
      [&](std::int32_t row, std::int32_t column, const Mat3& block) { add(row, column, block.data()); });
  const auto count = static_cast<py::ssize_t>(rows.size());
  return py::make_tuple(py::array_t<std::int32_t>(count, rows.data()),
                        py::array_t<std::int32_t>(count, columns.data()),
                        py::array_t<double>({count, py::ssize_t{3}, py::ssize_t{3}}, values.data()));
}

py::array_t<double> forces(const Simulation& simulation) {
  const std::vector<double> f = total_force(simulation.world(), simulation.state());
  return py::array_t<double>({static_cast<py::ssize_t>(f.size() / 3), py::ssize_t{3}}, f.data());
}

/// The first block of the rotations of a body's nodes, in the order of the nodes; -1 where they have none.
std::int32_t first_rotation(const Simulation& simulation, const std::string& name) {
  const Body& body = simulation.world().body(name);
  if (body.first_frame < 0) return -1;
  return simulation.world().frames()[static_cast<std::size_t>(body.first_frame)].rotation;
}

/// Which axes of the rows are unknowns (r, 3): not held, not led, not eliminated by a condensed region.
py::array_t<bool> free_axes(const Simulation& simulation) {
  const World& world = simulation.world();
  const std::vector<std::uint8_t>& masks = world.fixed().masks();
  py::array_t<bool> free({static_cast<py::ssize_t>(masks.size()), py::ssize_t{3}});
  for (std::size_t row = 0; row < masks.size(); ++row) {
    for (int axis = 0; axis < 3; ++axis) free.mutable_at(row, axis) = ((masks[row] >> axis) & 1) == 0;
  }
  for (const Body& body : world.bodies()) {
    for (const BodyModel* model : body.models) {
      for (const std::int32_t row : model->eliminated()) {
        for (int axis = 0; axis < 3; ++axis) free.mutable_at(row, axis) = false;
      }
    }
  }
  return free;
}

/// Masses (n,) of all rows [kg]; of each frame its row, that of its rotation, and its inertia now [kg m2].
py::tuple lumped_masses(const Simulation& simulation) {
  const Mass& mass = simulation.world().mass();
  const auto count = static_cast<py::ssize_t>(mass.frames().size());
  py::array_t<std::int32_t> rows({count, py::ssize_t{2}});
  py::array_t<double> inertias({count, py::ssize_t{3}, py::ssize_t{3}});
  for (py::ssize_t k = 0; k < count; ++k) {
    const Frame& frame = mass.frames()[static_cast<std::size_t>(k)];
    rows.mutable_at(k, 0) = frame.block;
    rows.mutable_at(k, 1) = frame.rotation;
    const Mat3 now = spatial_inertia(frame, simulation.state().rotations[static_cast<std::size_t>(k)]);
    std::copy_n(now.data(), 9, inertias.mutable_data(k, 0, 0));  // symmetric
  }
  return py::make_tuple(
      py::array_t<double>(static_cast<py::ssize_t>(mass.nodal().size()), mass.nodal().data()), rows,
      inertias);
}

}  // namespace

void bind_matrices(py::class_<Simulation>& simulation) {
  using py::arg;
  simulation.def("forces", &forces)
      .def("first_rotation", &first_rotation, arg("body"))
      .def("free_axes", &free_axes)
      .def("lumped_masses", &lumped_masses)
      .def("stiffness", [](const Simulation& s) { return to_blocks(stiffness_matrix(s.world(), s.state())); })
      .def("damping", [](const Simulation& s) { return to_blocks(damping_matrix(s.world(), s.state())); })
      .def("mass_matrix", [](const Simulation& s) { return to_blocks(mass_matrix(s.world(), s.state())); });
}

}  // namespace tissu::bind
