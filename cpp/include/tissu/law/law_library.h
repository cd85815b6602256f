#pragma once

/// What a shared library with one law hands over, in plain C, so that any compiler may have made it. A
/// library exports `extern "C" const tissu::LawLibrary* tissu_law_v2()`; a layout that changes gets another
/// number, in the name of that function too.

#include <cstdint>

namespace tissu {

inline constexpr std::int32_t kLawLibraryVersion = 2;
inline constexpr const char* kLawLibraryEntry = "tissu_law_v2";

/// As LawParameter of law_info.h.
struct LawLibraryParameter {
  const char* name;
  const char* unit;
  const char* meaning;
  const char* accepted;
  double typical;
  double lower;
  double upper;
  std::int32_t lower_included;
};

/// What several parameters meet together: value(parameters) > 0.
struct LawLibraryRequirement {
  const char* field;
  const char* accepted;
  double (*value)(const double* parameters);
};

/// As LawKernels of law_kernels.h.
struct LawLibraryKernels {
  std::int32_t dimension;
  void (*energy)(const double* constants, int points, const double* F, double* W);
  void (*stress)(const double* constants, int points, const double* F, double* P);
  void (*stress_change)(const double* constants, int points, const double* F, const double* dF, double* dP);
  void (*tangent)(const double* constants, int points, const double* F, double* A);
};

/// As LawInfo of law_info.h, with the kernels for each reference dimension. All of it lives as long as the
/// library.
struct LawLibrary {
  std::int32_t version;  ///< kLawLibraryVersion
  std::int32_t bytes;    ///< sizeof(LawLibrary)
  std::int32_t lanes;    ///< elements side by side in the arrays of the kernels
  const char* instruction_set;
  const char* name;
  std::int32_t linear;
  std::int32_t frame_invariant;
  std::int32_t isotropic;
  std::int32_t addition;
  std::int32_t parameter_count;
  std::int32_t constant_count;
  std::int32_t requirement_count;
  std::int32_t kernel_count;
  const LawLibraryParameter* parameters;
  const char* const* constants;
  const LawLibraryRequirement* requirements;
  const LawLibraryKernels* kernels;
  void (*compute)(const double* parameters, double* constants);
  void (*small_strain)(const double* constants, double* lambda_and_mu);  ///< null: not isotropic at rest
};

}  // namespace tissu
