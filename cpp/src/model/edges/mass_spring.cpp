#include "tissu/model/edges/mass_spring.h"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <utility>

#include "tissu/model/edges/tetra_edges.h"

namespace tissu {
namespace {

constexpr std::size_t kNodes = 4;

double distance(ConstReals x, std::int32_t a, std::int32_t b) { return (block(x, b) - block(x, a)).norm(); }

}  // namespace

ModelInfo MassSpring::info() {
  using enum Ability::Can;
  return {.name = "mass-spring",
          .form = "springs on the edges, k = E sum V / l0^2",
          .laws = {"hooke", "stvk"},
          .elements = {"tetra"},
          .poisson = {no, "1/4 where edges lie in all directions alike"},
          .rotation = {yes, "exact"},
          .strain = {partly, "springs; nothing holds the volume"},
          .inversion = {no, "springs do not see it"},
          .topology = {yes, "cell by cell"}};
}

MassSpring::MassSpring(ElasticBlock block, ConstReals rest_positions, Isa isa, Threads threads)
    : CellModel(std::move(block), threads), kernels_(find_spring_kernels(isa)) {
  check_laws(block_, static_cast<std::size_t>(cell_count()));
  const LawUse law = laws_of(block_).front();
  std::array<double, 2> constants;  // of hooke and stvk, for the sake of what they refuse
  for (std::int32_t cell = 0; cell < (uniform(law.parameters) ? 1 : cell_count()); ++cell) {
    cell_constants(block_, law, cell, constants);
  }
  lay_cells(rest_positions, {.frames = false, .triangular = false});
  order_ = ElementOrder();  // cells are worked through by their springs only
  shape_.rest = {};
  lay_springs(rest_positions);
}

double MassSpring::young(std::size_t cell) const {
  return of_cell(block_.parameters.at("young"), static_cast<std::int32_t>(cell));
}

void MassSpring::lay_springs(ConstReals rest_positions) {
  struct Piece {
    std::int32_t a, b, cell;
    auto operator<=>(const Piece&) const = default;
  };
  std::vector<Piece> pieces;
  for (std::size_t i = 0; i < block_.cells.size(); i += kNodes) {
    for (const auto& [a, b] : kTetraEdges) {
      const auto [low, high] = std::minmax(block_.cells[i + static_cast<std::size_t>(a)],
                                           block_.cells[i + static_cast<std::size_t>(b)]);
      pieces.push_back({low, high, static_cast<std::int32_t>(i / kNodes)});
    }
  }
  std::ranges::sort(pieces);
  std::vector<double> volumes;      // sum V of each spring
  std::vector<double> stiffnesses;  // sum E V
  for (const Piece& piece : pieces) {
    if (ends_.empty() || *(ends_.end() - 2) != piece.a || ends_.back() != piece.b) {
      ends_.insert(ends_.end(), {piece.a, piece.b});
      volumes.push_back(0.0);
      stiffnesses.push_back(0.0);
    }
    const auto cell = static_cast<std::size_t>(piece.cell);
    volumes.back() += shape_.volumes[cell];
    stiffnesses.back() += young(cell) * shape_.volumes[cell];
  }
  springs_ = order_elements(ends_, 2, rest_positions);
  const std::size_t lanes = springs_.element.size();
  for (auto* values : {&stiffness_, &length_, &shares_}) values->assign(lanes, 0.0);
  for (std::size_t i = 0; i < lanes; ++i) {
    const auto s = static_cast<std::size_t>(springs_.element[i]);
    length_[i] = distance(rest_positions, ends_[2 * s], ends_[2 * s + 1]);
    if (springs_.real[i] == 0) continue;
    shares_[i] = volumes[s] / (length_[i] * length_[i]);
    stiffness_[i] = stiffnesses[s] / (length_[i] * length_[i]);
  }
  rest_.resize(3 * block_.cells.size());
  for (std::size_t i = 0; i < block_.cells.size(); ++i) {
    tissu::block(Reals(rest_), static_cast<std::int32_t>(i)) = tissu::block(rest_positions, block_.cells[i]);
  }
}

void MassSpring::bind(const Sparsity& pattern) {
  constexpr std::array<std::array<std::size_t, 2>, 4> kPairs{{{0, 0}, {0, 1}, {1, 0}, {1, 1}}};
  spring_slots_.resize(springs_.element.size() * kPairs.size());
  for (std::size_t i = 0; i < springs_.element.size(); ++i) {
    const std::int32_t* ends = ends_.data() + 2 * static_cast<std::size_t>(springs_.element[i]);
    for (std::size_t p = 0; p < kPairs.size(); ++p) {
      spring_slots_[(i / kLanes * kPairs.size() + p) * kLanes + i % kLanes] =
          pattern.slot(ends[kPairs[p][0]], ends[kPairs[p][1]]);
    }
  }
}

Loops<SpringKernels, SpringView> MassSpring::loops(const double* damping) const {
  return {*kernels_,
          {.places = springs_.places.data(),
           .slots = spring_slots_.data(),
           .stiffness = stiffness_.data(),
           .length = length_.data(),
           .damping = damping},
          springs_};
}

void MassSpring::add_force(const State& state, Scratch& /*scratch*/, Reals f) const {
  force_by(loops(), state.positions, f);
}

void MassSpring::add_stiffness(const State& state, Scratch& /*scratch*/, StiffnessScale scale,
                               BlockMatrix& matrix) const {
  stiffness_by(loops(), state.positions, scale, matrix);
}

void MassSpring::add_product(const State& state, Scratch& /*scratch*/, StiffnessScale scale, ConstReals p,
                             Reals out) const {
  product_by(loops(), state.positions, scale.position, p, out);
}

void MassSpring::add_damping(const double* damping, ConstReals x, double scale, ConstReals p,
                             Reals out) const {
  const SpringView v = loops(damping).view;
  for_chunks(springs_, [&](const Chunk& chunk) {
    kernels_->damping_product(v, chunk, x.data(), scale, p.data(), out.data());
  });
}

void MassSpring::add_damping(const double* damping, ConstReals x, double scale, BlockMatrix& matrix) const {
  const SpringView v = loops(damping).view;
  double* values = matrix.values();
  for_chunks(springs_, [&](const Chunk& chunk) { kernels_->damping(v, chunk, x.data(), scale, values); });
}

double MassSpring::energy(const State& state, Scratch& scratch) const {
  return energy_by(loops(), state.positions, scratch);
}

void MassSpring::add_part_energies(const State& state, Scratch& scratch,
                                   std::span<const std::int32_t> part_of, Reals energies) const {
  add_by_part(springs_, energies_by(loops(), state.positions, scratch), ends_, 2, part_of, energies);
}

void MassSpring::add_masses(std::vector<double>& nodal) const {
  const bool equal_masses = options_or_defaults<MassSpringOptions>(block_.model).equal_masses;
  std::vector<char> used(nodal.size(), 0);
  double total = 0.0;
  double count = 0.0;
  for (std::size_t i = 0; i < block_.cells.size(); ++i) {
    const auto node = static_cast<std::size_t>(block_.cells[i]);
    const std::size_t e = i / kNodes;
    const double share = of_cell(block_.density, static_cast<std::int32_t>(e)) * shape_.volumes[e] / kNodes;
    if (!equal_masses) nodal[node] += share;
    total += share;
    count += used[node] == 0 ? 1.0 : 0.0;
    used[node] = 1;
  }
  if (!equal_masses) return;
  for (std::size_t node = 0; node < nodal.size(); ++node) {
    if (used[node] != 0) nodal[node] += total / count;
  }
}

/// The part of a cell in a spring, E V / l0^2 of its stiffness, holds E V ((l - l0) / l0)^2 / 2.
CellFields MassSpring::fields(const State& state) const {
  CellFields fields;
  for (std::size_t e = 0; e < shape_.volumes.size(); ++e) {
    const std::int32_t* cell = block_.cells.data() + kNodes * e;
    const auto place = static_cast<std::int32_t>(kNodes * e);
    double squares = 0.0;
    for (const auto& [a, b] : kTetraEdges) {
      const double l0 = distance(rest_, place + a, place + b);
      const double strain = distance(state.positions, cell[a], cell[b]) / l0 - 1.0;
      squares += strain * strain;
    }
    Mat3 now;
    for (int i = 0; i < 3; ++i) {
      now.col(i) = tissu::block(ConstReals(state.positions), cell[i + 1]) -
                   tissu::block(ConstReals(state.positions), cell[0]);
    }
    fields.energy_density.push_back(0.5 * young(e) * squares);
    const double whole = shape_.volumes[e] / of_cell(block_.share, static_cast<std::int32_t>(e));
    fields.volume_ratio.push_back(now.determinant() / 6.0 / whole);
  }
  return fields;
}

std::int32_t MassSpring::spring_count() const { return static_cast<std::int32_t>(ends_.size() / 2); }

std::size_t MassSpring::bytes() const {
  return springs_.places.size() * sizeof(std::uint16_t) +
         (springs_.nodes.size() + spring_slots_.size()) * sizeof(std::int32_t) +
         (stiffness_.size() + length_.size()) * sizeof(double);
}

/// k and l0 of each spring, shared out over the cells.
std::size_t MassSpring::reals_per_cell() const {
  const auto cells = static_cast<std::size_t>(cell_count());
  return (2 * static_cast<std::size_t>(spring_count()) + cells / 2) / cells;
}

}  // namespace tissu
