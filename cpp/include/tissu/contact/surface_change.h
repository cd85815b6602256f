#pragma once

/// What of the surfaces is still there after an edit of a world. An edit describes the surfaces anew, in any
/// way; what they have in common stays, so that contacts keep what they remember.

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "tissu/contact/contact.h"
#include "tissu/contact/surface_set.h"
#include "tissu/contact/travel.h"

namespace tissu {

/// A surface is the same by its name, a vertex by its node, an edge and a triangle by their nodes.
class SurfaceChange {
 public:
  SurfaceChange(const SurfaceSet& before, const SurfaceSet& after);

  /// Numbers afterwards; -1: it is gone. Each is looked for when it is asked for.
  [[nodiscard]] std::int32_t surface(std::int32_t before) const {
    return surfaces_[static_cast<std::size_t>(before)];
  }
  [[nodiscard]] std::int32_t vertex(std::int32_t before) const;
  [[nodiscard]] std::int32_t edge(std::int32_t before) const;
  [[nodiscard]] std::int32_t primitive(std::int32_t before) const;

  /// Gives a contact the numbers that it has afterwards. False: a part of it is gone, and the contact with
  /// it.
  [[nodiscard]] bool carry(ContactNumbers& contact) const;

 private:
  using Numbers = std::vector<std::int32_t>;
  /// Features afterwards by their lowest vertices, in ascending number.
  struct Lists {
    template <class Feature>
    Lists(const std::vector<Feature>& features, std::size_t vertices);
    [[nodiscard]] std::span<const std::int32_t> of(std::int32_t vertex) const {
      const auto v = static_cast<std::size_t>(vertex);
      return std::span(items).subspan(static_cast<std::size_t>(begin[v]),
                                      static_cast<std::size_t>(begin[v + 1] - begin[v]));
    }
    Numbers begin;
    Numbers items;
  };
  [[nodiscard]] bool carry_features(ContactNumbers& contact) const;
  [[nodiscard]] bool runs_as_before(std::int32_t edge) const;
  void order_edges(ContactNumbers& contact) const;

  const SurfaceSet& before_;
  const SurfaceSet& after_;
  Numbers surfaces_;
  Lists edges_at_, primitives_at_;
  Numbers owners_;  ///< of the edges afterwards: the primitive that each belongs to
};

}  // namespace tissu
