#pragma once

/// The surface of a body's volumes as contact meets it (kerf.h), followed from edit to edit: after an edit
/// only what it touched is looked at.

#include <array>
#include <cstdint>
#include <map>
#include <span>
#include <unordered_map>
#include <utility>
#include <vector>

#include "edit/cut/kerf.h"
#include "edit/cut/outer_triangles.h"
#include "tissu/edit/cut/cut_plan.h"
#include "tissu/edit/cut/hosts.h"
#include "tissu/edit/cut/material.h"

namespace tissu {

class KerfTable {
 public:
  /// `depth` as in kerf_surface.
  KerfTable(const Hosts& hosts, const Material& material, double depth);

  /// Before the plan is applied to hosts and material, …
  void begin(const Hosts& hosts, const Material& material, const CutPlan& plan);
  /// … and afterwards.
  void end(const Hosts& hosts, const Material& material, const CutPlan& plan);
  /// As kerf_surface gives it.
  [[nodiscard]] KerfSurface surface() const;
  /// Of each of its triangles, whether the latest edit may have changed it or moved a vertex of it.
  [[nodiscard]] std::vector<std::uint8_t> changed() const;

 private:
  /// Where a vertex stands: the first-day nodes that carry it, with its weights; alike at copies.
  using Place = std::array<std::pair<std::int32_t, double>, 4>;
  struct Use {
    std::int32_t corners = 0;  ///< of outer triangles at the vertex
    std::int32_t walls = 0;    ///< of those that a blade opened
  };
  void look(const Hosts& hosts, const Material& material, std::span<const std::int32_t> around);
  void take(const OuterTriangle& triangle, std::int32_t sign);
  void place(const Hosts& hosts, const Material& material);
  void draw(const Hosts& hosts, const Material& material);

  double depth_;
  std::map<std::int32_t, std::vector<OuterTriangle>> triangles_;  ///< of each cell that has some
  std::unordered_map<std::int32_t, Use> uses_;                    ///< of each vertex of the surface
  std::map<std::int32_t, Rider> carried_;
  std::map<Place, std::vector<std::int32_t>> twins_;  ///< vertices of the surface by where they stand
  std::unordered_map<std::int32_t, Place> places_;    ///< of the same
  std::vector<std::int32_t> cells_;                   ///< whose outer triangles may differ after the edit
  std::vector<std::int32_t> vertices_;                ///< around which something may differ
};

}  // namespace tissu
