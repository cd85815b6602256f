#include "edit/cut/incisions.h"

#include <algorithm>
#include <map>
#include <utility>

#include "tissu/base/sort_unique.h"

namespace tissu {
namespace {

using Numbers = std::vector<std::int32_t>;

std::size_t at(std::int32_t i) { return static_cast<std::size_t>(i); }

/// An edge between two vertices of an incision is one of its surface, so that a vertex which another blade
/// puts on the edge is on that incision too: else the faces there would never open. `on`: vertices of the
/// patch that are on it.
void add_divided(const Patch& patch, std::vector<char> on, const Fans& fans, Numbers& list) {
  for (const auto& [vertex, p, q] : patch.divisions) {
    if (on[at(p)] == 0 || on[at(q)] == 0 || on[at(vertex)] != 0) continue;
    on[at(vertex)] = 1;
    const Numbers now = fans.numbers(vertex);
    list.insert(list.end(), now.begin(), now.end());
  }
}

}  // namespace

void remember_incisions(const Patch& patch, const Material& material, const OnIncisions& met, CutPlan& plan) {
  std::map<std::int32_t, Numbers> lists;
  for (const auto& [number, known] : met) {
    for (std::size_t v = 0; v < known.vertices.size(); ++v) {
      if (known.vertices[v].on) lists[number].push_back(patch.vertices[v].number);
    }
  }
  for (auto& [number, list] : lists) {
    const auto before = std::ranges::find(material.incisions, number, &Incision::number);
    if (before != material.incisions.end())
      list.insert(list.end(), before->vertices.begin(), before->vertices.end());
    sort_unique(list);
    if (before == material.incisions.end() || list != before->vertices)
      plan.material.incisions.push_back({number, std::move(list)});
  }
}

OnCut known_before(const Patch& patch, const Material& material, std::int32_t number) {
  OnCut known(patch.vertices.size());
  for (const Incision& incision : material.incisions) {
    if (incision.number != number || number < 0) continue;
    for (std::size_t v = 0; v < patch.vertices.size(); ++v) {
      const Patch::Vertex& vertex = patch.vertices[v];
      if (!std::ranges::binary_search(incision.vertices, vertex.number)) continue;
      known.put_on(static_cast<std::int32_t>(v), vertex.place, vertex.place, -1);
      known.vertices[v].before = true;
    }
  }
  for (const Patch::Division& division : patch.divisions) {
    if (!known[division.p].before || !known[division.q].before) continue;
    const Vec3& place = patch.vertex(division.vertex).place;
    known.put_on(division.vertex, place, place, -1);
    known.vertices[at(division.vertex)].before = true;
  }
  return known;
}

void write_incisions(const Patch& patch, const Material& material, const OnIncisions& met, const Fans& fans,
                     CutPlan& plan) {
  std::map<std::int32_t, Numbers> lists;
  for (const Incision& incision : material.incisions) {
    for (const std::int32_t vertex : incision.vertices) {
      const std::int32_t place = patch.place_of(vertex);
      const Numbers now = place < 0 ? Numbers{vertex} : fans.numbers(place);
      Numbers& list = lists[incision.number];
      list.insert(list.end(), now.begin(), now.end());
    }
    std::vector<char> on(patch.vertices.size(), 0);
    for (std::size_t v = 0; v < on.size(); ++v)
      on[v] = std::ranges::binary_search(incision.vertices, patch.vertices[v].number) ? 1 : 0;
    add_divided(patch, std::move(on), fans, lists[incision.number]);
  }
  for (const auto& [number, known] : met) {
    std::vector<char> on(patch.vertices.size(), 0);
    for (std::size_t v = 0; v < known.vertices.size(); ++v) {
      if (!known.vertices[v].on) continue;
      on[v] = 1;
      const Numbers now = fans.numbers(static_cast<std::int32_t>(v));
      lists[number].insert(lists[number].end(), now.begin(), now.end());
    }
    add_divided(patch, std::move(on), fans, lists[number]);
  }
  for (auto& [number, list] : lists) {
    sort_unique(list);
    plan.material.incisions.push_back({number, std::move(list)});
  }
}

}  // namespace tissu
