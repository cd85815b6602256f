#pragma once

#include <utility>
#include <vector>

#include "tissu/force/force_model.h"

namespace tissu {

/// A point that a link may hold: a node, or a place on a frame.
struct LinkPoint {
  std::int32_t block = 0;     ///< node, or translation block of the frame
  std::int32_t frame = -1;    ///< number of the frame, -1 for a node
  Vec3 place = Vec3::Zero();  ///< in the frame's axes [m]
};

/// Springs of no rest length between any two points, chosen before the first step or between two steps.
///
/// f_a = k (p_b - p_a). The stiffness is -k J^T J with J = dp/dq, which leaves out the turning of a frame's
/// lever arm under load; it is always semi-definite. Nodes that were not coupled before get extra blocks in
/// the matrix.
class Links final : public ForceModel {
 public:
  /// Adds a link and returns its number.
  std::int32_t add(const LinkPoint& a, const LinkPoint& b, double stiffness);
  void clear() { links_.clear(); }
  /// Takes over the links of another world of the same unknowns.
  void take_over(const Links& other) { links_ = other.links_; }
  [[nodiscard]] std::size_t size() const { return links_.size(); }
  /// Eleven numbers for each link: block, frame and place of either point, and the stiffness.
  [[nodiscard]] std::vector<double> numbers() const;
  /// The links that `numbers` told.
  void restore(ConstReals numbers);
  /// The pairs of rows that they couple now.
  [[nodiscard]] std::vector<std::pair<std::int32_t, std::int32_t>> coupled() const;

  [[nodiscard]] std::string_view effect() const override { return "links"; }
  [[nodiscard]] ForceKind kind() const override { return ForceKind::elastic; }
  void add_force(const State& state, Reals f) const override;
  void add_stiffness(const State& state, StiffnessScale scale, BlockMatrix& matrix) const override;
  void add_product(const State& state, StiffnessScale scale, ConstReals p, Reals out) const override;
  [[nodiscard]] double energy(const State& state) const override;

 private:
  struct Link {
    LinkPoint a;
    LinkPoint b;
    double stiffness;  ///< [N/m]
  };
  std::vector<Link> links_;
};

}  // namespace tissu
