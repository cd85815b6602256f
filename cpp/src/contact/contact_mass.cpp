#include "tissu/contact/contact_mass.h"

#include <Eigen/LU>

namespace tissu {

double largest_of(const Mat3& mobility) { return mobility.cwiseAbs().rowwise().sum().maxCoeff(); }

namespace {

/// The inverse of an inertia on the axes of space that are not given, zero on the others.
Mat3 free_inverse(const Mat3& inertia, std::uint8_t given) {
  Mat3 free = inertia;
  for (int axis = 0; axis < 3; ++axis) {
    if (((given >> axis) & 1) == 0) continue;
    free.row(axis).setZero();
    free.col(axis).setZero();
    free(axis, axis) = 1.0;
  }
  Mat3 inverse = free.inverse();
  for (int axis = 0; axis < 3; ++axis) {
    if (((given >> axis) & 1) != 0) inverse(axis, axis) = 0.0;
  }
  return inverse;
}

}  // namespace

ContactMass::ContactMass(const Contact& contact, const FixedDofs& fixed, const Mass& mass)
    : contact_(contact), fixed_(fixed), mass_(mass) {
  const auto& rotations = contact.surfaces().rotations();
  if (rotations.empty()) return;
  inertia_of_.assign(mass.nodal().size(), -1);
  for (std::size_t i = 0; i < rotations.size(); ++i) {
    inertia_of_[static_cast<std::size_t>(rotations[i].row)] = static_cast<std::int32_t>(i);
  }
}

void ContactMass::begin(const State& start) {
  start_ = &start;
  inertias_.clear();
  for (const SurfaceRotation& of : contact_.surfaces().rotations()) {
    const auto frame = static_cast<std::size_t>(of.frame);
    const Mat3 inertia = spatial_inertia(mass_.frames()[frame], start.rotations[frame]);
    inertias_.push_back(free_inverse(inertia, fixed_.masks()[static_cast<std::size_t>(of.row)]));
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
  return inertias_[static_cast<std::size_t>(inertia_of_[static_cast<std::size_t>(rotation)])];
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
