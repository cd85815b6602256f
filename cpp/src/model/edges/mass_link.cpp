#include "tissu/model/edges/mass_link.h"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <utility>

#include "tissu/model/edges/tetra_edges.h"
#include "tissu/model/points/elastic_points.h"

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
  lay_links(rest_positions);
  keep_volumes();
}

void MassLink::lay_links(ConstReals rest_positions) {
  const LawUse use{block_.law, block_.parameters, block_.loaded};
  const auto reals = static_cast<std::size_t>(kernels_->reals);
  lay_constants(reals, false, [&](std::size_t lane, std::span<double> constants) {
    const std::int32_t e = order_.element[lane];
    const std::int32_t* nodes = &block_.cells[4 * static_cast<std::size_t>(e)];
    LinkCell cell;
    gradient_products(nodes, rest_positions, cell.s);
    cell.squares = squares_of(nodes, rest_positions);
    const double material = shape_.volumes[static_cast<std::size_t>(e)];
    cell.volume = material / of_cell(block_.share, e);
    cell.counted = order_.real[lane] != 0 ? material : 0.0;
    std::array<double, 2> lame;
    cell_constants(block_, use, e, lame);
    cell.lame = {lame[0], lame[1]};
    std::ranges::copy(block_.law == "stvk" ? stvk_constants(cell) : neo_hooke_constants(cell),
                      constants.begin());
  });
}

Loops<MassLinkKernels, MassLinkView> MassLink::loops() const {
  return {*kernels_, {order_.places.data(), slots_.data(), constants_.data()}, order_};
}

void MassLink::add_force(const State& state, Scratch& /*scratch*/, Reals f) const {
  force_by(loops(), state.positions, f);
}

void MassLink::add_stiffness(const State& state, Scratch& /*scratch*/, StiffnessScale scale,
                             BlockMatrix& matrix) const {
  stiffness_by(loops(), state.positions, scale, matrix);
}

void MassLink::add_product(const State& state, Scratch& /*scratch*/, StiffnessScale scale, ConstReals p,
                           Reals out) const {
  product_by(loops(), state.positions, scale.position, p, out);
}

double MassLink::energy(const State& state, Scratch& scratch) const {
  return energy_by(loops(), state.positions, scratch);
}

void MassLink::add_part_energies(const State& state, Scratch& scratch, std::span<const std::int32_t> part_of,
                                 Reals energies) const {
  add_by_part(order_, energies_by(loops(), state.positions, scratch), block_.cells,
              static_cast<std::size_t>(reference_.nodes), part_of, energies);
}

CellFields MassLink::fields(const State& state) const {
  CellFields fields = fields_by(loops(), state.positions);
  for (std::size_t e = 0; e < shape_.volumes.size(); ++e) {
    fields.volume_ratio[e] /= shape_.volumes[e] / of_cell(block_.share, static_cast<std::int32_t>(e));
  }
  return fields;
}

PointFields MassLink::point_fields(const PointQuery& query) const { return elastic_points(block_, query); }

std::size_t MassLink::bytes() const {
  return CellModel::bytes() + (shape_.rest.size() + constants_.size()) * sizeof(double);
}

std::size_t MassLink::reals_per_cell() const { return static_cast<std::size_t>(kernels_->reals); }

}  // namespace tissu
