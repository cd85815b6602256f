#include <gtest/gtest.h>

#include <cstring>
#include <string_view>

#include "../world/sample_worlds.h"

/// The same bits for any number of threads, on a mesh of many chunks, pieces and colours.
namespace tissu {
namespace {

// A factor is a hundred times slower where every access is recorded; which threads meet stays the same.
#if defined(__SANITIZE_THREAD__)
constexpr int kHexahedra = 9;
constexpr int kSteps = 3;
#else
constexpr int kHexahedra = 15;
constexpr int kSteps = 8;
#endif

struct ThreadsCase {
  const char* name;
  Split split;
  bool direct;
  int newton;
  bool viscous = false;  ///< every viscosity there is
  const char* model = "fem";
};

void PrintTo(const ThreadsCase& c, std::ostream* out) { *out << c.name; }

class SameBits : public testing::TestWithParam<ThreadsCase> {
 protected:
  static WorldDescription world(int threads) {
    const Split split = GetParam().split;
    // 3456 tetrahedra or 3375 hexahedra
    const int n = split == Split::none ? kHexahedra : 8;
    const Mesh mesh = box_mesh(Vec3::Zero(), Vec3(2, 1, 1), {split == Split::none ? n : 9, n, n}, split);
    WorldDescription world;
    world.bodies = {test::body_of(mesh, {.young = 100.0})};
    for (ElasticBlock& block : world.bodies[0].elastic) block.model = options_named(GetParam().model);
    world.bodies[0].frames = std::string_view(GetParam().model) == "frames";
    world.bodies[0].rayleigh = {0.1, 0.001};
    if (GetParam().viscous) {
      world.bodies[0].viscosity = {0.1, 0.2, 0.3, {{0.5, 0.1}, {0.2, 1.0}}};
    }
    world.gravity = Vec3(0.0, 0.0, -9.81);
    world.fixed = {test::fixed(test::nodes_at(mesh, 0, 0.0))};
    world.threads = threads;
    return world;
  }
  static State after_some_steps(int threads) {
    auto solver = GetParam().direct ? std::make_unique<Cholesky>() : test::conjugate_gradient(1e-6);
    Simulation simulation =
        test::simulate(world(threads), test::implicit_euler(GetParam().newton, 1e-6), std::move(solver));
    EXPECT_EQ(simulation.world().threads().count(), threads);
    for (int i = 0; i < kSteps; ++i) simulation.step(0.01);
    return simulation.state();
  }
};

bool same_bits(const std::vector<double>& a, const std::vector<double>& b) {
  if (a.size() != b.size()) return false;
  return a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0;
}

TEST_P(SameBits, OnOneToFourThreads) {
  const State one = after_some_steps(1);
  for (const int threads : {2, 3, 4}) {
    const State several = after_some_steps(threads);
    EXPECT_TRUE(same_bits(one.positions, several.positions)) << threads << " threads";
    EXPECT_TRUE(same_bits(one.velocities, several.velocities)) << threads << " threads";
    EXPECT_TRUE(one.memory == several.memory) << threads << " threads";
    ASSERT_EQ(one.rotations.size(), several.rotations.size());
    for (std::size_t i = 0; i < one.rotations.size(); ++i) {
      EXPECT_EQ(one.rotations[i].coeffs(), several.rotations[i].coeffs())
          << i << ", " << threads << " threads";
    }
  }
}

TEST_P(SameBits, OnASecondRun) {
  const State first = after_some_steps(2);
  EXPECT_TRUE(same_bits(first.positions, after_some_steps(2).positions));
}

INSTANTIATE_TEST_SUITE_P(
    Worlds, SameBits,
    testing::Values(ThreadsCase{"tetra_conjugate_gradient", Split::six, false, 1},
                    ThreadsCase{"tetra_cholesky", Split::six, true, 1},
                    ThreadsCase{"tetra_newton", Split::six, false, 3},
                    ThreadsCase{"hexahedron_conjugate_gradient", Split::none, false, 1},
                    ThreadsCase{"tetra_viscous", Split::six, false, 2, true},
                    ThreadsCase{"tetra_mean_dilatation", Split::six, false, 2, false, "mean-dilatation"},
                    ThreadsCase{"hexahedron_mean_dilatation", Split::none, true, 1, false, "mean-dilatation"},
                    ThreadsCase{"tetra_frames", Split::six, false, 1, false, "frames"}),
    testing::PrintToStringParamName());

}  // namespace
}  // namespace tissu
