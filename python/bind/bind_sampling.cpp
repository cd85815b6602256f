#include "bind.h"
#include "tissu/mesh/triangle_tree.h"

namespace tissu::bind {
namespace {

/// Nearest points (n, 3) and their distances (n,); NaN and infinity beyond the reach.
py::tuple nearest(const TriangleTree& tree, const Array<double>& points, double reach) {
  const py::ssize_t count = with_columns(points, 3, "points").shape(0);
  Array<double> places({count, py::ssize_t{3}});
  Array<double> distances(count);
  const ConstReals from(points.data(), static_cast<std::size_t>(points.size()));
  const Reals to(places.mutable_data(), static_cast<std::size_t>(places.size()));
  double* const away = distances.mutable_data();
  {
    const py::gil_scoped_release released;
    std::int32_t last = -1;  // neighbours in the list are often neighbours in space
    for (py::ssize_t i = 0; i < count; ++i) {
      const TriangleTree::Nearest found =
          tree.nearest(block(from, static_cast<std::int32_t>(i)), reach, last);
      block(to, static_cast<std::int32_t>(i)) = found.place;
      away[i] = std::sqrt(found.square);
      last = found.leaf;
    }
  }
  return py::make_tuple(places, distances);
}

}  // namespace

void bind_sampling(py::module_& m) {
  using py::arg;
  py::class_<TriangleTree>(m, "TriangleTree")
      .def(py::init([](const Array<double>& corners) {
             return std::make_unique<TriangleTree>(
                 ConstReals(corners.data(), static_cast<std::size_t>(corners.size())));
           }),
           py::kw_only(), arg("corners"))
      .def("nearest", &nearest, py::kw_only(), arg("points"), arg("reach"));
}

}  // namespace tissu::bind
