#include "tissu/haptic/local_model.h"

#include <cmath>
#include <string>

#include "tissu/base/error.h"
#include "tissu/base/number_text.h"

namespace tissu::haptic {
namespace {

bool is_finite(const LocalContact& c) noexcept {
  return c.l.allFinite() && c.anchor.allFinite() && c.normal.allFinite() && c.tangent.allFinite() &&
         c.force.allFinite() && std::isfinite(c.friction);
}

[[noreturn]] void refuse(const LocalModel& model, const std::string& sentence) {
  throw ParameterError("Local model " + std::to_string(model.stamp) + ": " + sentence);
}

bool is_unit(const Vec3& v) { return std::abs(v.norm() - 1.0) < 1e-6; }

void check_contact(const LocalModel& model, std::int32_t i) {
  const LocalContact& c = model.contact[static_cast<std::size_t>(i)];
  const std::string name = "contact " + std::to_string(i);
  if (!is_unit(c.normal) || !is_unit(c.tangent) || std::abs(c.normal.dot(c.tangent)) > 1e-6) {
    refuse(model, "the normal and the tangent of " + name + " must be unit vectors at right angles.");
  }
  if (c.friction < 0.0) {
    refuse(model, "the friction of " + name + " is " + number_text(c.friction) + "; it must be at least 0.");
  }
}

}  // namespace

bool is_finite(const LocalModel& model) noexcept {
  if (model.contacts < 0 || model.contacts > kMaxContacts || !model.q_ref.allFinite()) return false;
  for (std::int32_t i = 0; i < model.contacts; ++i) {
    if (!is_finite(model.contact[static_cast<std::size_t>(i)])) return false;
  }
  const BladeRow& blade = model.blade;
  if (blade.present && !(blade.l.allFinite() && blade.way.allFinite() && blade.anchor.allFinite() &&
                         std::isfinite(blade.compliance) && std::isfinite(blade.limit))) {
    return false;
  }
  const int n = 3 * model.contacts;
  return model.W.topLeftCorner(n, n).allFinite();
}

void settle_compliance(LocalModel& model) noexcept {
  const int n = 3 * model.contacts;
  if (n == 0) return;
  auto W = model.W.topLeftCorner(n, n);
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < i; ++j) W(i, j) = W(j, i) = 0.5 * (W(i, j) + W(j, i));
  }
  const double more = 1e-9 * W.trace();
  for (int i = 0; i < n; ++i) W(i, i) += more;
}

void check(const LocalModel& model) {
  if (model.contacts < 0 || model.contacts > kMaxContacts) {
    refuse(model, "it has " + std::to_string(model.contacts) + " contacts; 0 to " +
                      std::to_string(kMaxContacts) + " are accepted.");
  }
  if (!is_finite(model)) refuse(model, "every number must be finite.");
  for (std::int32_t i = 0; i < model.contacts; ++i) check_contact(model, i);
  const BladeRow& blade = model.blade;
  if (blade.present && (!is_unit(blade.way) || blade.compliance < 0.0 || blade.limit < 0.0)) {
    refuse(model, "the blade's way must be a unit vector, its compliance and limit at least 0.");
  }
  const int n = 3 * model.contacts;
  const auto W = model.W.topLeftCorner(n, n);
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j <= i; ++j) {
      const double bound = std::sqrt(std::max(0.0, W(i, i)) * std::max(0.0, W(j, j)));
      const bool symmetric = std::abs(W(i, j) - W(j, i)) <= 1e-9 * W.diagonal().cwiseAbs().maxCoeff();
      if (W(i, i) < 0.0 || !symmetric || std::abs(W(i, j)) > bound * (1.0 + 1e-6)) {
        refuse(model, "W must be symmetric and positive semi-definite; row " + std::to_string(i) +
                          ", column " + std::to_string(j) + " is not.");
      }
    }
  }
}

}  // namespace tissu::haptic
