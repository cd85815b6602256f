#include "edit/cut/carriers.h"

#include <algorithm>

#include "tissu/base/sort_unique.h"

namespace tissu {
namespace {

std::size_t at(std::int32_t i) { return static_cast<std::size_t>(i); }

}  // namespace

std::vector<std::int32_t> pieces_with(const Patch& patch, std::int32_t thin,
                                      std::span<const std::int32_t> vertices, const std::vector<char>& seen) {
  const std::size_t corners = patch.tetra(thin).corners();
  std::vector<std::int32_t> found;
  for (const std::int32_t piece : patch.tetrahedra_at(vertices.front())) {
    const Patch::Tetra& other = patch.tetra(piece);
    if (other.corners() <= corners || (!seen.empty() && seen[tissu::at(piece)] == 0)) continue;
    const auto is_in = [&](std::int32_t v) {
      return std::ranges::find(other.vertices, v) != other.vertices.end();
    };
    if (std::ranges::all_of(vertices, is_in)) found.push_back(piece);
  }
  std::ranges::sort(found, {}, [&](std::int32_t piece) {
    return std::pair(patch.cell(patch.tetra(piece).cell).number, piece);
  });
  return found;
}

std::vector<std::int32_t> vertices_of(const Patch::Tetra& thin, std::uint8_t face) {
  std::vector<std::int32_t> vertices;
  for (std::size_t i = 0; i < thin.corners(); ++i) {
    if (i != face) vertices.push_back(thin.vertices[i]);
  }
  return vertices;
}

Carriers::Carriers(const Patch& patch, const std::vector<char>& seen) : patch_(patch) {
  if (!patch.is_mixed()) return;
  for (std::size_t t = 0; t < patch.tetrahedra.size(); ++t) {
    const Patch::Tetra& thin = patch.tetrahedra[t];
    if (thin.corners() == 4 || seen[t] == 0) continue;
    const auto piece = static_cast<std::int32_t>(t);
    const auto whole = pieces_with(patch, piece, vertices_of(thin, kWholePiece), seen);
    if (!whole.empty()) {
      join(piece, whole, kWholePiece);
      continue;
    }
    for (std::uint8_t face = 0; face < thin.corners(); ++face) {
      if ((thin.cut >> face & 1U) == 0)
        join(piece, pieces_with(patch, piece, vertices_of(thin, face), seen), face);
    }
  }
  sort_unique(pairs_);
}

void Carriers::join(std::int32_t thin, const std::vector<std::int32_t>& carriers, std::uint8_t face) {
  if (carriers.empty()) return;
  std::int32_t carrier = carriers.front();
  for (const Patch::Chosen& chosen : patch_.chosen) {
    if (chosen.thin == thin && chosen.face == face && std::ranges::find(carriers, chosen.carrier) != carriers.end())
      carrier = chosen.carrier;
  }
  pairs_.emplace_back(thin, carrier);
  pairs_.emplace_back(carrier, thin);
}

std::span<const std::pair<std::int32_t, std::int32_t>> Carriers::at(std::int32_t piece) const {
  const auto found = std::ranges::equal_range(pairs_, piece, {}, &std::pair<std::int32_t, std::int32_t>::first);
  return {found.begin(), found.end()};
}

}  // namespace tissu
