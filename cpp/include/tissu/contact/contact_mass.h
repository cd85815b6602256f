#pragma once

/// What a contact's force changes of velocities: M^-1 of the rows that it moves, without given axes. Of rigid
/// bodies the inertia is that in space at the start of a step.

#include <vector>

#include "tissu/assembly/fixed_dofs.h"
#include "tissu/assembly/mass.h"
#include "tissu/contact/contact.h"

namespace tissu {

class ContactMass {
 public:
  ContactMass(const Contact& contact, const FixedDofs& fixed, const Mass& mass);

  /// A step begins at `start`, which outlives it.
  void begin(const State& start);
  /// The change of a row's velocity by a force or impulse on the vertex that it carries.
  [[nodiscard]] Vec3 change(const CarriedPart& part, const Vec3& force) const;
  /// v += M^-1 J^T force
  void give(const ContactNumbers& contact, const Vec3& force, Reals v) const;
  /// J M^-1 J^T, where row r counts shared[r] times: what a contact's acceleration is over its force [1/kg].
  /// `shared`: empty for ones.
  [[nodiscard]] Mat3 mobility(const ContactNumbers& contact, ConstReals shared) const;

 private:
  [[nodiscard]] Vec3 inverse(std::int32_t row) const;
  [[nodiscard]] const Mat3& inverse_inertia(std::int32_t rotation) const;

  const Contact& contact_;
  const FixedDofs& fixed_;
  const Mass& mass_;
  const State* start_ = nullptr;
  std::vector<Mat3> inertias_;            ///< inverse, of each rotation that carries vertices
  std::vector<std::int32_t> inertia_of_;  ///< of each row: its number there; empty: no rotation
};

/// At least the largest eigenvalue.
double largest_of(const Mat3& mobility);

}  // namespace tissu
