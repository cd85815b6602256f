#include "tissu/model/options.h"

#include <optional>
#include <string>
#include <utility>

#include "tissu/base/error.h"

namespace tissu {
namespace {

/// The defaults of the model of this name among the alternatives; `names` becomes a list of all.
template <std::size_t... Numbers>
std::optional<ModelOptions> find(std::string_view name, std::string& names,
                                 std::index_sequence<Numbers...> /*all*/) {
  std::optional<ModelOptions> found;
  const auto look = [&](ModelOptions options) {
    const std::string_view model = model_name(options);
    names += (names.empty() ? "" : ", ") + std::string(model);
    if (model == name) found = std::move(options);
  };
  (look(ModelOptions(std::in_place_index<Numbers>)), ...);
  return found;
}

}  // namespace

std::string_view model_name(const ModelOptions& options) {
  return std::visit([](const auto& own) { return own.kName; }, options);
}

ModelOptions options_named(std::string_view name) {
  std::string names;
  const auto found = find(name, names, std::make_index_sequence<std::variant_size_v<ModelOptions>>());
  if (found) return *found;
  throw ParameterError("there is no model \"" + std::string(name) + "\"; there are " + names + ".");
}

}  // namespace tissu
