#include "tissu/haptic/run.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <thread>
#include <vector>

#include "tissu/haptic/loop.h"
#include "tissu/haptic/replay_device.h"

namespace tissu::haptic {
namespace {

/// A device whose tool goes in and out by 2 mm around a depth of 100 mm.
ReplayDevice wobbling(std::size_t ticks) {
  std::vector<Answered> answers(ticks);
  for (std::size_t k = 0; k < ticks; ++k) {
    Sample& sample = answers[k].sample;
    sample.counts[3] =
        1000 + static_cast<std::int32_t>(std::lround(20.0 * std::sin(0.02 * static_cast<double>(k))));
    sample.sequence = static_cast<std::uint32_t>(k);
    sample.flags = 1 | 2 | 4;
    sample.tag = 1;
  }
  return ReplayDevice(std::move(answers));
}

Settings running() {
  Settings settings;
  settings.run = true;
  settings.tag = 1;
  settings.ramp = 0.01;
  return settings;
}

/// A floor at 100 mm that gives way.
LocalModel ground(double stiffness) {
  LocalModel model;
  model.tag = 1;
  model.contacts = 1;
  model.q_ref = Joints(0.0, 0.0, 0.0, 0.1);
  model.contact[0].anchor = Vec3(0.0, 0.0, 0.1);
  model.contact[0].normal = Vec3(0.0, 0.0, -1.0);
  for (int k = 0; k < 3; ++k) model.W(k, k) = 1.0 / stiffness;
  return model;
}

void expect_equal(const std::vector<TickRecord>& a, const std::vector<TickRecord>& b) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t k = 0; k < a.size(); ++k) {
    EXPECT_EQ(a[k].command.torque, b[k].command.torque) << k;
    EXPECT_EQ(a[k].report.tank, b[k].report.tank) << k;
  }
}

TEST(HapticRun, ThreadTakesModelsAndSettingsAndItsRecordsReplayToTheBit) {
  constexpr std::size_t kTicks = 2000;
  ReplayDevice device = wobbling(kTicks);
  haptic::Run run(device, running(), kTicks);
  LoopOptions plain{.period = 1e-3, .priority = 0, .lock_memory = false, .pin = false, .spin = 0.0};
  Loop loop(run, plain);
  loop.start();
  std::vector<LocalModel> models;
  std::vector<Settings> settings{running()};
  double felt = 0.0;
  // The tool is in for the first half of each 314 ticks: a thread that comes late waits for the next.
  const auto ticks = [&] { return static_cast<std::size_t>(loop.report().ticks); };
  while (ticks() < 300 || (felt == 0.0 && ticks() < kTicks)) {
    LocalModel model = ground(models.size() % 2 == 0 ? 400.0 : 500.0);
    run.publish(model);
    models.push_back(model);
    if (models.size() % 16 == 0) {
      settings.push_back(running());
      settings.back().limits.force = 1.0 + 0.01 * static_cast<double>(settings.size());
      // A busy machine may be late six times in a row, and holds the force back until it is acknowledged.
      settings.back().acknowledged = static_cast<std::uint32_t>(settings.size());
      run.set(settings.back(), static_cast<std::uint32_t>(settings.size() - 1));
    }
    felt = std::max(felt, std::abs(run.report().torque[3]));
    std::this_thread::sleep_for(std::chrono::microseconds(500));
  }
  loop.stop();
  const std::vector<TickRecord> records = run.take_records();
  EXPECT_EQ(run.lost_records(), 0);
  EXPECT_GT(felt, 0.0);

  ReplayDevice again = wobbling(kTicks);
  haptic::Run replay(again, running(), kTicks);
  std::uint64_t offered = 0;
  std::uint32_t change = 0;
  std::int64_t next = 0;
  for (const TickRecord& record : records) {
    if (record.settings != change) replay.set(settings[record.settings], record.settings);
    if (record.offered != offered) replay.offer(models[record.offered - 1]);
    change = record.settings;
    offered = record.offered;
    replay.step(record.number - next);
    next = record.number + 1;
  }
  expect_equal(records, replay.take_records());
}

TEST(HapticRun, EveryToolIsTakenWhereNoTagIsLookedAt) {
  ReplayDevice device = wobbling(10);
  Settings settings = running();
  settings.tag = kAnyTool;
  haptic::Run run(device, settings);
  for (int k = 0; k < 5; ++k) run.step();
  EXPECT_EQ(run.report().state, State::free);
}

TEST(HapticRun, WhatALoopDoesAfterItsLastTickSwitchesTheMotorsOff) {
  class Watched final : public Device {
   public:
    DeviceStatus read(Sample& sample) noexcept override {
      sample.flags = 7;
      sample.counts[3] = 1000;
      sample.tag = 1;
      return DeviceStatus::ok;
    }
    DeviceStatus write(const Command& command) noexcept override {
      enabled = command.enable;
      return DeviceStatus::ok;
    }
    [[nodiscard]] DeviceInfo info() const noexcept override { return {}; }
    bool enabled = false;
  };
  Watched device;
  haptic::Run run(device, running());
  for (int k = 0; k < 5; ++k) run.step();
  EXPECT_TRUE(device.enabled);
  run.end();
  EXPECT_FALSE(device.enabled);
}

}  // namespace
}  // namespace tissu::haptic
