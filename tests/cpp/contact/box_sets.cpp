#include "box_sets.h"

#include <algorithm>
#include <cmath>

#include "../../../bench/contact/folded_sheet.h"
#include "../base/random.h"

namespace tissu::test {
namespace {

using Boxes = std::vector<Box>;

Box box_of(const Vec3& one, const Vec3& other) {
  Box box = Box::none();
  box.add(one);
  box.add(other);
  return box;
}

SearchPlan one_surface(std::int32_t count) { return {{0, count}, {{0, 0}}}; }

/// Boxes of sizes up to `size` in a cube; the same ones at all times, each on its own straight way.
Boxes scattered(int count, const Vec3& size, double speed, int time) {
  Random random(7);
  Boxes boxes;
  for (int i = 0; i < count; ++i) {
    const Vec3 at = random.vector() + speed * time * random.vector();
    boxes.push_back(box_of(at, at + size.cwiseProduct(random.vector())));
  }
  return boxes;
}

/// Long thin ones, along any axis.
Boxes slivers(int time) {
  Random random(11);
  Boxes boxes;
  for (int i = 0; i < 300; ++i) {
    Vec3 size = Vec3::Constant(1e-4);
    size[i % 3] = 1.0;
    const Vec3 at = random.vector() + 0.01 * time * random.vector();
    boxes.push_back(box_of(at, at + size));
  }
  return boxes;
}

/// Heaps of boxes, each a thousandth as large as the one before, and as far away.
Boxes clusters(int time) {
  Random random(13);
  Boxes boxes;
  for (const double scale : {1e3, 1.0, 1e-3}) {
    for (int i = 0; i < 100; ++i) {
      const Vec3 at = Vec3::Constant(2.0 * scale) + scale * (random.vector() + 0.01 * time * random.vector());
      boxes.push_back(box_of(at, at + 0.3 * scale * random.vector()));
    }
  }
  return boxes;
}

/// Of whole numbers, so that sides of many touch.
Boxes bricks(int time) {
  Boxes boxes;
  for (int x = 0; x < 7; ++x) {
    for (int y = 0; y < 7; ++y) {
      for (int z = 0; z < 7; ++z) {
        const Vec3 at(x + time * (y % 2), y, z);
        boxes.push_back(box_of(at, at + Vec3::Ones()));
      }
    }
  }
  return boxes;
}

/// As far as single precision goes, and as small.
Boxes extreme(int time) {
  Random random(17);
  Boxes boxes;
  for (int i = 0; i < 60; ++i) {
    const double scale = std::pow(10.0, 37.0 - (i % 20) * 4.0);
    const Vec3 at = scale * (random.vector() + 0.1 * time * random.vector());
    boxes.push_back(box_of(at, at + scale * random.vector()));
  }
  boxes.push_back(box_of(Vec3::Constant(-3.4e38), Vec3::Constant(3.4e38)));
  return boxes;
}

/// Each a tenth as far from the origin as the one before: cuts by cost take off one at a time.
Boxes receding(int time) {
  Boxes boxes;
  for (int i = 0; i < 200; ++i) {
    const double at = std::pow(0.7, i + 0.1 * time);
    boxes.push_back(box_of(Vec3::Constant(at), Vec3::Constant(1.2 * at)));
  }
  return boxes;
}

Boxes with_giant(Boxes boxes) {
  boxes[boxes.size() / 2] = box_of(Vec3::Constant(-100), Vec3::Constant(100));
  return boxes;
}

/// Mixed up by and by until the order of the start is lost.
Boxes stirred(int time) {
  Random random(19);
  Boxes boxes;
  for (int i = 0; i < 400; ++i) {
    const Vec3 centre = random.vector();
    const double angle = 0.2 * time * (1.0 + centre.norm());
    const Vec3 at(std::cos(angle) * centre.x() - std::sin(angle) * centre.y(),
                  std::sin(angle) * centre.x() + std::cos(angle) * centre.y(), centre.z());
    boxes.push_back(box_of(at, at + Vec3::Constant(0.1)));
  }
  return boxes;
}

/// Time and again somewhere else, so that nothing of before is of use.
Boxes thrown(int time) {
  Random random(static_cast<unsigned>(100 + time));
  Boxes boxes;
  for (int i = 0; i < 300; ++i) {
    const Vec3 at = random.vector();
    boxes.push_back(box_of(at, at + 0.2 * random.vector()));
  }
  return boxes;
}

}  // namespace

std::vector<BoxPair> every_pair_tested(const SearchPlan& plan, const Boxes& boxes) {
  const auto surface = [&](std::int32_t p) {
    return static_cast<std::int32_t>(std::ranges::upper_bound(plan.first, p) - plan.first.begin()) - 1;
  };
  std::vector<BoxPair> pairs;
  for (std::int32_t a = 0; a < static_cast<std::int32_t>(boxes.size()); ++a) {
    for (std::int32_t b = a + 1; b < static_cast<std::int32_t>(boxes.size()); ++b) {
      const auto joins = [&](const SearchPlan::Meeting& m) {
        return std::minmax(m.a, m.b) == std::minmax(surface(a), surface(b));
      };
      const Box& p = boxes[static_cast<std::size_t>(a)];
      const Box& q = boxes[static_cast<std::size_t>(b)];
      bool apart = false;
      for (std::size_t k = 0; k < 3; ++k) apart = apart || p.high[k] < q.low[k] || q.high[k] < p.low[k];
      if (!apart && std::ranges::any_of(plan.meetings, joins)) pairs.push_back({a, b});
    }
  }
  return pairs;
}

std::vector<BoxScene> box_scenes() {
  const Vec3 small = Vec3::Constant(0.1);
  return {
      {"Random", one_surface(400), [=](int t) { return scattered(400, small, 0.01, t); }},
      {"Crowded", one_surface(150), [](int t) { return scattered(150, Vec3::Ones(), 0.05, t); }},
      {"Sheet", one_surface(450), [](int t) { return bench::folded_sheet(15, 3, 0.4, 0.2, 3.0 * t); }},
      {"Slivers", one_surface(300), slivers},
      {"AllIdentical", one_surface(200),
       [](int t) { return Boxes(200, box_of(Vec3(t, 0, 0), Vec3::Ones())); }},
      {"AllOnePoint", one_surface(200),
       [](int t) { return Boxes(200, box_of(Vec3(t, 0, 0), Vec3(t, 0, 0))); }},
      {"Points", one_surface(300), [](int t) { return scattered(300, Vec3::Zero(), 0.01, t); }},
      {"Clusters", one_surface(300), clusters},
      {"Giant", one_surface(300), [=](int t) { return with_giant(scattered(300, small, 0.01, t)); }},
      {"Bricks", one_surface(343), bricks},
      {"Extreme", one_surface(61), extreme},
      {"Receding", one_surface(200), receding},
      {"Stirred", one_surface(400), stirred},
      {"Thrown", one_surface(300), thrown},
      {"Surfaces",
       {{0, 100, 100, 250, 260, 300, 400}, {{0, 2}, {2, 2}, {4, 0}, {1, 0}, {5, 1}, {3, 4}, {1, 1}}},
       [=](int t) { return scattered(400, 2.0 * small, 0.02, t); }},
      {"SurfacesThatDoNotMeetThemselves",
       {{0, 200, 400}, {{1, 0}}},
       [=](int t) { return scattered(400, 2.0 * small, 0.02, t); }},
      {"NothingMeets", {{0, 50, 100}, {}}, [=](int t) { return scattered(100, small, 0.01, t); }},
      {"NoPrimitives", {{0, 0, 0}, {{0, 1}, {0, 0}}}, [](int) { return Boxes(); }},
      {"NoSurfaces", {}, [](int) { return Boxes(); }},
      {"OnePrimitive", one_surface(1), [=](int t) { return scattered(1, small, 0.01, t); }},
  };
}

}  // namespace tissu::test
