#pragma once

/// The laws by name: what a user gives, what a kernel stores. The table is made from the formulae.

#include <span>
#include <string_view>

#include "tissu/law/law.h"

namespace tissu {

struct LawParameter {
  std::string_view name;
  std::string_view unit;  ///< SI, "1" for none
  std::string_view meaning;
  std::string_view accepted;  ///< the range in words
  double typical;             ///< of soft tissue
  double lower;
  double upper;         ///< excluded
  bool lower_included;  ///< else excluded
};

struct LawInfo {
  std::string_view name;
  std::span<const LawParameter> parameters;
  std::span<const std::string_view> constants;  ///< in the order of the law's members
  bool frame_invariant;
  bool addition;  ///< to be added to a base law
  /// Constants of parameters whose ranges are checked; refuses what several parameters do not meet together.
  void (*compute)(const double* parameters, double* constants);
  Lame (*small_strain)(const double* constants);  ///< null for an addition
};

/// Every law, in the order of AllLaws.
std::span<const LawInfo> all_laws();

/// Null when there is none of this name.
const LawInfo* find_law(std::string_view name);

/// Constants of parameters. Throws ParameterError with the field, its value and what is accepted.
void law_constants(const LawInfo& law, std::span<const double> parameters, std::span<double> constants);

/// Throws ParameterError unless value > 0. For conditions on several parameters.
void require(double value, std::string_view law, std::string_view field, std::string_view accepted);

}  // namespace tissu
