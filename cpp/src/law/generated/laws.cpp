// Made from python/tissu/codegen/laws
// by `python -m tissu.codegen --update` (generator 1, SymPy 1.14.0). Do not edit.

#include <cmath>
#include <limits>

#include "tissu/law/law_info.h"

namespace tissu {
namespace {

constexpr double kAny = std::numeric_limits<double>::infinity();

namespace hooke {

constexpr LawParameter kParameters[] = {
    {"young", "Pa", "Young's modulus at small strain", "above 0", 3000.0, 0.0, kAny, false},
    {"poisson", "1", "Poisson's ratio at small strain", "above -1 and below 0.5", 0.4, -1.0, 0.5, false}};
constexpr std::string_view kConstants[] = {"lambda", "mu"};

void compute(const double* parameters, double* constants) {
  const double young = parameters[0];
  const double poisson = parameters[1];
  const double lambda = poisson * young / (poisson + 1.0) / (1.0 - 2.0 * poisson);
  constants[0] = lambda;
  const double mu = young / (2.0 * poisson + 2.0);
  constants[1] = mu;
}

Lame small_strain(const double* constants) {
  const double lambda = constants[0];
  const double mu = constants[1];
  return {lambda, mu};
}

}  // namespace hooke

namespace stvk {

constexpr LawParameter kParameters[] = {
    {"young", "Pa", "Young's modulus at small strain", "above 0", 3000.0, 0.0, kAny, false},
    {"poisson", "1", "Poisson's ratio at small strain", "above -1 and below 0.5", 0.4, -1.0, 0.5, false}};
constexpr std::string_view kConstants[] = {"lambda", "mu"};

void compute(const double* parameters, double* constants) {
  const double young = parameters[0];
  const double poisson = parameters[1];
  const double lambda = poisson * young / (poisson + 1.0) / (1.0 - 2.0 * poisson);
  constants[0] = lambda;
  const double mu = young / (2.0 * poisson + 2.0);
  constants[1] = mu;
}

Lame small_strain(const double* constants) {
  const double lambda = constants[0];
  const double mu = constants[1];
  return {lambda, mu};
}

}  // namespace stvk

namespace neo_hooke {

constexpr LawParameter kParameters[] = {
    {"young", "Pa", "Young's modulus at small strain", "above 0", 3000.0, 0.0, kAny, false},
    {"poisson", "1", "Poisson's ratio at small strain", "above -1 and below 0.5", 0.4, -1.0, 0.5, false}};
constexpr std::string_view kConstants[] = {"lambda", "mu"};

void compute(const double* parameters, double* constants) {
  const double young = parameters[0];
  const double poisson = parameters[1];
  const double lambda = poisson * young / (poisson + 1.0) / (1.0 - 2.0 * poisson);
  constants[0] = lambda;
  const double mu = young / (2.0 * poisson + 2.0);
  constants[1] = mu;
}

Lame small_strain(const double* constants) {
  const double lambda = constants[0];
  const double mu = constants[1];
  return {lambda, mu};
}

}  // namespace neo_hooke

namespace stable_neo_hooke {

constexpr LawParameter kParameters[] = {
    {"young", "Pa", "Young's modulus at small strain", "above 0", 3000.0, 0.0, kAny, false},
    {"poisson", "1", "Poisson's ratio at small strain", "above -1 and below 0.5", 0.4, -1.0, 0.5, false}};
constexpr std::string_view kConstants[] = {"mu_s", "lambda_s", "alpha"};

void compute(const double* parameters, double* constants) {
  const double young = parameters[0];
  const double poisson = parameters[1];
  const double mu_s = (4.0 / 3.0) * young / (2.0 * poisson + 2.0);
  constants[0] = mu_s;
  const double lambda_s =
      (5.0 / 6.0) * young / (2.0 * poisson + 2.0) + poisson * young / (poisson + 1.0) / (1.0 - 2.0 * poisson);
  constants[1] = lambda_s;
  const double alpha = 0.75 * mu_s / lambda_s + 1.0;
  constants[2] = alpha;
}

Lame small_strain(const double* constants) {
  const double mu_s = constants[0];
  const double lambda_s = constants[1];
  return {lambda_s - 0.625 * mu_s, 0.75 * mu_s};
}

}  // namespace stable_neo_hooke

namespace mooney_rivlin {

constexpr LawParameter kParameters[] = {
    {"c1", "Pa", "weight of Ibar1 - 3", "any finite number", 400.0, -kAny, kAny, false},
    {"c2", "Pa", "weight of Ibar2 - 3", "any finite number", 100.0, -kAny, kAny, false},
    {"kappa", "Pa", "bulk modulus", "above 0", 20000.0, 0.0, kAny, false}};
constexpr std::string_view kConstants[] = {"c1", "c2", "kappa"};

void compute(const double* parameters, double* constants) {
  const double c1 = parameters[0];
  const double c2 = parameters[1];
  const double kappa = parameters[2];
  require(c1 + c2, "mooney_rivlin", "c1 + c2", "a sum above 0 (half the shear modulus)");
  constants[0] = c1;
  constants[1] = c2;
  constants[2] = kappa;
}

Lame small_strain(const double* constants) {
  const double c1 = constants[0];
  const double c2 = constants[1];
  const double kappa = constants[2];
  return {kappa - (4.0 / 3.0) * c1 - (4.0 / 3.0) * c2, 2.0 * c1 + 2.0 * c2};
}

}  // namespace mooney_rivlin

namespace yeoh {

constexpr LawParameter kParameters[] = {
    {"c1", "Pa", "half the shear modulus at rest", "above 0", 500.0, 0.0, kAny, false},
    {"c2", "Pa", "weight of (Ibar1 - 3)^2", "any finite number", 120.0, -kAny, kAny, false},
    {"c3", "Pa", "weight of (Ibar1 - 3)^3", "any finite number", 30.0, -kAny, kAny, false},
    {"kappa", "Pa", "bulk modulus", "above 0", 20000.0, 0.0, kAny, false}};
constexpr std::string_view kConstants[] = {"c1", "c2", "c3", "kappa"};

void compute(const double* parameters, double* constants) {
  const double c1 = parameters[0];
  const double c2 = parameters[1];
  const double c3 = parameters[2];
  const double kappa = parameters[3];
  constants[0] = c1;
  constants[1] = c2;
  constants[2] = c3;
  constants[3] = kappa;
}

Lame small_strain(const double* constants) {
  const double c1 = constants[0];
  const double kappa = constants[3];
  return {kappa - (4.0 / 3.0) * c1, 2.0 * c1};
}

}  // namespace yeoh

namespace arruda_boyce {

constexpr LawParameter kParameters[] = {
    {"mu", "Pa", "scale of the stress", "above 0", 900.0, 0.0, kAny, false},
    {"lambda_m", "1", "stretch at which chains lock", "above 1", 1.6, 1.0, kAny, false},
    {"kappa", "Pa", "bulk modulus", "above 0", 20000.0, 0.0, kAny, false}};
constexpr std::string_view kConstants[] = {"b1", "b2", "b3", "b4", "b5", "kappa"};

void compute(const double* parameters, double* constants) {
  const double mu = parameters[0];
  const double lambda_m = parameters[1];
  const double kappa = parameters[2];
  const double b1 = 0.5 * mu;
  constants[0] = b1;
  const double b2 = (1.0 / 20.0) * mu / (lambda_m * lambda_m);
  constants[1] = b2;
  const double b3 = (11.0 / 1050.0) * mu / (lambda_m * lambda_m * lambda_m * lambda_m);
  constants[2] = b3;
  const double b4 = (19.0 / 7000.0) * mu / (lambda_m * lambda_m * lambda_m * lambda_m * lambda_m * lambda_m);
  constants[3] = b4;
  const double b5 = (519.0 / 673750.0) * mu /
                    (lambda_m * lambda_m * lambda_m * lambda_m * lambda_m * lambda_m * lambda_m * lambda_m);
  constants[4] = b5;
  constants[5] = kappa;
}

Lame small_strain(const double* constants) {
  const double b1 = constants[0];
  const double b2 = constants[1];
  const double b3 = constants[2];
  const double b4 = constants[3];
  const double b5 = constants[4];
  const double kappa = constants[5];
  return {kappa - 540.0 * b5 - 144.0 * b4 - 36.0 * b3 - 8.0 * b2 - (4.0 / 3.0) * b1,
          2.0 * b1 + 12.0 * b2 + 54.0 * b3 + 216.0 * b4 + 810.0 * b5};
}

}  // namespace arruda_boyce

namespace fibre {

constexpr LawParameter kParameters[] = {
    {"k1", "Pa", "stiffness of the fibres", "above 0", 2000.0, 0.0, kAny, false},
    {"k2", "1", "how fast they stiffen", "above 0", 0.8, 0.0, kAny, false},
    {"direction_x", "1", "direction at rest, x", "any finite number", 0.6, -kAny, kAny, false},
    {"direction_y", "1", "direction at rest, y", "any finite number", -0.48, -kAny, kAny, false},
    {"direction_z", "1", "direction at rest, z", "any finite number", 0.64, -kAny, kAny, false}};
constexpr std::string_view kConstants[] = {"k1", "k2", "a0", "a1", "a2"};

void compute(const double* parameters, double* constants) {
  const double k1 = parameters[0];
  const double k2 = parameters[1];
  const double direction_x = parameters[2];
  const double direction_y = parameters[3];
  const double direction_z = parameters[4];
  require(std::sqrt(direction_x * direction_x + direction_y * direction_y + direction_z * direction_z),
          "fibre", "direction", "a vector that is not zero");
  constants[0] = k1;
  constants[1] = k2;
  const double a0 = direction_x / std::sqrt(direction_x * direction_x + direction_y * direction_y +
                                            direction_z * direction_z);
  constants[2] = a0;
  const double a1 = direction_y / std::sqrt(direction_x * direction_x + direction_y * direction_y +
                                            direction_z * direction_z);
  constants[3] = a1;
  const double a2 = direction_z / std::sqrt(direction_x * direction_x + direction_y * direction_y +
                                            direction_z * direction_z);
  constants[4] = a2;
}

}  // namespace fibre

constexpr LawInfo kLaws[] = {
    {"hooke", hooke::kParameters, hooke::kConstants, false, false, &hooke::compute, &hooke::small_strain},
    {"stvk", stvk::kParameters, stvk::kConstants, true, false, &stvk::compute, &stvk::small_strain},
    {"neo_hooke", neo_hooke::kParameters, neo_hooke::kConstants, true, false, &neo_hooke::compute,
     &neo_hooke::small_strain},
    {"stable_neo_hooke", stable_neo_hooke::kParameters, stable_neo_hooke::kConstants, true, false,
     &stable_neo_hooke::compute, &stable_neo_hooke::small_strain},
    {"mooney_rivlin", mooney_rivlin::kParameters, mooney_rivlin::kConstants, true, false,
     &mooney_rivlin::compute, &mooney_rivlin::small_strain},
    {"yeoh", yeoh::kParameters, yeoh::kConstants, true, false, &yeoh::compute, &yeoh::small_strain},
    {"arruda_boyce", arruda_boyce::kParameters, arruda_boyce::kConstants, true, false, &arruda_boyce::compute,
     &arruda_boyce::small_strain},
    {"fibre", fibre::kParameters, fibre::kConstants, true, true, &fibre::compute, nullptr},
};

}  // namespace

std::span<const LawInfo> all_laws() { return kLaws; }

}  // namespace tissu
