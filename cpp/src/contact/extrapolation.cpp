#include "tissu/contact/extrapolation.h"

#include <algorithm>

namespace tissu {
namespace {

constexpr double kSlow = 0.5;      ///< changes that shrink faster settle by themselves
constexpr double kSlowest = 0.95;  ///< a larger one counts as this
constexpr double kOneMode = 0.2;   ///< of a change: more than this beside its multiple is another mode

Eigen::Vector4d multiplier(const ContactNumbers& c) { return {c.force, c.drag[0], c.drag[1], c.drag[2]}; }

bool slides(const ContactNumbers& c) { return c.sliding != 0.0; }

bool are_same(std::span<const ContactNumbers> one, std::span<const ContactNumbers> other) {
  return std::ranges::equal(one, other, [](const ContactNumbers& a, const ContactNumbers& b) {
    return a.key() == b.key() && slides(a) == slides(b);
  });
}

}  // namespace

bool Extrapolation::is_known(std::span<const ContactNumbers> contacts) const {
  return std::ranges::equal(contacts, keys_, {}, &ContactNumbers::key);
}

/// rho / (1 - rho); 0: changes do not shrink by one ratio.
double Extrapolation::factor() const {
  double both = 0.0;
  double first = 0.0;
  for (std::size_t i = 0; i < change_.size(); ++i) {
    both += change_[i].dot(before_[i]);
    first += before_[i].squaredNorm();
  }
  const double ratio = first > 0.0 ? both / first : 0.0;
  if (!(ratio > kSlow)) return 0.0;
  double size = 0.0;
  double other = 0.0;
  for (std::size_t i = 0; i < change_.size(); ++i) {
    size += change_[i].squaredNorm();
    other += (change_[i] - ratio * before_[i]).squaredNorm();
  }
  if (other > kOneMode * kOneMode * size) return 0.0;
  const double slow = std::min(ratio, kSlowest);
  return slow / (1.0 - slow);
}

void Extrapolation::lead(std::span<const ContactNumbers> solved, std::span<ContactNumbers> next) {
  const bool known = count_ > 0 && is_known(solved);
  before_.swap(change_);
  before_.resize(solved.size());
  change_.resize(solved.size());
  latest_.resize(solved.size());
  keys_.resize(solved.size());
  for (std::size_t i = 0; i < solved.size(); ++i) {
    const Eigen::Vector4d now = multiplier(solved[i]);
    change_[i] = known ? Eigen::Vector4d(now - latest_[i]) : Eigen::Vector4d(Eigen::Vector4d::Zero());
    latest_[i] = now;
    keys_[i] = solved[i].key();
  }
  count_ = known ? count_ + 1 : 1;
  if (count_ < 3 || !are_same(solved, next)) return;
  const double factor = this->factor();
  if (factor == 0.0) return;
  for (std::size_t i = 0; i < next.size(); ++i) {
    ContactNumbers& c = next[i];
    const Vec3 n = vector_of(c.normal);
    const double presses = std::max(-c.force, factor * change_[i][0]);
    Vec3 drags = factor * change_[i].tail<3>();
    drags -= n.dot(drags) * n;
    if (slides(c)) drags.setZero();  // friction is given by the normal force
    const Vec3 more = presses * n + drags;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      c.push[axis] += more[static_cast<Eigen::Index>(axis)];
    }
  }
  count_ = 0;  // the next change is not one of this row
}

}  // namespace tissu
