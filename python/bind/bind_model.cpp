#include <algorithm>

#include "bind.h"
#include "specs.h"
#include "tissu/model/models.h"

namespace tissu::bind {
namespace {

/// A model's name as scenes spell it: mass_spring.
std::string spelled(std::string_view name) {
  std::string result(name);
  std::ranges::replace(result, '-', '_');
  return result;
}

std::vector<std::string> words(const std::vector<std::string_view>& names) {
  return {names.begin(), names.end()};
}

py::tuple to_tuple(const Ability& ability) {
  const char* can[] = {"no", "partly", "yes"};
  return py::make_tuple(can[static_cast<int>(ability.can)], std::string(ability.how));
}

/// What each model says of itself.
py::list models() {
  py::list result;
  for (const ModelInfo& model : all_models()) {
    py::dict abilities;
    abilities["poisson"] = to_tuple(model.poisson);
    abilities["rotation"] = to_tuple(model.rotation);
    abilities["strain"] = to_tuple(model.strain);
    abilities["inversion"] = to_tuple(model.inversion);
    abilities["topology"] = to_tuple(model.topology);
    result.append(py::make_tuple(spelled(model.name), std::string(model.form), words(model.laws),
                                 words(model.elements), abilities));
  }
  return result;
}

}  // namespace

/// Each model by the name of its class in a scene, with its own options; the defaults are there.
void bind_model(py::module_& m) {
  using py::arg;
  m.def("models", &models);
  py::class_<ModelSpec>(m, "Model");
  m.def("FEM", [] { return ModelSpec{FemOptions{}}; });
  m.def(
      "Corotational",
      [](const std::string& rotation, const std::string& tangent) {
        return ModelSpec{CorotationalOptions{rotation, tangent}};
      },
      py::kw_only(), arg("rotation"), arg("tangent"));
  m.def(
      "MassSpring", [](bool equal_masses) { return ModelSpec{MassSpringOptions{equal_masses}}; },
      py::kw_only(), arg("equal_masses"));
  m.def("MassLink", [] { return ModelSpec{MassLinkOptions{}}; });
  m.def("MassTensor", [] { return ModelSpec{MassTensorOptions{}}; });
  m.def("MeanDilatation", [] { return ModelSpec{MeanDilatationOptions{}}; });
  m.def(
      "Condensed",
      [](const Array<std::int32_t>& kept) { return ModelSpec{CondensedOptions{to_vector(kept)}}; },
      py::kw_only(), arg("kept"));
  m.def(
      "Frames",
      [](const std::string& tangent, const std::string& section, const std::string& lever) {
        return ModelSpec{FramesOptions{tangent, section, lever}};
      },
      py::kw_only(), arg("tangent"), arg("section"), arg("lever"));
  m.def(
      "Shell", [](double drilling) { return ModelSpec{ShellOptions{drilling}}; }, py::kw_only(),
      arg("drilling"));
}

}  // namespace tissu::bind
