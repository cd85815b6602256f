/// A tick takes no memory: it runs in a thread that must not wait for anything.

#include <gtest/gtest.h>

#include <cmath>

#include "../base/allocations.h"
#include "tissu/haptic/simulated_device.h"
#include "tissu/haptic/stepped_loop.h"

namespace tissu::haptic {
namespace {

#ifdef TISSU_COUNTS_ALLOCATIONS

/// Eight contacts in one plane with friction, a blade, and tissue that gives way by 1 mm/N.
LocalModel crowded(std::uint64_t stamp) {
  LocalModel model;
  model.stamp = stamp;
  model.tag = 7;
  model.contacts = kMaxContacts;
  model.q_ref << 0.0, 0.0, 0.0, 0.2;
  for (int i = 0; i < kMaxContacts; ++i) {
    LocalContact& c = model.contact[static_cast<std::size_t>(i)];
    c.l = Vec3(2e-3 * std::cos(i), 2e-3 * std::sin(i), 0.0);
    c.anchor = Vec3(c.l[0], c.l[1], 0.199);
    c.normal = -Vec3::UnitZ();
    c.friction = 0.3;
    for (int k = 0; k < 3; ++k) model.W(3 * i + k, 3 * i + k) = 1e-3;
  }
  model.blade = {true, Vec3::Zero(), Vec3::UnitX(), Vec3(0.0, 0.0, 0.2), 1e-4, 0.2};
  return model;
}

TEST(Tick, TakesNoMemory) {
  HandSettings path;
  path.tremor = 1e-3;
  for (int i = 0; i < 200; ++i) {
    path.path.push_back({0.6 * i, {0.005 * std::sin(i), 0.005 * std::cos(2 * i), 0.2 + 0.003 * std::sin(3 * i)}, 0.2});
  }
  SimulatedDevice device({}, {.substeps = 2}, Hand(path), {0.0, 0.0, 0.0, 0.2});
  device.set_tool(7, true);
  Settings settings;
  settings.run = true;
  settings.tag = 7;
  const TrocarKinematics kinematics;
  SteppedLoop loop(device, kinematics, settings);
  std::uint64_t stamp = 0;
  LoopRow row;
  std::int64_t touching = 0;
  test::allocations = 0;
  test::counting = true;
  for (int i = 0; i < 100000; ++i) {
    if (i % 40 == 0) loop.publish(crowded(++stamp));
    loop.step(row);
    touching += row.report.state == State::contact ? 1 : 0;
  }
  test::counting = false;
  EXPECT_EQ(test::allocations.load(), 0);
  EXPECT_GT(touching, 50000);  // or nothing was solved
}

#endif

}  // namespace
}  // namespace tissu::haptic
