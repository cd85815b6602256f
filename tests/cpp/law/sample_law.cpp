/// A shared library with one law, as python/tissu/user_law/source.py writes them: neo-Hooke under another
/// name. TISSU_TEST_LAYOUT is the version it claims.

#include <cmath>
#include <limits>

#include "law/kernels/point.h"
#include "tissu/law/generated/neo_hooke.h"
#include "tissu/law/law_library.h"

#ifndef TISSU_TEST_SET
#define TISSU_TEST_SET "baseline"
#endif
#ifndef TISSU_TEST_LAYOUT
#define TISSU_TEST_LAYOUT kLawLibraryVersion
#endif

namespace tissu {
namespace {

constexpr double kAny = std::numeric_limits<double>::infinity();
constexpr LawLibraryParameter kParameters[] = {
    {"lambda", "Pa", "first of Lamé's constants", "any finite number", 4000.0, -kAny, kAny, 0},
    {"mu", "Pa", "shear modulus", "above 0", 1000.0, 0.0, kAny, 0}};
constexpr const char* kConstants[] = {"lambda", "mu"};

void compute(const double* parameters, double* constants) {
  constants[0] = parameters[0];
  constants[1] = parameters[1];
}
void small_strain(const double* constants, double* lambda_and_mu) { compute(constants, lambda_and_mu); }
double bulk(const double* parameters) { return parameters[0] + 2.0 / 3.0 * parameters[1]; }
constexpr LawLibraryRequirement kRequirements[] = {{"lambda + 2 mu / 3", "a bulk modulus above 0", &bulk}};

constexpr LawKernels kTable = TISSU_KERNELS::LawAtPoints<NeoHooke>::table();
constexpr LawLibraryKernels kKernels[] = {
    {kTable.dimension, kTable.energy, kTable.stress, kTable.stress_change, kTable.tangent}};
constexpr LawLibrary kLibrary = {TISSU_TEST_LAYOUT,
                                 sizeof(LawLibrary),
                                 TISSU_KERNELS::kLanes,
                                 TISSU_TEST_SET,
                                 "sample",
                                 kTable.linear,
                                 true,
                                 kTable.isotropic,
                                 false,
                                 2,
                                 2,
                                 1,
                                 1,
                                 kParameters,
                                 kConstants,
                                 kRequirements,
                                 kKernels,
                                 &compute,
                                 &small_strain};

}  // namespace
}  // namespace tissu

extern "C" [[gnu::visibility("default")]] const tissu::LawLibrary* tissu_law_v2() { return &tissu::kLibrary; }
