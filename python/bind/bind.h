#pragma once

/// Arrays between numpy and the core, for every file of the binding.

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <cstdint>
#include <string>
#include <vector>

#include "tissu/base/error.h"
#include "tissu/base/vec.h"

namespace tissu::bind {

namespace py = pybind11;

template <class T>
using Array = py::array_t<T, py::array::c_style | py::array::forcecast>;
using Doubles = Array<double>;
using Ints = Array<std::int32_t>;

/// The numbers of an array, copied in the order of its rows.
template <class T>
std::vector<T> to_vector(const Array<T>& array) {
  return {array.data(), array.data() + array.size()};
}

/// Refuses an array that does not have `columns` columns.
template <class T>
Array<T> with_columns(const Array<T>& array, py::ssize_t columns, const char* name) {
  if (array.ndim() == 2 && array.shape(1) == columns) return array;
  throw ParameterError(std::string(name) + " must have the shape (n, " + std::to_string(columns) + ").");
}

inline Vec3 to_vec3(const Array<double>& array, const char* name) {
  if (array.size() == 3) return {array.data()[0], array.data()[1], array.data()[2]};
  throw ParameterError(std::string(name) + " must have 3 numbers.");
}

/// An (n, 3) view of numbers that belong to `owner`, writable.
inline py::array_t<double> view_of(std::vector<double>& values, std::int32_t first, std::int32_t count,
                                   const py::object& owner) {
  return py::array_t<double>({static_cast<py::ssize_t>(count), static_cast<py::ssize_t>(3)},
                             values.data() + 3 * static_cast<std::ptrdiff_t>(first), owner);
}

void bind_law(py::module_& m);
void bind_model(py::module_& m);
void bind_world(py::module_& m);
void bind_simulation(py::module_& m);
void bind_compliance(py::module_& m);
void bind_solver(py::module_& m);
void bind_step(py::module_& m);
void bind_field(py::module_& m);
void bind_sampling(py::module_& m);
void bind_picture(py::module_& m);

}  // namespace tissu::bind

void bind_mesh(pybind11::module_& m);
