#pragma once

/// A trocar that runs: its device, what the controller decides, the newest model, and what each tick did. The
/// same ticks are taken one by one (`step`, simulated time) or by the thread of a `Loop` (real time).

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "tissu/haptic/device.h"
#include "tissu/haptic/exchange.h"
#include "tissu/haptic/local_model.h"
#include "tissu/haptic/loop.h"
#include "tissu/haptic/record_ring.h"
#include "tissu/haptic/tick.h"
#include "tissu/haptic/timing.h"

namespace tissu::haptic {

/// Everything that came into a tick and out of it: what a replay needs, and what it has to give again.
struct TickRecord {
  std::int64_t number = 0;     ///< of the period, those that were missed counted
  std::uint64_t offered = 0;   ///< stamp of the newest model
  std::uint32_t settings = 0;  ///< which change of settings
  DeviceStatus read = DeviceStatus::ok;
  DeviceStatus written = DeviceStatus::ok;  ///< of this tick's command
  Sample sample{};
  Command command{};
  TickReport report{};
};

/// Of `Settings::tag`: every tool is taken, and no tag is looked at.
inline constexpr std::uint64_t kAnyTool = ~std::uint64_t{0};

class Run final : public Ticked {
 public:
  /// `room`: ticks that are kept until `take_records` is called. The device outlives the run, and has no
  /// other. Settings are those of `check`.
  Run(Device& device, const Settings& settings, std::size_t room = 4096);

  // ---- the slow side: one thread
  /// The newest model. Its stamp is counted up here, and its time is that of the newest tick; both are
  /// written into it.
  void publish(LocalModel& model) noexcept;
  /// A model with a stamp and a time of its own: of a recording.
  void offer(const LocalModel& model) noexcept { models_.publish(model); }
  /// `number`: which change it is; ticks write it down.
  void set(const Settings& settings, std::uint32_t number) noexcept { settings_.publish({settings, number}); }
  /// One tick in simulated time, late by so many; not while a loop runs it.
  void step(std::int64_t late = 0) noexcept { tick(next_ + late - base_); }
  /// The newest report.
  const TickReport& report() noexcept;
  [[nodiscard]] std::vector<TickRecord> take_records() { return records_.take(); }
  [[nodiscard]] std::int64_t lost_records() const noexcept { return records_.lost(); }
  /// Period that comes next: a loop that is started again goes on from there.
  [[nodiscard]] std::int64_t next() const noexcept { return next_; }
  void begin() noexcept { base_ = next_; }

  // ---- the fast side
  void tick(std::int64_t number) noexcept override;
  void end() noexcept override;

  [[nodiscard]] TimingReport read_timing() const noexcept { return read_.report(); }
  [[nodiscard]] TimingReport write_timing() const noexcept { return write_.report(); }
  [[nodiscard]] TimingReport model_age() const noexcept { return age_.report(); }

 private:
  Device& device_;
  TrocarKinematics kinematics_;
  Exchange<LocalModel> models_;
  struct Numbered {
    Settings settings{};
    std::uint32_t number = 0;
  };
  Exchange<Numbered> settings_;
  Exchange<TickReport> reports_;
  RecordRing<TickRecord> records_;
  Memory memory_;
  TickRecord record_;
  std::uint64_t stamp_ = 0;
  std::int64_t base_ = 0;  // number of the loop's first period
  std::int64_t next_ = 0;
  std::atomic<std::int64_t> now_ns_{0};
  Timing read_, write_, age_;
};

}  // namespace tissu::haptic
