#include "bind.h"
#include "tissu/simulation/simulation.h"

namespace tissu::bind {
namespace {

using Shape = std::vector<py::ssize_t>;

py::array_t<double> array(const std::vector<double>& values, const Shape& shape) {
  return py::array_t<double>(shape, values.data());
}

/// Numbers (e, k) of the nodes of the cells, in the body.
py::array_t<std::int32_t> nodes_of(const BodyModel& model, std::int32_t first_node) {
  std::vector<std::int32_t> nodes = model.block().cells;
  for (std::int32_t& node : nodes) node -= first_node;
  return py::array_t<std::int32_t>(
      {static_cast<py::ssize_t>(model.cell_count()), static_cast<py::ssize_t>(model.nodes_per_cell())},
      nodes.data());
}

/// What a model has at its points, (e, q) of each; of a model without a stress the names alone.
py::dict to_dict(const BodyModel& model, const PointFields& points, std::int32_t first_node,
                 std::int32_t first_cell) {
  py::dict result;
  const py::ssize_t e = model.cell_count();
  const py::ssize_t q = points.points_per_cell;
  std::vector<std::int32_t> numbers = model.block().cell_numbers;
  for (std::int32_t i = 0; numbers.size() < static_cast<std::size_t>(e); ++i)
    numbers.push_back(first_cell + i);
  result["model"] = std::string(model_name(model.block().model));
  result["cells"] = py::array_t<std::int32_t>(e, numbers.data());
  if (q == 0) return result;
  result["nodes"] = nodes_of(model, first_node);
  result["through_thickness"] = points.through_thickness;
  result["positions"] = array(points.positions, {e, q, 3});
  result["volumes"] = array(points.volumes, {e, q});
  result["F"] = array(points.F, {e, q, 3, 3});
  result["P"] = array(points.P, {e, q, 3, 3});
  result["W"] = array(points.W, {e, q});
  if (!points.cell_W.empty()) result["cell_W"] = array(points.cell_W, {e});
  return result;
}

py::list point_fields(const Simulation& simulation, const std::string& name) {
  const World& world = simulation.world();
  const Body& body = world.body(name);
  py::list result;
  std::int32_t first_cell = 0;
  for (const BodyModel* model : body.models) {
    const PointFields points =
        model->point_fields({world.shape_positions(), simulation.state(), world.isa()});
    result.append(to_dict(*model, points, body.first_node, first_cell));
    first_cell += model->cell_count();
  }
  return result;
}

}  // namespace

void bind_point_fields(py::class_<Simulation>& simulation) {
  simulation.def("point_fields", &point_fields, py::arg("body"));
}

}  // namespace tissu::bind
