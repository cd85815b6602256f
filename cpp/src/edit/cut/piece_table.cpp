#include "tissu/edit/cut/piece_table.h"

#include <algorithm>
#include <deque>
#include <unordered_map>
#include <utility>

#include "edit/cut/host_joins.h"
#include "edit/cut/joins.h"
#include "tissu/edit/cut/cut_plan.h"

namespace tissu {
namespace {

std::size_t at(std::int32_t i) { return static_cast<std::size_t>(i); }

double whole_volume(const Hosts& hosts, std::int32_t cell) {
  double sum = 0.0;
  for (const MaterialTetra& tetra : whole_material(hosts, cell)) sum += rest_volume(hosts, {}, cell, tetra);
  return sum;
}

/// What grows from some cells of a piece, all fronts in turn, until one front is left or none.
class Flood {
 public:
  Flood(const Hosts& hosts, const Material& material, const std::vector<std::int32_t>& seeds)
      : joins_(hosts, material), sets_(seeds.size()), fronts_(seeds.size()) {
    for (std::size_t i = 0; i < seeds.size(); ++i) {
      seen_[seeds[i]] = static_cast<std::int32_t>(i);
      fronts_[i].push_back(seeds[i]);
    }
    left_ = seeds.size();
  }

  /// The parts that were seen whole, but for one where all were.
  std::vector<std::vector<std::int32_t>> run() {
    while (left_ > 1) {
      for (std::size_t i = 0; i < fronts_.size() && left_ > 1; ++i) {
        if (sets_.first(static_cast<std::int32_t>(i)) == static_cast<std::int32_t>(i) && !whole_.contains(i))
          grow(i);
      }
    }
    std::unordered_map<std::int32_t, std::vector<std::int32_t>> parts;
    for (const auto& [cell, seed] : seen_) {
      const std::int32_t set = sets_.first(seed);
      if (whole_.contains(at(set))) parts[set].push_back(cell);
    }
    std::vector<std::vector<std::int32_t>> result;
    for (auto& [set, cells] : parts) {
      std::ranges::sort(cells);
      result.push_back(std::move(cells));
    }
    std::ranges::sort(result);
    return result;
  }

 private:
  /// One cell of a front; where the front is empty, its part is whole.
  void grow(std::size_t set) {
    std::deque<std::int32_t>& front = fronts_[set];
    if (front.empty()) {
      whole_.emplace(set, true);
      --left_;
      return;
    }
    const std::int32_t cell = front.front();
    front.pop_front();
    for (const std::int32_t other : joins_.of(cell)) {
      const auto [known, fresh] = seen_.try_emplace(other, static_cast<std::int32_t>(set));
      if (fresh) {
        fronts_[at(sets_.first(static_cast<std::int32_t>(set)))].push_back(other);
      } else {
        join(static_cast<std::int32_t>(set), known->second);
      }
    }
  }

  void join(std::int32_t a, std::int32_t b) {
    const std::int32_t first = sets_.first(a);
    const std::int32_t second = sets_.first(b);
    if (first == second) return;
    sets_.join(first, second);
    const std::int32_t kept = sets_.first(first);
    std::deque<std::int32_t>& other = fronts_[at(kept == first ? second : first)];
    std::deque<std::int32_t>& to = fronts_[at(kept)];
    to.insert(to.end(), other.begin(), other.end());
    other.clear();
    --left_;
  }

  HostJoins joins_;
  Sets sets_;
  std::vector<std::deque<std::int32_t>> fronts_;
  std::unordered_map<std::int32_t, std::int32_t> seen_;  ///< cells, and the seed from which each was met
  std::unordered_map<std::size_t, bool> whole_;
  std::size_t left_ = 0;  ///< sets that may grow
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

void PieceTable::begin(const Hosts& hosts, const CutPlan& plan) {
  if (!single_) return;
  near_ = plan.gone;
  for (const ChangedCell& cell : plan.changed) near_.push_back(cell.number);
  for (const auto& [cell, list] : plan.material.cells) {
    if (hosts.has(cell)) near_.push_back(cell);
  }
  near_ = hosts.with_neighbours(near_);
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
  for (const std::vector<std::int32_t>& cells : Flood(hosts, material, seeds).run()) {
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
