#include "patch_energies.h"

#include <algorithm>
#include <cmath>
#include <unordered_map>
#include <utility>

#include "tissu/base/sort_unique.h"
#include "tissu/element/reference_cell.h"
#include "tissu/world/world.h"

namespace tissu {
namespace {

constexpr double kMostJump = 0.01;
constexpr double kStretch = 1e-3;
constexpr double kRounding = 1e-6;  ///< a strain
constexpr double kOfStretch = (kRounding / kStretch) * (kRounding / kStretch);

using Energies = std::unordered_map<std::int32_t, double>;

/// Some cells of a body, as a world of their own.
class PatchBody {
 public:
  PatchBody(const BodyDescription& body, std::optional<Isa> isa, const std::vector<std::int32_t>& cells)
      : isa_(isa) {
    for (const ElasticBlock& block : body.elastic) {
      std::vector<std::size_t> which;
      for (std::size_t i = 0; i < block.cell_numbers.size(); ++i) {
        if (std::ranges::binary_search(cells, block.cell_numbers[i])) which.push_back(i);
      }
      if (which.empty()) continue;
      ElasticBlock& part = body_.elastic.emplace_back(part_of(block, which));
      part.plans.clear();
      part.heirs_of.clear();
      part.fill = 1.0;
      nodes_.insert(nodes_.end(), part.cells.begin(), part.cells.end());
    }
    sort_unique(nodes_);
    for (ElasticBlock& part : body_.elastic) {
      for (std::int32_t& node : part.cells)
        node = static_cast<std::int32_t>(std::ranges::lower_bound(nodes_, node) - nodes_.begin());
    }
    body_.name = body.name;
  }

  /// Of each cell by its number [J].
  [[nodiscard]] Energies energies(ConstReals rest, ConstReals x) const {
    WorldDescription description;
    description.isa = isa_;
    description.bodies.push_back(body_);
    description.bodies.front().positions = some(rest);
    const World world(std::move(description));
    State state = world.rest_state();
    state.positions = some(x);
    Energies found;
    for (const BodyModel* model : world.bodies().front().models) {
      const CellFields fields = model->fields(state);
      for (std::size_t i = 0; i < fields.energy_density.size(); ++i)
        found[model->block().cell_numbers[i]] = fields.energy_density[i] * model->volumes()[i];
    }
    return found;
  }

 private:
  [[nodiscard]] std::vector<double> some(ConstReals places) const {
    std::vector<double> own;
    own.reserve(3 * nodes_.size());
    for (const std::int32_t node : nodes_) {
      const Vec3 place = block(places, node);
      own.insert(own.end(), place.data(), place.data() + 3);
    }
    return own;
  }

  std::optional<Isa> isa_;
  BodyDescription body_;
  std::vector<std::int32_t> nodes_;
};

/// Moves in rounds, in each of which no two moves change the same cell: so the change of a cell's energy in a
/// round is that of one move. Every move comes after those before it that change its cells.
std::vector<std::vector<std::size_t>> rounds_of(const Hosts& hosts, const std::vector<NodeMove>& moves) {
  std::unordered_map<std::int32_t, std::size_t> next;  // the round from which on a cell is free
  std::vector<std::vector<std::size_t>> rounds;
  for (std::size_t i = 0; i < moves.size(); ++i) {
    const auto cells = hosts.cells_at(moves[i].node);
    std::size_t round = 0;
    for (const std::int32_t cell : cells) round = std::max(round, next[cell]);
    for (const std::int32_t cell : cells) next[cell] = round + 1;
    rounds.resize(std::max(rounds.size(), round + 1));
    rounds[round].push_back(i);
  }
  return rounds;
}

}  // namespace

std::vector<std::int32_t> moves_with_a_jump(const BodyDescription& body, std::optional<Isa> isa,
                                            const Hosts& hosts, ConstReals x,
                                            const std::vector<NodeMove>& moves) {
  std::vector<std::int32_t> cells;
  for (const NodeMove& move : moves) {
    const auto around = hosts.cells_at(move.node);
    cells.insert(cells.end(), around.begin(), around.end());
  }
  sort_unique(cells);
  const PatchBody patch(body, isa, cells);
  std::vector<double> stretched(hosts.rest().begin(), hosts.rest().end());
  for (double& place : stretched) place *= 1.0 + kStretch;
  const Energies reference = patch.energies(hosts.rest(), stretched);
  std::vector<double> rest(hosts.rest().begin(), hosts.rest().end());
  std::vector<double> now(x.begin(), x.end());
  Energies before = patch.energies(rest, now);
  std::vector<std::int32_t> refused;
  for (const std::vector<std::size_t>& round : rounds_of(hosts, moves)) {
    for (const std::size_t i : round) {
      for (std::vector<double>* places : {&rest, &now}) {
        const Vec3 place = moves[i].to.at(*places);
        block(Reals(*places), moves[i].node) = place;
      }
    }
    Energies after = patch.energies(rest, now);
    for (const std::size_t i : round) {
      double energy = 0.0;
      double jump = 0.0;
      double rounding = 0.0;
      for (const std::int32_t cell : hosts.cells_at(moves[i].node)) {
        energy += before.at(cell);
        jump += after.at(cell) - before.at(cell);
        rounding += kOfStretch * reference.at(cell);
      }
      if (!(std::abs(jump) <= kMostJump * energy + rounding)) refused.push_back(moves[i].node);
    }
    before = std::move(after);
  }
  std::ranges::sort(refused);
  return refused;
}

}  // namespace tissu
