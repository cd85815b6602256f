#pragma once

/// Sheets and lines that share nodes with cells of a higher dimension go with the material of these.

#include <cstdint>
#include <functional>
#include <span>
#include <utility>
#include <vector>

#include "edit/cut/crossings.h"
#include "edit/cut/patch.h"

namespace tissu {

/// The vertices of a face of a triangle or of a piece of a line; all of them for `kWholePiece`.
std::vector<std::int32_t> thin_vertices(const Patch::Tetra& thin, std::uint8_t face);

/// The piece of the highest dimension that has all vertices of a thin one: the chosen one, else that of the
/// cell with the lowest number. -1: there is none.
std::int32_t top_carrier(const Patch& patch, std::int32_t thin);

/// Whether two pieces of one dimension hang together by pieces around all these vertices.
bool hang_together(const Patch& patch, std::int32_t a, std::int32_t b,
                   std::span<const std::int32_t> vertices);

/// Which pieces hang together across dimensions. A triangle of a sheet, or a piece of a line, whose vertices
/// all belong to a piece of a higher dimension goes with that one. Else each of its faces that no cut opened
/// goes with one that has the vertices of the face. Of several it is the one that the blade chose
/// (`Patch::chosen`), else that of the cell with the lowest number.
class Carriers {
 public:
  Carriers() = default;
  Carriers(const Patch& patch, const std::vector<char>& seen);

  /// Both ways, ascending.
  [[nodiscard]] const std::vector<std::pair<std::int32_t, std::int32_t>>& pairs() const { return pairs_; }
  /// The pairs that begin with this piece.
  [[nodiscard]] std::span<const std::pair<std::int32_t, std::int32_t>> at(std::int32_t piece) const;

 private:
  void join(const Patch& patch, std::int32_t thin, const std::vector<std::int32_t>& carriers,
            std::uint8_t face);

  std::vector<std::pair<std::int32_t, std::int32_t>> pairs_;
};

/// Chooses for thin pieces on the cut carriers on their own side of the blade (`Patch::chosen`). Carriers
/// that lie in the cut have no side. Where all carriers of one of its faces are on the other side, `open` is
/// called for the face. `above`: whether a piece is above the blade.
void choose_carriers(Patch& patch, const OnCut& known, const std::function<bool(std::int32_t)>& above,
                     const std::function<void(std::int32_t, std::uint8_t)>& open);

}  // namespace tissu
