#include "tissu/model/condensed/condensed.h"

#include <utility>

namespace tissu {

ModelInfo Condensed::info() {
  using enum Ability::Can;
  return {.name = "condensed",
          .form = "Hooke's law, inner nodes eliminated once",
          .laws = {"hooke"},
          .elements = {},
          .poisson = {yes, "of the law"},
          .rotation = {no, "linear"},
          .strain = {no, "linear"},
          .inversion = {yes, "linear"},
          .topology = {partly, "neighbours at once; without cells of its own it is condensed again"}};
}

Condensed::Condensed(ElasticBlock block, ConstReals rest_positions, Isa isa, Threads threads)
    : region_(std::make_shared<CondensedRegion>(std::move(block), rest_positions, isa, threads)),
      block_(region_->elastic().block()) {}

std::unique_ptr<BodyModel> Condensed::without(const ElasticBlock& left,
                                              const std::vector<std::int32_t>& removed) const {
  if (!removed.empty()) return nullptr;
  return std::unique_ptr<BodyModel>(new Condensed(region_, left));
}

void Condensed::couple(SparsityBuilder& builder) const {
  builder.add_cells(region_->kept(), static_cast<int>(region_->kept().size()));
}

void Condensed::bind(const Sparsity& pattern) {
  const std::vector<std::int32_t>& kept = region_->kept();
  slots_.clear();
  slots_.reserve(kept.size() * kept.size());
  for (const std::int32_t row : kept) {
    for (const std::int32_t column : kept) slots_.push_back(pattern.slot(row, column));
  }
}

/// f_row += scale sum_column S_row,column p_column, straight from and to arrays of the whole world.
template <class Value>
void Condensed::multiply(double scale, Value&& p, Reals f) const {
  const std::vector<std::int32_t>& kept = region_->kept();
  const std::size_t n = kept.size();
  for (std::size_t column = 0; column < n; ++column) {
    const Vec3 value = scale * p(kept[column]);
    const double* S = region_->stiffness().data() + 9 * n * column;
    for (std::size_t row = 0; row < n; ++row, S += 3) {
      double* to = f.data() + 3 * static_cast<std::ptrdiff_t>(kept[row]);
      for (std::size_t i = 0; i < 3; ++i) {
        to[i] += S[i] * value[0] + S[3 * n + i] * value[1] + S[6 * n + i] * value[2];
      }
    }
  }
}

void Condensed::add_force(const State& state, Scratch& /*scratch*/, Reals f) const {
  const std::vector<std::int32_t>& kept = region_->kept();
  multiply(
      -1.0,
      [&](std::int32_t node) {
        return Vec3(tissu::block(ConstReals(state.positions), node) -
                    tissu::block(ConstReals(region_->rest()), node));
      },
      f);
  for (std::size_t k = 0; k < kept.size(); ++k) {
    tissu::block(f, kept[k]) +=
        state.load_factor * region_->pull().segment<3>(static_cast<Eigen::Index>(3 * k));
  }
}

void Condensed::add_stiffness(const State& /*state*/, Scratch& /*scratch*/, StiffnessScale scale,
                              BlockMatrix& matrix) const {
  const std::vector<std::int32_t>& kept = region_->kept();
  if (scale.position == 0.0) return;
  double* values = matrix.values();
  const std::size_t n = kept.size();
  for (std::size_t row = 0; row < n; ++row) {
    for (std::size_t column = 0; column < n; ++column) {
      Eigen::Map<Mat3>(values + 9 * static_cast<std::ptrdiff_t>(slots_[row * n + column])) -=
          scale.position * region_->stiffness().block<3, 3>(static_cast<Eigen::Index>(3 * row),
                                                            static_cast<Eigen::Index>(3 * column));
    }
  }
}

void Condensed::add_product(const State& /*state*/, Scratch& /*scratch*/, StiffnessScale scale, ConstReals p,
                            Reals out) const {
  if (scale.position == 0.0) return;
  multiply(-scale.position, [&](std::int32_t node) { return Vec3(tissu::block(p, node)); }, out);
}

Eigen::VectorXd Condensed::displacements(const State& state) const {
  const std::vector<std::int32_t>& kept = region_->kept();
  Eigen::VectorXd u(static_cast<Eigen::Index>(3 * kept.size()));
  for (std::size_t k = 0; k < kept.size(); ++k) {
    u.segment<3>(static_cast<Eigen::Index>(3 * k)) = tissu::block(ConstReals(state.positions), kept[k]) -
                                                     tissu::block(ConstReals(region_->rest()), kept[k]);
  }
  return u;
}

/// Strains by the kept nodes and by the weight of the inner ones do no work on each other.
double Condensed::energy(const State& state, Scratch& /*scratch*/) const {
  const Eigen::VectorXd u = displacements(state);
  const double l = state.load_factor;
  return 0.5 * (u.dot(region_->stiffness() * u) + l * l * region_->sag()) + potential(state);
}

/// S couples no nodes of different parts; what no displacement changes is left out.
void Condensed::add_part_energies(const State& state, Scratch& /*scratch*/,
                                  std::span<const std::int32_t> part_of, Reals energies) const {
  const std::vector<std::int32_t>& kept = region_->kept();
  const Eigen::VectorXd u = displacements(state);
  const Eigen::VectorXd f = 0.5 * (region_->stiffness() * u) - state.load_factor * region_->pull();
  for (std::size_t k = 0; k < kept.size(); ++k) {
    const std::int32_t part = part_of[static_cast<std::size_t>(kept[k])];
    const auto first = static_cast<Eigen::Index>(3 * k);
    if (part >= 0) energies[static_cast<std::size_t>(part)] += u.segment<3>(first).dot(f.segment<3>(first));
  }
}

double Condensed::potential(const State& state) const {
  const double l = state.load_factor;
  return -l * (displacements(state).dot(region_->pull()) + region_->pull_at_rest() + l * region_->sag());
}

void Condensed::add_masses(std::vector<double>& nodal) const {
  const std::vector<std::int32_t>& kept = region_->kept();
  for (std::size_t k = 0; k < kept.size(); ++k)
    nodal[static_cast<std::size_t>(kept[k])] += region_->masses()[k];
}

std::size_t Condensed::bytes() const {
  return static_cast<std::size_t>(region_->stiffness().size()) * sizeof(double) +
         slots_.size() * sizeof(std::int32_t);
}

std::size_t Condensed::reals_per_cell() const {
  return static_cast<std::size_t>(region_->stiffness().size()) / static_cast<std::size_t>(cell_count());
}

}  // namespace tissu
