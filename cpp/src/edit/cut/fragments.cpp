#include "edit/cut/fragments.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <set>
#include <utility>

#include "edit/cut/joins.h"
#include "tissu/base/disjoint_sets.h"
#include "tissu/base/index.h"
#include "tissu/base/sort_unique.h"
#include "tissu/mesh/cell_shape.h"

namespace tissu {
namespace {

constexpr double kOnFace = 1e-9;  ///< of a tetrahedron's height: a point so far outside is in it

/// The corners in the middle between which a node beside the corners lies in the material: the ends of its
/// edge, or those of the diagonal of its face or cell along which the material of a whole cell is divided
/// (whole_material).
std::array<std::int32_t, 2> ends_around(const Hosts& hosts, std::int32_t cell, std::size_t node) {
  const CellType type = hosts.type(cell);
  const auto nodes = hosts.corners(cell);
  const auto ends = edges(type);
  if (node < nodes.size() + ends.size()) {
    const auto& [a, b] = ends[node - nodes.size()];
    return {nodes[a], nodes[b]};
  }
  const auto root = [&](std::int32_t one) { return hosts.root(one); };
  const auto across = [&](std::span<const std::int32_t> quad) {
    const auto low = static_cast<std::size_t>(std::ranges::min_element(quad, {}, root) - quad.begin());
    return std::array{quad[low], quad[(low + 2) % quad.size()]};
  };
  if (info(type).dimension == 2) return across(nodes);
  std::array<std::int32_t, 4> quad{};
  for (const LocalFace& face : faces(type)) {
    if (face.nodes % 2 == 0 || face.node[at(face.nodes - 1)] != node) continue;
    for (std::size_t c = 0; c < quad.size(); ++c) quad[c] = nodes[face.node[c]];
    return across(quad);
  }
  const std::int32_t low = *std::ranges::min_element(nodes, {}, root);
  const auto shares_face = [&](std::int32_t other) {
    return std::ranges::any_of(faces(type), [&](const LocalFace& face) {
      const auto corners = std::span(face.node).first(at(face.corners));
      const auto has = [&](std::int32_t one) {
        return std::ranges::any_of(corners, [&](std::uint8_t c) { return nodes[c] == one; });
      };
      return has(low) && has(other);
    });
  };
  return {low, *std::ranges::find_if_not(nodes, shares_face)};
}

}  // namespace

Fragments::Fragments(const Hosts& hosts, const Patch& patch, const std::vector<std::int32_t>& touched,
                     const std::vector<std::int32_t>& removed)
    : hosts_(hosts), patch_(patch), of_(patch.tetrahedra.size(), -1) {
  find_nodes(touched);
  find_fragments(removed);
  find_groups();
}

std::span<const std::int32_t> Fragments::nodes(std::int32_t fragment) const {
  const Fragment& f = fragments_[at(fragment)];
  const std::size_t count = hosts_.nodes(patch_.cell(f.cell).number).size();
  return std::span(item_node_).subspan(at(f.first_item), count);
}

std::int32_t Fragments::becomes(std::int32_t fragment, std::int32_t node) const {
  const auto before = hosts_.nodes(patch_.cell(fragments_[at(fragment)].cell).number);
  return nodes(fragment)[static_cast<std::size_t>(std::ranges::find(before, node) - before.begin())];
}

void Fragments::find_nodes(const std::vector<std::int32_t>& touched) {
  for (const std::int32_t cell : touched) {
    touched_nodes_.insert(touched_nodes_.end(), hosts_.nodes(cell).begin(), hosts_.nodes(cell).end());
  }
  sort_unique(touched_nodes_);
  for (const std::int32_t node : touched_nodes_) {
    const auto cells = hosts_.cells_at(node);
    cells_.insert(cells_.end(), cells.begin(), cells.end());
  }
  sort_unique(cells_);
}

void Fragments::find_fragments(const std::vector<std::int32_t>& removed) {
  std::vector<std::int32_t> rank(patch_.cells.size(), -1);  // of the seen hosts, by number
  for (std::size_t i = 0; i < cells_.size(); ++i) {
    if (!std::ranges::binary_search(removed, cells_[i])) {
      rank[at(patch_.cell_of(cells_[i]))] = static_cast<std::int32_t>(i);
    }
  }
  std::vector<char> seen(patch_.tetrahedra.size(), 0);
  std::vector<std::int32_t> order;
  for (std::size_t t = 0; t < seen.size(); ++t) {
    if (rank[at(patch_.tetrahedra[t].cell)] < 0) continue;
    seen[t] = 1;
    order.push_back(static_cast<std::int32_t>(t));
  }
  across_ = joins(patch_.tetrahedra, seen);
  carriers_ = Carriers(patch_, seen);
  DisjointSets sets(seen.size());
  for (const std::int32_t t : order) {
    for (const std::int32_t other : across_[at(t)]) {
      if (other >= 0 && patch_.tetra(other).cell == patch_.tetra(t).cell) sets.join(t, other);
    }
  }
  std::ranges::stable_sort(order, {}, [&](std::int32_t t) { return rank[at(patch_.tetra(t).cell)]; });
  std::vector<std::int32_t> number(seen.size(), -1);
  for (const std::int32_t t : order) {
    std::int32_t& own = number[at(sets.first(t))];
    if (own < 0) {
      own = static_cast<std::int32_t>(fragments_.size());
      const std::int32_t cell = patch_.tetra(t).cell;
      fragments_.push_back({cell, static_cast<std::int32_t>(item_fragment_.size()), 0.0});
      item_fragment_.resize(item_fragment_.size() + hosts_.nodes(patch_.cell(cell).number).size(), own);
    }
    of_[at(t)] = own;
    fragments_[at(own)].volume += patch_.rest_volume(patch_.tetra(t));
  }
  std::ranges::stable_sort(order, {}, [&](std::int32_t t) { return of_[at(t)]; });
  tetra_order_ = std::move(order);
  tetra_first_.assign(fragments_.size() + 1, 0);
  for (const std::int32_t t : tetra_order_) ++tetra_first_[at(of_[at(t)]) + 1];
  std::partial_sum(tetra_first_.begin(), tetra_first_.end(), tetra_first_.begin());
}

/// Items are the nodes of fragments. Those of two hosts are joined where material joins the hosts across
/// their common face; each node then has as many copies as its items have sets.
void Fragments::find_groups() {
  std::vector<std::pair<std::int32_t, std::int32_t>> pairs;
  for (std::size_t t = 0; t < across_.size(); ++t) {
    for (const std::int32_t other : across_[t]) {
      if (other < 0) continue;
      const std::int32_t a = of_[t];
      const std::int32_t b = of_[at(other)];
      if (a != b) pairs.emplace_back(std::min(a, b), std::max(a, b));
    }
  }
  for (const auto& [one, other] : carriers_.pairs()) {
    if (one < other)
      pairs.emplace_back(std::min(of_[at(one)], of_[at(other)]), std::max(of_[at(one)], of_[at(other)]));
  }
  sort_unique(pairs);
  DisjointSets sets(item_fragment_.size());
  const auto before = [&](std::int32_t fragment) {
    return hosts_.nodes(patch_.cell(fragments_[at(fragment)].cell).number);
  };
  for (const auto& [a, b] : pairs) {
    const auto of_a = before(a);
    const auto of_b = before(b);
    for (std::size_t i = 0; i < of_a.size(); ++i) {
      const auto same = std::ranges::find(of_b, of_a[i]);
      if (same == of_b.end()) continue;
      sets.join(fragments_[at(a)].first_item + static_cast<std::int32_t>(i),
                fragments_[at(b)].first_item + static_cast<std::int32_t>(same - of_b.begin()));
    }
  }
  std::vector<std::vector<std::int32_t>> items(touched_nodes_.size());
  for (std::size_t f = 0; f < fragments_.size(); ++f) {
    const auto nodes = before(static_cast<std::int32_t>(f));
    item_node_.insert(item_node_.end(), nodes.begin(), nodes.end());
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      const auto place = std::ranges::lower_bound(touched_nodes_, nodes[i]);
      if (place == touched_nodes_.end() || *place != nodes[i]) continue;
      items[static_cast<std::size_t>(place - touched_nodes_.begin())].push_back(fragments_[f].first_item +
                                                                                static_cast<std::int32_t>(i));
    }
  }
  item_first_.resize(item_fragment_.size());
  for (std::size_t i = 0; i < item_first_.size(); ++i)
    item_first_[i] = sets.first(static_cast<std::int32_t>(i));
  for (std::size_t i = 0; i < items.size(); ++i) number_groups(touched_nodes_[i], items[i]);
}

/// Numbers the copies of a node: the one with material at it keeps the number, of several and of none the
/// first.
void Fragments::number_groups(std::int32_t node, const std::vector<std::int32_t>& items) {
  struct Copy {
    std::int32_t first;
    bool material;
    std::int32_t number;
  };
  std::vector<Copy> copies;
  for (const std::int32_t item : items) {
    const auto same = std::ranges::find(copies, item_first_[at(item)], &Copy::first);
    Copy& copy = same != copies.end() ? *same : copies.emplace_back(Copy{item_first_[at(item)], false, node});
    copy.material = copy.material || material_at(item);
  }
  const bool any = std::ranges::any_of(copies, &Copy::material);
  if (!any) emptied_.push_back(node);
  if (copies.size() < 2) return;
  const auto kept = any ? std::ranges::find(copies, true, &Copy::material) : copies.begin();
  for (auto copy = copies.begin(); copy != copies.end(); ++copy) {
    if (copy == kept) continue;
    copy->number = hosts_.node_count() + static_cast<std::int32_t>(born_.size());
    born_.push_back({node, copy->material});
  }
  for (const std::int32_t item : items) {
    item_node_[at(item)] = std::ranges::find(copies, item_first_[at(item)], &Copy::first)->number;
  }
}

/// How deep a point lies in a fragment, as a share of the height of the tetrahedron that holds it best;
/// negative outside.
double Fragments::depth(std::int32_t fragment, const Vec3& p) const {
  double best = -std::numeric_limits<double>::infinity();
  for (std::int32_t i = tetra_first_[at(fragment)]; i < tetra_first_[at(fragment) + 1]; ++i) {
    const Patch::Tetra& tetra = patch_.tetra(tetra_order_[at(i)]);
    if (tetra.corners() < 4) {
      best = std::max(best, depth_in(tetra, p));
      continue;
    }
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t f = 0; f < 4; ++f) {
      const auto corner = [&](std::size_t c) { return patch_.vertex(tetra.vertices[kOpposite[f][c]]).rest; };
      const Vec3 inward = -(corner(1) - corner(0)).cross(corner(2) - corner(0));
      const double height = inward.dot(patch_.vertex(tetra.vertices[f]).rest - corner(0));
      least = std::min(least, inward.dot(p - corner(0)) / height);
    }
    best = std::max(best, least);
  }
  return best;
}

/// The same of a triangle, or a piece of a line, and of the point of its plane or line below p.
double Fragments::depth_in(const Patch::Tetra& thin, const Vec3& p) const {
  const auto corner = [&](std::size_t i) { return patch_.vertex(thin.vertices[i]).rest; };
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t f = 0; f < thin.corners(); ++f) {
    const Vec3 foot = corner((f + 1) % thin.corners());
    Vec3 inward = corner(f) - foot;
    if (thin.corners() == 3) {
      const Vec3 along = corner((f + 2) % 3) - foot;
      inward -= inward.dot(along) / along.squaredNorm() * along;
    }
    least = std::min(least, inward.dot(p - foot) / inward.squaredNorm());
  }
  return least;
}

/// Whether there is material at a node of a fragment: at a corner a vertex; in the middle of an edge, a face
/// or a cell the fragment that holds the place, both where that is on the cut. Of a cell that was cut before,
/// other cells may have it.
bool Fragments::material_at(std::int32_t item) const {
  const std::int32_t fragment = item_fragment_[at(item)];
  const Fragment& own = fragments_[at(fragment)];
  const auto local = at(item - own.first_item);
  const std::int32_t cell = patch_.cell(own.cell).number;
  if (local < hosts_.corners(cell).size()) {
    const std::int32_t vertex = patch_.place_of(hosts_.nodes(cell)[local]);
    if (vertex < 0) return false;
    const auto& around = patch_.tetrahedra_at(vertex);
    return std::ranges::any_of(around, [&](std::int32_t t) { return of_[at(t)] == fragment; });
  }
  const auto of_cell = [&](std::int32_t f) { return fragments_[at(f)].cell == own.cell; };
  std::int32_t first = fragment;
  while (first > 0 && of_cell(first - 1)) --first;
  std::int32_t end = fragment + 1;
  while (end < static_cast<std::int32_t>(fragments_.size()) && of_cell(end)) ++end;
  const bool is_part = patch_.cell(own.cell).stored;
  if (end - first == 1 && !is_part) return true;
  const auto [a, b] = ends_around(hosts_, cell, local);
  const Vec3 middle = 0.5 * (block(hosts_.rest(), a) + block(hosts_.rest(), b));
  const double depth_here = depth(fragment, middle);
  double best = is_part ? 0.0 : depth_here;
  for (std::int32_t f = first; f < end && !is_part; ++f) best = std::max(best, depth(f, middle));
  return depth_here >= std::min(best, 0.0) - kOnFace;
}

}  // namespace tissu
