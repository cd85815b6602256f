#include "tissu/model/edges/mass_tensor.h"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <utility>

#include "tissu/model/fem/elastic.h"
#include "tissu/model/points/elastic_points.h"

namespace tissu {
namespace {

/// X_a - X_0, columns.
Mat3 edges_of(const std::int32_t* nodes, ConstReals X) {
  Mat3 J;
  for (int a = 1; a < 4; ++a) J.col(a - 1) = block(X, nodes[a]) - block(X, nodes[0]);
  return J;
}

}  // namespace

ModelInfo MassTensor::info() {
  using enum Ability::Can;
  return {.name = "mass-tensor",
          .form = "the energy as a polynomial in displacements, constants on nodes, edges, faces and cells",
          .laws = {"hooke", "stvk"},
          .elements = {"tetra"},
          .poisson = {yes, "of the law"},
          .rotation = {partly,
                       "stvk: exact, but round-off grows with the cube of what it moves nodes by; hooke: no"},
          .strain = {partly, "stvk: to a compression of 0.577; hooke: no"},
          .inversion = {no, "a cell inside out is at rest too"},
          .topology = {yes, "constants change where cells go, and nowhere else"}};
}

MassTensor::MassTensor(ElasticBlock block, ConstReals rest_positions, Isa isa, Threads threads)
    : CellModel(std::move(block), threads),
      isa_(isa),
      linear_(block_.law == "hooke"),
      X_(rest_positions.begin(), rest_positions.end()) {
  check_laws(block_, static_cast<std::size_t>(cell_count()));
  lay_cells(X_, {.frames = false, .triangular = true});
  order_ = {};  // no loop runs over whole cells, and of their shape only the volume is kept
  shape_.rest = {};
  lay_laws();
  for (int size = 1; size <= 4; ++size) {
    const MassTensorKernels* kernels = find_mass_tensor_kernels(isa_, linear_, size);
    if (kernels == nullptr) continue;
    const auto cell_of = [this](std::int32_t e) { return cell(e); };
    parts_.push_back({kernels, tensor_table(size, kernels->reals, block_.cells, cell_of, X_)});
  }
}

MassTensor::MassTensor(const MassTensor& before, ElasticBlock left, const std::vector<std::int32_t>& removed)
    : CellModel(std::move(left), before.threads_), isa_(before.isa_), linear_(before.linear_), X_(before.X_) {
  lay_laws();
  std::vector<std::int32_t> gone;
  std::size_t next = 0;
  for (std::int32_t e = 0; e < before.cell_count(); ++e) {
    const auto at = static_cast<std::size_t>(e);
    if (next < removed.size() && removed[next] == e) {
      gone.insert(gone.end(), &before.block_.cells[4 * at], &before.block_.cells[4 * at] + 4);
      ++next;
    } else {
      shape_.volumes.push_back(before.shape_.volumes[at]);
    }
  }
  const auto cell_of = [this](std::int32_t e) { return cell(e); };
  for (const Part& part : before.parts_) {
    parts_.push_back({part.kernels, tissu::without(part.table, gone, block_.cells, cell_of, X_.size() / 3)});
  }
}

void MassTensor::lay_laws() {
  const LawUse use{block_.law, block_.parameters, block_.loaded};
  for (std::int32_t e = 0; e < (uniform(use.parameters) ? 1 : cell_count()); ++e) {
    std::array<double, 2> constants;
    cell_constants(block_, use, e, constants);
    lame_.push_back({constants[0], constants[1]});
  }
}

const Lame& MassTensor::lame_of(std::int32_t cell) const {
  return lame_[lame_.size() == 1 ? 0 : static_cast<std::size_t>(cell)];
}

std::unique_ptr<BodyModel> MassTensor::without(const ElasticBlock& left,
                                               const std::vector<std::int32_t>& removed) const {
  return std::unique_ptr<BodyModel>(new MassTensor(*this, left, removed));
}

TensorCell MassTensor::cell(std::int32_t number) const {
  const Mat3 inverse = edges_of(&block_.cells[4 * static_cast<std::size_t>(number)], X_).inverse();
  TensorCell cell;
  cell.g[0] = Vec3::Zero();
  for (std::size_t a = 1; a < 4; ++a) {
    cell.g[a] = inverse.row(static_cast<Eigen::Index>(a) - 1).transpose();
    cell.g[0] -= cell.g[a];
  }
  cell.volume = shape_.volumes[static_cast<std::size_t>(number)];
  cell.lame = lame_of(number);
  return cell;
}

void MassTensor::bind(const Sparsity& pattern) {
  elements_.reset();  // they know another pattern
  for (Part& part : parts_) {
    lay_slots(part.table.order, part.table.nodes, part.table.size, pattern, part.table.slots);
  }
}

Loops<MassTensorKernels, MassTensorView> MassTensor::loops(const Part& part) const {
  return {*part.kernels,
          {.places = part.table.order.places.data(),
           .slots = part.table.slots.data(),
           .constants = part.table.constants.data(),
           .rest = X_.data(),
           .origin = block_.cells.front()},
          part.table.order};
}

/// A quarter of each cell's mass at each of its nodes.
void MassTensor::add_masses(std::vector<double>& nodal) const {
  for (std::size_t i = 0; i < block_.cells.size(); ++i) {
    const auto cell = static_cast<std::int32_t>(i / 4);
    nodal[static_cast<std::size_t>(block_.cells[i])] +=
        0.25 * of_cell(block_.density, cell) * shape_.volumes[i / 4];
  }
}

void MassTensor::add_weights(std::vector<double>& nodal) const { add_masses(nodal); }

void MassTensor::add_force(const State& state, Scratch& /*scratch*/, Reals f) const {
  for (const Part& part : parts_) force_by(loops(part), state.positions, f);
}

const BodyModel& MassTensor::elements(const Sparsity& pattern) const {
  const std::scoped_lock one_makes_them(making_elements_);
  if (elements_ == nullptr) {
    elements_ = std::make_unique<Elastic>(block_, X_, isa_, threads_);
    elements_->bind(pattern);
  }
  return *elements_;
}

void MassTensor::add_stiffness(const State& state, Scratch& scratch, StiffnessScale scale,
                               BlockMatrix& matrix) const {
  if (scale.definite && !linear_) {
    elements(matrix.sparsity()).add_stiffness(state, scratch, scale, matrix);
    return;
  }
  for (const Part& part : parts_) stiffness_by(loops(part), state.positions, scale, matrix);
}

void MassTensor::add_product(const State& state, Scratch& /*scratch*/, StiffnessScale scale, ConstReals p,
                             Reals out) const {
  for (const Part& part : parts_) product_by(loops(part), state.positions, scale.position, p, out);
}

double MassTensor::energy(const State& state, Scratch& scratch) const {
  double sum = 0.0;
  for (const Part& part : parts_) {
    for (const double e : energies_by(loops(part), state.positions, scratch)) sum += e;
  }
  return sum;
}

void MassTensor::add_part_energies(const State& state, Scratch& scratch,
                                   std::span<const std::int32_t> part_of, Reals energies) const {
  for (const Part& part : parts_) {
    add_by_part(part.table.order, energies_by(loops(part), state.positions, scratch), part.table.nodes,
                static_cast<std::size_t>(part.table.size), part_of, energies);
  }
}

/// F from the positions: the constants do not hold it.
CellFields MassTensor::fields(const State& state) const {
  return cell_means(elastic_points(block_, {X_, state, isa_}));
}

PointFields MassTensor::point_fields(const PointQuery& query) const { return elastic_points(block_, query); }

std::size_t MassTensor::bytes() const {
  std::size_t sum = (X_.size() + 2 * lame_.size()) * sizeof(double);
  for (const Part& part : parts_) sum += part.table.bytes();
  const std::scoped_lock nobody_makes_them(making_elements_);
  if (elements_ != nullptr) sum += elements_->bytes();
  return sum;
}

std::size_t MassTensor::reals_per_cell() const {
  constexpr std::array<int, 5> kOfOneCell = {0, 4, 6, 4, 1};
  int sum = 0;
  for (const Part& part : parts_) {
    sum += kOfOneCell[static_cast<std::size_t>(part.table.size)] * part.table.reals;
  }
  return static_cast<std::size_t>(sum);
}

std::size_t MassTensor::constants() const {
  std::size_t sum = 0;
  for (const Part& part : parts_) sum += part.table.held();
  return sum;
}

std::size_t MassTensor::computed_constants() const {
  std::size_t sum = 0;
  for (const Part& part : parts_) sum += part.table.computed;
  return sum;
}

}  // namespace tissu
