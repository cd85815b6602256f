#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <span>
#include <utility>

#include "base/kernel_choice.h"
#include "kernels/frame_list.h"
#include "tissu/base/error.h"
#include "tissu/base/number_text.h"
#include "tissu/base/sort_unique.h"
#include "tissu/element/reference_cell.h"
#include "tissu/model/frames/frame_cells.h"
#include "tissu/model/frames/frames.h"

namespace tissu {
namespace {

constexpr int kMostNeighbours = 64;
/// Of the way from frame to point, which rotations turn: half of it makes the deflection follow them as a
/// parabola does (linked interpolation), so that bending takes no shear (Taylor and Auricchio 1993). With
/// linear weights and the whole of it rotations turn by half of what the material does. The published one is
/// whole.
constexpr double kLinked = 0.5;
constexpr double kAtRest = 1e-9;  ///< of F, above round-off in weights

void check(const ElasticBlock& block, const FramePoints& points) {
  const std::string where = "body \"" + block.body + "\"";
  const auto n = points.volumes.size();
  const auto k = static_cast<std::size_t>(points.neighbours);
  if (n == 0 || points.neighbours < 1 || points.neighbours > kMostNeighbours) {
    throw ParameterError(where + " has " + std::to_string(n) + " integration points with " +
                         std::to_string(points.neighbours) + " frames each; at least one point, and 1 to " +
                         std::to_string(kMostNeighbours) + " frames are accepted.");
  }
  const bool whole = points.frames.size() == n * k && points.weights.size() == n * k &&
                     points.gradients.size() == 3 * n * k && points.positions.size() == 3 * n &&
                     (points.dimension == 3 || points.axes.size() == 3 * n) &&
                     (points.turning.empty() || points.turning.size() == n);
  if (!whole) throw ParameterError(where + " has lists of points that differ in their length.");
  for (std::size_t s = 0; s < n; ++s) {
    if (points.volumes[s] > 0.0 && std::isfinite(points.volumes[s])) continue;
    throw ParameterError(where + ": integration point " + std::to_string(s) + " has a volume of " +
                         number_text(points.volumes[s]) + " m3; it must be positive and finite.");
  }
}

FramePoints points_for(const ElasticBlock& block, ConstReals rest_positions) {
  const auto given = options_or_defaults<FramesOptions>(block.model).points;
  if (!given) return points_of_cells(block, rest_positions);
  FramePoints points = *given;
  points.frames = block.cells;
  return points;
}

/// Half levers make a field quadratic in a cell: the points of `full` do not see all of it in a hexahedron or
/// a wedge, which leaves a motion of the cell without energy.
ElasticBlock with_quadrature(ElasticBlock block) {
  const auto options = options_or_defaults<FramesOptions>(block.model);
  if (options.lever != "half" || options.points) return block;
  const bool blind = block.element == "hexahedron" || block.element == "wedge";
  if (blind && block.quadrature == "full") block.quadrature = "over";
  const ReferenceCell cell = reference_cell(block.element, block.quadrature);
  const bool linear = block.element == "tetra" || block.element == "hexahedron" || block.element == "wedge" ||
                      block.element == "pyramid";
  if (cell.dimension < 3 || cell.points.empty() || linear) return block;
  throw ParameterError("body \"" + block.body + "\" asks for half a lever on cells of type \"" +
                       block.element +
                       "\", which bend by themselves; tetra, hexahedron, wedge and pyramid are accepted.");
}

int nodes_of(const ElasticBlock& block) {
  if (const auto given = options_or_defaults<FramesOptions>(block.model).points) return given->neighbours;
  const ReferenceCell cell = reference_cell(block.element, block.quadrature);
  if (!cell.points.empty() && block.cells.size() % static_cast<std::size_t>(cell.nodes) == 0 &&
      !block.cells.empty())
    return cell.nodes;
  throw ParameterError("body \"" + block.body + "\" asks for frames on cells of type \"" + block.element +
                       "\" with the quadrature \"" + block.quadrature +
                       "\"; whole cells of a known type, and reduced, full or over are accepted.");
}

}  // namespace

const FrameKernels* find_frame_kernels(Isa isa) { return TISSU_KERNELS_OF(isa, frame_kernels()); }

Frames::Frames(ElasticBlock block, ConstReals rest_positions, Isa isa, Threads threads)
    : block_(with_quadrature(std::move(block))),
      options_(options_or_defaults<FramesOptions>(block_.model)),
      threads_(threads),
      kernels_(find_frame_kernels(isa)),
      nodes_per_cell_(nodes_of(block_)) {
  points_ = points_for(block_, rest_positions);
  check(block_, points_);
  const auto cells = options_.points ? points_.volumes.size()
                                     : block_.cells.size() / static_cast<std::size_t>(nodes_per_cell_);
  volumes_.assign(cells, 0.0);
  for (std::size_t s = 0; s < points_.volumes.size(); ++s)
    volumes_[points_.cells.empty() ? s : static_cast<std::size_t>(points_.cells[s])] += points_.volumes[s];
  check_laws(block_, cells);
  check_size(block_, block_.density, "density", cells);
  for (const double density : block_.density) {
    if (density > 0.0 && std::isfinite(density)) continue;
    throw ParameterError("body \"" + block_.body + "\" has a density of " + number_text(density) +
                         " kg/m3; it must be positive and finite.");
  }
  lay_frames();
  order_ = order_points(listened_, points_.neighbours, static_cast<std::int32_t>(blocks_.size()));
  lay_coefficients(rest_positions);
  if (options_.lever == "half") check_rest(rest_positions);
  material_ = FrameMaterial(block_, stressed_points(), order_.point, isa);
  lay_holds();
  if (points_.dimension == 3 && options_.lever == "half") lay_tie();
}

/// As the material sees them: in plane strain a sheet is a volume, which does not thin.
FramePoints Frames::stressed_points() const {
  FramePoints points = points_;
  if (block_.plane == Plane::strain) points.dimension = 3;
  return points;
}

void Frames::lay_frames() {
  const bool known = block_.frames.size() == block_.cells.size();
  if (!options_.points && (!known || std::ranges::min(block_.frames) < 0)) {
    throw ParameterError("body \"" + block_.body +
                         "\" has frames as its model, but nodes without rotations; let its nodes be frames.");
  }
  std::vector<std::pair<std::int32_t, std::int32_t>> pairs;
  pairs.reserve(block_.cells.size());
  for (std::size_t i = 0; i < block_.cells.size(); ++i)
    pairs.emplace_back(block_.cells[i], known ? block_.frames[i] : -1);
  sort_unique(pairs);
  for (const auto& [block, frame] : pairs) {
    blocks_.push_back(block);
    numbers_.push_back(frame);
    rotations_.push_back(frame < 0 ? -1 : block_.first_rotation + frame);
  }
  for (const std::int32_t block : points_.frames) {
    listened_.push_back(
        static_cast<std::int32_t>(std::ranges::lower_bound(blocks_, block) - blocks_.begin()));
  }
}

Mat3 Frames::along(std::size_t point) const {
  const bool thin = points_.dimension < 3;
  const bool linked =
      options_.lever.empty() ? thin && options_.section != "middle" : options_.lever == "half";
  const double share = linked ? kLinked : 1.0;
  if (!thin) return share * Mat3::Identity();
  const Vec3 axis = tissu::block(ConstReals(points_.axes), static_cast<std::int32_t>(point));
  const Mat3 across = points_.dimension == 2 ? Mat3(axis * axis.transpose())
                                             : Mat3(Mat3::Identity() - axis * axis.transpose());
  return share * (Mat3::Identity() - across) + across;
}

void Frames::lay_coefficients(ConstReals rest_positions) {
  const auto k = static_cast<std::size_t>(points_.neighbours);
  const std::size_t groups = order_.point.size() / kLanes;
  levers_.resize(3 * points_.weights.size());
  for (std::size_t i = 0; i < points_.weights.size(); ++i) {
    const auto at = static_cast<std::int32_t>(i);
    const Vec3 way = tissu::block(ConstReals(points_.positions), static_cast<std::int32_t>(i / k)) -
                     tissu::block(rest_positions, points_.frames[i]);
    tissu::block(Reals(levers_), at) = along(i / k) * way;
  }
  lanes_.resize(groups * k * kLanes);
  coefficients_.resize(groups * k * 12 * kLanes);
  lane_volumes_.assign(groups * kLanes, 0.0);
  for (std::size_t i = 0; i < order_.point.size(); ++i) {
    const auto point = static_cast<std::size_t>(order_.point[i]);
    if (order_.real[i] != 0) lane_volumes_[i] = points_.volumes[point];
    const Mat3 A = along(point);
    for (std::size_t a = 0; a < k; ++a) {
      const std::size_t at = point * k + a;
      const std::size_t entry = i / kLanes * k + a;
      const Vec3 g = tissu::block(ConstReals(points_.gradients), static_cast<std::int32_t>(at));
      const Vec3 l = tissu::block(ConstReals(levers_), static_cast<std::int32_t>(at));
      Eigen::Matrix<double, 3, 3, Eigen::RowMajor> B = l * g.transpose() + points_.weights[at] * A;
      if (numbers_[static_cast<std::size_t>(listened_[at])] < 0) B.setZero();
      lanes_[entry * kLanes + i % kLanes] = listened_[at];
      double* to = coefficients_.data() + entry * 12 * kLanes + i % kLanes;
      for (std::size_t c = 0; c < 3; ++c) to[c * kLanes] = g[static_cast<int>(c)];
      for (std::size_t c = 0; c < 9; ++c) to[(3 + c) * kLanes] = B.data()[c];
    }
  }
}

/// Half a lever leaves a body as it is at rest where weights hold linear fields, with frames alone.
void Frames::check_rest(ConstReals rest_positions) const {
  const auto k = static_cast<std::size_t>(points_.neighbours);
  for (std::size_t s = 0; s < points_.volumes.size(); ++s) {
    Mat3 F = Mat3::Zero();
    double size = 0.0;
    bool all_turn = true;
    for (std::size_t at = s * k; at < (s + 1) * k; ++at) {
      const Vec3 g = tissu::block(ConstReals(points_.gradients), static_cast<std::int32_t>(at));
      const Vec3 l = tissu::block(ConstReals(levers_), static_cast<std::int32_t>(at));
      const Vec3 x = tissu::block(rest_positions, points_.frames[at]);
      F += (x + l) * g.transpose() + points_.weights[at] * along(s);
      size = std::max(size, x.cwiseAbs().maxCoeff() * g.cwiseAbs().maxCoeff());
      all_turn = all_turn && numbers_[static_cast<std::size_t>(listened_[at])] >= 0;
    }
    if (all_turn && (F - Mat3::Identity()).cwiseAbs().maxCoeff() <= kAtRest * (1.0 + size)) continue;
    throw ParameterError(
        "body \"" + block_.body + "\" asks for half a lever, but integration point " + std::to_string(s) +
        (all_turn ? " has weights that do not hold linear fields" : " listens to nodes without a rotation") +
        "; half a lever takes frames alone and the shape functions linear, trilinear and " +
        "moving_least_squares.");
  }
}

void Frames::couple(SparsityBuilder& builder) const {
  std::vector<std::int32_t> rows;
  const auto k = static_cast<std::size_t>(points_.neighbours);
  for (std::size_t i = 0; i < order_.point.size(); ++i) {
    if (order_.real[i] == 0 || (order_.shared[i / kLanes] != 0 && i % kLanes != 0)) continue;
    for (std::size_t a = 0; a < k; ++a) {
      const auto frame =
          static_cast<std::size_t>(listened_[static_cast<std::size_t>(order_.point[i]) * k + a]);
      rows.insert(rows.end(), {blocks_[frame], rotation_row(frame)});
    }
  }
  builder.add_cells(rows, static_cast<int>(2 * k));
}

void Frames::bind(const Sparsity& pattern) {
  const auto k = static_cast<std::size_t>(points_.neighbours);
  slots_.resize(order_.point.size() * k * k * 4);
  for (std::size_t i = 0; i < order_.point.size(); ++i) {
    const std::int32_t* frames = listened_.data() + static_cast<std::size_t>(order_.point[i]) * k;
    for (std::size_t pair = 0; pair < k * k; ++pair) {
      const auto a = static_cast<std::size_t>(frames[pair / k]);
      const auto b = static_cast<std::size_t>(frames[pair % k]);
      std::int32_t* to = slots_.data() + (i / kLanes * k * k + pair) * 4 * kLanes + i % kLanes;
      to[0] = pattern.slot(blocks_[a], blocks_[b]);
      to[kLanes] = pattern.slot(blocks_[a], rotation_row(b));
      to[2 * kLanes] = pattern.slot(rotation_row(a), blocks_[b]);
      to[3 * kLanes] = pattern.slot(rotation_row(a), rotation_row(b));
    }
  }
}

std::vector<double> Frames::points(const State& state) const {
  std::vector<double> result(points_.positions.size(), 0.0);
  const auto k = static_cast<std::size_t>(points_.neighbours);
  for (std::size_t i = 0; i < points_.weights.size(); ++i) {
    const std::int32_t frame = numbers_[static_cast<std::size_t>(listened_[i])];
    Vec3 place = tissu::block(ConstReals(state.positions), points_.frames[i]);
    if (frame >= 0)
      place += state.rotations[static_cast<std::size_t>(frame)] *
               Vec3(tissu::block(ConstReals(levers_), static_cast<std::int32_t>(i)));
    tissu::block(Reals(result), static_cast<std::int32_t>(i / k)) += points_.weights[i] * place;
  }
  return result;
}

std::size_t Frames::bytes() const {
  return (coefficients_.size() + lane_volumes_.size() + scratch_size()) * sizeof(double) +
         (lanes_.size() + slots_.size() + order_.share.size()) * sizeof(std::int32_t) + material_.bytes() +
         tie_.bytes();
}

std::size_t Frames::reals_per_cell() const { return 12 * static_cast<std::size_t>(points_.neighbours) + 1; }

}  // namespace tissu
