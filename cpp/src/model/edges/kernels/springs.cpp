#include "cell/kernels/for_batches.h"
#include "cell/kernels/packed.h"
#include "edge_lists.h"
#include "tissu/model/edges/spring_kernels.h"

namespace tissu::TISSU_KERNELS {
namespace {

/// Share of l0 below which a spring has no direction: it pulls no more than from there.
constexpr double kShortest = 1e-12;

struct Ends {
  const std::uint16_t* a;
  const std::uint16_t* b;
};

/// What a lane of springs looks like now.
struct Pulled {
  Batch d[3];
  Batch inverse;  ///< 1 / l
};

TISSU_INLINE void between(const PackedNodes& nodes, const Ends& ends, Batch (&d)[3]) {
  Batch a[3];
  gather_packed(nodes.values, ends.a, a);
  gather_packed(nodes.values, ends.b, d);
  for (int i = 0; i < 3; ++i) d[i] -= a[i];
}
TISSU_INLINE Batch dot(const Batch (&a)[3], const Batch (&b)[3]) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
TISSU_INLINE Pulled pulled(const PackedNodes& positions, const Ends& ends, Batch l0) {
  Pulled now;
  between(positions, ends, now.d);
  const Batch least = Batch(kShortest * kShortest) * l0 * l0;
  now.inverse = Batch(1.0) / sqrt(least + positive(dot(now.d, now.d) - least));
  return now;
}
/// Adds t to a and takes it from b.
TISSU_INLINE void add_pair(PackedNodes& sums, const Ends& ends, const Batch (&t)[3]) {
  scatter_packed(sums.values, ends.a, t);
  const Batch back[3] = {-t[0], -t[1], -t[2]};
  scatter_packed(sums.values, ends.b, back);
}

/// Calls f(offset of the lanes in arrays [group][8], ends) for all lanes of a chunk.
template <class Function>
TISSU_INLINE void for_lanes(const SpringView& view, const Chunk& chunk, Function&& f) {
  for_batches(
      chunk, [&](std::int32_t group, int lane) __attribute__((always_inline)) {
        const std::ptrdiff_t first = static_cast<std::ptrdiff_t>(group) * kLanes;
        const std::uint16_t* places = view.places + 2 * first + lane;
        f(first + lane, Ends{places, places + kLanes});
      });
}

/// How a pair of nodes answers: B p = along d (d . p) + across p.
struct Answer {
  Batch along;
  Batch across;
};
/// Of a spring: k ((1 - l0 / l) I + (l0 / l^3) d d^T)
TISSU_INLINE Answer of_spring(const SpringView& view, std::ptrdiff_t at, const Pulled& now) {
  const Batch k = Batch::load(view.stiffness + at);
  const Batch share = Batch::load(view.length + at) * now.inverse;
  return {k * share * now.inverse * now.inverse, k * (Batch(1.0) - share)};
}
/// Of a spring, nearest to that and without negative eigenvalues: shorter than at rest, it has k along itself
/// and nothing across. (Shorter than kShortest it has less than k.)
TISSU_INLINE Answer of_definite_spring(const SpringView& view, std::ptrdiff_t at, const Pulled& now) {
  const Batch k = Batch::load(view.stiffness + at);
  const Batch share = Batch::load(view.length + at) * now.inverse;
  const Batch one(1.0);
  const Batch most{share.v > one.v ? one.v : share.v};
  return {k * most * now.inverse * now.inverse, k * positive(Batch(1.0) - share)};
}
/// Of a damper: c d d^T / l^2
TISSU_INLINE Answer of_damper(const SpringView& view, std::ptrdiff_t at, const Pulled& now) {
  return {Batch::load(view.damping + at) * now.inverse * now.inverse, Batch(0.0)};
}

template <Answer (*answer)(const SpringView&, std::ptrdiff_t, const Pulled&)>
void product(const SpringView& view, const Chunk& chunk, const double* x, double scale, const double* p,
             double* out) {
  PackedNodes positions;
  PackedNodes changes;
  PackedNodes sums;
  positions.load(chunk, x);
  changes.load(chunk, p);
  sums.clear(chunk);
  for_lanes(view, chunk, [&](std::ptrdiff_t at, const Ends& ends) {
    const Pulled now = pulled(positions, ends, Batch::load(view.length + at));
    const Answer B = answer(view, at, now);
    Batch dp[3];
    between(changes, ends, dp);
    const Batch along = Batch(scale) * B.along * dot(now.d, dp);
    const Batch across = Batch(scale) * B.across;
    const Batch t[3] = {along * now.d[0] + across * dp[0], along * now.d[1] + across * dp[1],
                        along * now.d[2] + across * dp[2]};
    add_pair(sums, ends, t);
  });
  sums.add_to(chunk, out);
}

template <Answer (*answer)(const SpringView&, std::ptrdiff_t, const Pulled&)>
void matrix(const SpringView& view, const Chunk& chunk, const double* x, double scale, double* blocks) {
  PackedNodes positions;
  positions.load(chunk, x);
  for_lanes(view, chunk, [&](std::ptrdiff_t at, const Ends& ends) {
    const Pulled now = pulled(positions, ends, Batch::load(view.length + at));
    const Answer B = answer(view, at, now);
    const Batch along = Batch(scale) * B.along;
    const Batch across = Batch(scale) * B.across;
    Batch coupling[9];
    Batch own[9];
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) {
        coupling[3 * i + j] = along * now.d[i] * now.d[j] + (i == j ? across : Batch(0.0));
        own[3 * i + j] = -coupling[3 * i + j];
      }
    }
    const std::ptrdiff_t group = at / kLanes;
    const std::int32_t* slots = view.slots + 4 * kLanes * group + at % kLanes;
    scatter_add_block(blocks, slots, own);
    scatter_add_block(blocks, slots + kLanes, coupling);
    scatter_add_block(blocks, slots + 2 * kLanes, coupling);
    scatter_add_block(blocks, slots + 3 * kLanes, own);
  });
}

void force(const SpringView& view, const Chunk& chunk, const double* x, double* f) {
  PackedNodes positions;
  PackedNodes sums;
  positions.load(chunk, x);
  sums.clear(chunk);
  for_lanes(view, chunk, [&](std::ptrdiff_t at, const Ends& ends) {
    const Batch l0 = Batch::load(view.length + at);
    const Pulled now = pulled(positions, ends, l0);
    const Batch s = Batch::load(view.stiffness + at) * (Batch(1.0) - l0 * now.inverse);
    const Batch t[3] = {s * now.d[0], s * now.d[1], s * now.d[2]};
    add_pair(sums, ends, t);
  });
  sums.add_to(chunk, f);
}

void energy(const SpringView& view, const Chunk& chunk, const double* x, double* energies) {
  PackedNodes positions;
  positions.load(chunk, x);
  for_lanes(view, chunk, [&](std::ptrdiff_t at, const Ends& ends) {
    Batch d[3];
    between(positions, ends, d);
    const Batch longer = sqrt(dot(d, d)) - Batch::load(view.length + at);
    (Batch::load(energies + at) + Batch(0.5) * Batch::load(view.stiffness + at) * longer * longer)
        .store(energies + at);
  });
}

constexpr SpringKernels kTable = {&force,
                                  &product<of_spring>,
                                  &matrix<of_spring>,
                                  &energy,
                                  &product<of_damper>,
                                  &matrix<of_damper>,
                                  &matrix<of_definite_spring>};

}  // namespace

const SpringKernels* spring_kernels() { return &kTable; }

}  // namespace tissu::TISSU_KERNELS
