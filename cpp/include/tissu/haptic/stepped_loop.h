#pragma once

/// The loop without a clock: read, tick, write, as often as asked for. The same bits every time.

#include <cstdint>
#include <vector>

#include "tissu/haptic/tick.h"

namespace tissu::haptic {

/// What a tick looked like from outside.
struct LoopRow {
  TickReport report;
  Command command;
  Counts counts{};
};

/// `device`, `kinematics` outlive the loop. Settings and models change between calls of `run` only.
class SteppedLoop {
 public:
  /// Throws ParameterError where the settings do not pass `check` with the device's delay.
  SteppedLoop(Device& device, const Kinematics& kinematics, const Settings& settings);

  /// New settings from the next tick on; checked as in the constructor.
  void set(const Settings& settings);
  /// The newest model from the next tick on; its time is now. Its stamp must be another than that before.
  void publish(const LocalModel& model);
  /// n ticks; a row of each is appended where `rows` is there. Allocates nothing of its own without.
  void run(std::int64_t n, std::vector<LoopRow>* rows);
  /// One tick.
  void step(LoopRow& row) noexcept;
  /// Ticks that the next one is late by, in a row, as a thread would say; it goes back to 0 by itself.
  void be_late(std::int32_t ticks) noexcept { late_ = ticks; }

  [[nodiscard]] const Settings& settings() const noexcept { return settings_; }
  [[nodiscard]] const Memory& memory() const noexcept { return memory_; }
  /// Of the loop's clock [s].
  [[nodiscard]] double time() const noexcept { return static_cast<double>(memory_.tick) * settings_.period; }

 private:
  Device* device_;
  const Kinematics* kinematics_;
  Settings settings_;
  Memory memory_;
  LocalModel model_;
  DeviceStatus written_ = DeviceStatus::ok;
  std::int32_t late_ = 0;
};

}  // namespace tissu::haptic
