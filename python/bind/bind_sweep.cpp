/// Blades as the core has them.

#include <algorithm>

#include "bind.h"
#include "tissu/edit/cut/severed.h"
#include "tissu/edit/cut/sweep.h"
#include "tissu/simulation/simulation.h"

namespace tissu::bind {
namespace {

std::span<const double> numbers(const Doubles& array) {
  return {array.data(), static_cast<std::size_t>(array.size())};
}

py::array_t<bool> which_severed(const Sweep& sweep, const Doubles& begins, const Doubles& ends) {
  const std::vector<char> found =
      severed(sweep, numbers(with_columns(begins, 3, "begins")), numbers(with_columns(ends, 3, "ends")));
  py::array_t<bool> result(static_cast<py::ssize_t>(found.size()));
  std::ranges::transform(found, result.mutable_data(), [](char c) { return c != 0; });
  return result;
}

}  // namespace

void bind_sweep(py::module_& m) {
  using py::arg;
  py::class_<Simulation::Mark>(m, "Mark");
  py::class_<Sweep>(m, "Sweep");
  m.def(
       "plane_sweep",
       [](const Doubles& point, const Doubles& normal, const Doubles& low, const Doubles& high) {
         return plane_sweep(to_vec3(point, "point"), to_vec3(normal, "normal"), to_vec3(low, "low"),
                            to_vec3(high, "high"));
       },
       py::kw_only(), arg("point"), arg("normal"), arg("low"), arg("high"))
      .def(
          "disc_sweep",
          [](const Doubles& center, const Doubles& normal, double radius) {
            return disc_sweep(to_vec3(center, "center"), to_vec3(normal, "normal"), radius);
          },
          py::kw_only(), arg("center"), arg("normal"), arg("radius"))
      .def(
          "triangles_sweep",
          [](const Doubles& points, const Ints& triangles) {
            const Ints rows = with_columns(triangles, 3, "triangles");
            std::vector<std::array<std::int32_t, 3>> corners(static_cast<std::size_t>(rows.shape(0)));
            for (std::size_t t = 0; t < corners.size(); ++t)
              std::copy_n(rows.data(static_cast<py::ssize_t>(t)), 3, corners[t].begin());
            return triangle_sweep(numbers(with_columns(points, 3, "points")), corners);
          },
          py::kw_only(), arg("points"), arg("triangles"))
      .def(
          "edge_sweep",
          [](const Doubles& places, std::int32_t moments, std::int32_t points, std::int32_t incision,
             std::int32_t past) { return edge_sweep(numbers(places), moments, points, incision, past); },
          py::kw_only(), arg("places"), arg("moments"), arg("points"), arg("incision"), arg("past"))
      .def("severed", &which_severed, py::kw_only(), arg("sweep"), arg("begins"), arg("ends"));
}

}  // namespace tissu::bind
