#include "repair_energy.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numeric>
#include <unordered_map>
#include <utility>

#include "tissu/world/world.h"

namespace tissu {
namespace {

constexpr double kStretch = 1e-3;
constexpr double kRounding = 1e-6;  ///< a strain
constexpr double kOfStretch = (kRounding / kStretch) * (kRounding / kStretch);

/// Two patches as one world, in which they share no node.
class BothPatches {
 public:
  BothPatches(const ElasticBlock& block, std::size_t cell, std::optional<Isa> isa, const PatchCells& before,
              const PatchCells& after)
      : first_(before.nodes.size()) {
    ElasticBlock part = part_of(block, std::vector<std::size_t>(first_ + after.nodes.size(), cell));
    part.cells.clear();
    part.cell_numbers.resize(first_ + after.nodes.size());
    std::iota(part.cell_numbers.begin(), part.cell_numbers.end(), 0);
    part.origins.clear();
    part.heirs_of.clear();
    part.plans.clear();
    part.fill = 1.0;
    add(before, part);
    add(after, part);
    WorldDescription description;
    description.isa = isa;
    BodyDescription& body = description.bodies.emplace_back();
    body.name = block.body;
    body.positions = rest_;
    body.elastic.push_back(std::move(part));
    world_ = std::make_unique<const World>(std::move(description));
  }

  struct Energies {
    double before = 0.0;
    double after = 0.0;
  };
  [[nodiscard]] Energies now() const { return at(now_); }
  /// Where everything is longer by one part in a thousand.
  [[nodiscard]] Energies stretched() const {
    std::vector<double> places = rest_;
    for (double& place : places) place *= 1.0 + kStretch;
    return at(places);
  }

 private:
  void add(const PatchCells& patch, ElasticBlock& part) {
    std::unordered_map<std::int32_t, std::int32_t> numbers;
    for (std::size_t c = 0; c < patch.nodes.size(); ++c) {
      for (std::size_t i = 0; i < 4; ++i) {
        const auto next = static_cast<std::int32_t>(rest_.size() / 3);
        const auto [number, is_new] = numbers.try_emplace(patch.nodes[c][i], next);
        part.cells.push_back(number->second);
        if (!is_new) continue;
        rest_.insert(rest_.end(), patch.rest[c][i].data(), patch.rest[c][i].data() + 3);
        now_.insert(now_.end(), patch.now[c][i].data(), patch.now[c][i].data() + 3);
      }
    }
  }

  [[nodiscard]] Energies at(const std::vector<double>& places) const {
    State state = world_->rest_state();
    state.positions = places;
    Energies found;
    for (const BodyModel* model : world_->bodies().front().models) {
      const CellFields fields = model->fields(state);
      for (std::size_t i = 0; i < fields.energy_density.size(); ++i) {
        const bool is_first = static_cast<std::size_t>(model->block().cell_numbers[i]) < first_;
        (is_first ? found.before : found.after) += fields.energy_density[i] * model->volumes()[i];
      }
    }
    return found;
  }

  std::size_t first_;
  std::vector<double> rest_;
  std::vector<double> now_;
  std::unique_ptr<const World> world_;
};

}  // namespace

bool is_small_jump(const ElasticBlock& block, std::size_t cell, std::optional<Isa> isa,
                   const PatchCells& before, const PatchCells& after, double share) {
  const BothPatches patches(block, cell, isa, before, after);
  const auto now = patches.now();
  return std::abs(now.after - now.before) <= share * now.before + kOfStretch * patches.stretched().before;
}

}  // namespace tissu
