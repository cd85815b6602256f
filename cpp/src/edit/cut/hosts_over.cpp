/// Hosts over others, which a plan is applied to and which the others are kept from.

#include "tissu/base/index.h"
#include "tissu/edit/cut/hosts.h"

namespace tissu {

Hosts Hosts::over(const Hosts& below) {
  Hosts hosts;
  hosts.below_ = &below;
  hosts.first_node_ = below.node_count();
  hosts.first_cell_ = below.next_cell();
  hosts.rest_ = below.rest_;
  hosts.points_ = below.points_;
  hosts.moved_ = below.moved_;
  return hosts;
}

const Hosts::Slot& Hosts::slot_below(std::int32_t cell) const {
  const auto edited = slots_over_.find(cell);
  return edited != slots_over_.end() ? edited->second : below_->slot(cell);
}

std::span<const std::int32_t> Hosts::cells_at_below(std::int32_t node) const {
  const auto edited = cells_at_over_.find(node);
  return edited != cells_at_over_.end() ? std::span<const std::int32_t>(edited->second)
                                        : below_->cells_at(node);
}

std::span<const std::int32_t> Hosts::pooled(std::int32_t cell, int count) const {
  const bool is_below = cell < first_cell_ && !slots_over_.contains(cell);
  const Hosts& holder = is_below ? *below_ : *this;
  return std::span(holder.pool_).subspan(at(slot(cell).first), at(count));
}

Hosts::Slot& Hosts::editable_slot(std::int32_t cell) {
  if (cell >= first_cell_) return cells_[at(cell - first_cell_)];
  const auto [edited, is_new] = slots_over_.try_emplace(cell, below_->slot(cell));
  if (is_new) {
    const auto nodes = below_->nodes(cell);
    edited->second.first = static_cast<std::int32_t>(pool_.size());
    pool_.insert(pool_.end(), nodes.begin(), nodes.end());
  }
  return edited->second;
}

std::vector<std::int32_t>& Hosts::editable_cells_at(std::int32_t node) {
  if (node >= first_node_) return cells_at_[at(node - first_node_)];
  const auto [edited, is_new] = cells_at_over_.try_emplace(node);
  if (is_new) {
    const auto cells = below_->cells_at(node);
    edited->second.assign(cells.begin(), cells.end());
  }
  return edited->second;
}

}  // namespace tissu
