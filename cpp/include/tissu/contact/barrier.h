#pragma once

/// A potential that grows without bound as surfaces close (after Li et al. 2020, ACM Transactions on Graphics
/// 39(4), Incremental potential contact), of squared distances:
///
///     sigma = (d^2 - d_m^2) / (d0^2 - d_m^2)      d0 = xi + gap, d_m = xi - 0.9 gap
///     E = B b(sigma), b = -(sigma - 1)^2 ln sigma where sigma < 1
///     H = B b'' 4 d^2 / (d0^2 - d_m^2)^2 n n^T    the turning of n left out: never negative
///
/// B gives n . H n = k at sigma = 1/4, k = 3 / (a + b) with the compliances a, b of the mean node of the two
/// surfaces in the step's own matrix, so that it is the same wherever a contact is. Below sigma = 1e-4 the
/// quadratic that touches b goes on: only the tests of ways keep surfaces apart there. In static steps B
/// grows where surfaces stay that near. Friction has the normal forces F of the latest lag:
///
///     f_T = -F f1(y / e) u_T / y,  y = |u_T|,  f1 = 2 s - s^2 where s < 1, else 1;  e = 1e-3 extent h / s

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "tissu/contact/implicit_contact.h"

namespace tissu {

/// b and its derivatives.
struct BarrierValue {
  double energy = 0.0;
  double slope = 0.0;
  double curvature = 0.0;
};
BarrierValue barrier_value(double sigma);

class BarrierContact final : public ImplicitContact {
 public:
  /// `extent`: of the scene [m]; where a free obstacle is larger, it counts.
  BarrierContact(const Contact& contact, const FixedDofs& fixed, double extent);

  [[nodiscard]] BarrierContact* barrier() override { return this; }
  void set_matrix(std::span<const double> blocks, double scale, const ContactStage& stage) override;
  /// If so, d0 = xi, and pairs become stiffer below sigma = 0.6: surfaces rest a little inside the gap,
  /// where augmented contacts rest.
  void rest_at_gap(bool rests) { rests_at_gap_ = rests; }
  /// What the contacts of the latest look store [J].
  [[nodiscard]] double energy() const { return energy_; }
  /// The normal forces of the contacts that act are those of friction from now on. By how much they changed,
  /// as a share.
  double lag();
  /// Contacts of a pair of surfaces that stay nearer than sigma = 1e-2 from one call to the next become
  /// stiffer, until `set_matrix`. Whether any did.
  bool stiffen();
  /// The contacts that act, looked at where `before` acted, become as stiff as those: a pair's first
  /// stiffness times the power of four that comes nearest to the normal forces that it had.
  void go_on_from(const ContactTable& before);

 protected:
  [[nodiscard]] bool may_press(std::size_t i) const override;
  [[nodiscard]] bool has_own_stiffness() const override { return true; }
  void begin_press() override;
  std::optional<double> press(std::size_t i, ContactNumbers& contact) override;
  void rub(ContactNumbers& contact, double bound, double k, double share) override;

 private:
  double extent_;
  bool rests_at_gap_ = false;
  double energy_ = 0.0;
  std::vector<double> stiffnesses_;  ///< k of each pair, …
  std::vector<double> stiffer_;      ///< … times that, …
  std::vector<double> nearest_;      ///< … its least sigma in the latest look, …
  std::vector<std::uint8_t> stays_;  ///< … which was that small before, too
};

}  // namespace tissu
