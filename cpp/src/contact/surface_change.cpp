#include "tissu/contact/surface_change.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>

#include "tissu/base/index.h"
#include "tissu/base/vec.h"

namespace tissu {
namespace {

template <std::size_t n>
using Key = std::array<std::int32_t, n>;

template <std::size_t n>
Key<n> ascending(Key<n> key) {
  std::ranges::sort(key);
  return key;
}

/// The corners of a primitive after an edit, ascending.
Key<3> key_of(const Primitive& primitive) { return ascending(primitive.vertex); }

/// The lowest vertex of an edge or a primitive.
std::int32_t lowest(const SurfaceEdge& edge) { return std::min(edge.vertex[0], edge.vertex[1]); }
std::int32_t lowest(const Primitive& primitive) {
  return *std::min_element(primitive.vertex.begin(), primitive.vertex.begin() + primitive.corners);
}

}  // namespace

/// Lists features by their lowest vertices.
template <class Feature>
SurfaceChange::Lists::Lists(const std::vector<Feature>& features, std::size_t vertices)
    : begin(vertices + 1, 0), items(features.size()) {
  for (const Feature& feature : features) ++begin[at(lowest(feature)) + 1];
  for (std::size_t v = 0; v < vertices; ++v) begin[v + 1] += begin[v];
  std::vector<std::int32_t> next(begin.begin(), begin.end() - 1);
  for (std::size_t i = 0; i < features.size(); ++i)
    items[at(next[at(lowest(features[i]))]++)] = static_cast<std::int32_t>(i);
}

SurfaceChange::SurfaceChange(const SurfaceSet& before, const SurfaceSet& after)
    : before_(before),
      after_(after),
      edges_at_(after.edges(), after.vertices().size()),
      primitives_at_(after.primitives(), after.vertices().size()) {
  for (const SurfaceSet::Surface& surface : before_.surfaces()) {
    const auto found = std::ranges::find(after_.surfaces(), surface.name, &SurfaceSet::Surface::name);
    const bool known = found != after_.surfaces().end() && (found->obstacle < 0) == (surface.obstacle < 0);
    surfaces_.push_back(known ? static_cast<std::int32_t>(found - after_.surfaces().begin()) : -1);
  }
  owners_.resize(after.edges().size());
  for (std::int32_t p = 0; p < static_cast<std::int32_t>(after.primitives().size()); ++p) {
    for (const std::int32_t e : after.edges_of(p)) owners_[at(e)] = p;
  }
}

/// The vertices of a surface stand in the order of their nodes. At the edge of a cut in a sheet, which
/// contact meets half a thickness beside its node, a vertex is another one than before.
std::int32_t SurfaceChange::vertex(std::int32_t before) const {
  const SurfaceVertex& vertex = before_.vertices()[at(before)];
  const std::int32_t number = surface(vertex.surface);
  if (number < 0) return -1;
  const SurfaceSet::Surface& of = after_.surfaces()[at(number)];
  const auto begin = after_.vertices().begin() + of.first_vertex;
  const auto end = after_.vertices().begin() + of.last_vertex;
  const auto found = std::ranges::lower_bound(begin, end, vertex.node, {}, &SurfaceVertex::node);
  if (found == end || found->node != vertex.node) return -1;
  const auto now = static_cast<std::int32_t>(found - after_.vertices().begin());
  const Vec3 was_at = block(ConstReals(before_.rest()), before);
  if (found->radius > 0.0 && block(ConstReals(after_.rest()), now) != was_at) return -1;
  return now;
}

/// Of several wedges at an edge, the one that a triangle beside it belongs to; else the first.
std::int32_t SurfaceChange::edge(std::int32_t before) const {
  const SurfaceEdge& edge = before_.edges()[at(before)];
  const auto key = ascending(Key<2>{vertex(edge.vertex[0]), vertex(edge.vertex[1])});
  if (key[0] < 0) return -1;
  std::int32_t first = -1;
  for (const std::int32_t e : edges_at_.of(key[0])) {
    const SurfaceEdge& other = after_.edges()[at(e)];
    if (ascending(other.vertex) != key) continue;
    const bool is_beside = std::ranges::any_of(edge.face, [&](std::int32_t p) {
      if (p < 0) return false;
      const std::int32_t now = primitive(p);
      return now >= 0 && std::ranges::find(other.face, now) != other.face.end();
    });
    if (is_beside) return e;
    if (first < 0) first = e;
  }
  return first;
}

std::int32_t SurfaceChange::primitive(std::int32_t before) const {
  Primitive primitive = before_.primitives()[at(before)];
  for (int i = 0; i < primitive.corners; ++i) {
    std::int32_t& corner = primitive.vertex[at(i)];
    corner = vertex(corner);
    if (corner < 0) return -1;
  }
  const Key<3> key = key_of(primitive);
  for (const std::int32_t p : primitives_at_.of(lowest(primitive))) {
    if (key_of(after_.primitives()[at(p)]) == key) return p;
  }
  return -1;
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
