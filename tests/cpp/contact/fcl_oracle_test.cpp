/// Distances and crossings of two meshes against the Flexible Collision Library: another program's answers,
/// by other formulas. Its trees are built anew for each question, of boxes along the axes.

#include <fcl/geometry/bvh/BVH_model.h>
#include <fcl/narrowphase/collision.h>
#include <fcl/narrowphase/distance.h>
#include <gtest/gtest.h>

#include <set>

#include "contact/narrow.h"
#include "contact/nearest_pair.h"
#include "tissu/base/index.h"
#include "tissu/contact/audit.h"
#include "triangle_meshes.h"

namespace tissu {
namespace {

using test::TriangleMesh;
using test::TwoMeshes;

/// Of a distance, in sizes of the meshes: both programs take differences of coordinates of that size, and
/// FCL's least squares lose some digits more than ours.
constexpr double kRoundOff = 1e-12;

using Model = fcl::BVHModel<fcl::AABB<double>>;

std::shared_ptr<Model> model_of(const TriangleMesh& mesh) {
  std::vector<fcl::Triangle> triangles;
  for (const auto& [a, b, c] : mesh.triangles) triangles.emplace_back(at(a), at(b), at(c));
  auto model = std::make_shared<Model>();
  model->beginModel();
  model->addSubModel(mesh.points, triangles);
  model->endModel();
  return model;
}

fcl::CollisionObject<double> object_of(const TriangleMesh& mesh) {
  return fcl::CollisionObject<double>(model_of(mesh));
}

double distance_by_fcl(const TriangleMesh& first, const TriangleMesh& second) {
  const auto one = object_of(first);
  const auto other = object_of(second);
  fcl::DistanceResult<double> result;
  return fcl::distance(&one, &other, fcl::DistanceRequest<double>(), result);
}

using TrianglePairs = std::set<std::pair<std::int32_t, std::int32_t>>;

TrianglePairs crossings_by_fcl(const TriangleMesh& first, const TriangleMesh& second) {
  const auto one = object_of(first);
  const auto other = object_of(second);
  fcl::CollisionRequest<double> request;
  request.num_max_contacts = 1'000'000;
  fcl::CollisionResult<double> result;
  fcl::collide(&one, &other, request, result);
  TrianglePairs pairs;
  for (std::size_t i = 0; i < result.numContacts(); ++i) {
    pairs.emplace(static_cast<std::int32_t>(result.getContact(i).b1),
                  static_cast<std::int32_t>(result.getContact(i).b2));
  }
  return pairs;
}

/// The triangles of a mesh that have these nodes.
std::vector<std::int32_t> triangles_with(const TriangleMesh& mesh, std::span<const std::int32_t> nodes) {
  std::vector<std::int32_t> found;
  for (std::int32_t t = 0; t < std::ssize(mesh.triangles); ++t) {
    const auto has = [&](std::int32_t node) {
      return std::ranges::find(mesh.triangles[at(t)], node) != mesh.triangles[at(t)].end();
    };
    if (std::ranges::all_of(nodes, has)) found.push_back(t);
  }
  return found;
}

/// Two triangles cross where an edge of one goes through the other.
TrianglePairs crossings_by_audit(const TriangleMesh& first, const TriangleMesh& second) {
  const TwoMeshes two(first, second, 0.01);
  const Contact contact(two.description, two.first_row, two.state.positions);
  TrianglePairs pairs;
  for (const Crossing& crossing : crossings(contact, two.state)) {
    const bool turned = crossing.surface == 1;
    for (const std::int32_t s : triangles_with(turned ? second : first, crossing.edge)) {
      for (const std::int32_t t : triangles_with(turned ? first : second, crossing.triangle)) {
        pairs.insert(turned ? std::pair(t, s) : std::pair(s, t));
      }
    }
  }
  return pairs;
}

/// The nearest of all pairs of features that the candidates of this gap hold; and of those among them that
/// the narrow phase takes for contacts.
struct Nearest {
  double of_all = std::numeric_limits<double>::infinity();
  double of_contacts = std::numeric_limits<double>::infinity();
};

Nearest nearest(const TriangleMesh& first, const TriangleMesh& second, double gap) {
  const TwoMeshes two(first, second, gap);
  const SurfaceSet surfaces(two.description, two.first_row, two.state.positions);
  Candidates candidates(two.description, surfaces);
  const ConstReals places(two.state.positions);
  candidates.cover(places, places);
  Nearest nearest;
  Found found{};
  for (const Candidate& candidate : candidates.list()) {
    std::array<Vec3, 4> p{};
    for (int k = 0; k < vertices_of(candidate.kind); ++k) {
      p[static_cast<std::size_t>(k)] = block(places, candidate.vertex[static_cast<std::size_t>(k)]);
    }
    nearest.of_all = std::min(nearest.of_all, std::sqrt(nearest_of(candidate.kind, p).square));
    if (find_contact(surfaces, places, candidate, 2.0 * gap, found)) {
      nearest.of_contacts = std::min(nearest.of_contacts, found.distance);
    }
  }
  return nearest;
}

/// Distances, where the two do not cross: at a gap that reaches as far, and at one that does not.
void expect_same_distance(const TriangleMesh& first, const TriangleMesh& second, double distance) {
  const double error = kRoundOff * (first.radius() + second.radius());
  const Nearest reached = nearest(first, second, 0.5 * distance * (1.0 + 1e-6));
  EXPECT_NEAR(reached.of_all, distance, error);
  EXPECT_NEAR(reached.of_contacts, distance, error);
  const Nearest short_of = nearest(first, second, 0.5 * distance * (1.0 - 1e-6));
  EXPECT_EQ(short_of.of_contacts, std::numeric_limits<double>::infinity());
}

struct Answers {
  int apart = 0;
  int crossing = 0;
  std::size_t pairs = 0;
};

void compare(const TriangleMesh& first, const TriangleMesh& second, Answers& answers) {
  const TrianglePairs pairs = crossings_by_fcl(first, second);
  EXPECT_EQ(crossings_by_audit(first, second), pairs);
  answers.pairs += pairs.size();
  ++(pairs.empty() ? answers.apart : answers.crossing);
  if (pairs.empty()) expect_same_distance(first, second, distance_by_fcl(first, second));
}

TEST(FclOracle, RandomMeshesAreAsFarAndCrossAsOften) {
  Answers answers;
  for (unsigned number = 0; number < 200; ++number) {
    test::Random random(number);
    const auto mesh = [&](bool closed) {
      return closed ? test::bumpy_ball(3, random) : test::crumpled_sheet(12, random);
    };
    const TriangleMesh first = mesh(number % 2 == 0);
    const TriangleMesh second = mesh(number % 3 == 0).placed(random.rotation(), 1.5 * random.vector());
    compare(first, second, answers);
    if (testing::Test::HasFailure()) FAIL() << number;
  }
  EXPECT_GT(answers.apart, 50);
  EXPECT_GT(answers.crossing, 50);
  EXPECT_GT(answers.pairs, 1000U);
}

// One comes down onto the other, until it is in it by half its height.
TEST(FclOracle, OrgansAreAsFarAndCrossAsOften) {
  const TriangleMesh organ = test::organ();
  Answers answers;
  test::Random random(1);
  for (int i = 0; i < 12; ++i) {
    const Vec3 by(0.01 * random.number(), 0.01 * random.number(), 0.18 - 0.01 * i);
    compare(organ, organ.placed(random.rotation(), by), answers);
    if (testing::Test::HasFailure()) FAIL() << i;
  }
  EXPECT_GT(answers.apart, 2);
  EXPECT_GT(answers.crossing, 2);
  EXPECT_GT(answers.pairs, 100U);
}

}  // namespace
}  // namespace tissu
