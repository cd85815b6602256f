#pragma once

/// Impulses on the velocities at the end of a step, of methods whose way has impulses of its own (as
/// constrained motion has: Andersen 1983, Journal of Computational Physics 52, 24-34). What was shut on the
/// way neither closes nor slides on by them:
///
///     find p_n >= 0 complementary to u >= 0, u = n . J v        |p_T| <= mu p_n, opposite to the sliding
///
/// by projected Gauss-Seidel over all contacts, with the masses. Linear momentum is kept to round-off.

#include <span>
#include <vector>

#include "tissu/assembly/fixed_dofs.h"
#include "tissu/assembly/mass.h"
#include "tissu/contact/contact_mass.h"
#include "tissu/contact/contact_run.h"

namespace tissu {

class EndImpulses {
 public:
  EndImpulses(const Contact& contact, const FixedDofs& fixed, const Mass& mass)
      : contact_(contact), mass_(contact, fixed, mass) {}

  /// v += M^-1 J^T p, and p / h joins the forces `push` of the contacts, of a step of h from `start`.
  void strike(const ContactRun& run, const State& start, double h, std::span<ContactNumbers> contacts,
              Reals v);

 private:
  struct Blow {
    std::size_t contact;
    double friction;
    double weight;              ///< n . W n [1/kg], W = J M^-1 J^T
    double tangent;             ///< the largest of W [1/kg]
    Vec3 led;                   ///< the rate that obstacles have of it [m/s]
    double normal = 0.0;        ///< p_n [N s]
    Vec3 along = Vec3::Zero();  ///< p_T [N s]
  };
  /// One contact, the others as they are; the change of its impulse.
  double relax(const ContactRun& run, const ContactNumbers& contact, Blow& blow, Reals v) const;

  const Contact& contact_;
  ContactMass mass_;
  std::vector<Blow> blows_;
};

}  // namespace tissu
