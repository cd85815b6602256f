#include "cell/kernels/point_laws.h"
#include "cell/kernels/shape.h"
#include "law/kernels/point.h"
#include "overstress.h"
#include "tissu/viscosity/prony_kernels.h"
#include "viscosity_lists.h"

namespace tissu::TISSU_KERNELS {
namespace {

using OverstressAtPoints = LawAtPoints<Overstress>;
constexpr LawKernels kOverstress = {Overstress<Batch>::kName,
                                    false,
                                    3,
                                    OverstressAtPoints::kConstants,
                                    nullptr,
                                    &OverstressAtPoints::stress,
                                    &OverstressAtPoints::stress_change,
                                    &OverstressAtPoints::tangent};

constexpr int kEntries = 6;  ///< of a symmetric tensor: xx yy zz yz xz xy
constexpr int kRow[kEntries] = {0, 1, 2, 1, 0, 0};
constexpr int kColumn[kEntries] = {0, 1, 2, 2, 2, 1};
using Strain = Batch[kEntries];

/// Where the numbers of a point begin in the memory, …
std::ptrdiff_t place_of(const PronyView& view, std::int32_t group, int point) {
  const std::ptrdiff_t at = static_cast<std::ptrdiff_t>(group) * view.points + point;
  return at * (1 + view.branches) * kEntries * kLanes;
}
/// … and those of a branch among them.
std::ptrdiff_t branch_place(int branch) {
  return static_cast<std::ptrdiff_t>(1 + branch) * kEntries * kLanes;
}
const double* lame_of(const PronyView& view, std::int32_t group) {
  return view.constants + group * view.constants_stride;
}

/// The law `Overstress` with what the memory of a point makes of its constants.
struct OverstressOfMemory {
  static bool isotropic(const ElasticView&) { return false; }  // what is remembered has axes of its own
  template <class Function>
  static void for_each(const ElasticView& base, std::int32_t group, int point, Function&& f) {
    const auto& view = static_cast<const PronyView&>(base);
    alignas(64) double constants[2 + kEntries][kLanes];
    const double* memory = view.memory + place_of(view, group, point);
    const double* lame = lame_of(view, group);
    double sum = 0.0;
    for (int k = 0; k < view.branches; ++k) sum += view.shares[k] * view.rise[k];
    for (int lane = 0; lane < kLanes; lane += kWidth) {
      const Batch lambda = Batch::load(lame + lane);
      const Batch mu = Batch::load(lame + kLanes + lane);
      Strain Z;  // sum_k g_k (a_k q_k0 - b_k E0)
      for (int s = 0; s < kEntries; ++s) {
        Z[s] = Batch(-sum) * Batch::load(memory + s * kLanes + lane);
        for (int k = 0; k < view.branches; ++k) {
          Z[s] += Batch(view.shares[k] * view.decay[k]) *
                  Batch::load(memory + branch_place(k) + s * kLanes + lane);
        }
      }
      const Batch spherical = lambda * (Z[0] + Z[1] + Z[2]);
      (lambda * Batch(sum)).store(constants[0] + lane);
      (mu * Batch(sum)).store(constants[1] + lane);
      for (int s = 0; s < kEntries; ++s) {
        const Batch H = Batch(2.0) * mu * Z[s] + (s < 3 ? spherical : Batch(0.0));
        H.store(constants[2 + s] + lane);
      }
    }
    f(kOverstress, constants[0]);
  }
};

constexpr PointLaws kAtPoint = LawsAtPoint<OverstressOfMemory, 3>::table();

template <int N>
struct Prony : Shape<N, 3> {
  using Base = Shape<N, 3>;
  using typename Base::Nodal;
  using typename Base::Point;

  /// E = (F^T F - I) / 2
  static void strain(const Point& F, int lane, Strain& E) {
    for (int s = 0; s < kEntries; ++s) {
      Batch sum(s < 3 ? -1.0 : 0.0);
      for (int i = 0; i < 3; ++i)
        sum += Batch::load(F[3 * i + kRow[s]] + lane) * Batch::load(F[3 * i + kColumn[s]] + lane);
      E[s] = Batch(0.5) * sum;
    }
  }
  /// q = a q0 + b (E - E0) of a branch
  static void elastic_strain(const PronyView& view, const double* memory, int branch, int lane,
                             const Strain& E, Strain& q) {
    const double* before = memory + branch_place(branch);
    for (int s = 0; s < kEntries; ++s) {
      q[s] = Batch(view.decay[branch]) * Batch::load(before + s * kLanes + lane) +
             Batch(view.rise[branch]) * (E[s] - Batch::load(memory + s * kLanes + lane));
    }
  }
  /// Calls f(group, point, F) for every point of a chunk.
  template <class Function>
  static void for_points(const PronyView& view, const Chunk& chunk, const double* x, Function&& f) {
    PackedNodes positions;
    alignas(64) Nodal position;
    alignas(64) Point F;
    positions.load(chunk, x);
    for (std::int32_t group = chunk.begin; group < chunk.end; ++group) {
      Base::gather_nodes(view, group, positions, position);
      for (int g = 0; g < view.points; ++g) {
        Base::gradient(Base::gradients_of(view, g), Base::rest_of(view, group, g), position, F);
        f(group, g, F);
      }
    }
  }

  /// sum_k g_k (lambda / 2 tr(q_k)^2 + mu tr(q_k^2))
  static void energy(const PronyView& view, const Chunk& chunk, const double* x, double* energies) {
    for_points(view, chunk, x, [&](std::int32_t group, int g, const Point& F) {
      const double* memory = view.memory + place_of(view, group, g);
      const double* lame = lame_of(view, group);
      const double* volume = Base::rest_of(view, group, g) + 9 * kLanes;
      for (int lane = 0; lane < kLanes; lane += kWidth) {
        Strain E;
        strain(F, lane, E);
        Batch W(0.0);
        for (int k = 0; k < view.branches; ++k) {
          Strain q;
          elastic_strain(view, memory, k, lane, E, q);
          const Batch trace = q[0] + q[1] + q[2];
          const Batch squares = q[0] * q[0] + q[1] * q[1] + q[2] * q[2] +
                                Batch(2.0) * (q[3] * q[3] + q[4] * q[4] + q[5] * q[5]);
          W += Batch(view.shares[k]) * (Batch(0.5) * Batch::load(lame + lane) * trace * trace +
                                        Batch::load(lame + kLanes + lane) * squares);
        }
        double* to = energies + static_cast<std::ptrdiff_t>(group) * kLanes + lane;
        (Batch::load(to) + Batch(view.weights[g]) * Batch::load(volume + lane) * W).store(to);
      }
    });
  }

  static void advance(const PronyView& view, const Chunk& chunk, const double* x, double* memory) {
    for_points(view, chunk, x, [&](std::int32_t group, int g, const Point& F) {
      const double* before = view.memory + place_of(view, group, g);
      double* after = memory + place_of(view, group, g);
      for (int lane = 0; lane < kLanes; lane += kWidth) {
        Strain E;
        strain(F, lane, E);
        for (int k = 0; k < view.branches; ++k) {
          Strain q;
          elastic_strain(view, before, k, lane, E, q);
          for (int s = 0; s < kEntries; ++s) q[s].store(after + branch_place(k) + s * kLanes + lane);
        }
        for (int s = 0; s < kEntries; ++s) E[s].store(after + s * kLanes + lane);
      }
    });
  }

  static constexpr PronyKernels table() { return {N, &kAtPoint, &energy, &advance}; }
};

constexpr PronyKernels kTables[] = {
    Prony<4>::table(), Prony<10>::table(), Prony<8>::table(), Prony<20>::table(), Prony<27>::table(),
    Prony<6>::table(), Prony<15>::table(), Prony<5>::table(), Prony<13>::table(),
};

}  // namespace

KernelList<PronyKernels> prony_kernels() { return {kTables, sizeof(kTables) / sizeof(kTables[0])}; }

}  // namespace tissu::TISSU_KERNELS
