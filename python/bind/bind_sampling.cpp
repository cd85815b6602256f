#include <string>

#include "bind.h"
#include "tissu/base/parallel.h"
#include "tissu/mesh/triangle_tree.h"

namespace tissu::bind {
namespace {

/// Nearest points (n, 3) and their distances (n,); NaN and infinity beyond the reach, one or one for each.
/// The answer is the same on any number of threads.
py::tuple nearest(const TriangleTree& tree, const Array<double>& points, const Array<double>& reach,
                  int threads) {
  const py::ssize_t count = with_columns(points, 3, "points").shape(0);
  const py::ssize_t stride = reach.size() == 1 ? 0 : 1;
  if (stride == 1 && reach.size() != count) {
    throw py::value_error("reach: found " + std::to_string(reach.size()) + " numbers for " +
                          std::to_string(count) + " points; one, or one for each, is accepted");
  }
  Array<double> places({count, py::ssize_t{3}});
  Array<double> distances(count);
  const ConstReals from(points.data(), static_cast<std::size_t>(points.size()));
  const Reals to(places.mutable_data(), static_cast<std::size_t>(places.size()));
  double* const away = distances.mutable_data();
  const double* const limits = reach.data();
  {
    const py::gil_scoped_release released;
    Threads(threads).for_pieces(static_cast<std::int32_t>(count), [&](std::int32_t begin, std::int32_t end) {
      std::int32_t last = -1;  // neighbours in the list are often neighbours in space
      for (std::int32_t i = begin; i < end; ++i) {
        const TriangleTree::Nearest found = tree.nearest(block(from, i), limits[stride * i], last);
        block(to, i) = found.place;
        away[i] = std::sqrt(found.square);
        last = found.leaf;
      }
    });
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
      .def("nearest", &nearest, py::kw_only(), arg("points"), arg("reach"), arg("threads"));
}

}  // namespace tissu::bind
