#include "edit/cut/carriers.h"

#include <algorithm>

#include "tissu/base/index.h"
#include "tissu/base/sort_unique.h"

namespace tissu {
namespace {

bool has_all(const Patch::Tetra& piece, std::span<const std::int32_t> vertices) {
  return std::ranges::all_of(
      vertices, [&](std::int32_t v) { return std::ranges::find(piece.vertices, v) != piece.vertices.end(); });
}

/// The pieces of a higher dimension than `thin` that have all these vertices, by the numbers of their cells.
/// `seen`: only these pieces; empty: all.
std::vector<std::int32_t> pieces_with(const Patch& patch, std::int32_t thin,
                                      std::span<const std::int32_t> vertices, const std::vector<char>& seen) {
  const std::size_t corners = patch.tetra(thin).corners();
  std::vector<std::int32_t> found;
  for (const std::int32_t piece : patch.tetrahedra_at(vertices.front())) {
    const Patch::Tetra& other = patch.tetra(piece);
    if (other.corners() <= corners || (!seen.empty() && seen[at(piece)] == 0)) continue;
    if (has_all(other, vertices)) found.push_back(piece);
  }
  std::ranges::sort(found, {}, [&](std::int32_t piece) {
    return std::pair(patch.cell(patch.tetra(piece).cell).number, piece);
  });
  return found;
}

/// False where the vertices of a face are on the cut and no carrier is on the side of the thin piece.
bool choose(Patch& patch, const OnCut& known, const std::function<bool(std::int32_t)>& above,
            std::int32_t piece, std::uint8_t face, const std::vector<std::int32_t>& carriers) {
  const auto vertices = thin_vertices(patch.tetra(piece), face);
  if (!std::ranges::all_of(vertices, [&](std::int32_t v) { return known.on(v); })) return true;
  const bool side = above(piece);
  bool any = false;
  for (const std::int32_t carrier : carriers) {
    const auto has_side = [&](std::int32_t v) { return v >= 0 && !known.on(v); };
    if (std::ranges::none_of(patch.tetra(carrier).vertices, has_side)) continue;
    any = true;
    if (above(carrier) != side) continue;
    patch.chosen.push_back({piece, face, carrier});
    return true;
  }
  return !any;
}

}  // namespace

std::vector<std::int32_t> thin_vertices(const Patch::Tetra& thin, std::uint8_t face) {
  std::vector<std::int32_t> vertices;
  for (std::size_t i = 0; i < thin.corners(); ++i) {
    if (i != face) vertices.push_back(thin.vertices[i]);
  }
  return vertices;
}

std::int32_t top_carrier(const Patch& patch, std::int32_t thin) {
  if (patch.tetra(thin).corners() == 4) return -1;
  const auto whole = pieces_with(patch, thin, thin_vertices(patch.tetra(thin), kWholePiece), {});
  std::int32_t best = -1;
  for (const std::int32_t piece : whole) {
    if (best < 0 || patch.tetra(piece).corners() > patch.tetra(best).corners()) best = piece;
  }
  for (const Patch::Chosen& one : patch.chosen) {
    if (one.thin != thin || one.face != kWholePiece || std::ranges::find(whole, one.carrier) == whole.end())
      continue;
    if (patch.tetra(one.carrier).corners() == patch.tetra(best).corners()) best = one.carrier;
  }
  return best;
}

bool hang_together(const Patch& patch, std::int32_t a, std::int32_t b,
                   std::span<const std::int32_t> vertices) {
  std::vector<std::int32_t> left;
  for (const std::int32_t piece : patch.tetrahedra_at(vertices.front())) {
    if (patch.tetra(piece).corners() == patch.tetra(a).corners() && has_all(patch.tetra(piece), vertices))
      left.push_back(piece);
  }
  std::vector<std::int32_t> reached{a};
  for (std::size_t next = 0; next < reached.size(); ++next) {
    if (reached[next] == b) return true;
    const Patch::Tetra& own = patch.tetra(reached[next]);
    for (std::size_t f = 0; f < own.corners(); ++f) {
      const bool is_around = std::ranges::find(vertices, own.vertices[f]) == vertices.end();
      if (!is_around || (own.cut >> f & 1U) != 0) continue;
      const auto face = thin_vertices(own, static_cast<std::uint8_t>(f));
      for (const std::int32_t piece : left) {
        const bool known = std::ranges::find(reached, piece) != reached.end();
        if (!known && has_all(patch.tetra(piece), face)) reached.push_back(piece);
      }
    }
  }
  return false;
}

Carriers::Carriers(const Patch& patch, const std::vector<char>& seen) {
  if (!patch.is_mixed()) return;
  for (std::size_t t = 0; t < patch.tetrahedra.size(); ++t) {
    const Patch::Tetra& thin = patch.tetrahedra[t];
    if (thin.corners() == 4 || seen[t] == 0) continue;
    const auto piece = static_cast<std::int32_t>(t);
    const auto whole = pieces_with(patch, piece, thin_vertices(thin, kWholePiece), seen);
    if (!whole.empty()) {
      join(patch, piece, whole, kWholePiece);
      continue;
    }
    for (std::size_t f = 0; f < thin.corners(); ++f) {
      const auto face = static_cast<std::uint8_t>(f);
      if ((thin.cut >> face & 1U) == 0)
        join(patch, piece, pieces_with(patch, piece, thin_vertices(thin, face), seen), face);
    }
  }
  sort_unique(pairs_);
}

void Carriers::join(const Patch& patch, std::int32_t thin, const std::vector<std::int32_t>& carriers,
                    std::uint8_t face) {
  if (carriers.empty()) return;
  std::int32_t carrier = carriers.front();
  for (const Patch::Chosen& chosen : patch.chosen) {
    if (chosen.thin == thin && chosen.face == face &&
        std::ranges::find(carriers, chosen.carrier) != carriers.end())
      carrier = chosen.carrier;
  }
  pairs_.emplace_back(thin, carrier);
  pairs_.emplace_back(carrier, thin);
}

std::span<const std::pair<std::int32_t, std::int32_t>> Carriers::at(std::int32_t piece) const {
  const auto found =
      std::ranges::equal_range(pairs_, piece, {}, &std::pair<std::int32_t, std::int32_t>::first);
  return {found.begin(), found.end()};
}

void choose_carriers(Patch& patch, const OnCut& known, const std::function<bool(std::int32_t)>& above,
                     const std::function<void(std::int32_t, std::uint8_t)>& open) {
  for (std::size_t t = 0; t < patch.tetrahedra.size(); ++t) {
    const Patch::Tetra thin = patch.tetrahedra[t];
    const auto met = [&](std::int32_t v) { return v >= 0 && known.on(v); };
    if (thin.corners() == 4 || std::ranges::none_of(thin.vertices, met)) continue;
    const auto piece = static_cast<std::int32_t>(t);
    const auto whole = pieces_with(patch, piece, thin_vertices(thin, kWholePiece), {});
    if (!whole.empty()) {
      (void)choose(patch, known, above, piece, kWholePiece, whole);
      continue;
    }
    for (std::size_t f = 0; f < thin.corners(); ++f) {
      const auto face = static_cast<std::uint8_t>(f);
      if ((thin.cut >> face & 1U) != 0) continue;
      const auto carriers = pieces_with(patch, piece, thin_vertices(thin, face), {});
      if (!carriers.empty() && !choose(patch, known, above, piece, face, carriers)) open(piece, face);
    }
  }
}

}  // namespace tissu
