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
  namespace bind = tissu::haptic::bind;
  bind::bind_kinematics(m);
  bind::bind_settings(m);
  bind::bind_local_model(m);
  bind::bind_parts(m);
  bind::bind_device(m);
  bind::bind_loop(m);  // after what it takes
  bind::bind_wire(m);
  bind::bind_run(m);
}
