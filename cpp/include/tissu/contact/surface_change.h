#pragma once

/// What of the surfaces is still there after an edit of a world. An edit describes the surfaces anew, in any
/// way; what they have in common stays, so that contacts keep what they remember.

#include <cstdint>
#include <vector>

#include "tissu/contact/contact.h"
#include "tissu/contact/surface_set.h"
#include "tissu/contact/travel.h"

namespace tissu {

/// A surface is the same by its name, a vertex by its node, an edge and a triangle by their nodes.
class SurfaceChange {
 public:
  SurfaceChange(const SurfaceSet& before, const SurfaceSet& after);

  /// Numbers afterwards; -1: it is gone.
  [[nodiscard]] std::int32_t surface(std::int32_t before) const { return of(surfaces_, before); }
  [[nodiscard]] std::int32_t vertex(std::int32_t before) const { return of(vertices_, before); }
  [[nodiscard]] std::int32_t edge(std::int32_t before) const { return of(edges_, before); }
  [[nodiscard]] std::int32_t primitive(std::int32_t before) const { return of(primitives_, before); }

  /// Gives a contact the numbers that it has afterwards. False: a part of it is gone, and the contact with
  /// it.
  [[nodiscard]] bool carry(ContactNumbers& contact) const;

 private:
  using Numbers = std::vector<std::int32_t>;
  static std::int32_t of(const Numbers& numbers, std::int32_t i) {
    return numbers[static_cast<std::size_t>(i)];
  }
  void match_surfaces();
  void match_vertices();
  void match_edges();
  void match_primitives();
  [[nodiscard]] bool carry_features(ContactNumbers& contact) const;
  [[nodiscard]] bool runs_as_before(std::int32_t edge) const;
  void order_edges(ContactNumbers& contact) const;

  const SurfaceSet& before_;
  const SurfaceSet& after_;
  Numbers surfaces_, vertices_, edges_, primitives_;
  Numbers owners_;  ///< of the edges afterwards: the primitive that each belongs to
};

}  // namespace tissu
