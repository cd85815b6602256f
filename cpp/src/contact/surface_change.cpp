#include "tissu/contact/surface_change.h"

#include <algorithm>
#include <array>
#include <utility>

#include "tissu/base/vec.h"

namespace tissu {
namespace {

std::size_t at(std::int32_t i) { return static_cast<std::size_t>(i); }

template <std::size_t n>
using Key = std::array<std::int32_t, n>;

template <std::size_t n>
Key<n> ascending(Key<n> key) {
  std::ranges::sort(key);
  return key;
}

/// Finds numbers by keys.
template <std::size_t n>
class Index {
 public:
  void add(const Key<n>& key, std::int32_t number) { rows_.push_back({key, number}); }
  void sort() { std::ranges::sort(rows_); }
  [[nodiscard]] std::int32_t find(const Key<n>& key) const {
    return find(key, [](std::int32_t) { return true; });
  }
  /// The first one of those with this key that is the right one; the first one of all if none is.
  template <class Right>
  [[nodiscard]] std::int32_t find(const Key<n>& key, Right&& is_right) const {
    const auto first = std::ranges::lower_bound(rows_, std::pair(key, std::int32_t{0}));
    if (first == rows_.end() || first->first != key) return -1;
    for (auto row = first; row != rows_.end() && row->first == key; ++row) {
      if (is_right(row->second)) return row->second;
    }
    return first->second;
  }

 private:
  std::vector<std::pair<Key<n>, std::int32_t>> rows_;
};

}  // namespace

SurfaceChange::SurfaceChange(const SurfaceSet& before, const SurfaceSet& after)
    : before_(before), after_(after) {
  match_surfaces();
  match_vertices();
  match_primitives();
  match_edges();
  owners_.resize(after.edges().size());
  for (std::int32_t p = 0; p < static_cast<std::int32_t>(after.primitives().size()); ++p) {
    for (const std::int32_t e : after.edges_of(p)) owners_[at(e)] = p;
  }
}

void SurfaceChange::match_surfaces() {
  for (const SurfaceSet::Surface& surface : before_.surfaces()) {
    const auto found = std::ranges::find(after_.surfaces(), surface.name, &SurfaceSet::Surface::name);
    const bool known = found != after_.surfaces().end() && (found->obstacle < 0) == (surface.obstacle < 0);
    surfaces_.push_back(known ? static_cast<std::int32_t>(found - after_.surfaces().begin()) : -1);
  }
}

/// The vertices of a surface stand in the order of their nodes. At the edge of a cut in a sheet, which
/// contact meets half a thickness beside its node, a vertex is another one than before.
void SurfaceChange::match_vertices() {
  for (std::size_t v = 0; v < before_.vertices().size(); ++v) {
    const SurfaceVertex& vertex = before_.vertices()[v];
    const std::int32_t number = surface(vertex.surface);
    vertices_.push_back(-1);
    if (number < 0) continue;
    const SurfaceSet::Surface& of = after_.surfaces()[at(number)];
    const auto begin = after_.vertices().begin() + of.first_vertex;
    const auto end = after_.vertices().begin() + of.last_vertex;
    const auto found = std::ranges::lower_bound(begin, end, vertex.node, {}, &SurfaceVertex::node);
    if (found == end || found->node != vertex.node) continue;
    const auto now = static_cast<std::int32_t>(found - after_.vertices().begin());
    const Vec3 was_at = block(ConstReals(before_.rest()), static_cast<std::int32_t>(v));
    if (found->radius > 0.0 && block(ConstReals(after_.rest()), now) != was_at) continue;
    vertices_.back() = now;
  }
}

void SurfaceChange::match_edges() {
  Index<2> index;
  for (std::size_t e = 0; e < after_.edges().size(); ++e) {
    index.add(ascending(after_.edges()[e].vertex), static_cast<std::int32_t>(e));
  }
  index.sort();
  for (const SurfaceEdge& edge : before_.edges()) {
    const auto key = ascending(Key<2>{vertex(edge.vertex[0]), vertex(edge.vertex[1])});
    // Of several wedges at an edge, the one that a triangle beside it belongs to.
    edges_.push_back(index.find(key, [&](std::int32_t e) {
      const auto& faces = after_.edges()[at(e)].face;
      return std::ranges::any_of(edge.face, [&](std::int32_t p) {
        return p >= 0 && primitive(p) >= 0 && std::ranges::find(faces, primitive(p)) != faces.end();
      });
    }));
  }
}

void SurfaceChange::match_primitives() {
  Index<3> index;
  for (std::size_t p = 0; p < after_.primitives().size(); ++p) {
    index.add(ascending(after_.primitives()[p].vertex), static_cast<std::int32_t>(p));
  }
  index.sort();
  for (const Primitive& primitive : before_.primitives()) {
    Key<3> key = primitive.vertex;
    bool there = true;
    for (int i = 0; i < primitive.corners; ++i) {
      key[at(i)] = vertex(key[at(i)]);
      there = there && key[at(i)] >= 0;
    }
    primitives_.push_back(there ? index.find(ascending(key)) : -1);
  }
}

bool SurfaceChange::carry(ContactNumbers& contact) const {
  for (double& v : contact.vertex) {
    if (v < 0.0) continue;
    v = vertex(static_cast<std::int32_t>(v));
    if (v < 0.0) return false;
  }
  return carry_features(contact);
}

/// What its key consists of.
bool SurfaceChange::carry_features(ContactNumbers& contact) const {
  const auto a = static_cast<std::int32_t>(contact.a);
  const auto b = static_cast<std::int32_t>(contact.b);
  if (contact.kind == ContactNumbers::kPlane) {
    contact.a = vertex(a);
    // Obstacles keep their numbers: an edit changes bodies.
    return contact.a >= 0.0;
  }
  switch (static_cast<PairKind>(contact.kind)) {
    case PairKind::edge_edge:
      contact.a = edge(a);
      contact.b = edge(b);
      // Points of an edge are numbered from its first end.
      if (contact.point != 0.0 && !(runs_as_before(a) && runs_as_before(b))) return false;
      if (contact.a >= 0.0 && contact.b >= 0.0) order_edges(contact);
      break;
    case PairKind::vertex_face: {
      contact.a = vertex(a);
      contact.b = primitive(b);
      // Points of a face are numbered from its corners.
      if (contact.b < 0.0 || contact.point == 0.0) break;
      const auto& corners = after_.primitives()[static_cast<std::size_t>(contact.b)].vertex;
      for (std::size_t k = 0; k < 3; ++k) {
        if (vertex(before_.primitives()[at(b)].vertex[k]) != corners[k]) return false;
      }
      break;
    }
    case PairKind::vertex_edge:
      contact.a = vertex(a);
      contact.b = edge(b);
      break;
    case PairKind::vertex_vertex:
      contact.a = vertex(a);
      contact.b = vertex(b);
      break;
  }
  return contact.a >= 0.0 && contact.b >= 0.0;
}

bool SurfaceChange::runs_as_before(std::int32_t e) const {
  const std::int32_t now = edge(e);
  return now >= 0 && vertex(before_.edges()[at(e)].vertex[0]) == after_.edges()[at(now)].vertex[0];
}

/// Of two edges of one body, that of the lower primitive is the first.
void SurfaceChange::order_edges(ContactNumbers& contact) const {
  const auto owner = [&](double e) { return owners_[static_cast<std::size_t>(e)]; };
  const auto surface_of = [&](double v) { return after_.vertices()[static_cast<std::size_t>(v)].surface; };
  if (surface_of(contact.vertex[0]) != surface_of(contact.vertex[2])) return;
  if (owner(contact.a) <= owner(contact.b)) return;
  std::swap(contact.a, contact.b);
  for (const std::size_t k : {std::size_t{0}, std::size_t{1}}) {
    std::swap(contact.vertex[k], contact.vertex[k + 2]);
    std::swap(contact.beta[k], contact.beta[k + 2]);
  }
  for (double& beta : contact.beta) beta = -beta;
  for (auto* side : {&contact.fixed, &contact.normal, &contact.place, &contact.push, &contact.drag}) {
    for (double& x : *side) x = -x;
  }
}

}  // namespace tissu
