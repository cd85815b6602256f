#include "tissu/law/law_info.h"

#include <cmath>
#include <sstream>
#include <string>

#include "tissu/base/error.h"

namespace tissu {
namespace {

std::string with_unit(double value, std::string_view unit) {
  std::ostringstream text;
  text.precision(12);
  text << value;
  if (unit != "1") text << ' ' << unit;
  return text.str();
}

void check_range(std::string_view law, const LawParameter& p, double value) {
  const bool low = p.lower_included ? value < p.lower : value <= p.lower;
  if (std::isfinite(value) && !low && value < p.upper) return;
  throw ParameterError(std::string(law) + ": " + std::string(p.name) + " is " + with_unit(value, p.unit) +
                       "; accepted is " + std::string(p.accepted) + ".");
}

}  // namespace

const LawInfo* find_law(std::string_view name) {
  for (const LawInfo& law : all_laws()) {
    if (law.name == name) return &law;
  }
  return nullptr;
}

void require(double value, std::string_view law, std::string_view field, std::string_view accepted) {
  if (value > 0.0) return;
  throw ParameterError(std::string(law) + ": " + std::string(field) + " is " + with_unit(value, "1") +
                       "; accepted is " + std::string(accepted) + ".");
}

void law_constants(const LawInfo& law, std::span<const double> parameters, std::span<double> constants) {
  if (parameters.size() != law.parameters.size() || constants.size() != law.constants.size()) {
    throw ParameterError(std::string(law.name) + ": " + std::to_string(parameters.size()) +
                         " parameters are given; accepted are " + std::to_string(law.parameters.size()) +
                         ", for " + std::to_string(law.constants.size()) + " constants.");
  }
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    check_range(law.name, law.parameters[i], parameters[i]);
  }
  law.compute(parameters.data(), constants.data());
  for (std::size_t i = 0; i < constants.size(); ++i) {
    if (!std::isfinite(constants[i])) {
      throw ParameterError(std::string(law.name) + ": the parameters give a constant " +
                           std::string(law.constants[i]) + " that is not finite; take smaller ones.");
    }
  }
}

}  // namespace tissu
