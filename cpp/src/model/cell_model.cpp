#include "tissu/model/cell_model.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "tissu/base/error.h"
#include "tissu/base/number_text.h"
#include "tissu/cell/chunk_plan.h"

namespace tissu {
namespace {

/// "tetra, hexahedron, …"
std::string element_names() {
  std::string text;
  for (const ElementInfo& info : elements()) text += (text.empty() ? "" : ", ") + std::string(info.name);
  return text;
}

void check_element(const ElasticBlock& block, const ReferenceCell& reference) {
  if (reference.points.empty()) {
    throw ParameterError("body \"" + block.body + "\" asks for the element \"" + block.element +
                         "\" with the quadrature \"" + block.quadrature + "\"; there are the elements " +
                         element_names() + ", and the quadratures reduced, full and over.");
  }
  const auto nodes = static_cast<std::size_t>(reference.nodes);
  if (!block.cells.empty() && block.cells.size() % nodes == 0) return;
  throw MeshError("body \"" + block.body + "\" has " + std::to_string(block.cells.size()) +
                  " node numbers for cells of type " + block.element + ", which have " +
                  std::to_string(nodes) + " each; give whole cells, and at least one.");
}

void check_sizes(const ElasticBlock& block, const ReferenceCell& reference, std::size_t cells) {
  check_size(block, block.density, "density", cells);
  check_size(block, block.cross_section, reference.dimension == 1 ? "section" : "thickness", cells);
  check_size(block, block.share, "share of material", cells);
  for (const double share : block.share) {
    if (share > 0.0 && share <= 1.0) continue;
    throw ParameterError("body \"" + block.body + "\" has a cell with a share of material of " +
                         number_text(share) + "; it must be above 0 and at most 1.");
  }
  for (const double size : block.cross_section) {
    if (size > 0.0 && std::isfinite(size)) continue;
    throw ParameterError("body \"" + block.body + "\" has a thickness or section of " + number_text(size) +
                         "; it must be positive and finite.");
  }
  for (const double density : block.density) {
    if (density > 0.0 && std::isfinite(density)) continue;
    throw ParameterError("body \"" + block.body + "\" has a density of " + number_text(density) +
                         " kg/m3; it must be positive and finite.");
  }
}

/// Von Mises' stress of a lane's mean Cauchy stress xx yy zz yz xz xy, [group][6][8].
double von_mises(const double* stresses, std::size_t lane) {
  constexpr std::size_t kLanes = ElementOrder::kLanes;
  const auto s = [&](std::size_t k) { return stresses[(lane / kLanes * 6 + k) * kLanes + lane % kLanes]; };
  const double deviation =
      (s(0) - s(1)) * (s(0) - s(1)) + (s(1) - s(2)) * (s(1) - s(2)) + (s(2) - s(0)) * (s(2) - s(0));
  const double shear = s(3) * s(3) + s(4) * s(4) + s(5) * s(5);
  return std::sqrt(0.5 * deviation + 3.0 * shear);
}

}  // namespace

CellModel::CellModel(ElasticBlock block, Threads threads)
    : block_(std::move(block)),
      threads_(threads),
      reference_(reference_cell(block_.element, block_.quadrature)) {
  check_element(block_, reference_);
  check_sizes(block_, reference_, static_cast<std::size_t>(cell_count()));
}

void CellModel::lay_cells(ConstReals rest_positions, RestForm form, std::span<const std::int32_t> together) {
  order_ = order_elements(block_.cells, reference_.nodes, rest_positions, together, block_.fill);
  lay_rest_shape(rest_positions, form);
}

void CellModel::lay_planned_cells(ConstReals rest_positions, RestForm form) {
  const std::vector<std::int32_t>& origins = block_.origins.empty() ? block_.cell_numbers : block_.origins;
  const auto plan =
      std::ranges::find_if(block_.plans, [&](const auto& p) { return p->has(origins.front()); });
  if (plan != block_.plans.end()) {
    order_ = order_by(**plan, {block_.cells, reference_.nodes, block_.cell_numbers, origins});
    block_.plans = {*plan};
  } else {
    order_ = order_elements(block_.cells, reference_.nodes, rest_positions, {}, block_.fill);
    block_.plans = {std::make_shared<const ChunkPlan>(plan_of(order_, block_.cell_numbers))};
  }
  lay_rest_shape(rest_positions, form);
}

void CellModel::lay_rest_shape(ConstReals rest_positions, RestForm form) {
  shape_ = rest_shape({reference_, block_.cells, block_.cross_section, rest_positions, block_.share}, order_,
                      form);
  if (shape_.bad.empty()) return;
  if (!block_.cell_numbers.empty()) {
    for (std::int32_t& cell : shape_.bad) cell = block_.cell_numbers[static_cast<std::size_t>(cell)];
  }
  throw MeshError("body \"" + block_.body + "\" has " + std::to_string(shape_.bad.size()) + " of " +
                  std::to_string(cell_count()) + " cells of type " + block_.element +
                  " that are inverted or have no volume (" + first_five(shape_.bad) +
                  "); repair or remove them.");
}

std::int32_t CellModel::cell_count() const {
  return static_cast<std::int32_t>(block_.cells.size()) / reference_.nodes;
}

void CellModel::couple(SparsityBuilder& builder) const { builder.add_cells(block_.cells, reference_.nodes); }

void CellModel::keep_volumes() {
  AlignedVector<double> volumes;
  const std::size_t reals = shape_.reals;
  for (std::size_t i = 0; i < shape_.rest.size(); ++i) {
    if (i / kLanes % reals == reals - 1) volumes.push_back(shape_.rest[i]);
  }
  volumes.shrink_to_fit();
  shape_.rest = std::move(volumes);
  shape_.reals = 1;
}

void CellModel::bind(const Sparsity& pattern) {
  lay_slots(order_, block_.cells, reference_.nodes, pattern, slots_);
}

void CellModel::lay_slots(const ElementOrder& order, const std::vector<std::int32_t>& cells, int size,
                          const Sparsity& pattern, AlignedVector<std::int32_t>& to) const {
  const auto n = static_cast<std::size_t>(size);
  const auto groups = static_cast<std::size_t>(order.groups());
  to.resize(groups * n * n * kLanes);
  threads_.for_pieces(order.groups(), [&](std::int32_t begin, std::int32_t end) {
    for (auto group = static_cast<std::size_t>(begin); group < static_cast<std::size_t>(end); ++group) {
      std::int32_t* slots = to.data() + group * n * n * kLanes;
      for (std::size_t a = 0; a < n; ++a) {
        for (std::size_t b = 0; b < n; ++b) {
          for (std::size_t lane = 0; lane < kLanes; ++lane) {
            const std::int32_t* cell =
                cells.data() + static_cast<std::size_t>(order.element[group * kLanes + lane]) * n;
            slots[(a * n + b) * kLanes + lane] = pattern.slot(cell[a], cell[b]);
          }
        }
      }
    }
  });
}

/// Calls f(node, mass of the cell, sum_g w_g rho N_a, share of the node in sum_g w_g N_a^2).
template <class Function>
void CellModel::for_nodes(Function&& f) const {
  std::vector<double> scratch;
  for (std::size_t i = 0; i < order_.element.size(); ++i) {
    if (order_.real[i] != 0) for_lane_nodes(i, scratch, f);
  }
}

void CellModel::add_weights(std::vector<double>& nodal) const {
  for_nodes([&](std::size_t node, double, double weight, double) { nodal[node] += weight; });
}

void CellModel::add_masses(std::vector<double>& nodal) const {
  const bool linear = find_element(block_.element)->order == 1;
  for_nodes([&](std::size_t node, double mass, double weight, double share) {
    nodal[node] += linear ? weight : mass * share;
  });
}

std::size_t CellModel::bytes() const {
  return order_.places.size() * sizeof(std::uint16_t) +
         (order_.nodes.size() + slots_.size()) * sizeof(std::int32_t);
}

std::vector<double> CellModel::reference_gradients() const {
  std::vector<double> gradients;
  for (const ReferenceCell::Point& point : reference_.points) {
    for (const auto& gradient : point.gradients) {
      gradients.insert(gradients.end(), gradient.begin(), gradient.begin() + reference_.dimension);
    }
  }
  return gradients;
}

ElasticView CellModel::cell_view() const {
  return {.places = order_.places.data(),
          .slots = slots_.data(),
          .rest = shape_.rest.data(),
          .rest_points = shape_.rest_points,
          .weights = shape_.weights.data(),
          .frames = nullptr,
          .constants = constants_.data(),
          .constants_stride = constants_stride_,
          .gradients = nullptr,
          .points = static_cast<int>(reference_.points.size()),
          .laws = nullptr,
          .law_count = 0,
          .at_point = nullptr};
}

CellFields CellModel::cell_fields(const std::vector<double>& stresses, const std::vector<double>& ratios,
                                  ConstReals energies) const {
  CellFields fields;
  const auto cells = static_cast<std::size_t>(cell_count());
  fields.von_mises.resize(cells);
  fields.energy_density.resize(cells);
  fields.volume_ratio.resize(cells);
  for_lanes([&](std::size_t lane, std::size_t cell) {
    fields.von_mises[cell] = von_mises(stresses.data(), lane);
    fields.energy_density[cell] = energies[lane] / shape_.volumes[cell];
    fields.volume_ratio[cell] = ratios[lane];
  });
  return fields;
}

}  // namespace tissu
