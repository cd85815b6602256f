#include "tissu/model/points/thin_ratios.h"

#include <algorithm>
#include <array>
#include <limits>

#include "tissu/model/points/listed_material.h"

namespace tissu {
namespace {

constexpr std::size_t kLanes = PointMaterial::kLanes;
using Nine = std::array<double, PointMaterial::kNine>;
using ByRows = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;
using Lane = Eigen::Map<ByRows, 0, Eigen::Stride<3 * kLanes, kLanes>>;

PointMaterial material_of(const ElasticBlock& block, const ReferenceCell& reference, Isa isa) {
  const auto points = reference.points.size();
  std::vector<std::int32_t> cells(block.cells.size() / static_cast<std::size_t>(reference.nodes) * points);
  for (std::size_t i = 0; i < cells.size(); ++i) cells[i] = static_cast<std::int32_t>(i / points);
  return ListedMaterial(block, cells, isa).across(reference.dimension);
}

}  // namespace

ThinRatios::ThinRatios(const ElasticBlock& block, Isa isa)
    : reference_(reference_cell(block.element, block.quadrature)),
      thin_(block, reference_.dimension),
      material_(material_of(block, reference_, isa)) {}

void ThinRatios::stretch(std::int32_t group, std::size_t points, Group& of) const {
  Nine seen;
  Nine whole;
  for (std::size_t lane = 0; lane < kLanes; ++lane) {
    Lane(seen.data() + lane) = thin_.seen(of[std::min(lane, points - 1)].F);
  }
  material_.stretch(group, seen.data(), whole.data());
  for (std::size_t lane = 0; lane < points; ++lane) {
    of[lane].F = thin_.stretched(of[lane].F, Mat3(Lane(whole.data() + lane)));
  }
}

double ThinRatios::least(const ElasticBlock& block, ConstReals X, ConstReals x) const {
  const std::size_t per_cell = reference_.points.size();
  const std::size_t count = block.cells.size() / static_cast<std::size_t>(reference_.nodes) * per_cell;
  double found = std::numeric_limits<double>::infinity();
  double volume = 0.0;
  double now = 0.0;
  Group group;
  for (std::size_t first = 0; first < count; first += kLanes) {
    const std::size_t points = std::min(kLanes, count - first);
    for (std::size_t k = 0; k < points; ++k) {
      const CellPoint at =
          cell_point(block, reference_, X, x, (first + k) / per_cell, (first + k) % per_cell);
      group[k] = {thin_.unstrained_across(at), at.volume};
    }
    if (thin_.thins()) stretch(static_cast<std::int32_t>(first / kLanes), points, group);
    for (std::size_t k = 0; k < points; ++k) {
      volume += group[k].volume;
      now += group[k].volume * group[k].F.determinant();
      if ((first + k + 1) % per_cell != 0) continue;
      if (now / volume < found) found = now / volume;  // not a number either
      volume = now = 0.0;
    }
  }
  return found;
}

}  // namespace tissu
