#pragma once

/// Of what the cells of a body are made.

#include <cstdint>
#include <span>
#include <unordered_map>

#include "tissu/world/description.h"

namespace tissu {

class CellKinds {
 public:
  /// Of a body whose cells are numbered, which must live as long.
  explicit CellKinds(const BodyDescription& body);

  /// Which block of the body a cell is in, and where.
  struct Place {
    std::size_t block;
    std::size_t cell;
  };
  [[nodiscard]] const Place& place(std::int32_t cell) const { return places_.at(cell); }
  /// Whether cells have one law, density and share.
  [[nodiscard]] bool are_alike(std::span<const std::int32_t> cells) const;

 private:
  const BodyDescription& body_;
  std::unordered_map<std::int32_t, Place> places_;
};

}  // namespace tissu
