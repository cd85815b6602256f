#include <algorithm>

#include "bind.h"
#include "tissu/picture/raster.h"

namespace tissu::bind {
namespace {

template <class T>
py::array_t<T> to_array(const std::vector<T>& values, std::vector<py::ssize_t> shape) {
  py::array_t<T> result(std::move(shape));
  std::ranges::copy(values, result.mutable_data());
  return result;
}

/// Pixels (p,), triangles (p,), weights (p, 3) and nearness (p,).
py::tuple seen(const Array<double>& corners, const Array<std::int64_t>& triangles, std::int64_t width,
               std::int64_t height) {
  with_columns(corners, 3, "corners");
  with_columns(triangles, 3, "triangles");
  Seen found;
  {
    const std::span<const double> at(corners.data(), static_cast<std::size_t>(corners.size()));
    const std::span<const std::int64_t> of(triangles.data(), static_cast<std::size_t>(triangles.size()));
    const py::gil_scoped_release released;
    found = rasterise(at, of, width, height);
  }
  const auto count = static_cast<py::ssize_t>(found.pixel.size());
  return py::make_tuple(to_array(found.pixel, {count}), to_array(found.triangle, {count}),
                        to_array(found.weights, {count, 3}), to_array(found.nearness, {count}));
}

}  // namespace

void bind_picture(py::module_& m) {
  using py::arg;
  m.def("rasterise", &seen, py::kw_only(), arg("corners"), arg("triangles"), arg("width"), arg("height"));
}

}  // namespace tissu::bind
