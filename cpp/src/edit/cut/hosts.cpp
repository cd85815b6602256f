#include "tissu/edit/cut/hosts.h"

#include <algorithm>
#include <numeric>
#include <string>

#include "edit/cut/missing_cell.h"
#include "tissu/base/error.h"
#include "tissu/base/index.h"
#include "tissu/base/sort_unique.h"
#include "tissu/edit/cut/cut_plan.h"

namespace tissu {
namespace {

constexpr std::size_t kClusterSize = 64;

/// The bits of a number below 2^10, two places apart.
std::uint32_t spread(std::uint32_t bits) {
  bits = (bits | (bits << 16U)) & 0x030000FFU;
  bits = (bits | (bits << 8U)) & 0x0300F00FU;
  bits = (bits | (bits << 4U)) & 0x030C30C3U;
  return (bits | (bits << 2U)) & 0x09249249U;
}

/// Place on Morton's curve in a grid of 1024 x 1024 x 1024 over a box.
std::uint32_t morton(const Vec3& p, const Eigen::AlignedBox3d& box) {
  std::uint32_t code = 0;
  for (int i = 0; i < 3; ++i) {
    const double size = box.sizes()[i];
    const double share = size > 0.0 ? (p[i] - box.min()[i]) / size : 0.0;
    code |= spread(static_cast<std::uint32_t>(share * 1023.0)) << static_cast<unsigned>(i);
  }
  return code;
}

void insert_sorted(std::vector<std::int32_t>& list, std::int32_t value) {
  const auto place = std::ranges::lower_bound(list, value);
  if (place == list.end() || *place != value) list.insert(place, value);
}

void erase_sorted(std::vector<std::int32_t>& list, std::int32_t value) {
  const auto place = std::ranges::lower_bound(list, value);
  if (place != list.end() && *place == value) list.erase(place);
}

/// Memory for what edits add, so that the first of them does not move all that is there: a quarter more.
template <class... Lists>
void reserve_more(Lists&... lists) {
  (lists.reserve(lists.size() + lists.size() / 4), ...);
}

}  // namespace

Hosts::Hosts(const Mesh& mesh) : rest_(mesh.positions), root_(at(mesh.node_count())) {
  std::iota(root_.begin(), root_.end(), 0);
  cells_at_.resize(root_.size());
  std::int32_t number = 0;
  for (const CellBlock& block : mesh.blocks) {
    for (std::int32_t i = 0; i < block.size(); ++i, ++number) {
      const auto nodes = block.cell(i);
      add({number, block.type, number, 1.0, {nodes.begin(), nodes.end()}}, -1);
    }
  }
  make_clusters();
  reserve_more(rest_, root_, cells_, pool_, cells_at_);
}

Hosts::Hosts(std::vector<double> rest, std::vector<std::int32_t> root, std::span<const Cell> cells,
             std::int32_t next_cell, std::vector<Rider> points, bool moved)
    : rest_(std::move(rest)), root_(std::move(root)), points_(std::move(points)), moved_(moved) {
  const auto wrong = [](const std::string& what) { return ParameterError("hosts of a cut body: " + what); };
  if (rest_.size() != 3 * root_.size()) throw wrong("3 rest numbers and one root per node are accepted.");
  cells_at_.resize(root_.size());
  for (const Cell& cell : cells) {
    const bool numbered = cell.number >= this->next_cell() && cell.number < next_cell;
    const bool complete = cell.nodes.size() == at(info(cell.type).nodes);
    const bool known = std::ranges::all_of(cell.nodes, [&](auto n) { return n >= 0 && n < node_count(); });
    if (!numbered || !complete || !known) {
      throw wrong("cell " + std::to_string(cell.number) +
                  " has a number that does not ascend, or nodes that are not there.");
    }
    add(cell, -1);
  }
  cells_.resize(at(next_cell), {-1, -1, 0.0, CellType::tetra, -1, 1.0});
  make_clusters();
  reserve_more(rest_, root_, cells_, pool_, cells_at_);
}

std::vector<std::int32_t> Hosts::numbers() const {
  std::vector<std::int32_t> there;
  for (std::int32_t cell = 0; cell < next_cell(); ++cell) {
    if (has(cell)) there.push_back(cell);
  }
  return there;
}

bool Hosts::has(std::int32_t cell) const { return cell >= 0 && cell < next_cell() && slot(cell).first >= 0; }

std::span<const std::int32_t> Hosts::nodes(std::int32_t cell) const {
  return pooled(cell, info(type(cell)).nodes);
}

std::span<const std::int32_t> Hosts::corners(std::int32_t cell) const {
  return pooled(cell, info(type(cell)).corners);
}

bool Hosts::lies_in_volume(std::int32_t cell) const {
  const auto own = corners(cell);
  return std::ranges::any_of(cells_at(own.front()), [&](std::int32_t one) {
    const auto nodes = corners(one);
    return info(type(one)).dimension == 3 && std::ranges::all_of(own, [&](std::int32_t node) {
             return std::ranges::find(nodes, node) != nodes.end();
           });
  });
}

std::vector<std::int32_t> Hosts::with_neighbours(std::span<const std::int32_t> cells) const {
  std::vector<std::int32_t> found;
  for (const std::int32_t cell : cells) found.insert(found.end(), nodes(cell).begin(), nodes(cell).end());
  sort_unique(found);
  std::vector<std::int32_t> all;
  for (const std::int32_t node : found) all.insert(all.end(), cells_at(node).begin(), cells_at(node).end());
  sort_unique(all);
  return all;
}

void Hosts::add(const Cell& cell, std::int32_t cluster) {
  cells_.resize(at(cell.number - first_cell_) + 1, {-1, -1, 0.0, CellType::tetra, -1, 1.0});
  cells_.back() = {
      static_cast<std::int32_t>(pool_.size()), cell.origin, cell.share, cell.type, -1, cell.thickness};
  pool_.insert(pool_.end(), cell.nodes.begin(), cell.nodes.end());
  for (const std::int32_t node : cell.nodes) insert_sorted(editable_cells_at(node), cell.number);
  if (cluster >= 0) join_cluster(cell.number, cluster);
}

void Hosts::take_out(std::int32_t cell) {
  for (const std::int32_t node : nodes(cell)) erase_sorted(editable_cells_at(node), cell);
  if (below_ == nullptr) erase_sorted(clusters_[at(slot(cell).cluster)].cells, cell);
  editable_slot(cell).first = -1;
}

void Hosts::replace_nodes(std::int32_t cell, std::span<const std::int32_t> nodes) {
  for (const std::int32_t node : this->nodes(cell)) erase_sorted(editable_cells_at(node), cell);
  std::ranges::copy(nodes, pool_.begin() + editable_slot(cell).first);
  for (const std::int32_t node : nodes) insert_sorted(editable_cells_at(node), cell);
  join_cluster(cell, slot(cell).cluster);
}

void Hosts::join_cluster(std::int32_t cell, std::int32_t cluster) {
  if (below_ != nullptr) return;
  Cluster& home = clusters_[at(cluster)];
  cells_[at(cell)].cluster = cluster;
  insert_sorted(home.cells, cell);
  for (const std::int32_t node : corners(cell)) {
    insert_sorted(home.corners, node);
    home.rest.extend(block(rest(), node).eval());
  }
}

void Hosts::make_clusters() {
  Eigen::AlignedBox3d box;
  for (std::int32_t node = 0; node < node_count(); ++node) box.extend(block(rest(), node).eval());
  std::vector<std::pair<std::uint32_t, std::int32_t>> order;
  for (const std::int32_t cell : numbers()) {
    Vec3 sum = Vec3::Zero();
    for (const std::int32_t node : corners(cell)) sum += block(rest(), node);
    order.emplace_back(morton(sum / static_cast<double>(corners(cell).size()), box), cell);
  }
  std::ranges::sort(order);
  clusters_.resize((order.size() + kClusterSize - 1) / kClusterSize);
  for (std::size_t i = 0; i < order.size(); ++i) {
    join_cluster(order[i].second, static_cast<std::int32_t>(i / kClusterSize));
  }
}

Rider Hosts::on_first_day(const Rider& rider) const {
  Rider sum;
  const auto add = [&](std::int32_t node, double weight) {
    const auto end = sum.node.begin() + sum.count;
    const auto same =
        at(static_cast<std::int32_t>(std::find(sum.node.begin(), end, node) - sum.node.begin()));
    if (same == sum.node.size()) return false;
    if (same == at(sum.count)) sum.node[at(sum.count++)] = node;
    sum.weight[same] += weight;
    return true;
  };
  for (std::size_t i = 0; i < at(rider.count); ++i) {
    const std::int32_t own = root(rider.node[i]);
    if (own >= 0) {
      if (!add(own, rider.weight[i])) return {};
      continue;
    }
    const Rider& point = points_[at(-1 - own)];
    if (point.count == 0) return {};
    for (std::size_t k = 0; k < at(point.count); ++k) {
      if (!add(point.node[k], rider.weight[i] * point.weight[k])) return {};
    }
  }
  return sum;
}

void Hosts::move(const NodeMove& move) {
  const Vec3 place = move.to.at(rest());
  block(Reals(rest_), move.node) = place;
  moved_ = true;
  if (below_ != nullptr) return;
  for (const std::int32_t cell : cells_at(move.node)) clusters_[at(slot(cell).cluster)].rest.extend(place);
}

void Hosts::apply(const CutPlan& plan) {
  for (const NodeMove& one : plan.moved) move(one);
  for (const BornNode& node : plan.nodes) {
    const bool is_copy = node.between.count == 0;
    if (!is_copy) {
      points_.push_back(on_first_day(node.between));
      moved_ = moved_ || points_.back().count == 0;
    }
    const Vec3 place = is_copy  ? Vec3(block(rest(), node.copied))
                       : moved_ ? node.between.at(rest())
                                : points_.back().at(rest());
    rest_.insert(rest_.end(), place.data(), place.data() + 3);
    root_.push_back(is_copy ? root(node.copied) : -static_cast<std::int32_t>(points_.size()));
    cells_at_.emplace_back();
  }
  for (const ChangedCell& cell : plan.changed) replace_nodes(cell.number, cell.nodes);
  for (const BornCell& cell : plan.born) {
    add({cell.number, type(cell.parent), origin(cell.parent), cell.share, cell.nodes, thickness(cell.parent)},
        slot(cell.parent).cluster);
  }
  for (const std::int32_t cell : plan.gone) take_out(cell);
}

void Hosts::remove(std::span<const std::int32_t> cells) {
  for (const std::int32_t cell : cells) {
    if (!has(cell)) throw missing_cell(cell);
  }
  for (const std::int32_t cell : cells) {
    if (has(cell)) take_out(cell);
  }
}

}  // namespace tissu
