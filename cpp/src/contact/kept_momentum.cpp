/// What rigid bodies lose whose ways are cut. Where they stop each other they lose no momentum together: as
/// in an impact without a bounce, what is left of their ways beside each other goes on with their mean
/// velocity. Nodes of soft bodies would get back what their cells cannot bear, which were not solved.

#include <limits>

#include "hold_back.h"
#include "tissu/contact/contact_run.h"

namespace tissu {

/// f(island, row, rigid) of rows whose ways pairs of free rows cut.
template <class Function>
void ContactRun::for_held_rows(Function&& f) const {
  const SurfaceSet& surfaces = contact_.surfaces();
  const auto tell = [&](std::size_t mover, std::int32_t row, bool rigid) {
    const auto number = static_cast<std::int32_t>(mover);
    if (held_->share(number) == 1.0 || held_->is_stopped_by_given(number)) return;
    f(held_->island(number), row, rigid);
  };
  const auto& vertices = surfaces.vertices();
  for (std::size_t v = 0; v < vertices.size(); ++v) {
    if (vertices[v].row >= 0 && given_[v] == 0) tell(v, vertices[v].row, false);
  }
  const auto& inner = surfaces.inner_rows();
  for (std::size_t i = 0; i < inner.size(); ++i) {
    if (given_[vertices.size() + i] == 0) tell(vertices.size() + i, inner[i].row, false);
  }
  for (const auto& surface : surfaces.surfaces()) {
    if (surface.carrier < 0) continue;
    tell(static_cast<std::size_t>(surface.first_vertex),
         surfaces.carriers()[static_cast<std::size_t>(surface.carrier)].row, true);
  }
}

void ContactRun::keep_momentum(const Mass& mass, const FixedDofs& fixed, ConstReals before, Reals v) {
  lost_.assign(4 * contact_.surfaces().mover_count(), 0.0);
  const auto of = [&](std::int32_t island) {
    return lost_.begin() + 4 * static_cast<std::ptrdiff_t>(island);
  };
  for_held_rows([&](std::int32_t island, std::int32_t row, bool rigid) {
    const auto at = static_cast<std::size_t>(row);
    const double m = mass.nodal()[at];
    const Vec3 lost = m * (block(before, row) - block(ConstReals(v), row));
    const auto sum = of(island);
    sum[0] += rigid && fixed.masks()[at] == 0 ? m : std::numeric_limits<double>::infinity();
    for (int k = 0; k < 3; ++k) sum[1 + k] += lost[k];
  });
  for_held_rows([&](std::int32_t island, std::int32_t row, bool /*rigid*/) {
    const auto sum = of(island);
    if (sum[0] > 0.0) block(v, row) += Vec3(sum[1], sum[2], sum[3]) / sum[0];
  });
}

}  // namespace tissu
