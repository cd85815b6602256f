#include "tissu/force/instruments.h"

#include <cmath>
#include <span>
#include <string>

#include "held_place.h"
#include "tissu/base/error.h"
#include "tissu/base/number_text.h"

namespace tissu {
namespace {

constexpr double kMost = 1e6;  ///< points of an edge, poses that wait, tracks
constexpr double kMostRows = 1e3;

/// What is wrong with the track at the beginning of the numbers; empty: nothing.
std::string misfit(std::span<const double> numbers, std::int32_t blocks) {
  if (numbers.size() < Instruments::kHead) return "does not have its first six numbers";
  if (!is_whole(numbers[0], 0.0, kMost) || !is_whole(numbers[2], -1.0, 2e9) ||
      !is_whole(numbers[3], 0.0, kMost) || !is_whole(numbers[4], 1.0, kMost) ||
      !is_whole(numbers[5], 0.0, kMostRows)) {
    return "counts what cannot be counted so";
  }
  const auto count = [&](std::size_t i) { return static_cast<std::size_t>(numbers[i]); };
  const std::size_t poses = Instruments::kHead + Instruments::kPose * count(4);
  const std::size_t length = poses + Instruments::kAnchor * count(3) * count(5);
  if (numbers[1] != static_cast<double>(length) || length > numbers.size()) return "has another length";
  for (std::size_t i = Instruments::kHead; i < poses; i += Instruments::kPose) {
    double square = 0.0;
    for (std::size_t k = 3; k < Instruments::kPose; ++k) square += numbers[i + k] * numbers[i + k];
    if (!(std::abs(square - 1.0) < 1e-6)) return "is turned by a quaternion of another length than one";
  }
  for (std::size_t i = poses; i < length; i += Instruments::kAnchor) {
    for (std::size_t k = 1; k < 5; ++k) {
      if (!is_whole(numbers[i + k], -1.0, blocks)) return "rides on block " + number_text(numbers[i + k]);
    }
  }
  return {};
}

}  // namespace

void Instruments::claim_memory(MemoryPlaces& places) { place_ = places.claim(std::string(kMemory), 0); }

void Instruments::carry_memory(const ForceModel& before, const Memory& then, Memory& now) const {
  if (const auto* same = dynamic_cast<const Instruments*>(&before)) now[place_] = then[same->place_];
}

void Instruments::check_memory(const State& state) const {
  const std::span<const double> numbers(state.memory[place_]);
  for (std::size_t i = 0; i < numbers.size(); i += static_cast<std::size_t>(numbers[i + 1])) {
    const std::string text = misfit(numbers.subspan(i), state.blocks());
    if (!text.empty()) {
      throw ParameterError("the track of an instrument " + text +
                           "; restore what instruments remember as it was taken.");
    }
  }
}

}  // namespace tissu
