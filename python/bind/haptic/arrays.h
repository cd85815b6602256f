#pragma once

/// Arrays between numpy and the haptic library, for every file of this binding.

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <Eigen/Core>
#include <string>

#include "tissu/base/error.h"
#include "tissu/base/vec.h"

namespace tissu::haptic::bind {

namespace py = pybind11;
using Doubles = py::array_t<double, py::array::c_style | py::array::forcecast>;

/// The numbers of an array of that shape as a matrix or vector of Eigen; refuses another shape.
template <class Matrix>
Matrix to_matrix(const Doubles& array, const char* name) {
  constexpr int kRows = Matrix::RowsAtCompileTime;
  constexpr int kColumns = Matrix::ColsAtCompileTime;
  const bool vector = kColumns == 1 && array.ndim() == 1 && array.shape(0) == kRows;
  if (!vector && !(array.ndim() == 2 && array.shape(0) == kRows && array.shape(1) == kColumns)) {
    const std::string shape =
        kColumns == 1 ? std::to_string(kRows) + "," : std::to_string(kRows) + ", " + std::to_string(kColumns);
    throw ParameterError(std::string(name) + " must have the shape (" + shape + ").");
  }
  Matrix made;
  for (int i = 0; i < kRows; ++i) {
    for (int j = 0; j < kColumns; ++j) made(i, j) = array.data()[i * kColumns + j];
  }
  return made;
}

/// A vector (n,) or a matrix (n, m) as an array.
template <class Matrix>
py::array_t<double> to_array(const Eigen::MatrixBase<Matrix>& matrix) {
  py::array_t<double> made;
  if (Matrix::ColsAtCompileTime == 1) {
    made = py::array_t<double>(matrix.rows());
  } else {
    made = py::array_t<double>({matrix.rows(), matrix.cols()});
  }
  double* to = made.mutable_data();
  for (Eigen::Index i = 0; i < matrix.rows(); ++i) {
    for (Eigen::Index j = 0; j < matrix.cols(); ++j) *to++ = matrix(i, j);
  }
  return made;
}

void bind_kinematics(py::module_& m);
void bind_settings(py::module_& m);
void bind_local_model(py::module_& m);
void bind_parts(py::module_& m);
void bind_device(py::module_& m);
void bind_loop(py::module_& m);
void bind_wire(py::module_& m);
void bind_run(py::module_& m);

}  // namespace tissu::haptic::bind
