#pragma once

/// A body that is cut, and all that must be true of it after each cut.

#include <cstdint>
#include <functional>
#include <random>
#include <string>
#include <vector>

#include "tissu/edit/cut/cut_plan.h"
#include "tissu/edit/cut/material_mesh.h"
#include "tissu/edit/cut/snap.h"
#include "tissu/edit/repair/plan_repair.h"

namespace tissu::test {

/// A box filled with cells of one type, its inner nodes moved by up to `jitter` of a cell's edge.
Mesh typed_box(CellType type, const Vec3& size, std::array<int, 3> cells, double jitter, std::uint64_t seed);

class CutBody {
 public:
  explicit CutBody(const Mesh& mesh);
  /// Moves every present place by a map.
  void move(const std::function<Vec3(const Vec3&)>& map);

  /// Plans, applies to hosts, material and places.
  CutPlan cut(const Sweep& sweep, const CutOptions& options = {});
  /// Nodes move onto the blade where they may; all may if `rules` has no list.
  CutPlan snap(const Sweep& sweep, CutOptions options = {}, SnapRules rules = {});
  /// Bad cells are repaired; all nodes may move if `rules` has no list.
  RepairPlan repair(const RepairOptions& options = {}, RepairRules rules = {});
  CutPlan ablate(const std::vector<std::int32_t>& cells);
  Sweep plane(const Vec3& point, const Vec3& normal) const;

  /// The first thing that is not as it must be, empty when all is: volumes, shares, weights, closed surface,
  /// areas, no hanging vertex, nodes apart where pieces are.
  [[nodiscard]] std::string fault() const;
  /// V - E + F - C of the material; edges and vertices by fans.
  [[nodiscard]] int characteristic() const;
  [[nodiscard]] std::size_t piece_count() const { return pieces(hosts, material).size(); }
  [[nodiscard]] double volume() const;
  [[nodiscard]] double cut_area() const;

  Hosts hosts;
  tissu::Material material;
  std::vector<double> x;

 private:
  void apply(const CutPlan& plan);
  [[nodiscard]] std::string tetrahedra_fault() const;
  [[nodiscard]] std::string share_fault() const;
  [[nodiscard]] std::string surface_fault() const;
  [[nodiscard]] std::string pieces_fault() const;
  [[nodiscard]] std::vector<MaterialTetra> list(std::int32_t cell) const;

  std::vector<double> first_volumes_;  ///< of each first-day cell's material; 0 where it was taken out
  double outer_area_ = 0.0;
  bool ablated_ = false;
  bool repaired_ = false;
};

/// A random blade near the box 0..size: a plane, a disc, a strip of triangles or a bent sweep; now and then
/// exactly through a node.
Sweep random_sweep(std::mt19937_64& random, const CutBody& body);

}  // namespace tissu::test
