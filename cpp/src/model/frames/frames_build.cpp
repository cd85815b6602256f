#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <span>
#include <utility>

#include "base/kernel_choice.h"
#include "kernels/frame_list.h"
#include "tissu/base/error.h"
#include "tissu/element/reference_cell.h"
#include "tissu/model/frames/frame_cells.h"
#include "tissu/model/frames/frames.h"

namespace tissu {
namespace {

constexpr int kMostNeighbours = 64;
/// Of the way from frame to point along a sheet or line, which rotations turn: half of it makes the
/// deflection follow them as a parabola does (linked interpolation), so that bending takes no shear (Taylor
/// and Auricchio 1993). The published one is whole.
constexpr double kLinked = 0.5;
/// Of the stiffness that a point has against turning alone: what holds rotations that nothing depends on.
constexpr double kHold = 1e-6;

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
                         std::to_string(points.volumes[s]) + " m3; it must be positive and finite.");
  }
}

FramePoints points_for(const ElasticBlock& block, ConstReals rest_positions) {
  const auto given = options_or_defaults<FramesOptions>(block.model).points;
  if (!given) return points_of_cells(block, rest_positions);
  FramePoints points = *given;
  points.frames = block.cells;
  return points;
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
    : block_(std::move(block)),
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
    throw ParameterError("body \"" + block_.body + "\" has a density of " + std::to_string(density) +
                         " kg/m3; it must be positive and finite.");
  }
  lay_frames();
  order_ = order_points(listened_, points_.neighbours, static_cast<std::int32_t>(blocks_.size()));
  lay_coefficients(rest_positions);
  material_ = PointMaterial(block_, stressed_points(), order_.point, isa);
  lay_holds();
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
  for (std::size_t i = 0; i < block_.cells.size(); ++i)
    pairs.emplace_back(block_.cells[i], known ? block_.frames[i] : -1);
  std::ranges::sort(pairs);
  pairs.erase(std::ranges::unique(pairs).begin(), pairs.end());
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
  if (points_.dimension == 3) return Mat3::Identity();
  const Vec3 axis = tissu::block(ConstReals(points_.axes), static_cast<std::int32_t>(point));
  const Mat3 across = points_.dimension == 2 ? Mat3(axis * axis.transpose())
                                             : Mat3(Mat3::Identity() - axis * axis.transpose());
  const double share = options_.section == "middle" ? 1.0 : kLinked;
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

void Frames::lay_holds() {
  holds_.assign(blocks_.size(), 0.0);
  if (points_.dimension < 3) return;  // there the directors turn with their frames
  const auto k = static_cast<std::size_t>(points_.neighbours);
  std::array<double, PointMaterial::kNine> F{};
  for (const std::size_t c : {0U, 4U, 8U}) std::fill_n(F.data() + c * kLanes, kLanes, 1.0);
  std::array<double, PointMaterial::kTangent> A;
  for (std::size_t group = 0; group < order_.point.size() / kLanes; ++group) {
    material_.tangent(static_cast<std::int32_t>(group), F.data(), A.data());
    for (std::size_t i = 0; i < k * kLanes; ++i) {
      const std::size_t lane = i % kLanes;
      const double* B = coefficients_.data() + (group * k + i / kLanes) * 12 * kLanes + 3 * kLanes + lane;
      double square = 0.0;
      for (std::size_t c = 0; c < 9; ++c) square += B[c * kLanes] * B[c * kLanes];
      holds_[static_cast<std::size_t>(lanes_[group * k * kLanes + i])] +=
          kHold * std::abs(A[lane]) * square * lane_volumes_[group * kLanes + lane];
    }
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

double Frames::density(std::size_t point) const {
  return of_cell(block_.density,
                 points_.cells.empty() ? static_cast<std::int32_t>(point) : points_.cells[point]);
}

template <class Function>
void Frames::for_neighbours(Function&& f) const {
  const auto k = static_cast<std::size_t>(points_.neighbours);
  for (std::size_t s = 0; s < points_.volumes.size(); ++s) {
    const std::span<const double> w(points_.weights.data() + s * k, k);
    const bool squares = std::ranges::min(w) < 0.0;
    const auto weight = [&](double value) { return squares ? value * value : value; };
    double sum = 0.0;
    for (const double value : w) sum += weight(value);
    for (std::size_t a = 0; a < k; ++a) f(s * k + a, density(s) * points_.volumes[s], weight(w[a]) / sum);
  }
}

void Frames::add_masses(std::vector<double>& nodal) const {
  for_neighbours([&](std::size_t at, double mass, double share) {
    nodal[static_cast<std::size_t>(points_.frames[at])] += share * mass;
  });
}

void Frames::add_weights(std::vector<double>& nodal) const {
  for_neighbours([&](std::size_t at, double mass, double /*share*/) {
    nodal[static_cast<std::size_t>(points_.frames[at])] += points_.weights[at] * mass;
  });
}

void Frames::add_inertias(std::vector<Mat3>& of_frames) const {
  for_neighbours([&](std::size_t at, double mass, double share) {
    const Vec3 l = tissu::block(ConstReals(levers_), static_cast<std::int32_t>(at));
    const auto point = at / static_cast<std::size_t>(points_.neighbours);
    const double own = !points_.turning.empty() ? points_.turning[point]
                       : points_.dimension == 3 ? std::pow(points_.volumes[point], 2.0 / 3.0) / 6.0
                                                : 0.0;
    const std::int32_t frame = numbers_[static_cast<std::size_t>(listened_[at])];
    if (frame < 0) return;
    of_frames[static_cast<std::size_t>(frame)] +=
        share * mass * ((l.squaredNorm() + own) * Mat3::Identity() - l * l.transpose());
  });
}

void Frames::add_moments(std::vector<Vec3>& of_frames) const {
  for_neighbours([&](std::size_t at, double mass, double /*share*/) {
    const std::int32_t frame = numbers_[static_cast<std::size_t>(listened_[at])];
    if (frame < 0) return;
    of_frames[static_cast<std::size_t>(frame)] +=
        points_.weights[at] * mass * tissu::block(ConstReals(levers_), static_cast<std::int32_t>(at));
  });
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
         (lanes_.size() + slots_.size() + order_.share.size()) * sizeof(std::int32_t) + material_.bytes();
}

std::size_t Frames::reals_per_cell() const { return 12 * static_cast<std::size_t>(points_.neighbours) + 1; }

}  // namespace tissu
