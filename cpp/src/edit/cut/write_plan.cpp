#include "edit/cut/write_plan.h"

#include <algorithm>
#include <map>

#include "tissu/base/index.h"

namespace tissu {
namespace {

void write_cells(const Hosts& hosts, const Patch& patch, const Fragments& fragments, const Replicas& replicas,
                 CutPlan& plan) {
  for (const Replicas::Replica& replica : replicas.all) {
    const std::int32_t host = patch.cell(replica.cell).number;
    const auto nodes = fragments.nodes(replica.fragment);
    if (replica.number != host) {
      if (plan.gone.empty() || plan.gone.back() != host) plan.gone.push_back(host);
      plan.born.push_back({replica.number, host, replica.share, {nodes.begin(), nodes.end()}});
    } else if (!std::ranges::equal(nodes, hosts.nodes(host))) {
      plan.changed.push_back({host, {nodes.begin(), nodes.end()}});
    }
  }
}

bool equal(const std::vector<MaterialTetra>& a, const std::vector<MaterialTetra>& b) {
  return std::ranges::equal(a, b, [](const MaterialTetra& p, const MaterialTetra& q) {
    return p.vertices == q.vertices && p.cut == q.cut;
  });
}

/// The lists of tetrahedra of all hosts of the patch, by numbers after the cut.
std::map<std::int32_t, std::vector<MaterialTetra>> lists_after(const Patch& patch, const Fragments& fragments,
                                                               const Replicas& replicas, const Fans& fans,
                                                               const std::vector<char>& gone) {
  std::map<std::int32_t, std::vector<MaterialTetra>> lists;
  for (std::size_t t = 0; t < patch.tetrahedra.size(); ++t) {
    const Patch::Tetra& tetra = patch.tetrahedra[t];
    if (gone[at(tetra.cell)] != 0) continue;
    const std::int32_t fragment = fragments.of(static_cast<std::int32_t>(t));
    const std::int32_t number = fragment < 0 ? patch.cell(tetra.cell).number
                                             : replicas.all[at(replicas.of_fragment[at(fragment)])].number;
    lists[number].push_back({fans.vertices()[t], tetra.cut});
  }
  return lists;
}

}  // namespace

Replicas find_replicas(const Hosts& hosts, const Patch& patch, const Fragments& fragments) {
  Replicas replicas;
  const auto& all = fragments.all();
  replicas.of_fragment.resize(all.size());
  std::int32_t next = hosts.next_cell();
  for (std::size_t first = 0; first < all.size();) {
    const std::size_t start = replicas.all.size();
    const std::int32_t host = patch.cell(all[first].cell).number;
    double volume = 0.0;
    std::size_t f = first;
    for (; f < all.size() && all[f].cell == all[first].cell; ++f) {
      const auto nodes = fragments.nodes(static_cast<std::int32_t>(f));
      std::size_t same = start;
      while (same < replicas.all.size() &&
             !std::ranges::equal(fragments.nodes(replicas.all[same].fragment), nodes)) {
        ++same;
      }
      if (same == replicas.all.size()) {
        replicas.all.push_back({all[f].cell, host, static_cast<std::int32_t>(f), 0.0});
      }
      replicas.of_fragment[f] = static_cast<std::int32_t>(same);
      replicas.all[same].share += all[f].volume;
      volume += all[f].volume;
    }
    const bool parted = replicas.all.size() - start > 1;
    for (std::size_t r = start; r < replicas.all.size(); ++r) {
      Replicas::Replica& replica = replicas.all[r];
      replica.share = parted ? hosts.share(host) * (replica.share / volume) : hosts.share(host);
      if (parted) replica.number = next++;
    }
    first = f;
  }
  return replicas;
}

void write_plan(const Hosts& hosts, const Material& material, const Patch& patch, const Fragments& fragments,
                const Replicas& replicas, const Fans& fans, CutPlan& plan) {
  std::vector<char> gone(patch.cells.size(), 0);  // removed: by the caller; replaced: below
  for (std::size_t c = 0; c < gone.size(); ++c) {
    gone[c] = std::ranges::binary_search(plan.gone, patch.cells[c].number) ? 1 : 0;
  }
  const auto removed = static_cast<std::ptrdiff_t>(plan.gone.size());
  write_cells(hosts, patch, fragments, replicas, plan);
  std::ranges::inplace_merge(plan.gone, plan.gone.begin() + removed);
  plan.first_node = hosts.node_count();
  plan.nodes = fragments.born();
  plan.emptied = fragments.emptied();
  plan.material.riders_changed = fans.changed();
  plan.material.riders_born = fans.riders();
  for (auto& [number, list] : lists_after(patch, fragments, replicas, fans, gone)) {
    const std::int32_t place = patch.cell_of(number);  // -1 for replicas
    const auto stored = material.cells.find(number);
    const bool whole =
        place >= 0 && !patch.cell(place).stored && !patch.cell(place).divided &&
        std::ranges::all_of(list, [](const MaterialTetra& tetra) {
          return tetra.cut == 0 && std::ranges::all_of(tetra.vertices, [](auto v) { return v >= 0; });
        });
    if (whole || (stored != material.cells.end() && equal(stored->second, list))) continue;
    plan.material.cells.emplace_back(number, std::move(list));
  }
}

}  // namespace tissu
