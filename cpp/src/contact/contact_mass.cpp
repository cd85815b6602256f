#include "tissu/contact/contact_mass.h"

#include <Eigen/LU>

namespace tissu {

double largest_of(const Mat3& mobility) { return mobility.cwiseAbs().rowwise().sum().maxCoeff(); }

void ContactMass::begin(const State& start) {
  start_ = &start;
  inertias_.clear();
  for (const SurfaceCarrier& carrier : contact_.surfaces().carriers()) {
    const auto frame = static_cast<std::size_t>(carrier.frame);
    inertias_.emplace_back(spatial_inertia(mass_.frames()[frame], start.rotations[frame]).inverse());
  }
}

Vec3 ContactMass::inverse(std::int32_t row) const {
  const auto i = static_cast<std::size_t>(row);
  Vec3 inverse = Vec3::Constant(1.0 / mass_.nodal()[i]);
  for (int axis = 0; axis < 3; ++axis) {
    if (((fixed_.masks()[i] >> axis) & 1) != 0) inverse(axis) = 0.0;
  }
  return inverse;
}

const Mat3& ContactMass::inverse_inertia(std::int32_t rotation) const {
  const auto& carriers = contact_.surfaces().carriers();
  std::size_t k = 0;
  while (carriers[k].rotation != rotation) ++k;
  return inertias_[k];
}

Vec3 ContactMass::change(const CarriedPart& part, const Vec3& force) const {
  if (part.turns) return inverse_inertia(part.row) * part.load(force);
  return part.weight * inverse(part.row).cwiseProduct(force);
}

void ContactMass::give(const ContactNumbers& contact, const Vec3& force, Reals v) const {
  contact_.for_parts(contact, *start_,
                     [&](const CarriedPart& part) { block(v, part.row) += change(part, force); });
}

Mat3 ContactMass::mobility(const ContactNumbers& contact, ConstReals shared) const {
  Mat3 sum = Mat3::Zero();
  contact_.for_parts(contact, *start_, [&](const CarriedPart& part) {
    const double n = shared.empty() ? 1.0 : shared[static_cast<std::size_t>(part.row)];
    if (part.turns) {
      sum += n * part.carried(inverse_inertia(part.row));
    } else {
      sum.diagonal() += n * part.weight * part.weight * inverse(part.row);
    }
  });
  return sum;
}

}  // namespace tissu
