#include "tissu/model/models.h"

#include <algorithm>
#include <array>
#include <string>
#include <utility>

#include "tissu/base/error.h"
#include "tissu/model/condensed/condensed.h"
#include "tissu/model/corotational/corotational.h"
#include "tissu/model/dilatation/mean_dilatation.h"
#include "tissu/model/edges/mass_link.h"
#include "tissu/model/edges/mass_spring.h"
#include "tissu/model/edges/mass_tensor.h"
#include "tissu/model/fem/elastic.h"
#include "tissu/model/frames/frames.h"
#include "tissu/model/shell/shell.h"

namespace tissu {
namespace {

template <class Model>
std::unique_ptr<BodyModel> make(ElasticBlock block, ConstReals rest_positions, Isa isa, Threads threads) {
  return std::make_unique<Model>(std::move(block), rest_positions, isa, threads);
}

struct Entry {
  ModelInfo info;
  std::unique_ptr<BodyModel> (*make)(ElasticBlock, ConstReals, Isa, Threads);
};

template <class Model>
Entry entry() {
  return {Model::info(), &make<Model>};
}

/// A model is added here and in options.h, and in tests/cpp/model/models_test.cpp.
const std::vector<Entry>& entries() {
  static const std::vector<Entry> all = {entry<Elastic>(),        entry<Corotational>(), entry<MassSpring>(),
                                         entry<MassLink>(),       entry<MassTensor>(),   entry<Condensed>(),
                                         entry<MeanDilatation>(), entry<Frames>(),       entry<Shell>()};
  return all;
}

std::string listed(const std::vector<std::string_view>& names) {
  std::string text;
  for (const std::string_view name : names) text += (text.empty() ? "" : ", ") + std::string(name);
  return text;
}

void check_taken(const ElasticBlock& block, const ModelInfo& info) {
  const auto refuse = [&](std::string_view what, const std::string& found,
                          const std::vector<std::string_view>& taken) {
    if (taken.empty() || std::ranges::find(taken, found) != taken.end()) return;
    throw ParameterError("body \"" + block.body + "\" asks for the model " + std::string(info.name) +
                         " with the " + std::string(what) + " " + found + "; this model takes " +
                         listed(taken) + ".");
  };
  refuse("element", block.element, info.elements);
  refuse("law", block.law, info.laws);
  if (!info.laws.empty() && block.loaded) {
    throw ParameterError("body \"" + block.body + "\" asks for the model " + std::string(info.name) +
                         " with the law " + block.law +
                         " of its own; only the models fem and mean-dilatation take such laws.");
  }
  if (info.laws.empty() || block.reinforcements.empty()) return;
  throw ParameterError("body \"" + block.body + "\" asks for the model " + std::string(info.name) +
                       " with fibres; only the models fem and mean-dilatation take them.");
}

}  // namespace

std::span<const ModelInfo> all_models() {
  static const std::vector<ModelInfo> infos = [] {
    std::vector<ModelInfo> result;
    for (const Entry& entry : entries()) result.push_back(entry.info);
    return result;
  }();
  return infos;
}

const ModelInfo* find_model(std::string_view name) {
  const auto models = all_models();
  const auto found = std::ranges::find(models, name, &ModelInfo::name);
  return found == models.end() ? nullptr : &*found;
}

std::unique_ptr<BodyModel> make_model(ElasticBlock block, ConstReals rest_positions, Isa isa,
                                      Threads threads) {
  for (const Entry& entry : entries()) {
    if (entry.info.name != model_name(block.model)) continue;
    check_taken(block, entry.info);
    return entry.make(std::move(block), rest_positions, isa, threads);
  }
  throw ParameterError("body \"" + block.body + "\" asks for the model " +
                       std::string(model_name(block.model)) + ", which cannot be made.");
}

}  // namespace tissu
