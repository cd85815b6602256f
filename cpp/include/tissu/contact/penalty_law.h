#pragma once

/// Springs of the penalty method (Chendeb 2007, section 4.3.2, with forces that end at a range and never
/// pull).
///
///     linear        f = k (d0 - d)                d0 = xi + gap, where d < d0 only
///     reciprocal    f = k1 (1/s - 1/s0)           s = d - r_a - r_b, s0 = s at d0, k1 = k s0^2 / 4
///
/// The reciprocal law goes on along its tangent from s0/2, where its stiffness has grown to k.

#include "tissu/contact/contact.h"

namespace tissu {

/// A force [N], and how fast it grows as surfaces close [N/m].
struct SpringForce {
  double force = 0.0;
  double slope = 0.0;
};

/// Of a spring of stiffness k [N/m] that is pressed by `depth` = d0 - d [m]; `range`: s0 [m].
SpringForce spring_force(PenaltyLaw law, double k, double depth, double range);

/// d0 - xi of a contact: a gap, or what is left of the distance at rest of parts of one body [m].
double spring_range(const Contact& contact, const ContactNumbers& of);

/// xi less most of the gap: the distance at which a spring is at its end [m].
double spring_stop(const Contact& contact, const ContactNumbers& of);

/// The damping of a spring, over the critical one, whose clamped force gives back a share e of the speed, at
/// least exp(-2) (Schwager, Poeschel 2007, Granular Matter 9, 465-469):
///
///     e = exp(-tan(theta) (pi - 2 theta)),  zeta = sin(theta)
double damping_of_restitution(double e);

/// That of a pair: of its restitution, or a fifth of the critical one.
double damping_of(const ContactPair& pair);

}  // namespace tissu
