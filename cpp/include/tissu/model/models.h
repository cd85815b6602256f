#pragma once

/// The models that can carry a body's cells, and what each says of itself.

#include <memory>
#include <span>
#include <string_view>

#include "tissu/base/isa.h"
#include "tissu/base/parallel.h"
#include "tissu/model/body_model.h"
#include "tissu/model/model_info.h"

namespace tissu {

std::span<const ModelInfo> all_models();
/// Null when there is none of this name.
const ModelInfo* find_model(std::string_view name);

/// The model that the block asks for; refuses unknown models, and laws and elements that a model does not
/// take.
std::unique_ptr<BodyModel> make_model(ElasticBlock block, ConstReals rest_positions, Isa isa,
                                      Threads threads);

}  // namespace tissu
