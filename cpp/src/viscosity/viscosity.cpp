#include "tissu/viscosity/viscosity.h"

#include <cmath>

#include "tissu/base/error.h"
#include "tissu/base/number_text.h"

namespace tissu {
namespace {

void check(const std::string& body, const std::string& what, double value, const std::string& unit,
           bool may_be_zero) {
  if (std::isfinite(value) && (may_be_zero ? value >= 0.0 : value > 0.0)) return;
  throw ParameterError("body \"" + body + "\" has " + what + " of " + number_text(value) + unit +
                       "; it must be finite and " + (may_be_zero ? "not negative." : "above 0."));
}

}  // namespace

void check_viscosity(const std::string& body, const Viscosity& viscosity) {
  check(body, "a shear viscosity", viscosity.shear, " Pa s", true);
  check(body, "a bulk viscosity", viscosity.bulk, " Pa s", true);
  check(body, "a centroid viscosity", viscosity.centroid, " N s/m4", true);
  for (const PronyBranch& branch : viscosity.prony) {
    check(body, "a Prony branch with a weight", branch.weight, "", true);
    check(body, "a Prony branch with a time", branch.time, " s", false);
  }
  if (viscosity.prony.size() <= Viscosity::kMostBranches) return;
  throw ParameterError("body \"" + body + "\" has " + std::to_string(viscosity.prony.size()) +
                       " Prony branches; at most " + std::to_string(Viscosity::kMostBranches) +
                       " are accepted.");
}

}  // namespace tissu
