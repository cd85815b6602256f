/// Random soups of 200 triangles, degenerate ones included: detection against testing every pair, and ways
/// against crossings that exact bisection finds. TISSU_SOUPS=0-10000 takes so many in each test.

#include <gtest/gtest.h>

#include <cmath>

#include "box_sets.h"
#include "contact/hold_back.h"
#include "contact/nearest_pair.h"
#include "soups.h"
#include "tissu/base/crossing.h"
#include "tissu/base/index.h"
#include "tissu/contact/audit.h"
#ifdef TISSU_FCL_ORACLE
#include "contact/fcl_broad_phase.h"
#endif

namespace tissu {
namespace {

using test::Soup;

constexpr unsigned kFew = 60;  ///< 6 s of one processor; 10,000 take 17 minutes

constexpr std::array<BroadPhaseKind, 4> kBroadPhases = {
    BroadPhaseKind::hierarchy, BroadPhaseKind::sweep_and_prune, BroadPhaseKind::grid, BroadPhaseKind::octree};

/// Numbers of `near` alone, of which the others have to be far.
template <class Far>
std::vector<Found> near_contacts(const Soup& soup, const SurfaceSet& surfaces, const Candidates& candidates,
                                 ConstReals places, Far&& is_far) {
  std::vector<Candidate> near;
  for (const std::int32_t i : candidates.near()) near.push_back(candidates.list()[at(i)]);
  return test::contacts_of(soup, surfaces, near, places, [&](std::size_t i, double reach) {
    return is_far(at(candidates.near()[i]), reach);
  });
}

TEST(SoupTest, EveryBroadPhaseGivesTheContactsOfTestingEveryPair) {
  std::array<int, 4> seen{};
  const test::SoupRange soups(kFew);
  for (unsigned number = soups.first; number < soups.end; ++number) {
    const Soup soup = test::soup(number);
    const SurfaceSet surfaces(soup.description, soup.first_row, soup.places[0]);
    ASSERT_EQ(surfaces.first_primitive().back(), 230);
    std::array<ContactDescription, kBroadPhases.size()> descriptions;
    std::vector<std::unique_ptr<Candidates>> all;
    for (std::size_t i = 0; i < kBroadPhases.size(); ++i) {
      descriptions[i] = soup.description;
      descriptions[i].broad_phase = kBroadPhases[i];
      for (const auto ways : {Candidates::Ways::apart, Candidates::Ways::together}) {
        all.push_back(std::make_unique<Candidates>(descriptions[i], surfaces, ways));
      }
    }
    for (std::size_t time = 0; time < soup.places.size(); ++time) {
      const std::vector<double>& from = soup.places[time == 0 ? 0 : time - 1];
      const std::vector<double>& to = soup.places[time];
      const std::vector<Found> expected =
          test::contacts_of(soup, surfaces, test::every_candidate(soup, surfaces, to, to), to,
                            [](std::size_t, double) { return false; });
      for (const Found& found : expected) ++seen[static_cast<std::size_t>(found.kind)];
      for (const std::unique_ptr<Candidates>& candidates : all) {
        candidates->cover(from, to);
        const std::vector<Found> found =
            near_contacts(soup, surfaces, *candidates, to,
                          [&](std::size_t i, double reach) { return candidates->is_far(i, reach); });
        ASSERT_TRUE(std::ranges::equal(found, expected, test::same))
            << candidates->broad_phase().name() << " finds " << found.size() << " contacts of "
            << expected.size() << " in soup " << number << " at " << time;
      }
    }
  }
  for (const int contacts : seen) EXPECT_GT(contacts, 100);
}

#ifdef TISSU_FCL_ORACLE
TEST(SoupTest, FclFindsTheBoxesThatTestingEveryPairFinds) {
  const test::SoupRange soups(kFew);
  for (unsigned number = soups.first; number < soups.end; ++number) {
    const Soup soup = test::soup(number);
    const SurfaceSet surfaces(soup.description, soup.first_row, soup.places[0]);
    const SearchPlan plan{surfaces.first_primitive(), {{0, 0}, {0, 1}, {1, 1}}};
    FclBroadPhase broad(plan);
    for (const std::vector<double>& places : soup.places) {
      std::vector<Box> boxes;
      for (const Primitive& primitive : surfaces.primitives()) {
        Box box = Box::none();
        for (int i = 0; i < primitive.corners; ++i) {
          box.add(Vec3(block(ConstReals(places), primitive.vertex[at(i)])));
        }
        boxes.push_back(box);
      }
      std::vector<BoxPair> pairs;
      broad.find(boxes, pairs);
      ASSERT_EQ(pairs, test::every_pair_tested(plan, boxes)) << number;
    }
  }
}
#endif

/// An edge and a triangle on their ways.
class Passing {
 public:
  Passing(const SurfaceSet& surfaces, std::int32_t edge, std::int32_t triangle, ConstReals from,
          ConstReals to)
      : surfaces_(surfaces), from_(from), to_(to) {
    const auto& [a, b] = surfaces.edges()[at(edge)].vertex;
    const auto& corners = surfaces.primitives()[at(triangle)].vertex;
    vertex_ = {a, b, corners[0], corners[1], corners[2]};
  }
  [[nodiscard]] bool share_a_vertex() const {
    return std::ranges::find(vertex_.begin() + 2, vertex_.end(), vertex_[0]) != vertex_.end() ||
           std::ranges::find(vertex_.begin() + 2, vertex_.end(), vertex_[1]) != vertex_.end();
  }
  /// Their boxes on the whole way have no point in common.
  [[nodiscard]] bool are_apart() const {
    Box edge = Box::none();
    Box triangle = Box::none();
    for (std::size_t i = 0; i < 5; ++i) {
      Box& box = i < 2 ? edge : triangle;
      box.add(place(i, 0.0));
      box.add(place(i, 1.0));
    }
    return !edge.overlaps(triangle);
  }
  [[nodiscard]] bool cross(double share) const {
    return crosses(place(0, share), place(1, share), {place(2, share), place(3, share), place(4, share)});
  }
  /// A share at which they cross, after one at which they do not; 2 where no sample crosses.
  [[nodiscard]] double first_crossing() const {
    constexpr int kSamples = 32;
    for (int i = 1; i <= kSamples; ++i) {
      double after = static_cast<double>(i) / kSamples;
      if (!cross(after)) continue;
      double before = static_cast<double>(i - 1) / kSamples;
      for (int round = 0; round < 48; ++round) {
        const double middle = 0.5 * (before + after);
        (cross(middle) ? after : before) = middle;
      }
      return after;
    }
    return 2.0;
  }
  /// What the five pairs of features between them may go. `distance`: the least at the start, and at rest.
  [[nodiscard]] double share(double apart, double& distance) const {
    double share = 1.0;
    distance = std::numeric_limits<double>::infinity();
    const auto look = [&](PairKind kind, std::array<std::size_t, 4> of) {
      Candidate candidate{kind, 0, 0, 0, {}, apart};
      std::array<Vec3, 4> start;
      std::array<Vec3, 4> rest;
      for (std::size_t k = 0; k < 4; ++k) {
        candidate.vertex[k] = vertex_[of[k]];
        start[k] = place(of[k], 0.0);
        rest[k] = block(ConstReals(surfaces_.rest()), vertex_[of[k]]);
      }
      for (const auto& p : {start, rest}) {
        distance = std::min(distance, std::sqrt(nearest_of(kind, p).square));
      }
      share = std::min(share, free_way(candidate, from_, to_).share);
    };
    for (const std::size_t end : {0U, 1U}) look(PairKind::vertex_face, {end, 2, 3, 4});
    look(PairKind::edge_edge, {0, 1, 2, 3});
    look(PairKind::edge_edge, {0, 1, 3, 4});
    look(PairKind::edge_edge, {0, 1, 4, 2});
    return share;
  }

 private:
  [[nodiscard]] Vec3 place(std::size_t i, double share) const {
    const Vec3 from = block(from_, vertex_[i]);
    return from + share * (block(to_, vertex_[i]) - from);
  }

  const SurfaceSet& surfaces_;
  ConstReals from_;
  ConstReals to_;
  std::array<std::int32_t, 5> vertex_{};
};

/// The ends of all ways after those that would pass through something were held back.
std::vector<double> held(const SurfaceSet& surfaces, const Candidates& candidates, ConstReals from,
                         ConstReals to) {
  const std::vector<std::uint8_t> given(surfaces.vertices().size(), 0);
  HoldBack hold_back(surfaces, given);
  hold_back.find(candidates, {}, from, to);
  std::vector<double> end(to.begin(), to.end());
  for (std::int32_t v = 0; v < std::ssize(surfaces.vertices()); ++v) {
    const Vec3 start = block(from, v);
    block(Reals(end), v) = start + hold_back.share(v) * (block(to, v) - start);
  }
  return end;
}

/// Ways that are all free together need no shortening when each is seen apart, and the other way round.
TEST(SoupTest, WaysAreFreeTogetherWhereNoneHasToBeShortened) {
  std::array<int, 2> seen{};
  const test::SoupRange soups(kFew);
  for (unsigned number = soups.first; number < soups.end; ++number) {
    const Soup soup = test::soup(number);
    const SurfaceSet surfaces(soup.description, soup.first_row, soup.places[0]);
    const std::vector<std::uint8_t> given(surfaces.vertices().size(), 0);
    HoldBack hold_back(surfaces, given);
    Candidates apart(soup.description, surfaces);
    Candidates together(soup.description, surfaces, Candidates::Ways::together);
    for (const double scale : {1e-3, 1e-2, 0.1, 1.0}) {
      const std::vector<double>& from = soup.places[1];
      std::vector<double> to = soup.places[2];
      for (std::size_t i = 0; i < to.size(); ++i) to[i] = from[i] + scale * (to[i] - from[i]) + (i % 3 == 2);
      apart.cover(from, to);
      together.cover(from, to);
      const bool free = !hold_back.find(apart, {}, from, to);
      ASSERT_EQ(hold_back.is_free(together, {}, from, to, {}, {}), free) << "soup " << number;
      ++seen[free ? 1 : 0];
    }
  }
  EXPECT_GT(seen[0], 10);
  EXPECT_GT(seen[1], 10);
}

TEST(SoupTest, WhatABodyHasInCommonGivesItNoCandidates) {
  const Soup soup = test::soup(0);
  const SurfaceSet surfaces(soup.description, soup.first_row, soup.places[0]);
  Candidates rest(soup.description, surfaces, Candidates::Ways::together);
  Candidates falling(soup.description, surfaces, Candidates::Ways::together);
  const std::vector<double>& from = soup.places[0];
  std::vector<double> to = from;
  for (std::size_t i = 2; i < to.size(); i += 3) to[i] -= 100.0;
  rest.cover(from, from);
  falling.cover(from, to);
  const auto within = [&](const Candidates& candidates) {
    return std::ranges::count_if(candidates.list(), [&](const Candidate& c) {
      const std::int32_t last = c.vertex[at(vertices_of(c.kind) - 1)];
      return surfaces.vertices()[at(c.vertex[0])].surface == surfaces.vertices()[at(last)].surface;
    });
  };
  const auto at_rest = static_cast<double>(within(rest));
  EXPECT_NEAR(static_cast<double>(within(falling)), at_rest, 0.01 * at_rest);
  EXPECT_GT(at_rest, 100.0);
}

TEST(SoupTest, NoCrossingThatExactBisectionFindsIsPassed) {
  int passed = 0;
  const test::SoupRange soups(kFew);
  for (unsigned number = soups.first; number < soups.end; ++number) {
    const Soup soup = test::soup(number);
    const SurfaceSet surfaces(soup.description, soup.first_row, soup.places[0]);
    Candidates candidates(soup.description, surfaces);
    const ConstReals from(soup.places[1]);
    const ConstReals to(soup.places[2]);
    candidates.cover(from, to);
    const std::vector<double> end = held(surfaces, candidates, from, to);
    for (std::int32_t t = 0; t < std::ssize(surfaces.primitives()); ++t) {
      if (surfaces.primitives()[at(t)].corners < 3) continue;
      for (std::int32_t e = 0; e < std::ssize(surfaces.edges()); ++e) {
        const Passing whole(surfaces, e, t, from, to);
        if (whole.are_apart() || whole.share_a_vertex() || whole.cross(0.0)) continue;
        const double crossing = whole.first_crossing();
        if (crossing > 1.0) continue;
        double distance = 0.0;
        const double share = whole.share(soup.description.pairs[0].gap, distance);
        // What coincides at rest never meets, and of what nearly touches at the start nothing is known.
        if (distance < 1e-9) continue;
        ++passed;
        ASSERT_LT(share, crossing) << "edge " << e << " and triangle " << t << " of soup " << number;
        const Passing short_way(surfaces, e, t, from, end);
        ASSERT_FALSE(short_way.first_crossing() <= 1.0)
            << "edge " << e << " and triangle " << t << " of soup " << number << ", held back";
      }
    }
  }
  EXPECT_GT(passed, 1000);
}

/// Whether any edge that belongs to one of two primitives goes through the other, which it does not share a
/// corner with.
bool cross(const SurfaceSet& surfaces, ConstReals places, std::int32_t p, std::int32_t q) {
  const Primitive& face = surfaces.primitives()[at(q)];
  if (face.corners < 3) return false;
  const auto place = [&](std::int32_t v) -> Vec3 { return block(places, v); };
  return std::ranges::any_of(surfaces.edges_of(p), [&](std::int32_t e) {
    const auto& ends = surfaces.edges()[at(e)].vertex;
    const bool apart = std::ranges::none_of(
        ends, [&](std::int32_t v) { return std::ranges::find(face.vertex, v) != face.vertex.end(); });
    return apart && crosses(place(ends[0]), place(ends[1]),
                            {place(face.vertex[0]), place(face.vertex[1]), place(face.vertex[2])});
  });
}

TEST(SoupTest, WhatCrossesSomePrimitivesIsFoundAsByTestingEveryPair) {
  std::array<int, 2> seen{};
  for (unsigned number = 0; number < 20; ++number) {
    const Soup soup = test::soup(number);
    const Contact contact(soup.description, soup.first_row, soup.places[0]);
    const SurfaceSet& surfaces = contact.surfaces();
    State state;
    state.positions = soup.places[0];
    std::vector<double> places(3 * surfaces.vertices().size());
    contact.place_vertices(state, state.time, places);
    const auto count = static_cast<std::int32_t>(surfaces.primitives().size());
    for (std::int32_t p = 0; p + 3 < count; p += 3) {
      std::vector<std::uint8_t> some(at(count), 0);
      bool expected = false;
      for (const std::int32_t one : {p, p + 1}) {
        some[at(one)] = 1;
        for (std::int32_t q = 0; q < count; ++q) {
          expected =
              expected || (q != one && (cross(surfaces, places, one, q) || cross(surfaces, places, q, one)));
        }
      }
      EXPECT_EQ(any_crosses(contact, state, some), expected) << "soup " << number << ", primitive " << p;
      ++seen[expected ? 1 : 0];
    }
  }
  EXPECT_GT(seen[0], 50);
  EXPECT_GT(seen[1], 50);
}

}  // namespace
}  // namespace tissu
