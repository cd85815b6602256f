#include "edit/repair/repair_mesh.h"

#include <algorithm>
#include <iterator>
#include <map>
#include <utility>

#include "edit/cut/patch.h"

namespace tissu {

RepairMesh::RepairMesh(const Hosts& hosts, const Material& material, ConstReals x)
    : hosts_(hosts),
      material_(material),
      rest_(hosts.rest().begin(), hosts.rest().end()),
      x_(x.begin(), x.end()),
      next_(hosts.next_cell()) {}

bool RepairMesh::has(std::int32_t cell) const {
  return !gone_.contains(cell) && (cells_.contains(cell) || hosts_.has(cell));
}

std::vector<std::int32_t> RepairMesh::numbers() const {
  std::vector<std::int32_t> there;
  for (std::int32_t cell = 0; cell < next_; ++cell) {
    if (has(cell)) there.push_back(cell);
  }
  return there;
}

bool RepairMesh::is_tetra(std::int32_t cell) const {
  return cell >= hosts_.next_cell() || hosts_.type(cell) == CellType::tetra;
}

RepairCell RepairMesh::cell(std::int32_t number) const {
  const auto own = cells_.find(number);
  if (own != cells_.end()) return own->second;
  RepairCell cell{{}, 0, number};
  std::ranges::copy(hosts_.nodes(number), cell.nodes.begin());
  const auto stored = material_.cells.find(number);
  if (stored == material_.cells.end()) return cell;
  const MaterialTetra& tetra = stored->second.front();  // the corners may be in another order
  for (std::size_t f = 0; f < 4; ++f) {
    if ((tetra.cut >> f & 1U) != 0)
      cell.cut |= static_cast<std::uint8_t>(1U << place_in(cell, tetra.vertices[f]));
  }
  return cell;
}

std::span<const std::int32_t> RepairMesh::cells_at(std::int32_t node) const {
  const auto own = at_.find(node);
  return own == at_.end() ? hosts_.cells_at(node) : std::span<const std::int32_t>(own->second);
}

std::vector<std::int32_t> RepairMesh::cells_with(std::span<const std::int32_t> nodes) const {
  std::vector<std::int32_t> found;
  for (const std::int32_t number : cells_at(nodes.front())) {
    if (!is_tetra(number)) continue;
    const RepairCell own = cell(number);
    if (std::ranges::all_of(nodes, [&](std::int32_t node) { return place_in(own, node) < 4; }))
      found.push_back(number);
  }
  return found;
}

bool RepairMesh::is_solid(std::int32_t node) const {
  return std::ranges::all_of(cells_at(node), [&](std::int32_t cell) { return is_tetra(cell); });
}

std::vector<RepairMesh::Face> RepairMesh::border(std::int32_t node) const {
  std::map<std::array<std::int32_t, 2>, std::vector<Face>> seen;
  for (const std::int32_t number : cells_at(node)) {
    if (!is_tetra(number)) continue;
    const RepairCell own = cell(number);
    for (std::size_t f = 0; f < 4; ++f) {
      if (own.nodes[f] == node) continue;
      std::array<std::int32_t, 2> others{};
      std::size_t count = 0;
      for (std::size_t i = 0; i < 4; ++i) {
        if (i != f && own.nodes[i] != node) others[count++] = own.nodes[i];
      }
      std::ranges::sort(others);
      seen[others].push_back({others, own.nodes[f], own.is_cut(f)});
    }
  }
  std::vector<Face> faces;
  for (const auto& [others, both] : seen) {
    if (both.size() == 1 || std::ranges::any_of(both, &Face::cut))
      faces.insert(faces.end(), both.begin(), both.end());
  }
  return faces;
}

std::vector<std::int32_t>& RepairMesh::own_cells_at(std::int32_t node) {
  const auto [own, is_new] = at_.try_emplace(node);
  if (is_new) own->second.assign(hosts_.cells_at(node).begin(), hosts_.cells_at(node).end());
  return own->second;
}

void RepairMesh::leave(std::int32_t number) {
  for (const std::int32_t node : cell(number).nodes) std::erase(own_cells_at(node), number);
}

void RepairMesh::join(std::int32_t number, const RepairCell& cell) {
  cells_[number] = cell;
  gone_.erase(number);
  for (const std::int32_t node : cell.nodes) {
    std::vector<std::int32_t>& list = own_cells_at(node);
    list.insert(std::ranges::lower_bound(list, number), number);
  }
}

std::vector<std::int32_t> RepairMesh::apply(const Operation& operation) {
  if (operation.move) {
    const NodeMove& move = *operation.move;
    for (std::vector<double>* places : {&rest_, &x_}) {
      const Vec3 place = move.to.at(*places);
      block(Reals(*places), move.node) = place;
    }
    moves_.push_back(move);
    return operation.patch;
  }
  for (const std::int32_t number : operation.patch) {
    leave(number);
    cells_.erase(number);
    gone_.insert(number);
  }
  std::vector<std::int32_t> numbers;
  for (const auto& [known, cell] : operation.after) {
    numbers.push_back(known >= 0 ? known : next_++);
    join(numbers.back(), cell);
  }
  return numbers;
}

CutPlan RepairMesh::plan() const {
  CutPlan plan;
  plan.moved = moves_;
  plan.first_node = hosts_.node_count();
  std::ranges::copy_if(gone_, std::back_inserter(plan.gone),
                       [&](std::int32_t number) { return number < hosts_.next_cell(); });
  std::vector<std::int32_t> numbers;
  numbers.reserve(cells_.size());
  for (const auto& [number, cell] : cells_) numbers.push_back(number);
  std::ranges::sort(numbers);
  std::int32_t next = hosts_.next_cell();
  for (const std::int32_t number : numbers) {
    const RepairCell& cell = cells_.at(number);
    const bool is_old = number < hosts_.next_cell();
    const std::int32_t own = is_old ? number : next++;
    const std::vector<std::int32_t> nodes(cell.nodes.begin(), cell.nodes.end());
    if (is_old) {
      plan.changed.push_back({own, nodes});
    } else {
      plan.born.push_back({own, cell.parent, 1.0, nodes});
    }
    if (cell.cut != 0 || material_.cells.contains(own))
      plan.material.cells.emplace_back(own, std::vector<MaterialTetra>{{cell.nodes, cell.cut}});
  }
  return plan;
}

}  // namespace tissu
