#include "bind.h"
#include "tissu/base/build.h"
#include "tissu/law/law_info.h"
#include "tissu/law/law_kernels.h"
#include "tissu/law/loaded_law.h"

namespace tissu::bind {
namespace {

Isa isa_named(const std::string& asked) {
  for (const Isa isa : {Isa::baseline, Isa::avx2, Isa::avx512}) {
    if (asked == name(isa)) return isa;
  }
  throw ParameterError("there is no instruction set \"" + asked + "\"; accepted: baseline, avx2, avx512.");
}

/// Every law: its name, parameters with typical values, number of constants, whether it is to be added to
/// another, and the reference dimensions of the cells that may be made of it.
py::list laws() {
  py::list result;
  for (const LawInfo& law : all_laws()) {
    std::map<std::string, double> typical;
    for (const LawParameter& parameter : law.parameters) typical.emplace(parameter.name, parameter.typical);
    std::vector<int> dimensions;
    for (const int m : {1, 2, 3}) {
      if (find_law_kernels(Isa::baseline, law.name, m) != nullptr) dimensions.push_back(m);
    }
    result.append(
        py::make_tuple(std::string(law.name), typical, law.constants.size(), law.addition, dimensions));
  }
  return result;
}

}  // namespace

void bind_law(py::module_& m) {
  using py::arg;
  m.def(
      "kernel_flags",
      [](const std::string& instruction_set) {
        return std::string(kernel_flags(isa_named(instruction_set)));
      },
      py::kw_only(), arg("instruction_set"));
  m.def("laws", &laws);
  py::class_<LoadedLaw, std::shared_ptr<LoadedLaw>>(m, "LoadedLaw")
      .def(py::init<std::string>(), py::kw_only(), arg("path"))
      .def_property_readonly("name", [](const LoadedLaw& law) { return std::string(law.info().name); })
      .def_property_readonly("instruction_set",
                             [](const LoadedLaw& law) { return std::string(name(law.isa())); })
      .def(
          "compute",
          [](const LoadedLaw& law, const Array<double>& parameters) {
            std::vector<double> constants(law.info().constants.size());
            law.compute(to_vector(parameters), constants);
            return Array<double>(static_cast<py::ssize_t>(constants.size()), constants.data());
          },
          py::kw_only(), arg("parameters"))
      .def(
          "small_strain",
          [](const LoadedLaw& law,
             const Array<double>& parameters) -> std::optional<std::pair<double, double>> {
            const std::optional<Lame> found = law.small_strain(to_vector(parameters));
            if (!found) return std::nullopt;
            return std::pair{found->lambda, found->mu};
          },
          py::kw_only(), arg("parameters"));
}

}  // namespace tissu::bind
