#include <algorithm>

#include "bind.h"
#include "tissu/picture/light.h"

namespace tissu::bind {
namespace {

std::span<const double> span_of(const Doubles& values) {
  return {values.data(), static_cast<std::size_t>(values.size())};
}

py::array_t<double> to_array(const std::vector<double>& values, std::vector<py::ssize_t> shape) {
  py::array_t<double> result(std::move(shape));
  std::ranges::copy(values, result.mutable_data());
  return result;
}

/// Colours (h, w, 3) and nearness (h, w); -infinity where nothing is seen.
py::tuple render(const Doubles& corners, const Array<std::int64_t>& triangles, const Doubles& normals,
                 const Doubles& towards, const Doubles& values, const Doubles& table, double low, double high,
                 const std::array<double, 3>& colour, std::int64_t width, std::int64_t height, double step) {
  with_columns(corners, 3, "corners");
  with_columns(triangles, 3, "triangles");
  const Paint paint{colour, span_of(values), span_of(table), low, high};
  const std::span<const std::int64_t> of(triangles.data(), static_cast<std::size_t>(triangles.size()));
  Canvas canvas;
  {
    const py::gil_scoped_release released;
    canvas = light(rasterise(span_of(corners), of, width, height), span_of(normals), span_of(towards), paint,
                   width, height);
    darken_edges(step, canvas);
  }
  return py::make_tuple(to_array(canvas.colour, {height, width, 3}),
                        to_array(canvas.nearness, {height, width}));
}

/// RGBA (h / finer, w / finer, 4) of colours (h, w, 3) and opacities (h, w).
py::array_t<double> shown(const Doubles& colour, const Doubles& opacity, std::int64_t finer) {
  if (opacity.ndim() != 2 || colour.size() != 3 * opacity.size()) {
    throw ParameterError("colour and opacity must have the shapes (h, w, 3) and (h, w).");
  }
  const py::ssize_t height = opacity.shape(0);
  const py::ssize_t width = opacity.shape(1);
  return to_array(shown_pixels(span_of(colour), span_of(opacity), width, height, finer),
                  {height / finer, width / finer, 4});
}

}  // namespace

void bind_picture(py::module_& m) {
  using py::arg;
  m.def("render", &render, py::kw_only(), arg("corners"), arg("triangles"), arg("normals"), arg("towards"),
        arg("values"), arg("table"), arg("low"), arg("high"), arg("colour"), arg("width"), arg("height"),
        arg("step"));
  m.def("shown_pixels", &shown, py::kw_only(), arg("colour"), arg("opacity"), arg("finer"));
}

}  // namespace tissu::bind
