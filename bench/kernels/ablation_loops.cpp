#include "cell/kernels/packed.h"
#include "loops.h"
#include "tissu/law/generated/stvk.h"

namespace tissu::TISSU_KERNELS {
namespace {

using bench::AblationBlock;
using Tensor = Tensor2<Batch>;
using Nodal = Batch[4][3];

constexpr unsigned kStream = 1;
constexpr unsigned kGather = 2;
constexpr unsigned kArithmetic = 4;
constexpr unsigned kScatter = 8;

/// f_a = -V P grad_a, with the differences of a linear tetrahedron in place of its shape functions.
TISSU_INLINE void force_of(const StVK<Batch>& law, const Nodal& x, const Tensor& Jinv, Batch volume,
                           Nodal& f) {
  Tensor G;
  TISSU_UNROLL
  for (int i = 0; i < 3; ++i) {
    TISSU_UNROLL
    for (int k = 0; k < 3; ++k) G(i, k) = x[k + 1][i] - x[0][i];
  }
  const Tensor H = product_transposed(law.stress(product(G, Jinv)), Jinv);
  TISSU_UNROLL
  for (int i = 0; i < 3; ++i) {
    TISSU_UNROLL
    for (int k = 0; k < 3; ++k) f[k + 1][i] = -(volume * H(i, k));
    f[0][i] = -(f[1][i] + f[2][i] + f[3][i]);
  }
}

/// One batch of one group. Without kStream the constants are those of group 0, which stay in the first level.
template <unsigned kParts>
TISSU_INLINE void lanes(const AblationBlock& block, const StVK<Batch>& law, std::size_t group, int lane,
                        const PackedNodes& x, PackedNodes& to, Batch (&sum)[3]) {
  const std::size_t read = (kParts & kStream) != 0 ? group : 0;
  const std::uint16_t* places = block.places + read * 4 * kLanes + lane;
  const double* rest = block.rest + read * 10 * kLanes + lane;
  Nodal u;
  Nodal f;
  Tensor Jinv;
  TISSU_UNROLL
  for (int k = 0; k < 9; ++k) Jinv.m[k / 3][k % 3] = Batch::load(rest + k * kLanes);
  const Batch volume = Batch::load(rest + 9 * kLanes);
  TISSU_UNROLL
  for (int a = 0; a < 4; ++a) {
    if constexpr ((kParts & kGather) != 0) {
      gather_packed(x.values, places + a * kLanes, u[a]);
    } else {
      TISSU_UNROLL
      for (int i = 0; i < 3; ++i) u[a][i] = Batch::load(x.values + (3 * a + i) * kLanes);
    }
  }
  if constexpr ((kParts & kArithmetic) != 0) {
    force_of(law, u, Jinv, volume, f);
  } else {
    TISSU_UNROLL
    for (int a = 0; a < 4; ++a) {
      TISSU_UNROLL
      for (int i = 0; i < 3; ++i) f[a][i] = u[a][i] + Jinv(i, a % 3);
    }
    f[0][0] += volume;
  }
  TISSU_UNROLL
  for (int a = 0; a < 4; ++a) {
    if constexpr ((kParts & kScatter) != 0) {
      scatter_packed(to.values, places + a * kLanes, f[a]);
    } else {
      TISSU_UNROLL
      for (int i = 0; i < 3; ++i) sum[i] += f[a][i];
    }
  }
}

template <unsigned kParts>
void run(const AblationBlock& block, const double* x, double* f, double* sink) {
  const StVK<Batch> law{Batch(block.lambda), Batch(block.mu)};
  Batch sum[3] = {Batch(0.0), Batch(0.0), Batch(0.0)};
  PackedNodes positions;
  PackedNodes forces;
  for (std::size_t c = 0; c < block.chunk_count; ++c) {
    const Chunk& chunk = block.chunks[c];
    if ((kParts & kGather) != 0 || c == 0) positions.load(chunk, x);
    if constexpr ((kParts & kScatter) != 0) forces.clear(chunk);
    for (auto group = static_cast<std::size_t>(chunk.begin); group < static_cast<std::size_t>(chunk.end);
         ++group) {
      for (int lane = 0; lane < kLanes; lane += kWidth) {
        asm volatile("" ::: "memory");  // what is read again and again is not kept, nor what follows from it
        lanes<kParts>(block, law, group, lane, positions, forces, sum);
      }
    }
    if constexpr ((kParts & kScatter) != 0) forces.add_to(chunk, f);
  }
  (sum[0] + sum[1] + sum[2]).store(sink);
}

}  // namespace

bench::AblationKernels ablation_loops() {
  return {{{"arithmetic", &run<kArithmetic>},
           {"constants", &run<kStream>},
           {"constants, gather", &run<kStream | kGather>},
           {"constants, gather, arithmetic", &run<kStream | kGather | kArithmetic>},
           {"constants, gather, scatter", &run<kStream | kGather | kScatter>},
           {"constants, gather, arithmetic, scatter", &run<kStream | kGather | kArithmetic | kScatter>}}};
}

}  // namespace tissu::TISSU_KERNELS
