#pragma once

#include <span>
#include <string_view>
#include <vector>

#include "tissu/force/force_model.h"

namespace tissu {

/// A node that carries a point, and its weight there.
struct GrabPart {
  std::int32_t node;
  double weight;
};

/// A point of a body: a node, a place in a cell by the values of its shape functions, or a place on a frame.
struct GrabPoint {
  std::vector<GrabPart> parts;  ///< the weights sum to one
  std::int32_t frame = -1;      ///< number of the frame, -1: none
  std::int32_t rotation = -1;   ///< block of its rotation
  Vec3 place = Vec3::Zero();    ///< from the frame's origin, in its axes [m]
};

/// The grabs of a state, which stand in its memory one after the other. They are made, moved and let go
/// before the first step or between two steps:
///
///     GrabTable(simulation.memory(Grabs::kMemory)).add(1, {{{7, 1.0}}}, Vec3(0.1, 0, 0), 50.0);
class GrabTable {
 public:
  static constexpr std::size_t kHead = 11;  ///< numbers of a grab beside two for each part
  static constexpr std::size_t kStiffness = 1;
  static constexpr std::size_t kTarget = 2;

  explicit GrabTable(std::vector<double>& numbers) : numbers_(numbers) {}
  /// Pulls a point towards `target` [m]; refuses a stiffness [N/m] that is not positive and a number that
  /// another grab has.
  void add(std::int32_t number, const GrabPoint& point, const Vec3& target, double stiffness);
  /// Refuses a number that no grab has; so does `release`.
  void move(std::int32_t number, const Vec3& target);
  void release(std::int32_t number);
  [[nodiscard]] std::size_t size() const;

 private:
  [[nodiscard]] std::size_t find(std::int32_t number) const;
  [[nodiscard]] std::size_t required(std::int32_t number) const;

  std::vector<double>& numbers_;
};

/// Springs of no rest length from points of the bodies to targets in space, as many as the state remembers.
///
/// f = k (target - p) with p = sum w_a x_a, or x + R place on a frame, times the share of the loads that
/// acts. The stiffness is -k J^T J with J = dp/dq, and the turning of a frame's lever arm under load, of
/// which the matrix gets the nearest semi-definite part: couplings of one vertex each.
class Grabs final : public ForceModel {
 public:
  static constexpr std::string_view kMemory = "grabs";     ///< name of their place in the memory
  static constexpr std::string_view kPresses = "presses";  ///< of those by which edges of blades press

  explicit Grabs(std::string_view name = kMemory) : name_(name) {}
  [[nodiscard]] std::string_view effect() const override { return name_; }
  [[nodiscard]] ForceKind kind() const override { return ForceKind::external; }
  void add_force(const State& state, Scratch& scratch, Reals f) const override;
  void add_product(const State& state, Scratch& scratch, StiffnessScale scale, ConstReals p,
                   Reals out) const override;
  /// sum k |target - p|^2 / 2 [J]
  [[nodiscard]] double energy(const State& state, Scratch& scratch) const override;

  [[nodiscard]] RunTime run_time() const override { return {.couples = true}; }
  void claim_memory(MemoryPlaces& places) override;
  void add_couplings(const State& state, StiffnessScale scale, Couplings& couplings) const override;
  void carry_memory(const ForceModel& before, const Memory& then, Memory& now) const override;
  /// Refuses grabs of nodes or frames that there are not.
  void check_memory(const State& state) const override;

 private:
  std::string_view name_;  ///< one of those above
  std::size_t place_ = 0;  ///< in State::memory
};

}  // namespace tissu
