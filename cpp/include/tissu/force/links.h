#pragma once

#include <string_view>
#include <vector>

#include "tissu/force/force_model.h"

namespace tissu {

/// A point that a link may hold: a node, or a place on a frame.
struct LinkPoint {
  std::int32_t block = 0;     ///< node, or translation block of the frame
  std::int32_t frame = -1;    ///< number of the frame, -1 for a node
  Vec3 place = Vec3::Zero();  ///< in the frame's axes [m]
};

struct Link {
  LinkPoint a;
  LinkPoint b;
  double stiffness;  ///< [N/m]
};

/// The links of a state, which stand in its memory: eleven numbers each, block, frame and place of either
/// point and the stiffness. They are chosen before the first step or between two steps:
///
///     LinkTable(simulation.memory(Links::kMemory)).add({3}, {7}, 50.0);
class LinkTable {
 public:
  explicit LinkTable(std::vector<double>& numbers) : numbers_(numbers) {}
  /// Adds a link and returns its number; refuses a stiffness that is not positive.
  std::int32_t add(const LinkPoint& a, const LinkPoint& b, double stiffness);
  void clear() { numbers_.clear(); }
  [[nodiscard]] std::size_t size() const;

 private:
  std::vector<double>& numbers_;
};

/// Springs of no rest length between any two points, as many as the state remembers.
///
/// f_a = k (p_b - p_a). The stiffness is -k J^T J with J = dp/dq, and the turning of a frame's lever arm
/// under load, of which the matrix gets the nearest semi-definite part, as couplings.
class Links final : public ForceModel {
 public:
  static constexpr std::string_view kMemory = "links";  ///< name of their place in the memory

  [[nodiscard]] std::string_view effect() const override { return "links"; }
  [[nodiscard]] ForceKind kind() const override { return ForceKind::elastic; }
  void add_force(const State& state, Scratch& scratch, Reals f) const override;
  void add_product(const State& state, Scratch& scratch, StiffnessScale scale, ConstReals p,
                   Reals out) const override;
  [[nodiscard]] double energy(const State& state, Scratch& scratch) const override;

  [[nodiscard]] RunTime run_time() const override { return {.couples = true}; }
  void claim_memory(MemoryPlaces& places) override;
  void add_couplings(const State& state, StiffnessScale scale, Couplings& couplings) const override;
  void carry_memory(const ForceModel& before, const Memory& then, Memory& now) const override;
  /// Refuses links of nodes or frames that there are not.
  void check_memory(const State& state) const override;

 private:
  /// Calls f(link) for each of the state.
  template <class Function>
  void for_links(const State& state, Function&& f) const;

  std::size_t place_ = 0;  ///< in State::memory
};

}  // namespace tissu
