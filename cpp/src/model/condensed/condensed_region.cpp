#include "tissu/model/condensed/condensed_region.h"

#include <algorithm>
#include <iterator>
#include <string>
#include <utility>

#include "tissu/assembly/fixed_dofs.h"
#include "tissu/base/error.h"
#include "tissu/base/sort_unique.h"

namespace tissu {
namespace {

ElasticBlock checked(ElasticBlock block) {
  if (options_or_defaults<CondensedOptions>(block.model).kept.empty()) {
    throw ParameterError("body \"" + block.body +
                         "\" asks for the model condensed and keeps no node; keep its surface, or the nodes "
                         "that are held, loaded or shared with other cells.");
  }
  return block;
}

}  // namespace

CondensedRegion::CondensedRegion(ElasticBlock block, ConstReals rest_positions, Isa isa, Threads threads)
    : elastic_(checked(std::move(block)), rest_positions, isa, threads),
      rest_(rest_positions.begin(), rest_positions.end()) {
  sort_nodes();
  assemble(isa);
  condense();
  share_masses();
}

void CondensedRegion::sort_nodes() {
  const ElasticBlock& whole = elastic_.block();
  std::vector<std::int32_t> nodes = whole.cells;
  sort_unique(nodes);
  std::vector<std::int32_t> kept = std::get<CondensedOptions>(whole.model).kept;
  std::ranges::sort(kept);
  std::ranges::set_intersection(nodes, kept, std::back_inserter(kept_));
  std::ranges::set_difference(nodes, kept, std::back_inserter(inner_));
  constexpr std::size_t kMostKept = 3000;
  if (kept_.empty()) checked({});
  if (kept_.size() > kMostKept) {
    throw ParameterError("body \"" + whole.body + "\": the model condensed would keep " +
                         std::to_string(kept_.size()) + " nodes, whose dense matrix is too large; at most " +
                         std::to_string(kMostKept) + " are accepted: keep only those that are touched.");
  }
}

void CondensedRegion::assemble(Isa isa) {
  SparsityBuilder builder(static_cast<std::int32_t>(rest_.size() / 3));
  elastic_.couple(builder);
  pattern_ = builder.build();
  elastic_.bind(pattern_);
  Scratch scratch;
  State rest;
  rest.positions = rest_;
  for (auto* matrix : {&K_, &Kii_}) {
    *matrix = std::make_unique<BlockMatrix>(pattern_, isa, Threads(1));
    (*matrix)->clear();
    elastic_.add_stiffness(rest, scratch, {-1.0, 0.0}, **matrix);
  }
  given_.assign(rest_.size() / 3, FixedDofs::kAllAxes);
  for (const std::int32_t node : inner_) given_[static_cast<std::size_t>(node)] = 0;
  std::vector<std::int32_t> rows;
  for (std::int32_t i = 0; i < K_->rows(); ++i) {
    if (given_[static_cast<std::size_t>(i)] != 0) rows.push_back(i);
  }
  Kii_->constrain(rows, given_);
}

void CondensedRegion::solve_inner(Reals b, Reals x) const {
  for (std::size_t i = 0; i < given_.size(); ++i) {
    if (given_[i] != 0) block(b, static_cast<std::int32_t>(i)).setZero();
  }
  std::ranges::fill(x, 0.0);
  if (inner_.empty()) return;
  const SolveReport report = factor_.solve(*Kii_, b, x, 0.0);
  if (report.positive_definite) return;
  throw ParameterError(
      "body \"" + elastic_.block().body +
      "\": the model condensed has inner nodes that its kept nodes do not hold; keep more of "
      "them, or the whole surface.");
}

void CondensedRegion::condense() {
  const std::size_t size = rest_.size();
  const auto n = static_cast<Eigen::Index>(3 * kept_.size());
  S_.resize(n, n);
  std::vector<double> unit(size, 0.0);
  std::vector<double> column(size);
  std::vector<double> inner(size);
  std::vector<double> through(size);
  for (Eigen::Index j = 0; j < n; ++j) {
    const std::int32_t node = kept_[static_cast<std::size_t>(j / 3)];
    block(Reals(unit), node)[j % 3] = 1.0;
    K_->multiply(unit, column);
    block(Reals(unit), node)[j % 3] = 0.0;
    std::vector<double>& b = through;
    b = column;
    solve_inner(b, inner);  // K_ii^-1 K_ij
    K_->multiply(inner, through);
    for (std::size_t k = 0; k < kept_.size(); ++k) {
      const Vec3 entry = block(ConstReals(column), kept_[k]) - block(ConstReals(through), kept_[k]);
      S_.block<3, 1>(static_cast<Eigen::Index>(3 * k), j) = entry;
    }
  }
  S_ = (0.5 * (S_ + S_.transpose())).eval();  // equal to round-off: every user may rely on it
}

/// Inertia in proportion to the kept nodes' own, so that none is negative; gravity as it is felt through the
/// region, weight_k - K_ki K_ii^-1 weight_i, less what it does to the masses that the kept nodes have.
void CondensedRegion::share_masses() {
  std::vector<double> own(rest_.size() / 3, 0.0);
  std::vector<double> pulled(rest_.size() / 3, 0.0);
  elastic_.add_masses(own);
  elastic_.add_weights(pulled);
  double total = 0.0;
  double kept = 0.0;
  for (const double m : own) total += m;
  for (const std::int32_t k : kept_) kept += own[static_cast<std::size_t>(k)];
  for (const std::int32_t k : kept_) masses_.push_back(own[static_cast<std::size_t>(k)] * total / kept);

  const Vec3 g = std::get<CondensedOptions>(elastic_.block().model).gravity;
  weight_.assign(rest_.size(), 0.0);
  for (const std::int32_t i : inner_) block(Reals(weight_), i) = pulled[static_cast<std::size_t>(i)] * g;
  std::vector<double> b = weight_;
  std::vector<double> x(rest_.size());
  solve_inner(b, x);
  for (const std::int32_t i : inner_) {
    sag_ += block(ConstReals(weight_), i).dot(block(ConstReals(x), i));
    pull_at_rest_ += block(ConstReals(weight_), i).dot(block(ConstReals(rest_), i));
  }
  K_->multiply(x, b);
  pull_.resize(static_cast<Eigen::Index>(3 * kept_.size()));
  for (std::size_t k = 0; k < kept_.size(); ++k) {
    const double less = pulled[static_cast<std::size_t>(kept_[k])] - masses_[k];
    pull_.segment<3>(static_cast<Eigen::Index>(3 * k)) = less * g - block(ConstReals(b), kept_[k]);
    pull_at_rest_ += less * g.dot(block(ConstReals(rest_), kept_[k]));
  }
}

void CondensedRegion::settle(State& state) const {
  const std::scoped_lock lock(looking_);
  const std::size_t size = rest_.size();
  room_.assign(3 * size, 0.0);
  const Reals of_kept = Reals(room_).first(size);
  const Reals b = Reals(room_).subspan(size, size);
  const Reals x = Reals(room_).last(size);
  for (const std::int32_t k : kept_) {
    block(of_kept, k) = block(ConstReals(state.positions), k) - block(ConstReals(rest_), k);
  }
  K_->multiply(of_kept, b);
  for (std::size_t i = 0; i < size; ++i) b[i] = state.load_factor * weight_[i] - b[i];
  solve_inner(b, x);
  for (const std::int32_t i : inner_) {
    block(Reals(state.positions), i) = block(ConstReals(rest_), i) + block(ConstReals(x), i);
  }
  for (const std::int32_t k : kept_) block(of_kept, k) = block(ConstReals(state.velocities), k);
  K_->multiply(of_kept, b);
  for (double& value : b) value = -value;
  solve_inner(b, x);
  for (const std::int32_t i : inner_) block(Reals(state.velocities), i) = block(ConstReals(x), i);
}

}  // namespace tissu
