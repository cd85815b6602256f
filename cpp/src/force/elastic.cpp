#include "tissu/force/elastic.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "tissu/base/error.h"
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
  shape_ = rest_shape(reference_, block_.cells, order_, rest_positions);
  if (!shape_.bad.empty()) {
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
  for (const double density : block_.density) {
    if (density > 0.0 && std::isfinite(density)) continue;
    throw ParameterError("body \"" + block_.body + "\" has a density of " + std::to_string(density) +
                         " kg/m3; it must be positive and finite.");
  }
}

std::int32_t Elastic::cell_count() const {
  return static_cast<std::int32_t>(block_.cells.size()) / reference_.nodes;
}

bool Elastic::has_constant_stiffness() const {
  return std::ranges::all_of(laws_, [](const LawKernels* law) { return law->linear; });
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
      to += info.constants.size();
    }
    for (std::size_t c = 0; c < count; ++c)
      constants_[(i / kLanes * count + c) * kLanes + i % kLanes] = constants[c];
  }
}

void Elastic::couple(SparsityBuilder& builder) const { builder.add_cells(block_.cells, kernels_->nodes); }

void Elastic::bind(const Sparsity& pattern) {
  const auto n = static_cast<std::size_t>(kernels_->nodes);
  const auto groups = static_cast<std::size_t>(order_.groups());
  slots_.resize(groups * n * n * kLanes);
  threads_.for_pieces(order_.groups(), [&](std::int32_t begin, std::int32_t end) {
    for (auto group = static_cast<std::size_t>(begin); group < static_cast<std::size_t>(end); ++group) {
      const std::int32_t* nodes = shape_.nodes.data() + group * n * kLanes;
      std::int32_t* slots = slots_.data() + group * n * n * kLanes;
      for (std::size_t a = 0; a < n; ++a) {
        for (std::size_t b = 0; b < n; ++b) {
          for (std::size_t lane = 0; lane < kLanes; ++lane) {
            slots[(a * n + b) * kLanes + lane] =
                pattern.slot(nodes[a * kLanes + lane], nodes[b * kLanes + lane]);
          }
        }
      }
    }
  });
}

ElasticView Elastic::view() const {
  return {shape_.nodes.data(),
          slots_.data(),
          shape_.rest.data(),
          constants_.data(),
          constants_stride_,
          gradients_.data(),
          static_cast<int>(reference_.points.size()),
          laws_.data(),
          static_cast<int>(laws_.size())};
}

template <class Function>
void Elastic::for_chunks(Function&& f) const {
  for (std::int32_t colour = 0; colour < order_.colours(); ++colour) {
    const std::int32_t begin = order_.colour_begin[static_cast<std::size_t>(colour)];
    const std::int32_t end = order_.colour_begin[static_cast<std::size_t>(colour) + 1];
    threads_.for_each(end - begin,
                      [&](std::int32_t c) { f(order_.chunks[static_cast<std::size_t>(begin + c)]); });
  }
}

void Elastic::add_force(const State& state, Reals f) const {
  const ElasticView v = view();
  for_chunks([&](GroupRange chunk) { kernels_->force(v, chunk, state.positions.data(), f.data()); });
}

void Elastic::add_stiffness(const State& state, StiffnessScale scale, BlockMatrix& matrix) const {
  if (scale.position == 0.0) return;
  const ElasticView v = view();
  double* values = matrix.values();
  for_chunks([&](GroupRange chunk) {
    kernels_->stiffness(v, chunk, state.positions.data(), scale.position, values);
  });
}

void Elastic::add_product(const State& state, StiffnessScale scale, ConstReals p, Reals out) const {
  if (scale.position == 0.0) return;
  const ElasticView v = view();
  for_chunks([&](GroupRange chunk) {
    kernels_->product(v, chunk, state.positions.data(), scale.position, p.data(), out.data());
  });
}

std::vector<double> Elastic::energies(const State& state) const {
  std::vector<double> result(order_.element.size(), 0.0);
  const ElasticView v = view();
  for_chunks([&](GroupRange chunk) { kernels_->energy(v, chunk, state.positions.data(), result.data()); });
  return result;
}

double Elastic::energy(const State& state) const {
  double sum = 0.0;
  for (const double e : energies(state)) sum += e;
  return sum;
}

void Elastic::add_weights(std::vector<double>& nodal) const {
  for_nodes([&](std::size_t node, double, double weight, double) { nodal[node] += weight; });
}

void Elastic::add_masses(std::vector<double>& nodal) const {
  const bool linear = find_element(block_.element)->order == 1;
  for_nodes([&](std::size_t node, double mass, double weight, double share) {
    nodal[node] += linear ? weight : mass * share;
  });
}

/// Calls f(node, mass of the cell, sum_g w_g rho N_a, share of the node in sum_g w_g N_a^2).
template <class Function>
void Elastic::for_nodes(Function&& f) const {
  const auto nodes = static_cast<std::size_t>(reference_.nodes);
  const std::size_t points = reference_.points.size();
  const std::size_t rest = static_cast<std::size_t>(reference_.dimension * reference_.dimension) + 1;
  std::vector<double> first(nodes);
  std::vector<double> second(nodes);
  for (std::size_t i = 0; i < order_.element.size(); ++i) {
    if (order_.real[i] == 0) continue;
    const auto e = static_cast<std::size_t>(order_.element[i]);
    const double density = of_cell(block_.density, order_.element[i]);
    std::ranges::fill(first, 0.0);
    std::ranges::fill(second, 0.0);
    double squares = 0.0;
    for (std::size_t g = 0; g < points; ++g) {
      const double w = shape_.rest[((i / kLanes * points + g) * rest + rest - 1) * kLanes + i % kLanes];
      for (std::size_t a = 0; a < nodes; ++a) {
        const double N = reference_.points[g].values[a];
        first[a] += w * density * N;
        second[a] += w * N * N;
        squares += w * N * N;
      }
    }
    for (std::size_t a = 0; a < nodes; ++a) {
      const auto node = static_cast<std::size_t>(block_.cells[e * nodes + a]);
      f(node, density * shape_.volumes[e], first[a], second[a] / squares);
    }
  }
}

CellFields Elastic::fields(const State& state) const {
  const std::size_t lanes = order_.element.size();
  std::vector<double> stresses(6 * lanes);
  std::vector<double> ratios(lanes);
  const ElasticView v = view();
  for_chunks([&](GroupRange chunk) {
    kernels_->stress(v, chunk, state.positions.data(), stresses.data(), ratios.data());
  });
  const std::vector<double> stored = energies(state);
  CellFields fields;
  const auto cells = static_cast<std::size_t>(cell_count());
  fields.von_mises.resize(cells);
  fields.energy_density.resize(cells);
  fields.volume_ratio.resize(cells);
  for (std::size_t i = 0; i < lanes; ++i) {
    if (order_.real[i] == 0) continue;
    const auto e = static_cast<std::size_t>(order_.element[i]);
    const auto s = [&](std::size_t k) { return stresses[(i / kLanes * 6 + k) * kLanes + i % kLanes]; };
    const double deviation =
        (s(0) - s(1)) * (s(0) - s(1)) + (s(1) - s(2)) * (s(1) - s(2)) + (s(2) - s(0)) * (s(2) - s(0));
    const double shear = s(3) * s(3) + s(4) * s(4) + s(5) * s(5);
    fields.von_mises[e] = std::sqrt(0.5 * deviation + 3.0 * shear);
    fields.energy_density[e] = stored[i] / shape_.volumes[e];
    fields.volume_ratio[e] = ratios[i];
  }
  return fields;
}

std::size_t Elastic::bytes() const {
  return (shape_.nodes.size() + slots_.size()) * sizeof(std::int32_t) +
         (shape_.rest.size() + constants_.size()) * sizeof(double);
}

}  // namespace tissu
