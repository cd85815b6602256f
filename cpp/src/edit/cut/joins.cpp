#include "edit/cut/joins.h"

#include <algorithm>
#include <bit>

#include "edit/cut/face_key.h"

namespace tissu {
namespace {

using Key = FaceKey;

Key face_key(const Patch::Tetra& tetra, std::size_t face) {
  Key key{tetra.vertices[kOpposite[face][0]], tetra.vertices[kOpposite[face][1]],
          tetra.vertices[kOpposite[face][2]]};
  if (key[0] > key[1]) std::swap(key[0], key[1]);
  if (key[1] > key[2]) std::swap(key[1], key[2]);
  if (key[0] > key[1]) std::swap(key[0], key[1]);
  return key;
}

/// Faces that wait for the tetrahedron on their other side, in a table of open addresses.
class Waiting {
 public:
  explicit Waiting(std::size_t count) : slots_(std::bit_ceil(2 * count + 1)) {}

  /// The side (tetrahedron * 4 + face) that waits at this face; where none does, this one waits: -1.
  std::int32_t meet(const Key& key, std::int32_t side) {
    std::size_t place = hash_of(key) & (slots_.size() - 1);
    while (slots_[place].side >= 0) {
      if (slots_[place].key == key) return slots_[place].side;
      place = (place + 1) & (slots_.size() - 1);
    }
    slots_[place] = {key, side};
    return -1;
  }

 private:
  struct Slot {
    Key key{};
    std::int32_t side = -1;
  };
  std::vector<Slot> slots_;
};

}  // namespace

std::vector<std::array<std::int32_t, 4>> joins(const std::vector<Patch::Tetra>& tetrahedra,
                                               const std::vector<char>& seen) {
  std::vector<std::array<std::int32_t, 4>> across(tetrahedra.size(), {-1, -1, -1, -1});
  const auto count = static_cast<std::size_t>(std::ranges::count(seen, char{1}));
  Waiting waiting(4 * count);
  for (std::size_t t = 0; t < tetrahedra.size(); ++t) {
    if (seen[t] == 0) continue;
    for (std::size_t f = 0; f < tetrahedra[t].corners(); ++f) {
      if ((tetrahedra[t].cut >> f & 1U) != 0) continue;
      const std::int32_t other =
          waiting.meet(face_key(tetrahedra[t], f), static_cast<std::int32_t>(4 * t + f));
      if (other < 0) continue;
      std::int32_t& next = across[static_cast<std::size_t>(other) / 4][static_cast<std::size_t>(other) % 4];
      across[t][f] = next < 0 ? other / 4 : next;
      next = static_cast<std::int32_t>(t);
    }
  }
  return across;
}

}  // namespace tissu
