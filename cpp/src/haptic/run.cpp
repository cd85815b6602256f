#include "tissu/haptic/run.h"

#include <chrono>
#include <cmath>

namespace tissu::haptic {
namespace {

std::int64_t now() noexcept {
  const auto time = std::chrono::steady_clock::now().time_since_epoch();
  return std::chrono::duration_cast<std::chrono::nanoseconds>(time).count();
}

}  // namespace

Run::Run(Device& device, const Settings& settings, std::size_t room)
    : device_(device),
      kinematics_(settings.joints),
      settings_(Numbered{settings, 0}),
      records_(room),
      memory_(start(settings)) {}

void Run::publish(LocalModel& model) noexcept {
  model.stamp = ++stamp_;
  model.time_ns = now_ns_.load(std::memory_order_relaxed);
  models_.publish(model);
}

const TickReport& Run::report() noexcept {
  reports_.take();
  return reports_.value();
}

void Run::tick(std::int64_t number) noexcept {
  number += base_;
  const std::int64_t began = now();
  settings_.take();
  models_.take();
  const Settings& settings = settings_.value().settings;
  record_.settings = settings_.value().number;
  const LocalModel& model = models_.value();
  record_.read = device_.read(record_.sample);
  const std::int64_t read = now();
  TickInput input;
  input.read = record_.read;
  input.written = record_.written;
  input.sample = record_.sample;
  if (settings.tag == kAnyTool) input.sample.tag = kAnyTool;
  input.now_ns = std::llround(static_cast<double>(number) * settings.period * 1e9);
  input.late = static_cast<std::int32_t>(number - next_);
  input.model = &model;
  record_.command = haptic::tick(kinematics_, settings, input, memory_, record_.report);
  const std::int64_t computed = now();
  record_.written = device_.write(record_.command);
  record_.number = number;
  record_.offered = model.stamp;
  records_.put(record_);
  reports_.publish(record_.report);
  now_ns_.store(input.now_ns, std::memory_order_relaxed);
  next_ = number + 1;
  read_.add(read - began);
  write_.add(now() - computed);
  if (model.stamp > 0) age_.add(std::llround(1e9 * record_.report.model_age));
}

void Run::end() noexcept { device_.write({}); }

}  // namespace tissu::haptic
