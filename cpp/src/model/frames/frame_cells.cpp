#include "tissu/model/frames/frame_cells.h"

#include <Eigen/LU>
#include <array>
#include <cmath>
#include <numbers>
#include <span>

#include "tissu/base/error.h"
#include "tissu/element/reference_cell.h"

namespace tissu {
namespace {

constexpr double kFlat =
    1e-14;  ///< of the m-th power of the largest entry of J: a measure below it is round-off

using Cell = std::span<const std::int32_t>;

/// Some unit vector across t.
Vec3 across(const Vec3& t) {
  Eigen::Index smallest = 0;
  t.cwiseAbs().minCoeff(&smallest);
  return t.cross(Vec3(Vec3::Unit(smallest))).normalized();
}

/// One quadrature point: its place, weights, gradients, measure [m3, m2 or m], and the axis it is thin along.
struct Place {
  Vec3 position = Vec3::Zero();
  std::vector<Vec3> gradients;
  double measure = 0.0;
  Vec3 axis = Vec3::Zero();
  bool flat = true;
};

Place place_of(const ReferenceCell& cell, const ReferenceCell::Point& point, Cell nodes, ConstReals X) {
  Place place;
  Mat3 J = Mat3::Zero();
  for (std::size_t a = 0; a < nodes.size(); ++a) {
    const Vec3 x = block(X, nodes[a]);
    place.position += point.values[a] * x;
    J += x * Eigen::Map<const Eigen::RowVector3d>(point.gradients[a].data());
  }
  const double size = J.cwiseAbs().maxCoeff();
  double measure = 0.0;
  if (cell.dimension == 2) {
    const Vec3 normal = J.col(0).cross(J.col(1));
    measure = normal.norm();
    place.axis = J.col(2) = normal / std::max(measure, 1e-300);
  } else if (cell.dimension == 1) {
    measure = J.col(0).norm();
    place.axis = J.col(0) / std::max(measure, 1e-300);
    J.col(1) = across(place.axis);
    J.col(2) = place.axis.cross(J.col(1));
  } else {
    measure = J.determinant();
  }
  place.flat = !(measure > kFlat * std::pow(size, cell.dimension));
  place.measure = point.weight * measure;
  if (place.flat) return place;
  const Mat3 inverse = J.inverse().transpose();
  for (std::size_t a = 0; a < nodes.size(); ++a) {
    place.gradients.emplace_back(inverse * Eigen::Map<const Vec3>(point.gradients[a].data()));
  }
  return place;
}

/// Where the points of a section stand off from its middle, and the inertia per mass that is left to each.
struct Section {
  std::vector<Vec3> offsets;
  double turning = 0.0;
  std::vector<FramePoints::OnSection> places = {};  ///< of rods
};

constexpr double kParallel = 1e-6;  ///< sine of the angle below which `up` says nothing across a line

/// Four points on the axes of a rod's section, with its second moments of area.
Section rod_section(const ElasticBlock& block, const Place& place, double area) {
  const bool round = block.section.up.isZero();
  const Vec3 up = round ? across(place.axis) : Vec3(place.axis.cross(block.section.up).cross(place.axis));
  if (up.norm() <= kParallel * (round ? 1.0 : block.section.up.norm())) {
    throw ParameterError("body \"" + block.body +
                         "\" has lines along the `up` of their section; a direction across all of them is " +
                         "accepted: give other lines a body of their own.");
  }
  const Vec3 e = up.normalized();
  const Vec3 f = place.axis.cross(e);
  const SectionConstants constants = section_constants(block.section, area, 0.0);
  const double a = std::sqrt(2.0 * constants.inertia_up / area);
  const double b = std::sqrt(2.0 * constants.inertia_across / area);
  const FramePoints::OnSection on_up{e, true, area};
  const FramePoints::OnSection on_across{f, false, area};
  return {{a * e, b * f, -a * e, -b * f}, 0.0, {on_up, on_across, on_up, on_across}};
}

Section section_of(const ElasticBlock& block, int dimension, const Place& place, double cross_section) {
  if (dimension == 3) return {{Vec3::Zero()}};
  const bool middle = options_or_defaults<FramesOptions>(block.model).section == "middle";
  if (dimension == 2) {
    const double d = cross_section / std::sqrt(12.0);
    if (middle) return {{Vec3::Zero()}, d * d};
    return {{d * place.axis, -d * place.axis}};
  }
  if (!middle) return rod_section(block, place, cross_section);
  if (block.section.shape != LineSection::Shape::round) {
    throw ParameterError(
        "body \"" + block.body +
        "\" has a section that is not round on points on the middle only; `section: whole` of " +
        "frames is accepted.");
  }
  return {{Vec3::Zero()}, cross_section / (2.0 * std::numbers::pi)};  // r^2 / 2
}

void add_point(const Place& place, const ReferenceCell::Point& point, Cell nodes, const Vec3& offset,
               double volume, FramePoints& to) {
  to.frames.insert(to.frames.end(), nodes.begin(), nodes.end());
  to.weights.insert(to.weights.end(), point.values.begin(), point.values.end());
  for (const Vec3& g : place.gradients) to.gradients.insert(to.gradients.end(), g.begin(), g.end());
  const Vec3 position = place.position + offset;
  to.positions.insert(to.positions.end(), position.begin(), position.end());
  to.volumes.push_back(volume);
  if (to.dimension < 3) to.axes.insert(to.axes.end(), place.axis.begin(), place.axis.end());
}

[[noreturn]] void refuse(const ElasticBlock& block, const std::vector<std::int32_t>& bad, std::size_t cells) {
  throw MeshError("body \"" + block.body + "\" has " + std::to_string(bad.size()) + " of " +
                  std::to_string(cells) + " cells of type " + block.element +
                  " that are inverted or have no volume (" + first_five(bad) + "); repair or remove them.");
}

}  // namespace

FramePoints points_of_cells(const ElasticBlock& block, ConstReals rest_positions) {
  const ReferenceCell cell = reference_cell(block.element, block.quadrature);
  const auto nodes = static_cast<std::size_t>(cell.nodes);
  const std::size_t count = block.cells.size() / nodes;
  FramePoints points;
  points.neighbours = cell.nodes;
  points.dimension = cell.dimension;
  std::vector<std::int32_t> bad;
  for (std::size_t e = 0; e < count; ++e) {
    const Cell of_cell = Cell(block.cells).subspan(e * nodes, nodes);
    const auto number = static_cast<std::int32_t>(e);
    const double size = cell.dimension == 3 ? 1.0 : tissu::of_cell(block.cross_section, number);
    const double material = tissu::of_cell(block.share, number);
    bool flat = false;
    for (const ReferenceCell::Point& point : cell.points) {
      const Place place = place_of(cell, point, of_cell, rest_positions);
      flat = flat || place.flat;
      if (flat) break;
      const Section section = section_of(block, cell.dimension, place, size);
      for (const Vec3& offset : section.offsets) {
        const double volume = place.measure * size / static_cast<double>(section.offsets.size());
        add_point(place, point, of_cell, offset, volume * material, points);
        points.cells.push_back(number);
        if (section.turning > 0.0) points.turning.push_back(section.turning);
      }
      points.sections.insert(points.sections.end(), section.places.begin(), section.places.end());
    }
    if (flat)
      bad.push_back(block.cell_numbers.empty() ? static_cast<std::int32_t>(e) : block.cell_numbers[e]);
  }
  if (!bad.empty()) refuse(block, bad, count);
  return points;
}

}  // namespace tissu
