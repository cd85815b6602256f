#pragma once

/// How much arithmetic an element needs, from formulae and not from what a kernel happens to do: the
/// figure that a rate is made of. Multiplications, additions and divisions count one each.

#include <optional>
#include <string_view>

#include "tissu/element/reference_cell.h"

namespace tissu::bench {

enum class Job { force, product, assembly };
inline constexpr Job kJobs[] = {Job::force, Job::product, Job::assembly};
std::string_view name(Job job);

/// The operations of a law at one point, counted by running it; nothing where the law has no such form.
struct LawOperations {
  double stress;
  double stress_change;
  double tangent;
};
std::optional<LawOperations> law_operations(std::string_view law, int dimension);

/// The operations of one element with N nodes, reference dimension m and the points g of its rule:
///   gradient   3 c_g + 6 m^2      sum_a x_a (x) dN_a, times J^-1; c_g sums over a and k what dN_a/dxi_k
///   costs:
///                                 nothing where it is 0, one where it is 1 or -1, else two
///   spread     6 m^2 + 3 m + 3 c_g     w P J^-T, times dN_a
///   force      sum_g gradient + stress + spread
///   product    sum_g 2 gradient + stress change + spread
///   assembly   sum_g gradient + tangent + t + m c_g + 18 m^2 n + 18 m n (n + 1) / 2, t = 3 m (3 m + 1) / 2:
///              the tangent times w, the gradients J^-T dN_a, then A grad_b for each node and grad_a . A
///              grad_b for each pair; n = N, but N - 1 on affine cells, where the first node's 9 (n^2 + n)
///              sums follow
double operations(const ReferenceCell& cell, bool affine, const LawOperations& law, Job job);

}  // namespace tissu::bench
