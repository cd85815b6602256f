/// The extension module tissu._core: every room of the core in one place, and its errors as Python's.

#include "bind.h"
#include "interruption.h"
#include "tissu/base/build.h"
#include "tissu/base/isa.h"
#include "tissu/base/parallel.h"
#include "tissu/contact/audit.h"

namespace tissu::bind {
namespace {

void set_error(const char* name, const Error& error) {
  const py::object type = py::module_::import("tissu.errors").attr(name);
  py::set_error(type, error.what());
}

// pybind11 asks for a function that takes its pointer by value.
void translate(std::exception_ptr pointer) {  // NOLINT(performance-unnecessary-value-param)
  try {
    if (pointer) std::rethrow_exception(pointer);
  } catch (const Diverged& error) {
    const py::object type = py::module_::import("tissu.errors").attr("Diverged");
    const py::object made = type(error.what(), py::arg("body") = error.body(),
                                 py::arg("element") = error.element(), py::arg("time") = error.time());
    PyErr_SetObject(type.ptr(), made.ptr());
  } catch (const MeshError& error) {
    set_error("MeshError", error);
  } catch (const OverlapError& error) {
    const py::object type = py::module_::import("tissu.errors").attr("OverlapError");
    const py::object made = type(error.what(), py::arg("places") = error.places());
    PyErr_SetObject(type.ptr(), made.ptr());
  } catch (const ParameterError& error) {
    set_error("ParameterError", error);
  } catch (const Error& error) {
    set_error("TissuError", error);
  }
}

py::dict to_dict(const BuildInfo& build) {
  py::dict libraries;
  for (const auto& [library, version] : build.libraries) libraries[py::str(library)] = version;
  py::dict info;
  info["version"] = build.version;
  info["compiler"] = build.compiler;
  info["instruction_set"] = std::string(name(choose_isa()));
  info["threads_available"] = available_threads();
  info["libraries"] = libraries;
  return info;
}

}  // namespace
}  // namespace tissu::bind

PYBIND11_MODULE(_core, m) {
  namespace bind = tissu::bind;
  pybind11::register_local_exception_translator(&bind::translate);
  m.def("build_info", [] { return bind::to_dict(tissu::build_info()); });
  bind_mesh(m);
  tissu::bind::bind_field(m);
  bind::bind_sampling(m);
  bind::bind_picture(m);
  bind::bind_law(m);  // before what takes one
  bind::bind_model(m);
  bind::bind_world(m);
  bind::bind_solver(m);
  bind::bind_step(m);
  bind::bind_simulation(m);
  bind::bind_compliance(m);
  bind::bind_interruption(m);
}
