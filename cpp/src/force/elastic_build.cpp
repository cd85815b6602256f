#include <algorithm>
#include <cmath>
#include <utility>

#include "tissu/base/error.h"
#include "tissu/force/elastic.h"
#include "tissu/law/law_info.h"

namespace tissu {
namespace {

constexpr int kLanes = ElementOrder::kLanes;

double of_cell(const std::vector<double>& values, std::int32_t cell) {
  return values.size() == 1 ? values.front() : values[static_cast<std::size_t>(cell)];
}

std::string first_five(const std::vector<std::int32_t>& numbers) {
  std::string text;
  for (std::size_t i = 0; i < numbers.size() && i < 5; ++i) {
    text += (i == 0 ? "" : ", ") + std::to_string(numbers[i]);
  }
  return numbers.size() > 5 ? text + ", …" : text;
}

/// The names of all laws, of all elements: "hooke, stvk, …".
template <class Infos>
std::string names_of(const Infos& infos) {
  std::string text;
  for (const auto& info : infos) text += (text.empty() ? "" : ", ") + std::string(info.name);
  return text;
}

/// The law and what is added to it.
std::vector<LawUse> laws_of(const ElasticBlock& block) {
  std::vector<LawUse> uses = {{block.law, block.parameters, block.loaded}};
  uses.insert(uses.end(), block.reinforcements.begin(), block.reinforcements.end());
  return uses;
}

const LawInfo& law_or_throw(const ElasticBlock& block, const LawUse& use) {
  const LawInfo* info = use.loaded ? &use.loaded->info() : find_law(use.law);
  if (info == nullptr) {
    throw ParameterError("body \"" + block.body + "\" asks for the law \"" + use.law + "\"; there are " +
                         names_of(all_laws()) + ".");
  }
  return *info;
}

/// Lamé's lambda of a piece that is free to thin: 2 lambda mu / (lambda + 2 mu) for a sheet, and E - 2 mu for
/// a line, so that lambda + 2 mu is Young's modulus there.
void release_across(const LawInfo& law, int dimension, std::span<double> constants) {
  double* lambda = nullptr;
  double mu = 0.0;
  for (std::size_t i = 0; i < constants.size(); ++i) {
    if (law.constants[i] == "lambda") lambda = &constants[i];
    if (law.constants[i] == "mu") mu = constants[i];
  }
  if (lambda == nullptr) return;
  *lambda = dimension == 2 ? 2.0 * *lambda * mu / (*lambda + 2.0 * mu) : mu * *lambda / (*lambda + mu);
}

void check_size(const ElasticBlock& block, const std::vector<double>& values, std::string_view what,
                std::size_t cells) {
  if (values.size() == 1 || values.size() == cells) return;
  throw ParameterError("body \"" + block.body + "\" has " + std::to_string(values.size()) + " values of " +
                       std::string(what) + " for " + std::to_string(cells) +
                       " cells; give one, or one for each cell.");
}

}  // namespace

Elastic::Elastic(ElasticBlock block, ConstReals rest_positions, Isa isa, Threads threads)
    : block_(std::move(block)),
      threads_(threads),
      reference_(reference_cell(block_.element, block_.quadrature)) {
  choose_kernels(isa);
  check_numbers();
  order_ = order_elements(block_.cells, kernels_->nodes, rest_positions);
  lay_constants();
  const bool blind = std::ranges::all_of(
      laws_of(block_), [&](const LawUse& use) { return law_or_throw(block_, use).frame_invariant; });
  shape_ = rest_shape({reference_, block_.cells, block_.cross_section, rest_positions}, order_,
                      {.frames = !blind, .triangular = kernels_->triangular});
  if (!shape_.bad.empty()) {
    if (!block_.cell_numbers.empty()) {
      for (std::int32_t& cell : shape_.bad) cell = block_.cell_numbers[static_cast<std::size_t>(cell)];
    }
    throw MeshError("body \"" + block_.body + "\" has " + std::to_string(shape_.bad.size()) + " of " +
                    std::to_string(cell_count()) + " cells of type " + block_.element +
                    " that are inverted or have no volume (" + first_five(shape_.bad) +
                    "); repair or remove them.");
  }
}

void Elastic::choose_kernels(Isa isa) {
  if (reference_.points.empty()) {
    throw ParameterError("body \"" + block_.body + "\" asks for the element \"" + block_.element +
                         "\" with the quadrature \"" + block_.quadrature + "\"; there are the elements " +
                         names_of(elements()) + ", and the quadratures reduced, full and over.");
  }
  for (const LawUse& use : laws_of(block_)) {
    (void)law_or_throw(block_, use);
    laws_.push_back(use.loaded ? use.loaded->kernels(reference_.dimension)
                               : find_law_kernels(isa, use.law, reference_.dimension));
    if (laws_.back() == nullptr) {
      throw ParameterError("body \"" + block_.body + "\": the law \"" + use.law +
                           "\" needs cells with a volume, and " + block_.element + " has none.");
    }
  }
  if (block_.fused && block_.reinforcements.empty() && !block_.loaded) {
    kernels_ = find_elastic_kernels(isa, block_.element, block_.law, block_.quadrature);
  }
  if (kernels_ == nullptr) kernels_ = find_shape_kernels(isa, reference_.nodes, reference_.dimension);
  if (kernels_ == nullptr) {
    throw ParameterError("body \"" + block_.body + "\": cells of type " + block_.element +
                         " cannot be simulated yet.");
  }
  for (const ReferenceCell::Point& point : reference_.points) {
    for (const auto& gradient : point.gradients) {
      gradients_.insert(gradients_.end(), gradient.begin(), gradient.begin() + reference_.dimension);
    }
  }
}

void Elastic::check_numbers() const {
  const auto nodes = static_cast<std::size_t>(reference_.nodes);
  const std::size_t cells = block_.cells.size() / nodes;
  if (cells == 0 || block_.cells.size() % nodes != 0) {
    throw MeshError("body \"" + block_.body + "\" has " + std::to_string(block_.cells.size()) +
                    " node numbers for cells of type " + block_.element + ", which have " +
                    std::to_string(nodes) + " each; give whole cells, and at least one.");
  }
  for (const LawUse& use : laws_of(block_)) {
    const LawInfo& info = law_or_throw(block_, use);
    for (const LawParameter& parameter : info.parameters) {
      const auto found = use.parameters.find(std::string(parameter.name));
      if (found == use.parameters.end()) {
        throw ParameterError("body \"" + block_.body + "\": the law " + use.law + " lacks its parameter " +
                             std::string(parameter.name) + "; it has " + names_of(info.parameters) + ".");
      }
      check_size(block_, found->second, parameter.name, cells);
    }
    for (const auto& [name, values] : use.parameters) {
      if (std::ranges::find(info.parameters, name, &LawParameter::name) != info.parameters.end()) continue;
      throw ParameterError("body \"" + block_.body + "\": the law " + use.law + " has no parameter " + name +
                           "; it has " + names_of(info.parameters) + ".");
    }
  }
  check_size(block_, block_.density, "density", cells);
  check_size(block_, block_.cross_section, reference_.dimension == 1 ? "section" : "thickness", cells);
  for (const double size : block_.cross_section) {
    if (size > 0.0 && std::isfinite(size)) continue;
    throw ParameterError("body \"" + block_.body + "\" has a thickness or section of " +
                         std::to_string(size) + "; it must be positive and finite.");
  }
  for (const double density : block_.density) {
    if (density > 0.0 && std::isfinite(density)) continue;
    throw ParameterError("body \"" + block_.body + "\" has a density of " + std::to_string(density) +
                         " kg/m3; it must be positive and finite.");
  }
}

void Elastic::lay_constants() {
  const std::vector<LawUse> uses = laws_of(block_);
  bool uniform = true;
  std::size_t count = 0;
  for (const LawUse& use : uses) {
    count += law_or_throw(block_, use).constants.size();
    for (const auto& [name, values] : use.parameters) uniform = uniform && values.size() == 1;
  }
  const std::int32_t groups = uniform ? 1 : order_.groups();
  constants_stride_ = uniform ? 0 : static_cast<std::ptrdiff_t>(count) * kLanes;
  constants_.resize(static_cast<std::size_t>(groups) * count * kLanes);
  std::vector<double> parameters;
  std::vector<double> constants(count);
  for (std::size_t i = 0; i < static_cast<std::size_t>(groups) * kLanes; ++i) {
    double* to = constants.data();
    for (const LawUse& use : uses) {
      const LawInfo& info = law_or_throw(block_, use);
      parameters.clear();
      for (const LawParameter& parameter : info.parameters) {
        parameters.push_back(of_cell(use.parameters.at(std::string(parameter.name)), order_.element[i]));
      }
      const std::span<double> of_law{to, info.constants.size()};
      use.loaded ? use.loaded->compute(parameters, of_law) : law_constants(info, parameters, of_law);
      if (reference_.dimension < 3 && block_.plane == Plane::stress)
        release_across(info, reference_.dimension, of_law);
      to += info.constants.size();
    }
    for (std::size_t c = 0; c < count; ++c)
      constants_[(i / kLanes * count + c) * kLanes + i % kLanes] = constants[c];
  }
}

}  // namespace tissu
