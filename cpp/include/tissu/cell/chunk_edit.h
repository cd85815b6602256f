#pragma once

/// The order of a block whose cells come and go in place: it stays the one that its plan gives
/// (chunk_plan.h), but for where the groups of edited chunks stand in memory.

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "tissu/cell/chunk_plan.h"

namespace tissu {

class ChunkEdit {
 public:
  /// `order` is by the plan, and was never edited in place.
  ChunkEdit(std::shared_ptr<const ChunkPlan> plan, const ElementOrder& order, const PlannedCells& cells);

  void add(std::int32_t origin, std::int32_t number);
  void take(std::int32_t origin, std::int32_t number);
  /// The nodes of a cell changed.
  void touch(std::int32_t origin) { touched_.push_back(chunk_of(origin)); }
  /// A cell of another chunk, or of this one, has another place in the block.
  void move(std::int32_t origin, std::int32_t from, std::int32_t to, ElementOrder& order) const;
  /// Lays the chunks that were touched anew, and returns their groups. `place` is that of each number in the
  /// block, and `cells` are the nodes there.
  std::vector<ElementOrder::Run> lay(std::span<const std::int32_t> place, std::span<const std::int32_t> cells,
                                     ElementOrder& order);
  /// The groups that stand together with a cell's lane, and the place of that lane in sums over all cells.
  struct Seat {
    ElementOrder::Run run;
    std::int64_t rank;
  };
  [[nodiscard]] Seat seat(std::int32_t origin, std::int32_t lane) const;
  [[nodiscard]] std::int32_t chunk_of(std::int32_t origin) const {
    return plan_->chunk[static_cast<std::size_t>(origin)];
  }

 private:
  struct Part {
    std::int32_t begin = 0;
    std::int32_t groups = 0;
    std::int32_t capacity = 0;
    std::size_t first_node = 0;
    std::int32_t nodes = 0;
    std::size_t node_room = 0;
  };
  struct Standing {
    std::int32_t place;
    std::int32_t number;
    auto operator<=>(const Standing&) const = default;
  };
  void lay_chunk(std::int32_t chunk, std::span<const std::int32_t> place, std::span<const std::int32_t> cells,
                 ElementOrder& order);
  void fit(Part& part, std::int32_t groups, ElementOrder& order) const;
  void list_chunks(ElementOrder& order) const;

  std::shared_ptr<const ChunkPlan> plan_;
  int size_;
  std::vector<std::int32_t> by_colour_;          ///< chunks
  std::vector<std::vector<Part>> parts_;         ///< of each chunk
  std::vector<std::vector<Standing>> standing_;  ///< the cells of each chunk, ascending
  std::vector<std::int32_t> touched_;
};

}  // namespace tissu
