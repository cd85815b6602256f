#include "edit/repair/links.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <map>
#include <set>
#include <vector>

namespace tissu {
namespace {

using Edge = std::array<std::int32_t, 2>;
using Triangle = std::array<std::int32_t, 3>;

constexpr std::int32_t kOutside = -1;  ///< closes the surface

template <std::size_t n>
std::array<std::int32_t, n> ascending(std::array<std::int32_t, n> nodes) {
  std::ranges::sort(nodes);
  return nodes;
}

/// The triangles opposite to a node.
std::vector<Triangle> link_of(const RepairMesh& mesh, std::int32_t node) {
  std::vector<Triangle> link;
  for (const std::int32_t number : mesh.cells_at(node)) {
    Triangle others{};
    std::ranges::remove_copy(mesh.cell(number).nodes, others.begin(), node);
    link.push_back(ascending(others));
  }
  for (const RepairMesh::Face& face : mesh.border(node))
    link.push_back(ascending(Triangle{face.others[0], face.others[1], kOutside}));
  return link;
}

std::array<Edge, 3> edges_of(const Triangle& t) {
  return {Edge{t[0], t[1]}, Edge{t[0], t[2]}, Edge{t[1], t[2]}};
}

/// Every edge between two triangles, V - E + F = 2, and in one part.
bool is_sphere(const std::vector<Triangle>& link) {
  std::map<Edge, std::vector<std::size_t>> sides;
  std::set<std::int32_t> nodes;
  for (std::size_t t = 0; t < link.size(); ++t) {
    nodes.insert(link[t].begin(), link[t].end());
    for (const Edge& edge : edges_of(link[t])) sides[edge].push_back(t);
  }
  if (std::ranges::any_of(sides, [](const auto& side) { return side.second.size() != 2; })) return false;
  if (nodes.size() + link.size() != sides.size() + 2) return false;
  std::set<std::size_t> seen{0};
  std::vector<std::size_t> front{0};
  while (!front.empty()) {
    const std::size_t t = front.back();
    front.pop_back();
    for (const Edge& edge : edges_of(link[t])) {
      for (const std::size_t other : sides.at(edge)) {
        if (seen.insert(other).second) front.push_back(other);
      }
    }
  }
  return seen.size() == link.size();
}

struct Simplices {
  std::set<std::int32_t> nodes;
  std::set<Edge> edges;
  std::set<Triangle> triangles;
};

Simplices simplices(const std::vector<Triangle>& link) {
  Simplices found;
  for (const Triangle& t : link) {
    found.nodes.insert(t.begin(), t.end());
    for (const Edge& edge : edges_of(t)) found.edges.insert(edge);
    found.triangles.insert(t);
  }
  return found;
}

template <class T>
std::vector<T> common(const std::set<T>& a, const std::set<T>& b) {
  std::vector<T> both;
  std::ranges::set_intersection(a, b, std::back_inserter(both));
  return both;
}

}  // namespace

bool may_contract(const RepairMesh& mesh, std::int32_t u, std::int32_t v) {
  const std::vector<Triangle> of_u = link_of(mesh, u);
  const std::vector<Triangle> of_v = link_of(mesh, v);
  if (!is_sphere(of_u) || !is_sphere(of_v)) return false;
  std::set<std::int32_t> nodes;
  std::set<Edge> edges;
  for (const Triangle& t : of_u) {
    if (std::ranges::find(t, v) == t.end()) continue;
    Edge edge{};
    std::ranges::remove_copy(t, edge.begin(), v);
    edges.insert(edge);
    nodes.insert(edge.begin(), edge.end());
  }
  const Simplices first = simplices(of_u);
  const Simplices second = simplices(of_v);
  const auto is_of_edge = [&](std::int32_t node) { return nodes.contains(node); };
  return std::ranges::all_of(common(first.nodes, second.nodes), is_of_edge) &&
         std::ranges::all_of(common(first.edges, second.edges),
                             [&](const Edge& edge) { return edges.contains(edge); }) &&
         common(first.triangles, second.triangles).empty();
}

}  // namespace tissu
