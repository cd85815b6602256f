#include "tissu/haptic/stepped_loop.h"

#include <cmath>

namespace tissu::haptic {

SteppedLoop::SteppedLoop(Device& device, const Kinematics& kinematics, const Settings& settings)
    : device_(&device), kinematics_(&kinematics), settings_(settings), memory_(start(settings)) {
  check(settings, device.info().delay);
}

void SteppedLoop::set(const Settings& settings) {
  check(settings, device_->info().delay);
  settings_ = settings;
}

void SteppedLoop::publish(const LocalModel& model) {
  model_ = model;
  model_.time_ns = std::llround(time() * 1e9);
}

void SteppedLoop::step(LoopRow& row) noexcept {
  TickInput input;
  input.read = device_->read(input.sample);
  input.written = written_;
  input.now_ns = std::llround((time() + settings_.period) * 1e9);
  input.late = late_;
  input.model = &model_;
  late_ = 0;
  row.command = tick(*kinematics_, settings_, input, memory_, row.report);
  row.counts = memory_.sample.counts;
  written_ = device_->write(row.command);
}

void SteppedLoop::run(std::int64_t n, std::vector<LoopRow>* rows) {
  LoopRow row;
  for (std::int64_t i = 0; i < n; ++i) {
    step(row);
    if (rows != nullptr) rows->push_back(row);
  }
}

}  // namespace tissu::haptic
