#include "tissu/haptic/simulated_device.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "tissu/base/error.h"

namespace tissu::haptic {
namespace {

void require(bool good, const std::string& sentence) {
  if (!good) throw ParameterError("Simulated device: " + sentence);
}

bool at_least(const Joints& values, double low) {
  return values.allFinite() && (values.array() >= low).all();
}

void check(const MechanismSettings& m) {
  const ToolInertia& tool = m.inertia;
  require(
      tool.mass >= 0.0 && tool.across > 0.0 && tool.axial >= 0.0 && std::isfinite(tool.mass + tool.centre),
      "the tool's mass must be at least 0 and its moment of inertia above 0.");
  require(at_least(tool.cradle, 0.0) && tool.cradle[2] + tool.axial > 0.0 && tool.cradle[3] + tool.mass > 0.0,
          "every joint must move a mass or a moment of inertia above 0.");
  require(at_least(m.friction.viscous, 0.0) && at_least(m.friction.coulomb, 0.0) &&
              at_least(m.stop_stiffness, 0.0),
          "friction and the stiffness of the ends must be at least 0.");
  require(at_least(m.presliding, 1e-12) && at_least(m.blend, 1e-12),
          "presliding ways and blending speeds must be above 0.");
  require(at_least(m.efficiency, 1e-3) && (m.efficiency.array() <= 1.0).all(),
          "efficiencies must be above 0 and at most 1.");
  require(m.roller_force > 0.0, "the force that the rollers pass must be above 0 N.");
  require(m.gravity.allFinite(), "gravity must be finite.");
}

void check(const LineSettings& line) {
  require(line.period > 0.0 && std::isfinite(line.period) && line.substeps >= 1,
          "the period must be above 0 s and have at least one substep.");
  for (std::size_t i = 0; i < kChannels; ++i) {
    require(line.count_size[i] > 0.0 && line.torque_limit[i] >= 0.0 && std::isfinite(line.torque_limit[i]),
            "the size of a count must be above 0 and the limit of a torque at least 0; channel " +
                std::to_string(i) + " is not.");
  }
  require(line.torque_bits >= 0 && line.torque_bits <= 30, "a torque has 0 to 30 bits.");
  require(line.motor_lag >= 0.0 && line.delay >= 0.0 && line.jitter >= 0.0 &&
              line.delay + line.jitter < 256.0 * line.period,
          "lag, delay and jitter must be at least 0 s, delay and jitter together below 256 periods.");
  for (const double p : {line.lost, line.misread_tag}) {
    require(p >= 0.0 && p <= 1.0, "a probability must be from 0 to 1.");
  }
}

}  // namespace

SimulatedDevice::SimulatedDevice(const MechanismSettings& mechanism, const LineSettings& line,
                                 std::optional<Hand> hand, const Joints& q)
    : mechanism_(mechanism),
      line_(line),
      hand_(std::move(hand)),
      random_(line.seed),
      inertia_(mechanism.inertia) {
  check(mechanism);
  check(line);
  require(q.allFinite() && std::abs(q[0]) < 1.5 && std::abs(q[1]) < 1.5,
          "it must start at finite joints, pitch and roll below 1.5 rad.");
  state_.q = q;
  holding_ = hand_.has_value() && hand_->holds(0.0);
  inertia_.held = holding_ ? hand_->settings().mass : 0.0;
  if (line.unknown_zero) {
    homed_ = false;
    for (int i = 0; i < kJoints; ++i) {
      zero_[i] = line_.count_size[static_cast<std::size_t>(i)] * std::floor(random_.between(-4000.0, 4000.0));
    }
  }
}

void SimulatedDevice::set_tool(std::uint64_t tag, bool in) noexcept {
  tag_ = tag;
  tool_in_ = in;
}

void SimulatedDevice::plan_tools(std::vector<ToolChange> changes) {
  for (std::size_t i = 0; i < changes.size(); ++i) {
    require(changes[i].time >= 0.0 && (i == 0 || changes[i].time > changes[i - 1].time),
            "tools change at times from 0 s on that grow.");
  }
  changes_ = std::move(changes);
  changed_ = 0;
}

void SimulatedDevice::plug_in() noexcept {
  plugged_ = true;
  homed_ = false;
  enabled_ = false;
  waits_ = 0;
  jumped_ = {};
  zero_ = state_.q;
}

void SimulatedDevice::push(const Joints& q, const Joints& v) noexcept {
  state_.q = q;
  state_.p = Inertia(inertia_, q).matrix() * v;
  v_ = v;
}

void SimulatedDevice::aim(const Vec3& tip, double psi, double over) {
  if (!hand_) throw ParameterError("The simulated device has no hand that could be aimed; give it one.");
  if (!tip.allFinite() || !std::isfinite(psi) || !std::isfinite(over) || over < 0.0) {
    throw ParameterError("A hand is aimed at a place and in a time that are finite, the time at least 0.");
  }
  hand_->aim(time_, tip, psi, over);
}

void SimulatedDevice::follow() noexcept {
  if (hand_) hand_->follow();
}

std::int32_t SimulatedDevice::count(std::size_t channel) const noexcept {
  if (channel >= kJoints) return jumped_[channel];
  const auto i = static_cast<int>(channel);
  double position = state_.q[i] - zero_[i];
  if (i == 3 && mechanism_.encoder_on_motor) position += slip_;
  constexpr double kMost = std::numeric_limits<std::int32_t>::max();
  const double counted = std::floor(position / line_.count_size[channel]) + jumped_[channel];
  return static_cast<std::int32_t>(std::clamp(counted, -kMost, kMost));
}

DeviceStatus SimulatedDevice::read(Sample& sample) noexcept {
  advance();
  for (; changed_ < changes_.size() && changes_[changed_].time <= time_; ++changed_) {
    set_tool(changes_[changed_].tag, changes_[changed_].tag != 0);
  }
  ++sequence_;
  const bool lost = random_.happens(line_.lost);
  const bool misread = random_.happens(line_.misread_tag);
  if (!plugged_ || lost) return DeviceStatus::none;
  for (std::size_t i = 0; i < kChannels; ++i) sample.counts[i] = count(i);
  sample.time_ns = clock_ns_ + static_cast<std::int64_t>(std::llround(time_ * 1e9));
  sample.sequence = sequence_;
  sample.tag = tool_in_ ? (misread ? tag_ ^ (1ULL << (random_.bits() & 63U)) : tag_) : 0;
  const auto bit = [](bool on, Flag flag) { return on ? static_cast<unsigned>(flag) : 0U; };
  sample.flags = static_cast<std::uint16_t>(bit(homed_, Flag::homed) | bit(enabled_, Flag::enabled) |
                                            bit(tool_in_, Flag::tool_in) | bit(fault_, Flag::fault));
  return DeviceStatus::ok;
}

DeviceStatus SimulatedDevice::write(const Command& command) noexcept {
  const double late = random_.uniform() * line_.jitter;
  const bool lost = random_.happens(line_.lost);
  if (!plugged_) return DeviceStatus::none;
  if (lost || waits_ == kWaiting) return DeviceStatus::ok;
  arrival_ = std::max(arrival_, time_ + line_.delay + late);  // in the order in which they were sent
  waiting_[(first_ + waits_) % kWaiting] = {arrival_, command.torque, command.enable,
                                            1e-3 * command.watchdog_ms};
  ++waits_;
  return DeviceStatus::ok;
}

void SimulatedDevice::take_commands() noexcept {
  while (waits_ > 0 && waiting_[first_].time <= time_) {
    const Waiting& next = waiting_[first_];
    enabled_ = next.enable;
    cut_at_ = next.time + next.watchdog;
    for (int i = 0; i < kJoints; ++i) {
      const auto channel = static_cast<std::size_t>(i);
      const double limit = line_.torque_limit[channel];
      double torque = std::clamp(next.torque[channel], -limit, limit);
      if (!std::isfinite(torque)) torque = 0.0;
      if (line_.torque_bits > 0 && limit > 0.0) {
        const double step = 2.0 * limit / static_cast<double>(1 << line_.torque_bits);
        torque = step * std::round(torque / step);
      }
      target_[i] = enabled_ ? torque : 0.0;
    }
    first_ = (first_ + 1) % kWaiting;
    --waits_;
  }
  if (enabled_ && time_ > cut_at_) enabled_ = false;
  if (!enabled_) target_.setZero();
}

void SimulatedDevice::advance() noexcept {
  const double h = line_.period / line_.substeps;
  for (int i = 0; i < line_.substeps; ++i) {
    substep(h);
    time_ = static_cast<double>(++steps_) * h;
  }
}

DeviceInfo SimulatedDevice::info() const noexcept {
  DeviceInfo made;
  made.axes = kJoints;
  made.count_size = line_.count_size;
  made.torque_limit = line_.torque_limit;
  made.rate = 1.0 / line_.period;
  made.delay = line_.delay + 0.5 * line_.jitter;
  made.torque_confirmed = false;
  return made;
}

}  // namespace tissu::haptic
