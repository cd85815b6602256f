#pragma once

/// Ways of obstacles that are not straight. The test of ways, and the ways that friction drags along, know
/// where a step begins and ends.

#include "tissu/contact/contact.h"

namespace tissu {

/// Whether an obstacle near something turns too far in a step from `state`, or is led to and fro in it, for
/// one straight way to stand for its own: such a step is divided.
bool are_ways_bent(const Contact& contact, const State& state, double h);

}  // namespace tissu
