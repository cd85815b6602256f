/// Vertices that frames carry with their rotations.

#include <gtest/gtest.h>

#include <cmath>

#include "tissu/contact/candidates.h"
#include "tissu/contact/contact.h"

namespace tissu {
namespace {

constexpr double kStep = 1e-6;        ///< of central differences, …
constexpr double kDifference = 1e-9;  ///< … whose error is its square, and round-off over it
constexpr double kRoundOff = 1e-14;

/// A triangle carried by two frames, of which one is a frame of a second body that has a triangle, too.
struct TwoFrames {
  std::vector<Frame> frames = {{.block = 0, .rotation = 2, .mass = 1.0, .inertia = Mat3::Identity()},
                               {.block = 1, .rotation = 3, .mass = 1.0, .inertia = Mat3::Identity()}};
  std::vector<double> rest = {0.0, 0.0, 0.0, 1.0, 0.2, -0.1, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0};
  std::vector<double> weights = {0.3, 0.7, 0.6, 0.4, -0.2, 1.2};
  std::vector<Vec3> places = {{0.5, 0.3, 0.0}, {0.2, -0.3, 0.4}, {1.3, 0.0, 0.1}};
  ContactDescription description;

  TwoFrames() {
    SurfaceDescription surface{.name = "body"};
    surface.triangles = {{-3, -2, -1}};
    SurfaceRiders& riders = surface.riders;
    riders.vertex = {-3, -2, -1};
    for (std::size_t v = 0; v < 3; ++v) {
      for (std::int32_t node = 0; node < 2; ++node) {
        riders.node.push_back(node);
        riders.weight.push_back(weights[2 * v + static_cast<std::size_t>(node)]);
        const Vec3 arm = places[v] - block(ConstReals(rest), node);
        riders.arm.insert(riders.arm.end(), arm.begin(), arm.end());
      }
      riders.begin.push_back(static_cast<std::int32_t>(riders.node.size()));
    }
    description.bodies = {surface};
    description.pairs = {{.a = 0, .b = 0, .gap = 0.01}};
  }
  [[nodiscard]] Contact contact() const {
    const std::vector<std::int32_t> first(description.bodies.size(), 0);
    return {description, first, rest, frames};
  }
  [[nodiscard]] State turned() const {
    State state;
    state.positions = rest;
    state.positions[1] = 0.2;
    state.positions[5] = 0.7;
    state.velocities.assign(rest.size(), 0.0);
    state.rotations = {turn_by(Vec3(0.4, -0.9, 1.2)), turn_by(Vec3(-1.5, 0.2, 0.3))};
    return state;
  }
};

ContactNumbers any_contact() {
  ContactNumbers c;
  c.vertex = {0.0, 1.0, 2.0, -1.0};
  c.beta = {1.0, -0.3, -0.7, 0.0};
  c.normal = {0.0, 0.6, 0.8};
  return c;
}

TEST(TurningRidersTest, AVertexAtRestIsWhereItsFramesHaveIt) {
  const TwoFrames two;
  const Contact contact = two.contact();
  State state = two.turned();
  for (std::int32_t v = 0; v < 3; ++v) {
    EXPECT_NEAR(
        (Vec3(block(ConstReals(contact.surfaces().rest()), v)) - two.places[static_cast<std::size_t>(v)])
            .norm(),
        0.0, kRoundOff);
  }
  // A rigid motion of both frames moves the vertices rigidly.
  const Quaternion turn = turn_by(Vec3(0.3, 0.8, -0.4));
  const Vec3 way(1.0, 2.0, 3.0);
  for (std::int32_t k = 0; k < 2; ++k) {
    block(Reals(state.positions), k) = Vec3(turn * Vec3(block(ConstReals(two.rest), k)) + way);
    state.rotations[static_cast<std::size_t>(k)] = turn;
  }
  for (std::int32_t v = 0; v < 3; ++v) {
    const Vec3 wanted = turn * two.places[static_cast<std::size_t>(v)] + way;
    EXPECT_NEAR((contact.place(v, state) - wanted).norm(), 0.0, 10.0 * kRoundOff);
  }
}

TEST(TurningRidersTest, TheMotionOfAContactIsTheDerivativeOfItsReach) {
  const TwoFrames two;
  const Contact contact = two.contact();
  const State state = two.turned();
  const ContactNumbers c = any_contact();
  for (std::size_t i = 0; i < two.rest.size(); ++i) {
    std::vector<double> p(two.rest.size(), 0.0);
    p[i] = 1.0;
    const auto reach = [&](double h) {
      State to = state;
      move(state, two.frames, p, h, to);
      return contact.reach(c, to);
    };
    const Vec3 slope = (reach(kStep) - reach(-kStep)) / (2.0 * kStep);
    EXPECT_NEAR((contact.motion(c, state, p) - slope).norm(), 0.0, kDifference) << i;
  }
}

TEST(TurningRidersTest, ForcesAndMomentsOnFramesAreThoseOnTheVertices) {
  const TwoFrames two;
  const Contact contact = two.contact();
  const State state = two.turned();
  const ContactNumbers c = any_contact();
  const Vec3 force(0.3, -2.0, 1.1);
  Vec3 sum = Vec3::Zero();
  Vec3 moment = Vec3::Zero();
  int parts = 0;
  contact.for_parts(c, state, [&](const CarriedPart& part) {
    ++parts;
    if (part.turns) {
      moment += part.load(force);
    } else {
      sum += part.load(force);
      moment += Vec3(block(ConstReals(state.positions), part.row)).cross(part.load(force));
    }
  });
  EXPECT_EQ(parts, 4);  // of two frames the place and the rotation, each once
  Vec3 wanted = Vec3::Zero();
  for (std::int32_t v = 0; v < 3; ++v) {
    wanted += c.beta[static_cast<std::size_t>(v)] * contact.place(v, state).cross(force);
  }
  EXPECT_NEAR(sum.norm(), 0.0, 10.0 * kRoundOff);  // its weights sum to zero
  EXPECT_NEAR((moment - wanted).norm(), 0.0, 10.0 * kRoundOff);
}

/// The second body is a vertex, which is one of the frames.
TEST(TurningRidersTest, SurfacesThatOneRowCarriesNeverMeet) {
  TwoFrames two;
  const auto pairs = [&](std::int32_t node) {
    ContactDescription description = two.description;
    description.bodies.push_back({.name = "other", .points = {node}});
    description.pairs = {{.a = 0, .b = 1, .gap = 10.0}};
    const std::vector<std::int32_t> first(2, 0);
    const SurfaceSet set(description, first, two.rest, two.frames);
    Candidates candidates(description, set);
    std::vector<double> places = set.rest();
    places.resize(3 * set.mover_count());
    candidates.cover(places, places);
    return candidates.list().size();
  };
  EXPECT_EQ(pairs(1), 0U);
  EXPECT_GT(pairs(2), 0U);
}

}  // namespace
}  // namespace tissu
