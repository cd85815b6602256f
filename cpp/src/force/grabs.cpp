#include "tissu/force/grabs.h"

#include <Eigen/Geometry>
#include <cmath>
#include <string>

#include "held_place.h"
#include "tissu/base/error.h"
#include "tissu/base/number_text.h"

namespace tissu {
namespace {

constexpr std::size_t kHead = GrabTable::kHead;

/// A grab as it stands in the memory: number, stiffness, target, frame, block of its rotation, place, number
/// of parts, and node and weight of each part.
class Grab {
 public:
  explicit Grab(std::span<const double> numbers) : numbers_(numbers) {}
  [[nodiscard]] double stiffness() const { return numbers_[GrabTable::kStiffness]; }
  [[nodiscard]] Vec3 target() const { return {numbers_[2], numbers_[3], numbers_[4]}; }
  [[nodiscard]] bool on_frame() const { return numbers_[5] >= 0.0; }
  [[nodiscard]] std::int32_t rotation() const { return whole(6); }
  [[nodiscard]] std::size_t parts() const { return static_cast<std::size_t>(numbers_[10]); }
  [[nodiscard]] std::int32_t node(std::size_t i) const { return whole(kHead + 2 * i); }
  [[nodiscard]] double weight(std::size_t i) const { return numbers_[kHead + 2 * i + 1]; }

  /// From the frame's origin to the point, in space.
  [[nodiscard]] Vec3 arm(const State& state) const {
    return lever_arm(state, whole(5), Vec3(numbers_[7], numbers_[8], numbers_[9]));
  }
  [[nodiscard]] Vec3 position(const State& state) const {
    Vec3 p = arm(state);
    for (std::size_t i = 0; i < parts(); ++i) p += weight(i) * block(ConstReals(state.positions), node(i));
    return p;
  }
  /// dp/dq p: what a motion p of the unknowns does to the point.
  [[nodiscard]] Vec3 motion(const State& state, ConstReals p) const {
    Vec3 moved = Vec3::Zero();
    for (std::size_t i = 0; i < parts(); ++i) moved += weight(i) * block(p, node(i));
    if (on_frame()) moved += block(p, rotation()).cross(arm(state));
    return moved;
  }
  /// Of the spring, at a share of its stiffness.
  [[nodiscard]] Vec3 pull(const State& state, double share) const {
    return share * stiffness() * (target() - position(state));
  }
  void add_force(const State& state, const Vec3& force, Reals f) const {
    for (std::size_t i = 0; i < parts(); ++i) block(f, node(i)) += weight(i) * force;
    if (on_frame()) block(f, rotation()) += arm(state).cross(force);
  }
  [[nodiscard]] std::int32_t vertex(const State& state, std::vector<CarriedPart>& room,
                                    Couplings& couplings) const {
    if (parts() == 1 && weight(0) == 1.0 && !on_frame()) return node(0);
    room.clear();
    for (std::size_t i = 0; i < parts(); ++i) room.push_back({node(i), weight(i)});
    if (on_frame()) room.push_back({rotation(), 1.0, arm(state), true});
    return couplings.carry(room);
  }

 private:
  [[nodiscard]] std::int32_t whole(std::size_t i) const { return static_cast<std::int32_t>(numbers_[i]); }
  std::span<const double> numbers_;
};

/// Numbers of the grab that begins at `i`; beyond the end where the memory is none of grabs.
std::size_t length_at(std::span<const double> numbers, std::size_t i) {
  constexpr double kMostParts = 64.0;
  const bool readable = i + kHead <= numbers.size() && is_whole(numbers[i + 10], 1.0, kMostParts);
  return readable ? kHead + 2 * static_cast<std::size_t>(numbers[i + 10]) : numbers.size() + 1;
}

template <class Function>
void for_grabs(std::span<const double> numbers, Function&& f) {
  for (std::size_t i = 0; i < numbers.size(); i += length_at(numbers, i)) f(Grab(numbers.subspan(i)));
}

/// What is wrong with the grab; empty: nothing.
std::string misfit(const State& state, std::span<const double> grab) {
  const double stiffness = grab[GrabTable::kStiffness];
  if (!(stiffness > 0.0) || !std::isfinite(stiffness)) {
    return "has a stiffness of " + number_text(stiffness) + " N/m; it must be positive and finite";
  }
  const auto frames = static_cast<double>(state.rotations.size());
  const bool known = is_whole(grab[5], -1.0, frames) && is_whole(grab[6], -1.0, state.blocks()) &&
                     (grab[5] < 0.0) == (grab[6] < 0.0);
  if (!known) {
    return "holds frame " + number_text(grab[5]) + " with rotation block " + number_text(grab[6]) +
           "; the world has " + std::to_string(state.rotations.size()) + " frames";
  }
  for (std::size_t i = kHead; i < grab.size(); i += 2) {
    if (is_whole(grab[i], 0.0, state.blocks())) continue;
    return "holds block " + number_text(grab[i]) + "; the world has " + std::to_string(state.blocks()) +
           " blocks";
  }
  return {};
}

}  // namespace

void GrabTable::add(std::int32_t number, const GrabPoint& point, const Vec3& target, double stiffness) {
  if (!(stiffness > 0.0) || !std::isfinite(stiffness)) {
    throw ParameterError("a grab's stiffness is " + number_text(stiffness) +
                         " N/m; it must be positive and finite.");
  }
  if (find(number) != numbers_.size()) {
    throw ParameterError("there is a grab number " + std::to_string(number) +
                         " already; take another number.");
  }
  numbers_.insert(numbers_.end(),
                  {static_cast<double>(number), stiffness, target.x(), target.y(), target.z(),
                   static_cast<double>(point.frame), static_cast<double>(point.rotation), point.place.x(),
                   point.place.y(), point.place.z(), static_cast<double>(point.parts.size())});
  for (const GrabPart& part : point.parts) {
    numbers_.insert(numbers_.end(), {static_cast<double>(part.node), part.weight});
  }
}

void GrabTable::move(std::int32_t number, const Vec3& target) {
  const std::size_t at = required(number) + kTarget;
  for (std::size_t k = 0; k < 3; ++k) numbers_[at + k] = target[static_cast<Eigen::Index>(k)];
}

void GrabTable::release(std::int32_t number) {
  const std::size_t at = required(number);
  const auto begin = numbers_.begin() + static_cast<std::ptrdiff_t>(at);
  numbers_.erase(begin, begin + static_cast<std::ptrdiff_t>(length_at(numbers_, at)));
}

std::size_t GrabTable::size() const {
  std::size_t count = 0;
  for_grabs(numbers_, [&](const Grab&) { ++count; });
  return count;
}

std::size_t GrabTable::find(std::int32_t number) const {
  std::size_t i = 0;
  while (i < numbers_.size() && numbers_[i] != number) i += length_at(numbers_, i);
  return i;
}

std::size_t GrabTable::required(std::int32_t number) const {
  const std::size_t at = find(number);
  if (at < numbers_.size()) return at;
  throw ParameterError("grab number " + std::to_string(number) + " does not exist; it was let go.");
}

void Grabs::claim_memory(MemoryPlaces& places) { place_ = places.claim(std::string(name_), 0); }

void Grabs::carry_memory(const ForceModel& before, const Memory& then, Memory& now) const {
  const auto* grabs = dynamic_cast<const Grabs*>(&before);
  if (grabs != nullptr && grabs->name_ == name_) now[place_] = then[grabs->place_];
}

void Grabs::check_memory(const State& state) const {
  const std::span<const double> numbers(state.memory[place_]);
  for (std::size_t i = 0; i < numbers.size();) {
    const std::size_t length = length_at(numbers, i);
    if (i + length > numbers.size()) {
      throw ParameterError("found " + std::to_string(numbers.size()) +
                           " numbers of grabs, which are not those of whole grabs.");
    }
    const std::string text = misfit(state, numbers.subspan(i, length));
    if (!text.empty()) throw ParameterError("grab " + number_text(numbers[i]) + " " + text + ".");
    i += length;
  }
}

void Grabs::add_force(const State& state, Scratch& /*scratch*/, Reals f) const {
  for_grabs(state.memory[place_],
            [&](const Grab& grab) { grab.add_force(state, grab.pull(state, state.load_factor), f); });
}

void Grabs::add_product(const State& state, Scratch& /*scratch*/, StiffnessScale scale, ConstReals p,
                        Reals out) const {
  for_grabs(state.memory[place_], [&](const Grab& grab) {
    const double k = state.load_factor * grab.stiffness();
    grab.add_force(state, -scale.position * k * grab.motion(state, p), out);
    if (!grab.on_frame()) return;
    const Vec3 pull = grab.pull(state, state.load_factor);
    add_turning(grab.arm(state), pull, grab.rotation(), scale.position, p, out);
  });
}

void Grabs::add_couplings(const State& state, StiffnessScale scale, Couplings& couplings) const {
  if (scale.position == 0.0) return;
  std::vector<CarriedPart> room;
  for_grabs(state.memory[place_], [&](const Grab& grab) {
    const double k = state.load_factor * grab.stiffness();
    const std::int32_t vertex = grab.vertex(state, room, couplings);
    couplings.add({{vertex, 0, 0, 0}, {1.0, 0.0, 0.0, 0.0}, -scale.position * k * Mat3::Identity()});
    if (!grab.on_frame()) return;
    const Vec3 pull = grab.pull(state, state.load_factor);
    couple_turning(grab.arm(state), pull, grab.rotation(), scale.position, couplings);
  });
}

double Grabs::energy(const State& state, Scratch& /*scratch*/) const {
  double sum = 0.0;
  for_grabs(state.memory[place_], [&](const Grab& grab) {
    const double k = state.load_factor * grab.stiffness();
    sum += 0.5 * k * (grab.target() - grab.position(state)).squaredNorm();
  });
  return sum;
}

}  // namespace tissu
