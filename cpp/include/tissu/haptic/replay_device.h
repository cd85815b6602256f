#pragma once

/// A device that gives what another one gave.

#include <cstddef>
#include <utility>
#include <vector>

#include "tissu/haptic/device.h"

namespace tissu::haptic {

/// What a device answered in one tick.
struct Answered {
  DeviceStatus read = DeviceStatus::ok;
  DeviceStatus written = DeviceStatus::ok;
  Sample sample{};
};

class ReplayDevice final : public Device {
 public:
  explicit ReplayDevice(std::vector<Answered> answers, const DeviceInfo& info = {})
      : answers_(std::move(answers)), info_(info) {}

  /// The next sample; `gone` after the last.
  DeviceStatus read(Sample& sample) noexcept override {
    if (next_ == answers_.size()) return DeviceStatus::gone;
    const Answered& now = answers_[next_++];
    if (now.read == DeviceStatus::ok) sample = now.sample;
    return now.read;
  }
  /// What was answered to the command of the tick that was read last.
  DeviceStatus write(const Command& /*command*/) noexcept override {
    return next_ == 0 ? DeviceStatus::ok : answers_[next_ - 1].written;
  }
  [[nodiscard]] DeviceInfo info() const noexcept override { return info_; }

 private:
  std::vector<Answered> answers_;
  DeviceInfo info_;
  std::size_t next_ = 0;
};

}  // namespace tissu::haptic
