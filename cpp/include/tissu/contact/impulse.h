#pragma once

/// Impulses that keep near surfaces from closing, in explicit steps (Chendeb 2007, section 4.3.2; all
/// contacts of a step together, by projected Gauss-Seidel).
///
///     find p_n >= 0 complementary to u >= u*,   u = n . J v with the impulses,  W = J M^-1 J^T
///     friction        |p_T| <= mu p_n, opposite to the sliding
///     on the way      u* = -max(g0, 0) / h      it comes as near as the surfaces rest
///     at the end      u* = -e u-                of contacts that are shut there; e = 0 where they closed no
///                                               faster than the step's forces alone change u
///
/// g0 is the gap and u- the rate at the start of the step. The mean velocity of the way and the velocity at
/// the end have impulses of their own, as the positions and velocities of constrained motion have (Andersen
/// 1983); the second ones are the momentum that surfaces exchange. Depth that is there already is taken out
/// of the places alone, in four sweeps at most, so that it adds no motion.
///
/// The step's forces have those of the latest step's contacts in them, as forces that stay, so that what
/// rests is at rest in every stage of a step; impulses are the rest of what is needed, and never pull in sum.
/// Linear momentum is kept to round-off.

#include "tissu/contact/explicit_contact.h"

namespace tissu {

class ImpulseContact : public ExplicitContact {
 public:
  ImpulseContact(const Contact& contact, const FixedDofs& fixed, const Mass& mass);

  [[nodiscard]] bool stays() const override { return true; }
  void add_force(const State& at, double share, Reals f) override;
  [[nodiscard]] bool strikes_first() const override { return true; }
  void find_blows(double pushed) override;
  void take_back(double pushed, Reals way, Reals end) override;
  void strike_way(ConstReals way, Reals change) override;
  void lift(State& end) override;
  void strike_end(ConstReals velocities, const State& end, Reals change) override;

 protected:
  /// The impulses of a contact, of the way or of the end.
  struct Impulse {
    double normal = 0.0;          ///< p_n [N s]
    Vec3 along = Vec3::Zero();    ///< p_T [N s]
    double missing = 0.0;         ///< by how much u is below u* without impulses [m/s]
    Vec3 sliding = Vec3::Zero();  ///< tangential rate without impulses [m/s]
    [[nodiscard]] Vec3 sum(const Vec3& n) const { return normal * n + along; }
  };
  /// A contact that may close in this step.
  struct Blow {
    ContactNumbers contact;
    double apart;        ///< at which it is shut [m]
    double restitution;  ///< e
    double friction;
    double weight;   ///< n . W n [1/kg]
    double tangent;  ///< the largest of W [1/kg]
    Impulse way;
    Impulse end;
  };
  void begin_response() override;
  void keep(const State& end, std::vector<ContactNumbers>& kept) override;
  /// What the impulses of a contact begin with, and how near it may come.
  virtual void begin_blow(Blow& blow, double pushed) const;
  [[nodiscard]] std::vector<Blow>& blows() { return blows_; }
  /// Nothing is left of its gap.
  [[nodiscard]] bool is_shut(const Blow& blow, const State& end) const;

 private:
  [[nodiscard]] double least_end_rate(const Blow& blow, double after) const;
  /// One contact, the others as they are; the change of its impulse.
  double relax(const Blow& blow, Impulse& impulse, Reals change) const;
  void solve(Impulse Blow::*of, Reals change);
  bool lift_once(State& end);

  bool given_ = true;  ///< the forces that impulses begin with are in the velocities already
  std::vector<Blow> blows_;
  std::vector<double> moves_;
  std::vector<std::int32_t> counts_;  ///< of deep contacts of each row: zero between two lifts
  std::vector<std::int32_t> rows_;
};

}  // namespace tissu
