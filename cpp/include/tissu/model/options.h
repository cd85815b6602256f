#pragma once

/// Which model carries a block, with what this model alone asks for: one struct for each, from its own room.

#include <string_view>
#include <variant>

#include "tissu/model/condensed/condensed_options.h"
#include "tissu/model/corotational/corotational_options.h"
#include "tissu/model/dilatation/mean_dilatation_options.h"
#include "tissu/model/edges/edge_options.h"
#include "tissu/model/fem/fem_options.h"
#include "tissu/model/frames/frames_options.h"
#include "tissu/model/shell/shell_options.h"

namespace tissu {

/// In the order of all_models(); continuum elements are the default.
using ModelOptions =
    std::variant<FemOptions, CorotationalOptions, MassSpringOptions, MassLinkOptions, MassTensorOptions,
                 CondensedOptions, MeanDilatationOptions, FramesOptions, ShellOptions>;

/// The model's name as scenes write it.
std::string_view model_name(const ModelOptions& options);

/// The defaults of a model; refuses a name that no model has.
ModelOptions options_named(std::string_view name);

/// A model's own options, or its defaults where the block names another model: that one is then made of it,
/// as a condensed region is of continuum elements.
template <class Options>
Options options_or_defaults(const ModelOptions& options) {
  const Options* own = std::get_if<Options>(&options);
  return own == nullptr ? Options{} : *own;
}

}  // namespace tissu
