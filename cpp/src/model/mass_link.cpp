#include "tissu/model/mass_link.h"

#include <Eigen/LU>
#include <array>
#include <utility>

#include "tissu/model/tetra_edges.h"

namespace tissu {
namespace {

/// s_ab = g_a . g_b of a tetrahedron at rest.
using GradientProducts = double[4][4];

/// l^2 of the six edges [m2]
std::array<double, 6> squares_of(const std::int32_t* nodes, ConstReals X) {
  std::array<double, 6> squares;
  for (std::size_t e = 0; e < 6; ++e) {
    const auto [a, b] = kTetraEdges[e];
    squares[e] = (block(X, nodes[b]) - block(X, nodes[a])).squaredNorm();
  }
  return squares;
}

void gradient_products(const std::int32_t* nodes, ConstReals X, GradientProducts& s) {
  Mat3 J;
  for (int a = 1; a < 4; ++a) J.col(a - 1) = block(X, nodes[a]) - block(X, nodes[0]);
  const Mat3 inverse = J.inverse();
  Eigen::Matrix<double, 4, 3> g;
  g.bottomRows<3>() = inverse;
  g.row(0) = -inverse.colwise().sum();
  for (int a = 0; a < 4; ++a) {
    for (int b = 0; b < 4; ++b) s[a][b] = g.row(a).dot(g.row(b));
  }
}

/// What a law keeps of one tetrahedron of volume V and its twin of volume `counted`: the same, or 0 for a
/// lane that only pads.
struct LinkCell {
  GradientProducts s;
  std::array<double, 6> squares;  ///< l0^2 [m2]
  double volume;
  double counted;
  Lame lame;
};

std::vector<double> stvk_constants(const LinkCell& cell) {
  double MW[kEdgePairs];  // times 4 V
  edge_moduli(cell.s, 0.5 * cell.counted * cell.lame.lambda, 0.5 * cell.counted * cell.lame.mu, MW);
  std::vector<double> constants(MW, MW + kEdgePairs);
  constants.insert(constants.end(), cell.squares.begin(), cell.squares.end());
  return constants;
}

std::vector<double> neo_hooke_constants(const LinkCell& cell) {
  std::vector<double> constants;
  for (const auto& [a, b] : kTetraEdges) constants.push_back(-cell.counted * cell.lame.mu * cell.s[a][b]);
  constants.push_back(1.0 / (6.0 * cell.volume));
  constants.push_back(cell.counted * cell.lame.mu);
  constants.push_back(cell.counted * cell.lame.lambda);
  return constants;
}

}  // namespace

ModelInfo MassLink::info() {
  using enum Ability::Can;
  return {.name = "mass-link",
          .form = "energy in the squared lengths of the edges",
          .laws = {"stvk", "neo_hooke"},
          .elements = {"tetra"},
          .poisson = {yes, "of the law"},
          .rotation = {yes, "exact: lengths do not turn"},
          .strain = {yes, "the law's; stvk to a compression of 0.577"},
          .inversion = {no, "stvk: lengths do not see it; neo_hooke: refused as the law does"},
          .topology = {yes, "cell by cell"}};
}

MassLink::MassLink(ElasticBlock block, ConstReals rest_positions, Isa isa, Threads threads)
    : CellModel(std::move(block), threads), kernels_(find_mass_link_kernels(isa, block_.law)) {
  check_laws(block_, static_cast<std::size_t>(cell_count()));
  lay_cells(rest_positions, {.frames = false, .triangular = true});
  lay_constants(rest_positions);
  keep_volumes();
}

void MassLink::lay_constants(ConstReals rest_positions) {
  const auto reals = static_cast<std::size_t>(kernels_->reals);
  constants_.resize(order_.element.size() * reals);
  const LawUse use{block_.law, block_.parameters, block_.loaded};
  for (std::size_t i = 0; i < order_.element.size(); ++i) {
    const std::int32_t e = order_.element[i];
    const std::int32_t* nodes = &block_.cells[4 * static_cast<std::size_t>(e)];
    LinkCell cell;
    gradient_products(nodes, rest_positions, cell.s);
    cell.squares = squares_of(nodes, rest_positions);
    cell.volume = shape_.volumes[static_cast<std::size_t>(e)];
    cell.counted = order_.real[i] != 0 ? cell.volume : 0.0;
    std::array<double, 2> lame;
    cell_constants(block_, use, e, lame);
    cell.lame = {lame[0], lame[1]};
    const auto constants = block_.law == "stvk" ? stvk_constants(cell) : neo_hooke_constants(cell);
    for (std::size_t k = 0; k < reals; ++k) {
      constants_[(i / kLanes * reals + k) * kLanes + i % kLanes] = constants[k];
    }
  }
}

MassLinkView MassLink::view() const {
  return {.places = order_.places.data(), .slots = slots_.data(), .constants = constants_.data()};
}

void MassLink::add_force(const State& state, Reals f) const {
  const MassLinkView v = view();
  for_chunks([&](const Chunk& chunk) { kernels_->force(v, chunk, state.positions.data(), f.data()); });
}

void MassLink::add_stiffness(const State& state, StiffnessScale scale, BlockMatrix& matrix) const {
  if (scale.position == 0.0) return;
  const MassLinkView v = view();
  double* values = matrix.values();
  for_chunks([&](const Chunk& chunk) {
    kernels_->stiffness(v, chunk, state.positions.data(), scale.position, values);
  });
}

void MassLink::add_product(const State& state, StiffnessScale scale, ConstReals p, Reals out) const {
  if (scale.position == 0.0) return;
  const MassLinkView v = view();
  for_chunks([&](const Chunk& chunk) {
    kernels_->product(v, chunk, state.positions.data(), scale.position, p.data(), out.data());
  });
}

std::vector<double> MassLink::energies(const State& state) const {
  std::vector<double> result(order_.element.size(), 0.0);
  const MassLinkView v = view();
  for_chunks([&](const Chunk& chunk) { kernels_->energy(v, chunk, state.positions.data(), result.data()); });
  return result;
}

double MassLink::energy(const State& state) const {
  double sum = 0.0;
  for (const double e : energies(state)) sum += e;
  return sum;
}

CellFields MassLink::fields(const State& state) const {
  const std::size_t lanes = order_.element.size();
  std::vector<double> stresses(6 * lanes);
  std::vector<double> now(lanes);
  const MassLinkView v = view();
  for_chunks([&](const Chunk& chunk) {
    kernels_->stress(v, chunk, state.positions.data(), stresses.data(), now.data());
  });
  const std::vector<double> stored = energies(state);
  const auto cells = static_cast<std::size_t>(cell_count());
  CellFields fields;
  fields.von_mises.resize(cells);
  fields.energy_density.resize(cells);
  fields.volume_ratio.resize(cells);
  for_lanes([&](std::size_t lane, std::size_t cell) {
    fields.von_mises[cell] = von_mises(stresses.data(), lane);
    fields.energy_density[cell] = stored[lane] / shape_.volumes[cell];
    fields.volume_ratio[cell] = now[lane] / shape_.volumes[cell];
  });
  return fields;
}

std::size_t MassLink::bytes() const {
  return CellModel::bytes() + (shape_.rest.size() + constants_.size()) * sizeof(double);
}

std::size_t MassLink::reals_per_cell() const { return static_cast<std::size_t>(kernels_->reals); }

}  // namespace tissu
