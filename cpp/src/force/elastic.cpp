#include "tissu/force/elastic.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <utility>

#include "tissu/base/error.h"
#include "tissu/element/reference_cell.h"
#include "tissu/law/law.h"

namespace tissu {
namespace {

constexpr int kLanes = ElementOrder::kLanes;
constexpr int kRest = 10;

const ElasticKernels* find_or_throw(const ElasticBlock& block, Isa isa) {
  const auto* kernels = find_elastic_kernels(isa, block.element, block.law, block.quadrature);
  if (kernels == nullptr) {
    throw ParameterError(
        "body \"" + block.body + "\" asks for element \"" + block.element + "\", law \"" + block.law +
        "\", quadrature \"" + block.quadrature +
        "\"; there are the elements tetra and hexahedron, the laws hooke and stvk, the quadratures "
        "full and over.");
  }
  return kernels;
}

double of_cell(const std::vector<double>& values, std::int32_t cell) {
  return values.size() == 1 ? values.front() : values[static_cast<std::size_t>(cell)];
}

void check_size(const ElasticBlock& block, const std::vector<double>& values, const char* what,
                std::size_t cells) {
  if (values.size() == 1 || values.size() == cells) return;
  throw ParameterError("body \"" + block.body + "\" has " + std::to_string(values.size()) + " values of " +
                       what + " for " + std::to_string(cells) + " cells; give one, or one for each cell.");
}

/// J at a point: sum_a X_a (x) dN_a/dxi
Mat3 jacobian(const ReferenceCell::Point& point, std::span<const std::int32_t> cell, ConstReals X) {
  Mat3 J = Mat3::Zero();
  for (std::size_t a = 0; a < cell.size(); ++a) {
    J += block(X, cell[a]) * Eigen::Map<const Eigen::RowVector3d>(point.gradients[a].data());
  }
  return J;
}

std::string first_five(const std::vector<std::int32_t>& numbers) {
  std::string text;
  for (std::size_t i = 0; i < numbers.size() && i < 5; ++i) {
    text += (i == 0 ? "" : ", ") + std::to_string(numbers[i]);
  }
  return numbers.size() > 5 ? text + ", …" : text;
}

}  // namespace

Elastic::Elastic(ElasticBlock block, ConstReals rest_positions, Isa isa, Threads threads)
    : block_(std::move(block)), threads_(threads), kernels_(find_or_throw(block_, isa)) {
  const std::size_t cells = block_.cells.size() / static_cast<std::size_t>(kernels_->nodes);
  if (cells == 0 || block_.cells.size() % static_cast<std::size_t>(kernels_->nodes) != 0) {
    throw MeshError("body \"" + block_.body + "\" has " + std::to_string(block_.cells.size()) +
                    " node numbers for cells of type " + block_.element + ", which have " +
                    std::to_string(kernels_->nodes) + " each; give whole cells, and at least one.");
  }
  check_size(block_, block_.young, "Young's modulus", cells);
  check_size(block_, block_.poisson, "Poisson's ratio", cells);
  check_size(block_, block_.density, "density", cells);
  for (const double density : block_.density) {
    if (!(density > 0.0) || !std::isfinite(density)) {
      throw ParameterError("body \"" + block_.body + "\" has a density of " + std::to_string(density) +
                           " kg/m3; it must be positive and finite.");
    }
  }
  order_ = order_elements(block_.cells, kernels_->nodes, rest_positions);
  lay_constants();
  lay_rest(rest_positions);
}

std::int32_t Elastic::cell_count() const {
  return static_cast<std::int32_t>(block_.cells.size()) / kernels_->nodes;
}

void Elastic::lay_constants() {
  const bool uniform = block_.young.size() == 1 && block_.poisson.size() == 1;
  const std::int32_t groups = uniform ? 1 : order_.groups();
  constants_stride_ = uniform ? 0 : std::ptrdiff_t{2} * kLanes;
  for (std::int32_t group = 0; group < groups; ++group) {
    double lanes[2][kLanes];
    for (int lane = 0; lane < kLanes; ++lane) {
      const std::int32_t e = order_.element[static_cast<std::size_t>(group * kLanes + lane)];
      const Lame constants = lame(of_cell(block_.young, e), of_cell(block_.poisson, e));
      lanes[0][lane] = constants.lambda;
      lanes[1][lane] = constants.mu;
    }
    constants_.insert(constants_.end(), &lanes[0][0], &lanes[0][0] + 2 * kLanes);
  }
}

void Elastic::lay_rest(ConstReals X) {
  const ReferenceCell reference = reference_cell(block_.element, block_.quadrature);
  const auto nodes = static_cast<std::size_t>(kernels_->nodes);
  const auto points = static_cast<std::size_t>(kernels_->points);
  const auto groups = static_cast<std::size_t>(order_.groups());
  nodes_.resize(groups * nodes * kLanes);
  rest_.resize(groups * points * kRest * kLanes);
  volumes_.assign(static_cast<std::size_t>(cell_count()), 0.0);
  std::vector<std::int32_t> bad;
  for (std::size_t i = 0; i < order_.element.size(); ++i) {
    const std::size_t group = i / kLanes;
    const std::size_t lane = i % kLanes;
    const auto e = static_cast<std::size_t>(order_.element[i]);
    const bool real = order_.real[i] != 0;
    const std::span<const std::int32_t> cell(block_.cells.data() + e * nodes, nodes);
    for (std::size_t a = 0; a < nodes; ++a) nodes_[(group * nodes + a) * kLanes + lane] = cell[a];
    bool inverted = false;
    for (std::size_t g = 0; g < points; ++g) {
      const Mat3 J = jacobian(reference.points[g], cell, X);
      const double det = J.determinant();
      const double scale = J.cwiseAbs().maxCoeff();
      inverted = inverted || !(det > 1e-14 * scale * scale * scale);
      const Mat3 Jinv = inverted ? Mat3(Mat3::Identity()) : Mat3(J.inverse());
      double* to = rest_.data() + (group * points + g) * kRest * kLanes + lane;
      for (int k = 0; k < 9; ++k) to[k * kLanes] = Jinv(k / 3, k % 3);
      const double w = reference.points[g].weight * det;
      to[std::ptrdiff_t{9} * kLanes] = real ? w : 0.0;
      if (real) volumes_[e] += w;
    }
    if (inverted && real) bad.push_back(static_cast<std::int32_t>(e));
  }
  if (!bad.empty()) {
    std::ranges::sort(bad);
    throw MeshError("body \"" + block_.body + "\" has " + std::to_string(bad.size()) + " of " +
                    std::to_string(cell_count()) + " cells of type " + block_.element +
                    " that are inverted or have no volume (" + first_five(bad) + "); repair or remove them.");
  }
}

void Elastic::couple(SparsityBuilder& builder) const { builder.add_cells(block_.cells, kernels_->nodes); }

void Elastic::bind(const Sparsity& pattern) {
  const auto n = static_cast<std::size_t>(kernels_->nodes);
  const auto groups = static_cast<std::size_t>(order_.groups());
  slots_.resize(groups * n * n * kLanes);
  threads_.for_pieces(order_.groups(), [&](std::int32_t begin, std::int32_t end) {
    for (auto group = static_cast<std::size_t>(begin); group < static_cast<std::size_t>(end); ++group) {
      const std::int32_t* nodes = nodes_.data() + group * n * kLanes;
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
  return {nodes_.data(), slots_.data(), rest_.data(), constants_.data(), constants_stride_};
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

void Elastic::add_masses(std::vector<double>& nodal) const {
  const ReferenceCell reference = reference_cell(block_.element, block_.quadrature);
  const auto nodes = static_cast<std::size_t>(kernels_->nodes);
  const auto points = static_cast<std::size_t>(kernels_->points);
  for (std::size_t i = 0; i < order_.element.size(); ++i) {
    if (order_.real[i] == 0) continue;
    const std::int32_t e = order_.element[i];
    const double density = of_cell(block_.density, e);
    for (std::size_t g = 0; g < points; ++g) {
      const double w =
          rest_[(i / kLanes * points + g) * kRest * kLanes + std::size_t{9} * kLanes + i % kLanes];
      for (std::size_t a = 0; a < nodes; ++a) {
        const auto node = static_cast<std::size_t>(block_.cells[static_cast<std::size_t>(e) * nodes + a]);
        nodal[node] += w * density * reference.points[g].values[a];
      }
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
    fields.energy_density[e] = stored[i] / volumes_[e];
    fields.volume_ratio[e] = ratios[i];
  }
  return fields;
}

std::size_t Elastic::bytes() const {
  return (nodes_.size() + slots_.size()) * sizeof(std::int32_t) +
         (rest_.size() + constants_.size()) * sizeof(double);
}

}  // namespace tissu
