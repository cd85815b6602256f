#include "tissu/model/cell_editor.h"

#include <algorithm>
#include <utility>

#include "tissu/base/index.h"
#include "tissu/cell/chunk_plan.h"
#include "tissu/model/law_constants.h"

namespace tissu {
namespace {

constexpr std::int32_t kLanes = ElementOrder::kLanes;
/// Of what a model has on its first day: more than that moves everything once.
constexpr double kReserve = 1.5;

template <class Values>
void reserve(Values& values) {
  values.reserve(static_cast<std::size_t>(kReserve * static_cast<double>(values.size())) + 4096);
}

}  // namespace

CellEditor::CellEditor(CellModel& model)
    : model_(model),
      table_(model.block_),
      chunks_(model.block_.plans.front(), model.order_,
              {model.block_.cells, model.reference_.nodes, model.block_.cell_numbers, model.block_.origins}),
      lane_(model.block_.cell_numbers.size(), -1) {
  ElementOrder& order = model.order_;
  for (std::size_t i = 0; i < order.element.size(); ++i) {
    if (order.real[i] != 0) lane_[at(order.element[i])] = static_cast<std::int32_t>(i);
  }
  const std::int32_t* nodes = order.nodes.data();
  reserve(order.nodes);
  for (Chunk& chunk : order.chunks) chunk.nodes = order.nodes.data() + (chunk.nodes - nodes);
  reserve(order.element);
  reserve(order.real);
  reserve(order.places);
  reserve(model.shape_.rest);
  reserve(model.shape_.volumes);
  reserve(model.slots_);
  if (model.constants_stride_ != 0) reserve(model.constants_);
}

std::unique_ptr<CellEditor> BodyModel::make_editor() { return nullptr; }

std::span<const std::int32_t> CellEditor::nodes(std::int32_t cell) const {
  const std::size_t count = at(model_.reference_.nodes);
  return std::span(model_.block_.cells).subspan(at(table_.place(cell)) * count, count);
}

void CellEditor::edit(const CellEdit& edit, std::int32_t first_node, ConstReals X) {
  ElasticBlock& block = model_.block_;
  for (const std::int32_t cell : edit.gone) {
    if (has(cell)) chunks_.take(origin(table_.place(cell)), cell);
  }
  const std::vector<BlockTable::Shift> shifts = table_.apply(edit, first_node, block);
  for (const CellEdit::Cell& cell : edit.born) {
    if (has(cell.number)) chunks_.add(origin(table_.place(cell.number)), cell.number);
  }
  for (const CellEdit::Moved& cell : edit.moved) {
    if (has(cell.number)) chunks_.touch(origin(table_.place(cell.number)));
  }
  lane_.resize(std::max(lane_.size(), block.cell_numbers.size()), -1);
  for (const BlockTable::Shift& shift : shifts) {
    model_.shape_.volumes.resize(lane_.size(), 0.0);
    model_.shape_.volumes[at(shift.to)] = model_.shape_.volumes[at(shift.from)];
    lane_[at(shift.to)] = lane_[at(shift.from)];
    chunks_.move(shift.origin, shift.from, shift.to, model_.order_);
  }
  lane_.resize(block.cell_numbers.size());
  laid_ = chunks_.lay(table_.places(), block.cells, model_.order_);
  for (const ElementOrder::Run run : laid_) {
    for (std::int32_t i = run.begin * kLanes; i < run.end * kLanes; ++i) {
      if (model_.order_.real[at(i)] != 0) lane_[at(model_.order_.element[at(i)])] = i;
    }
  }
  lay_rest({model_.reference_, block.cells, block.cross_section, X, block.share}, model_.order_, laid_,
           model_.shape_);
  lay_constants();
}

void CellEditor::lay_constants() {
  if (model_.constants_stride_ == 0) return;
  const auto stride = static_cast<std::size_t>(model_.constants_stride_);
  model_.constants_.resize(at(model_.order_.groups()) * stride);
  for (const ElementOrder::Run run : laid_) {
    const auto cells =
        std::span(model_.order_.element).subspan(at(run.begin * kLanes), at((run.end - run.begin) * kLanes));
    LawConstants laid = lay_law_constants(model_.block_, cells, model_.reference_.dimension);
    std::ranges::copy(laid.values,
                      model_.constants_.begin() + static_cast<std::ptrdiff_t>(at(run.begin) * stride));
  }
}

void CellEditor::bind_lane(const Sparsity& pattern, std::int32_t lane) {
  const std::size_t n = at(model_.reference_.nodes);
  const std::int32_t* cell = model_.block_.cells.data() + at(model_.order_.element[at(lane)]) * n;
  std::int32_t* slots = model_.slots_.data() + at(lane / kLanes) * n * n * at(kLanes) + at(lane % kLanes);
  for (std::size_t a = 0; a < n; ++a) {
    for (std::size_t b = 0; b < n; ++b) slots[(a * n + b) * at(kLanes)] = pattern.slot(cell[a], cell[b]);
  }
}

void CellEditor::bind(const Sparsity& pattern, std::span<const std::int32_t> cells) {
  const std::size_t n = at(model_.reference_.nodes);
  model_.slots_.resize(at(model_.order_.groups()) * n * n * at(kLanes));
  for (const ElementOrder::Run run : laid_) {
    for (std::int32_t lane = run.begin * kLanes; lane < run.end * kLanes; ++lane) bind_lane(pattern, lane);
  }
  const auto is_laid = [&](ElementOrder::Run run) {
    return std::ranges::find(laid_, run.begin, &ElementOrder::Run::begin) != laid_.end();
  };
  for (const std::int32_t cell : cells) {
    if (!has(cell)) continue;
    const std::int32_t place = table_.place(cell);
    const ElementOrder::Run run = chunks_.seat(origin(place), lane_[at(place)]).run;
    if (is_laid(run)) continue;
    bind_lane(pattern, lane_[at(place)]);
    const std::int32_t last = run.end * kLanes - 1;  // lanes that only pad repeat the last cell of a chunk
    if (model_.order_.element[at(last)] != place) continue;
    for (std::int32_t lane = run.begin * kLanes; lane <= last; ++lane) {
      if (model_.order_.element[at(lane)] == place) bind_lane(pattern, lane);
    }
  }
}

double CellEditor::volume(std::int32_t cell) const { return model_.shape_.volumes[at(table_.place(cell))]; }

double CellEditor::energy(std::span<const std::int32_t> cells, ConstReals x) {
  energies_.resize(model_.order_.element.size());
  std::vector<std::int32_t> lanes;
  std::vector<std::int32_t> begins;  // of the chunks
  for (const std::int32_t cell : cells) {
    if (!has(cell)) continue;
    const std::int32_t place = table_.place(cell);
    lanes.push_back(lane_[at(place)]);
    begins.push_back(chunks_.seat(origin(place), lanes.back()).run.begin);
  }
  std::ranges::sort(begins);
  for (const Chunk& chunk : model_.order_.chunks) {
    if (!std::ranges::binary_search(begins, chunk.begin)) continue;
    std::fill(energies_.begin() + chunk.begin * kLanes, energies_.begin() + chunk.end * kLanes, 0.0);
    model_.add_energies(chunk, x, energies_);
  }
  double sum = 0.0;
  for (const std::int32_t lane : lanes) sum += energies_[at(lane)];
  return sum;
}

std::vector<std::int32_t> CellEditor::laid_nodes() const {
  std::vector<std::int32_t> nodes;
  for (const Chunk& chunk : model_.order_.chunks) {
    if (std::ranges::find(laid_, chunk.begin, &ElementOrder::Run::begin) == laid_.end()) continue;
    nodes.insert(nodes.end(), chunk.nodes, chunk.nodes + chunk.node_count);
  }
  return nodes;
}

void CellEditor::add_node(std::int32_t node, std::span<const std::int32_t> cells, double& mass,
                          double& weight) const {
  std::vector<std::pair<std::int64_t, std::int32_t>> lanes;  // in the order in which masses are summed
  for (const std::int32_t cell : cells) {
    if (!has(cell)) continue;
    const std::int32_t place = table_.place(cell);
    lanes.emplace_back(chunks_.seat(origin(place), lane_[at(place)]).rank, lane_[at(place)]);
  }
  std::ranges::sort(lanes);
  const bool linear = find_element(model_.block_.element)->order == 1;
  std::vector<double> scratch;
  for (const auto& [rank, lane] : lanes) {
    model_.for_lane_nodes(at(lane), scratch,
                          [&](std::size_t at_node, double whole, double own, double share) {
                            if (at_node != static_cast<std::size_t>(node)) return;
                            mass += linear ? own : whole * share;
                            weight += own;
                          });
  }
}

}  // namespace tissu
