#include "bind.h"
#include "tissu/field/cell_gradients.h"
#include "tissu/field/shape_function.h"

namespace tissu::bind {
namespace {

template <class T>
py::array_t<T> shaped(const std::vector<T>& values, std::vector<py::ssize_t> shape) {
  return py::array_t<T>(std::move(shape), values.data());
}

py::tuple weights(const std::string& name, int neighbours, const Doubles& frames, const Doubles& points,
                  const std::string& body) {
  ShapeFunctionUse use;
  use.name = name;
  use.neighbours = neighbours;
  const std::vector<double> origins = to_vector(with_columns(frames, 3, "frames"));
  const std::vector<double> places = to_vector(with_columns(points, 3, "points"));
  const FrameWeights found = shape_weights(use, origins, places, {.body = body});
  const auto n = static_cast<py::ssize_t>(places.size() / 3);
  const py::ssize_t k = found.neighbours;
  return py::make_tuple(shaped(found.frames, {n, k}), shaped(found.weights, {n, k}),
                        shaped(found.gradients, {n, k, 3}));
}

py::array_t<double> gradients(const std::string& cell_type, const Doubles& positions, const Ints& cells) {
  const std::vector<double> places = to_vector(with_columns(positions, 3, "positions"));
  const std::vector<std::int32_t> nodes = to_vector(cells);
  return shaped(mean_gradients(cell_type, places, nodes), {cells.shape(0), cells.shape(1), 3});
}

/// Name, neighbours, completeness and meaning of each shape function.
py::list functions() {
  py::list result;
  for (const ShapeFunctionInfo& info : all_shape_functions()) {
    result.append(py::make_tuple(std::string(info.name), info.neighbours, std::string(info.complete),
                                 std::string(info.meaning)));
  }
  return result;
}

}  // namespace

void bind_field(py::module_& m) {
  using py::arg;
  m.def("shape_functions", &functions);
  m.def("shape_weights", &weights, py::kw_only(), arg("name"), arg("neighbours"), arg("frames"),
        arg("points"), arg("body"));
  m.def("mean_gradients", &gradients, py::kw_only(), arg("cell_type"), arg("positions"), arg("cells"));
}

}  // namespace tissu::bind
