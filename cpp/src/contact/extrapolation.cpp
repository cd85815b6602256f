#include "tissu/contact/extrapolation.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace tissu {
namespace {

constexpr double kSlow = 0.5;      ///< changes that shrink faster settle by themselves
constexpr double kSlowest = 0.95;  ///< others do not settle
constexpr double kOneMode = 0.2;   ///< of a change: more than this beside its multiple is another mode

Vec3 multiplier(const ContactNumbers& c) { return c.force * vector_of(c.normal) + vector_of(c.drag); }

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
  change_.resize(solved.size());
  latest_.resize(solved.size());
  keys_.resize(solved.size());
  for (std::size_t i = 0; i < solved.size(); ++i) {
    const Vec3 now = multiplier(solved[i]);
    change_[i] = known ? Vec3(now - latest_[i]) : Vec3(Vec3::Zero());
    latest_[i] = now;
    keys_[i] = solved[i].key();
  }
  count_ = known ? count_ + 1 : 1;
  if (count_ < 3 || !are_same(solved, next)) return;
  const double factor = this->factor();
  if (factor == 0.0) return;
  for (std::size_t i = 0; i < next.size(); ++i) {
    ContactNumbers& c = next[i];
    Vec3 more = factor * change_[i];
    const Vec3 n = vector_of(c.normal);
    if (slides(c)) more = n.dot(more) * n;  // friction is given by the normal force
    const double pulls = c.force + n.dot(more);
    if (pulls < 0.0) more -= pulls * n;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      c.push[axis] += more[static_cast<Eigen::Index>(axis)];
    }
  }
  count_ = 0;  // the next change is not one of this row
}

}  // namespace tissu
