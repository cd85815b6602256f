#include "edit/cut/divide.h"

#include <algorithm>
#include <map>
#include <string>
#include <utility>

#include "edit/cut/fans.h"
#include "edit/cut/fragments.h"
#include "edit/cut/write_plan.h"
#include "tissu/base/error.h"
#include "tissu/base/index.h"
#include "tissu/base/sort_unique.h"

namespace tissu {
namespace {

using Numbers = std::vector<std::int32_t>;

/// The body with its cells divided, and no node parted yet.
class Divided {
 public:
  Divided(const Hosts& hosts, const Material& material, const Patch& patch, const OnIncisions& met)
      : patch_(patch),
        first_(hosts.node_count()),
        plan_(),
        hosts_(Hosts::over(hosts)),
        material_{material.riders, {}, material.incisions} {
    plan_.first_node = first_;
    add_nodes();
    add_cells(hosts.next_cell());
    add_incisions(material, met);
    hosts_.apply(plan_);
    material_.apply(plan_);
    sort_unique(touched_);
    around_ = hosts_.with_neighbours(touched_);
    for (const std::int32_t cell : around_) {
      const auto known = material.cells.find(cell);
      if (known != material.cells.end()) material_.cells.insert(*known);  // where the plan has no other
    }
  }

  [[nodiscard]] const CutPlan& plan() const { return plan_; }
  [[nodiscard]] const Hosts& hosts() const { return hosts_; }
  /// Of the cells around.
  [[nodiscard]] const Material& material() const { return material_; }
  /// New cells and those with an opened face, ascending.
  [[nodiscard]] const Numbers& touched() const { return touched_; }
  /// Those, and the cells at their nodes.
  [[nodiscard]] const Numbers& around() const { return around_; }
  [[nodiscard]] std::vector<double> places(ConstReals x) const {
    std::vector<double> all(x.begin(), x.end());
    for (const BornNode& node : plan_.nodes) {
      const Vec3 place = node.between.at(x);
      all.insert(all.end(), place.data(), place.data() + 3);
    }
    return all;
  }

 private:
  /// The node that a vertex of the patch is from now on.
  [[nodiscard]] std::int32_t node(std::int32_t vertex) const {
    const std::int32_t number = patch_.vertex(vertex).number;
    return number >= 0 ? number : first_ + (-1 - number);
  }

  void add_nodes() {
    for (const Patch::Vertex& vertex : patch_.vertices) {
      if (vertex.number < 0) plan_.nodes.push_back({-1, true, vertex.rider});
    }
  }

  void add_cells(std::int32_t next) {
    std::vector<Numbers> tetrahedra(patch_.cells.size());
    for (std::size_t t = 0; t < patch_.tetrahedra.size(); ++t)
      tetrahedra[at(patch_.tetrahedra[t].cell)].push_back(static_cast<std::int32_t>(t));
    for (std::size_t c = 0; c < tetrahedra.size(); ++c) {
      const Patch::Cell& cell = patch_.cells[c];
      if (!cell.divided && !cell.opened) continue;
      if (cell.divided) plan_.gone.push_back(cell.number);
      for (const std::int32_t t : tetrahedra[c]) add_cell(cell, patch_.tetra(t), next);
    }
  }

  void add_cell(const Patch::Cell& cell, const Patch::Tetra& tetra, std::int32_t& next) {
    const std::int32_t number = cell.divided ? next++ : cell.number;
    MaterialTetra own;
    own.cut = tetra.cut;
    own.vertices[3] = kNoVertex;
    for (std::size_t i = 0; i < tetra.corners(); ++i) own.vertices[i] = node(tetra.vertices[i]);
    const auto end = own.vertices.begin() + static_cast<std::ptrdiff_t>(tetra.corners());
    if (cell.divided) plan_.born.push_back({number, cell.number, 1.0, {own.vertices.begin(), end}});
    if (own.cut != 0) plan_.material.cells.emplace_back(number, std::vector<MaterialTetra>{own});
    touched_.push_back(number);
  }

  /// Vertices that the blade put on its incision; between two of an incision, those of another blade too.
  void add_incisions(const Material& material, const OnIncisions& met) {
    std::map<std::int32_t, Incision> lists;
    for (const Incision& incision : material.incisions) {
      Incision& list = lists[incision.number] = incision;
      add_divided(on(incision.vertices), list.vertices);
      std::vector<char> front = on(incision.front);
      add_ends(on(incision.vertices), front);
      add_divided(std::move(front), list.front);
    }
    for (const auto& [number, known] : met) {
      std::vector<char> on(patch_.vertices.size(), 0);
      for (std::size_t v = 0; v < known.vertices.size(); ++v) on[v] = known.vertices[v].on ? 1 : 0;
      add_divided(on, lists[number].vertices);
      add_divided(std::move(on), lists[number].front);
    }
    for (auto& [number, list] : lists) {
      list.number = number;
      sort_unique(list.vertices);
      sort_unique(list.front);
      plan_.material.incisions.push_back(std::move(list));
    }
  }

  [[nodiscard]] std::vector<char> on(const Numbers& vertices) const {
    std::vector<char> on(patch_.vertices.size(), 0);
    for (std::size_t v = 0; v < on.size(); ++v)
      on[v] = std::ranges::binary_search(vertices, patch_.vertices[v].number) ? 1 : 0;
    return on;
  }

  /// Vertices between two of an incision, of which one is at its front, are at its front.
  void add_ends(std::vector<char> on, std::vector<char>& front) const {
    for (const auto& [vertex, p, q] : patch_.divisions) {
      if (on[at(p)] == 0 || on[at(q)] == 0) continue;
      on[at(vertex)] = 1;
      if (front[at(p)] != 0 || front[at(q)] != 0) front[at(vertex)] = 1;
    }
  }

  void add_divided(std::vector<char> on, Numbers& list) const {
    for (const auto& [vertex, p, q] : patch_.divisions) {
      if (on[at(p)] != 0 && on[at(q)] != 0) on[at(vertex)] = 1;
    }
    for (std::size_t v = 0; v < on.size(); ++v) {
      if (on[v] != 0) list.push_back(node(static_cast<std::int32_t>(v)));
    }
  }

  const Patch& patch_;
  std::int32_t first_;
  CutPlan plan_;
  Hosts hosts_;
  Material material_;
  Numbers touched_;
  Numbers around_;
};

/// One plan of two: cells are divided, then nodes part.
void join(const CutPlan& divided, CutPlan parted, CutPlan& plan) {
  plan.first_node = divided.first_node;
  plan.gone = divided.gone;
  plan.born = divided.born;
  for (ChangedCell& cell : parted.changed) {
    const auto born = std::ranges::lower_bound(plan.born, cell.number, {}, &BornCell::number);
    if (born != plan.born.end() && born->number == cell.number) {
      born->nodes = std::move(cell.nodes);
    } else {
      plan.changed.push_back(std::move(cell));
    }
  }
  plan.nodes = divided.nodes;
  plan.nodes.insert(plan.nodes.end(), parted.nodes.begin(), parted.nodes.end());
  plan.emptied = std::move(parted.emptied);
  std::map<std::int32_t, std::vector<MaterialTetra>> cells;
  for (const auto& [number, list] : divided.material.cells) cells[number] = list;
  for (auto& [number, list] : parted.material.cells) cells[number] = std::move(list);
  plan.material.cells.assign(cells.begin(), cells.end());
  plan.material.incisions = std::move(parted.material.incisions);
}

}  // namespace

void refuse_undivided(const Hosts& hosts, const Material& material, const Numbers& cells) {
  for (const std::int32_t cell : cells) {
    if (hosts.type(cell) == CellType::tetra || hosts.type(cell) == CellType::triangle) continue;
    throw ParameterError(
        "the cut meets cell " + std::to_string(cell) + " of type " +
        std::string(info(hosts.type(cell)).name) +
        "; tetrahedra and triangles of first order are accepted where editing says subdivide: take "
        "method: virtual.");
  }
  const auto is_part = [&](std::int32_t cell) { return hosts.share(cell) < 1.0; };
  if (material.riders.empty() && std::ranges::none_of(cells, is_part)) return;
  throw ParameterError(
      "the body was cut by virtual copies before, whose parts are not divided; go on with method: virtual, "
      "or "
      "start again.");
}

bool write_division(const Hosts& hosts, const Material& material, ConstReals x, const Patch& patch,
                    const OnIncisions& met, CutPlan& plan) {
  const Divided divided(hosts, material, patch, met);
  const std::vector<double> places = divided.places(x);
  const Patch now(divided.hosts(), divided.material(), places, divided.around());
  const Fragments fragments(divided.hosts(), now, divided.touched(), {});
  const Replicas replicas = find_replicas(divided.hosts(), now, fragments);
  Numbers parted;
  for (const std::int32_t cell : divided.touched()) {
    for (const std::int32_t node : divided.hosts().nodes(cell)) parted.push_back(now.place_of(node));
  }
  sort_unique(parted);
  const Fans fans(now, fragments, parted);
  CutPlan of_nodes;
  write_plan(divided.hosts(), divided.material(), now, fragments, replicas, fans, of_nodes);
  write_incisions(now, divided.material(), {}, fans, of_nodes);
  const bool parts = !of_nodes.nodes.empty();
  join(divided.plan(), std::move(of_nodes), plan);
  return parts;
}

}  // namespace tissu
