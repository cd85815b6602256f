/// What rows lose whose ways are cut. Where they stop each other they lose no momentum together: as in an
/// impact without a bounce, they go on with their mean velocity.

#include <algorithm>
#include <cmath>
#include <limits>

#include "hold_back.h"
#include "tissu/contact/candidates.h"
#include "tissu/contact/contact_run.h"

namespace tissu {

namespace {

constexpr double kTogether = 2.0;  ///< times what a row goes beside its island

}  // namespace

/// A row whose way pairs of free rows cut.
struct ContactRun::HeldRow {
  std::int32_t island;
  std::int32_t mover;
  std::int32_t row;
  bool rigid;
};

template <class Function>
void ContactRun::for_held_rows(Function&& f) const {
  const SurfaceSet& surfaces = contact_.surfaces();
  const auto give = [&](std::size_t mover, std::int32_t row, bool rigid) {
    const auto number = static_cast<std::int32_t>(mover);
    if (held_->share(number) == 1.0 || held_->is_stopped_by_given(number)) return;
    f(HeldRow{held_->island(number), number, row, rigid});
  };
  const auto& vertices = surfaces.vertices();
  for (std::size_t v = 0; v < vertices.size(); ++v) {
    if (vertices[v].row >= 0 && given_[v] == 0) give(v, vertices[v].row, false);
  }
  const auto& inner = surfaces.inner_rows();
  for (std::size_t i = 0; i < inner.size(); ++i) {
    if (given_[vertices.size() + i] == 0) give(vertices.size() + i, inner[i].row, false);
  }
  for (const auto& surface : surfaces.surfaces()) {
    if (surface.carrier < 0) continue;
    const auto at = static_cast<std::size_t>(surface.carrier);
    give(static_cast<std::size_t>(surface.first_vertex), surfaces.carriers()[at].row, true);
  }
}

/// A way w of share s becomes c + s (w - c), c the mean of its island by mass, where c is more than twice as
/// long as any w - c: nodes that stand still would be taken along faster than their cells bear. The ways to
/// there are others than those whose shares were found, and are tested as they are.
void ContactRun::go_on_together(const Mass& mass, const FixedDofs& fixed, ConstReals whole, State& to) {
  if (held_->stopped().empty()) return;
  const auto way_from = [&](const HeldRow& held) {
    Vec3 from = block(ConstReals(from_), held.mover);
    if (!held.rigid) return from;
    return Vec3(block(ConstReals(start_->positions), held.row) + from -
                block(ConstReals(begin_), held.mover));
  };
  lost_.assign(5 * contact_.surfaces().mover_count(), 0.0);
  const auto of = [&](std::int32_t island) {
    return lost_.begin() + 5 * static_cast<std::ptrdiff_t>(island);
  };
  const auto mean_of = [&](std::int32_t island) {
    const auto sum = of(island);
    const bool moves = sum[0] > 0.0 && std::isfinite(sum[0]);
    return moves ? Vec3(Vec3(sum[1], sum[2], sum[3]) / sum[0]) : Vec3(Vec3::Zero());
  };
  for_held_rows([&](const HeldRow& held) {
    const auto at = static_cast<std::size_t>(held.row);
    const double m = mass.nodal()[at];
    const Vec3 way = m * (block(whole, held.row) - way_from(held));
    const auto sum = of(held.island);
    sum[0] += fixed.masks()[at] == 0 ? m : std::numeric_limits<double>::infinity();
    for (int k = 0; k < 3; ++k) sum[1 + k] += way[k];
  });
  for_held_rows([&](const HeldRow& held) {
    const Vec3 beside = block(whole, held.row) - way_from(held) - mean_of(held.island);
    double& most = of(held.island)[4];
    most = std::max(most, beside.norm());
  });
  placed_ = to.positions;
  bool goes = false;
  for_held_rows([&](const HeldRow& held) {
    const Vec3 mean = mean_of(held.island);
    if (!(mean.norm() > kTogether * of(held.island)[4])) return;
    goes = true;
    block(Reals(to.positions), held.row) += (1.0 - held_->share(held.mover)) * mean;
  });
  if (!goes) return;
  const std::vector<Candidate> stopped = held_->stopped_pairs(*candidates_);
  gather(to, now_);
  measure_ways(to);
  candidates_->cover(from_, now_, leaves_);
  if (!held_->is_free(*candidates_, planes_, from_, now_, bends_, sways_)) {
    to.positions = placed_;
    now_ = goal_;
    measure_ways(to);
    candidates_->cover(from_, now_, leaves_);
  }
  held_->stop_again(*candidates_, stopped);
}

void ContactRun::keep_momentum(const Mass& mass, const FixedDofs& fixed, ConstReals before, Reals v) {
  lost_.assign(4 * contact_.surfaces().mover_count(), 0.0);
  const auto of = [&](std::int32_t island) {
    return lost_.begin() + 4 * static_cast<std::ptrdiff_t>(island);
  };
  // Nodes of soft bodies would get back what their cells cannot bear, which were not solved.
  for_held_rows([&](const HeldRow& held) {
    const auto at = static_cast<std::size_t>(held.row);
    const double m = mass.nodal()[at];
    const Vec3 lost = m * (block(before, held.row) - block(ConstReals(v), held.row));
    const auto sum = of(held.island);
    sum[0] += held.rigid && fixed.masks()[at] == 0 ? m : std::numeric_limits<double>::infinity();
    for (int k = 0; k < 3; ++k) sum[1 + k] += lost[k];
  });
  for_held_rows([&](const HeldRow& held) {
    const auto sum = of(held.island);
    if (sum[0] > 0.0) block(v, held.row) += Vec3(sum[1], sum[2], sum[3]) / sum[0];
  });
}

}  // namespace tissu
