#include "tissu/edit/cut/piece_table.h"

#include <algorithm>
#include <utility>

#include "edit/cut/host_joins.h"
#include "edit/cut/joins.h"
#include "edit/cut/shared_corners.h"
#include "tissu/base/disjoint_sets.h"
#include "tissu/base/index.h"
#include "tissu/base/sort_unique.h"
#include "tissu/edit/cut/cut_plan.h"

namespace tissu {
namespace {

double whole_volume(const Hosts& hosts, std::int32_t cell) {
  double sum = 0.0;
  for (const MaterialTetra& tetra : whole_material(hosts, cell)) sum += rest_volume(hosts, {}, cell, tetra);
  return sum;
}

/// What grows from some cells of a piece, all fronts in turn, until one front is left or none.
class Flood {
 public:
  /// `met`: of each cell -1; so it is again afterwards.
  Flood(const Hosts& hosts, const Material& material, const std::vector<std::int32_t>& seeds,
        std::vector<std::int32_t>& met)
      : joins_(hosts, material), sets_(seeds.size()), fronts_(seeds.size()), met_(met), seen_(seeds) {
    for (std::size_t i = 0; i < seeds.size(); ++i) {
      met_[at(seeds[i])] = static_cast<std::int32_t>(i);
      fronts_[i].cells.push_back(seeds[i]);
    }
    left_ = seeds.size();
  }
  Flood(const Flood&) = delete;
  Flood& operator=(const Flood&) = delete;
  ~Flood() {
    for (const std::int32_t cell : seen_) met_[at(cell)] = -1;
  }

  /// The parts that were seen whole, but for one where all were.
  std::vector<std::vector<std::int32_t>> run() {
    while (left_ > 1) {
      for (std::size_t i = 0; i < fronts_.size() && left_ > 1; ++i) {
        if (sets_.first(static_cast<std::int32_t>(i)) == static_cast<std::int32_t>(i) && !fronts_[i].whole)
          grow(i);
      }
    }
    std::vector<std::vector<std::int32_t>> parts(fronts_.size());
    for (const std::int32_t cell : seen_) {
      const auto set = at(sets_.first(met_[at(cell)]));
      if (fronts_[set].whole) parts[set].push_back(cell);
    }
    std::erase_if(parts, [](const auto& cells) { return cells.empty(); });
    for (auto& cells : parts) std::ranges::sort(cells);
    std::ranges::sort(parts);
    return parts;
  }

 private:
  struct Front {
    std::vector<std::int32_t> cells;  ///< those from `next` on wait
    std::size_t next = 0;
    bool whole = false;
  };

  /// One cell of a front; where the front is empty, its part is whole.
  void grow(std::size_t set) {
    Front& front = fronts_[set];
    if (front.next == front.cells.size()) {
      front.whole = true;
      --left_;
      return;
    }
    for (const std::int32_t other : joins_.of(front.cells[front.next++])) {
      if (met_[at(other)] >= 0) {
        join(static_cast<std::int32_t>(set), met_[at(other)]);
        continue;
      }
      met_[at(other)] = static_cast<std::int32_t>(set);
      seen_.push_back(other);
      fronts_[at(sets_.first(static_cast<std::int32_t>(set)))].cells.push_back(other);
    }
  }

  void join(std::int32_t a, std::int32_t b) {
    const std::int32_t first = sets_.first(a);
    const std::int32_t second = sets_.first(b);
    if (first == second) return;
    sets_.join(first, second);
    const std::int32_t kept = sets_.first(first);
    Front& other = fronts_[at(kept == first ? second : first)];
    Front& to = fronts_[at(kept)];
    to.cells.insert(to.cells.end(), other.cells.begin() + static_cast<std::ptrdiff_t>(other.next),
                    other.cells.end());
    other = {};
    --left_;
  }

  HostJoins joins_;
  DisjointSets sets_;
  std::vector<Front> fronts_;
  std::vector<std::int32_t>& met_;  ///< of each cell, the seed from which it was met
  std::vector<std::int32_t> seen_;  ///< the cells that were
  std::size_t left_ = 0;            ///< sets that may grow
};

}  // namespace

PieceTable::PieceTable(const Hosts& hosts, const Material& material) : piece_(at(hosts.next_cell()), -1) {
  const std::vector<std::int32_t> numbers = hosts.numbers();
  const auto dimension = [&](std::int32_t cell) { return info(hosts.type(cell)).dimension; };
  single_ = std::ranges::all_of(
      numbers, [&](std::int32_t cell) { return dimension(cell) == dimension(numbers.front()); });
  for (const Piece& piece : pieces(hosts, material)) {
    for (const std::int32_t cell : piece.cells) {
      single_ = single_ && piece_[at(cell)] < 0;
      piece_[at(cell)] = static_cast<std::int32_t>(volumes_.size());
    }
    volumes_.push_back(piece.volume);
    counts_.push_back(static_cast<std::int32_t>(piece.cells.size()));
  }
}

double PieceTable::volume(const Hosts& hosts, std::int32_t cell) const {
  return hosts.share(cell) * whole_volume(hosts, cell);
}

/// What parts of a piece has a cell of the plan, or one that a face joined to such a cell before.
void PieceTable::begin(const Hosts& hosts, const CutPlan& plan) {
  if (!single_) return;
  near_ = plan.gone;
  for (const ChangedCell& cell : plan.changed) near_.push_back(cell.number);
  for (const auto& [cell, list] : plan.material.cells) {
    if (hosts.has(cell)) near_.push_back(cell);
  }
  const std::vector<std::int32_t> touched = near_;
  for (const std::int32_t cell : touched) {
    const auto of_face = at(info(hosts.type(cell)).dimension);
    for_cells_at_corners(hosts, cell, [&](std::int32_t other, std::size_t shared) {
      if (shared >= of_face) near_.push_back(other);
    });
  }
  sort_unique(near_);
  piece_.resize(std::max(piece_.size(), at(hosts.next_cell())), -1);
  for (const BornCell& cell : plan.born) {
    if (piece_.size() <= at(cell.number)) piece_.resize(at(cell.number) + 1, -1);
    piece_[at(cell.number)] = piece_[at(cell.parent)];
    near_.push_back(cell.number);
  }
  for (const std::int32_t cell : plan.gone) {
    volumes_[at(piece_[at(cell)])] -= volume(hosts, cell);
    --counts_[at(piece_[at(cell)])];
    piece_[at(cell)] = -1;
  }
}

void PieceTable::end(const Hosts& hosts, const Material& material, const CutPlan& plan) {
  if (!single_) return;
  for (const BornCell& cell : plan.born) {
    volumes_[at(piece_[at(cell.number)])] += volume(hosts, cell.number);
    ++counts_[at(piece_[at(cell.number)])];
  }
  std::erase_if(near_, [&](std::int32_t cell) { return !hosts.has(cell); });
  met_.resize(piece_.size(), -1);
  std::ranges::sort(near_, {}, [&](std::int32_t cell) { return std::pair(piece_[at(cell)], cell); });
  for (std::size_t begin = 0, end = 0; begin < near_.size(); begin = end) {
    const std::int32_t piece = piece_[at(near_[begin])];
    while (end < near_.size() && piece_[at(near_[end])] == piece) ++end;
    part(hosts, material,
         {near_.begin() + static_cast<std::ptrdiff_t>(begin),
          near_.begin() + static_cast<std::ptrdiff_t>(end)});
  }
}

/// Parts of a piece that were seen whole become pieces of their own; the rest stays what it was.
void PieceTable::part(const Hosts& hosts, const Material& material, const std::vector<std::int32_t>& seeds) {
  for (const std::vector<std::int32_t>& cells : Flood(hosts, material, seeds, met_).run()) {
    const auto number = static_cast<std::int32_t>(volumes_.size());
    const auto from = at(piece_[at(cells.front())]);
    double whole = 0.0;
    for (const std::int32_t cell : cells) {
      whole += volume(hosts, cell);
      piece_[at(cell)] = number;
    }
    volumes_[from] -= whole;
    counts_[from] -= static_cast<std::int32_t>(cells.size());
    volumes_.push_back(whole);
    counts_.push_back(static_cast<std::int32_t>(cells.size()));
  }
}

std::vector<Piece> PieceTable::list(const Hosts& hosts, const Material& material) const {
  if (!single_) return pieces(hosts, material);
  std::vector<Piece> found;
  std::vector<std::int32_t> place(volumes_.size(), -1);  // pieces by their first cells
  for (std::size_t cell = 0; cell < piece_.size(); ++cell) {
    if (piece_[cell] < 0) continue;
    const auto piece = at(piece_[cell]);
    if (place[piece] < 0) {
      place[piece] = static_cast<std::int32_t>(found.size());
      found.push_back({{}, volumes_[piece]});
      found.back().cells.reserve(at(counts_[piece]));
    }
    found[at(place[piece])].cells.push_back(static_cast<std::int32_t>(cell));
  }
  return found;
}

}  // namespace tissu
