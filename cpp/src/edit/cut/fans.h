#pragma once

/// The vertices of the material after a cut: those that opened faces part get copies.

#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include "edit/cut/fragments.h"
#include "edit/cut/patch.h"
#include "tissu/edit/cut/cut_plan.h"

namespace tissu {

/// Around a vertex, the tetrahedra that faces not opened join are a fan. Each fan has a vertex of its own;
/// the fan of the lowest cell keeps the number. A vertex at a node is that node, whichever copy of it the
/// fan's hosts have; a second fan at the same copy gets a rider of weight 1.
class Fans {
 public:
  /// `parted`: vertices (places) whose fans may be several, ascending; the others have one.
  Fans(const Patch& patch, const Fragments& fragments, const std::vector<std::int32_t>& parted);

  /// The vertices of each tetrahedron of the patch, by numbers after the cut.
  [[nodiscard]] const std::vector<std::array<std::int32_t, 4>>& vertices() const { return vertices_; }
  /// The riders that follow the old ones.
  [[nodiscard]] const std::vector<Rider>& riders() const { return riders_; }
  /// Old riders whose nodes are others now, by ascending place.
  [[nodiscard]] const std::vector<std::pair<std::int32_t, Rider>>& changed() const { return changed_; }
  /// The numbers that a vertex (place) has after the cut; its own where nothing changed.
  [[nodiscard]] std::vector<std::int32_t> numbers(std::int32_t vertex) const;

 private:
  void number_vertex(std::int32_t vertex, bool parted);
  void number_fan(std::int32_t vertex, const std::vector<std::int32_t>& fan, bool first);
  [[nodiscard]] std::vector<std::vector<std::int32_t>> fans_at(std::int32_t vertex) const;
  [[nodiscard]] std::int32_t cell_number(std::int32_t tetra) const;
  std::int32_t add_rider(const Rider& rider);

  const Patch& patch_;
  const Fragments& fragments_;
  std::vector<std::array<std::int32_t, 4>> vertices_;
  std::vector<Rider> riders_;
  std::vector<std::pair<std::int32_t, Rider>> changed_;
  std::vector<std::int32_t> taken_;  ///< nodes that fans of the vertex at hand are
};

}  // namespace tissu
