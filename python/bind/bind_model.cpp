#include "bind.h"
#include "tissu/model/models.h"

namespace tissu::bind {
namespace {

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
    result.append(py::make_tuple(std::string(model.name), std::string(model.form), words(model.laws),
                                 words(model.elements), abilities));
  }
  return result;
}

}  // namespace

void bind_model(py::module_& m) { m.def("models", &models); }

}  // namespace tissu::bind
