#include "tissu/law/law.h"

#include <cmath>
#include <string>

#include "tissu/base/error.h"
#include "tissu/base/number_text.h"
#include "tissu/law/generated/hooke.h"
#include "tissu/law/generated/stvk.h"

namespace tissu {

static_assert(Law<Hooke>);
static_assert(Law<StVK>);

Lame lame(double young, double poisson) {
  if (!std::isfinite(young) || young <= 0.0) {
    throw ParameterError("Young's modulus is " + number_text(young) + " Pa; it must be positive and finite.");
  }
  if (!(poisson > -1.0 && poisson < 0.5)) {
    throw ParameterError(
        "Poisson's ratio is " + number_text(poisson) +
        "; it must lie between -1 and 0.5, both excluded (0.49 for nearly incompressible tissue).");
  }
  return {young * poisson / ((1.0 + poisson) * (1.0 - 2.0 * poisson)), young / (2.0 * (1.0 + poisson))};
}

}  // namespace tissu
