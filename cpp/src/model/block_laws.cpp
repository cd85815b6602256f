#include <algorithm>
#include <vector>

#include "tissu/base/error.h"
#include "tissu/model/elastic_block.h"

namespace tissu {
namespace {

/// "hooke, stvk, …"
template <class Infos>
std::string names_of(const Infos& infos) {
  std::string text;
  for (const auto& info : infos) text += (text.empty() ? "" : ", ") + std::string(info.name);
  return text;
}

}  // namespace

bool uniform(const LawParameters& parameters) {
  return std::ranges::all_of(parameters, [](const auto& parameter) { return parameter.second.size() == 1; });
}

std::vector<LawUse> laws_of(const ElasticBlock& block) {
  std::vector<LawUse> uses = {{block.law, block.parameters, block.loaded}};
  uses.insert(uses.end(), block.reinforcements.begin(), block.reinforcements.end());
  return uses;
}

const LawInfo& law_info(const ElasticBlock& block, const LawUse& use) {
  const LawInfo* info = use.loaded ? &use.loaded->info() : find_law(use.law);
  if (info == nullptr) {
    throw ParameterError("body \"" + block.body + "\" asks for the law \"" + use.law + "\"; there are " +
                         names_of(all_laws()) + ".");
  }
  return *info;
}

void check_laws(const ElasticBlock& block, std::size_t cells) {
  for (const LawUse& use : laws_of(block)) {
    const LawInfo& info = law_info(block, use);
    for (const LawParameter& parameter : info.parameters) {
      const auto found = use.parameters.find(std::string(parameter.name));
      if (found == use.parameters.end()) {
        throw ParameterError("body \"" + block.body + "\": the law " + use.law + " lacks its parameter " +
                             std::string(parameter.name) + "; it has " + names_of(info.parameters) + ".");
      }
      check_size(block, found->second, parameter.name, cells);
    }
    for (const auto& [name, values] : use.parameters) {
      if (std::ranges::find(info.parameters, name, &LawParameter::name) != info.parameters.end()) continue;
      throw ParameterError("body \"" + block.body + "\": the law " + use.law + " has no parameter " + name +
                           "; it has " + names_of(info.parameters) + ".");
    }
  }
}

void cell_constants(const ElasticBlock& block, const LawUse& use, std::int32_t cell,
                    std::span<double> constants) {
  const LawInfo& info = law_info(block, use);
  std::vector<double> parameters;
  for (const LawParameter& parameter : info.parameters) {
    parameters.push_back(of_cell(use.parameters.at(std::string(parameter.name)), cell));
  }
  use.loaded ? use.loaded->compute(parameters, constants) : law_constants(info, parameters, constants);
}

}  // namespace tissu
