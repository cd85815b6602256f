/// The extension module tissu._haptic: the trocar and its loop, and the errors of the library as Python's.

#include "haptic/arrays.h"

namespace tissu::haptic::bind {
namespace {

// pybind11 asks for a function that takes its pointer by value.
void translate(std::exception_ptr pointer) {  // NOLINT(performance-unnecessary-value-param)
  const auto set = [](const char* name, const Error& error) {
    py::set_error(py::module_::import("tissu.errors").attr(name), error.what());
  };
  try {
    if (pointer) std::rethrow_exception(pointer);
  } catch (const ParameterError& error) {
    set("ParameterError", error);
  } catch (const Error& error) {
    set("TissuError", error);
  }
}

}  // namespace
}  // namespace tissu::haptic::bind

PYBIND11_MODULE(_haptic, m) {
  pybind11::register_local_exception_translator(&tissu::haptic::bind::translate);
  tissu::haptic::bind::bind_kinematics(m);
  tissu::haptic::bind::bind_devices(m);
  tissu::haptic::bind::bind_simulated(m);
  tissu::haptic::bind::bind_run(m);
}
