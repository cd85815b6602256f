#pragma once

/// Forces of contacts, judged body by body: a change that is small beside all forces may be large on a light
/// body.

#include <span>
#include <vector>

#include "tissu/contact/contact.h"

namespace tissu {

class BodyForces {
 public:
  /// `rows`: of the world.
  BodyForces(const Contact& contact, std::size_t rows);

  /// A step begins at `start`, which outlives it. Forces on a body are judged by a thousandth of its `load`
  /// [N] where they are smaller; it may be empty.
  void begin(const State& start, ConstReals load);
  /// A force that moves things by no more than the round-off of their places [N].
  [[nodiscard]] double round_off(const ContactNumbers& contact) const;
  /// By how much the forces `push` of contacts that were looked at differ from those of contacts with which a
  /// system was solved, on the body where it is most: |change of the forces on rows| / |forces|.
  double change(std::span<const ContactNumbers> solved, std::span<const ContactNumbers> looked);
  /// Forces of contacts: what they give, and what was taken off them.
  void clear();
  void add(const ContactNumbers& contact, const Vec3& given, const Vec3& taken_off);
  /// What was taken off as a share of what is given, on the body where it is most.
  [[nodiscard]] double taken_off();

 private:
  void scatter(const ContactNumbers& contact, const Vec3& force, Reals f) const;
  /// Squares of forces on rows, summed for each body.
  void sum_squares(ConstReals forces, std::vector<double>& squares) const;
  void add_squares(const ContactNumbers& contact, double square, std::vector<double>& squares) const;
  /// The largest |part| / |whole| of a body; each body's floor counts as a part of its whole.
  [[nodiscard]] double largest_share(ConstReals parts, ConstReals wholes) const;

  const Contact& contact_;
  const State* start_ = nullptr;
  std::vector<double> levers_;     ///< of each carrier, to where it touches at most [m]
  std::vector<double> forces_;     ///< on rows
  std::vector<double> refusals_;   ///< on rows
  std::vector<double> floors_;     ///< of each body [N]
  std::vector<double> sizes_;      ///< squares on each body: of the forces before, …
  std::vector<double> others_;     ///< … of those after, …
  std::vector<double> roundings_;  ///< … of what round-off of places makes of them, …
  std::vector<double> changes_;    ///< … and of what changed
};

}  // namespace tissu
