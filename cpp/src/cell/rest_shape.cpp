#include "tissu/cell/rest_shape.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <utility>

namespace tissu {
namespace {

constexpr std::size_t kLanes = ElementOrder::kLanes;
/// Of the m-th power of the largest entry of J: a determinant below it is round-off.
constexpr double kFlat = 1e-14;
/// Of the largest entry of J: differences below it are round-off of positions.
constexpr double kAffine = 1e-12;

using Cell = std::span<const std::int32_t>;

Cell cell_of(const ReferenceCell& reference, const std::vector<std::int32_t>& cells, std::size_t e) {
  const auto nodes = static_cast<std::size_t>(reference.nodes);
  return {cells.data() + e * nodes, nodes};
}

/// J at a point: sum_a X_a (x) dN_a/dxi, columns beyond m are zero.
Mat3 jacobian(const ReferenceCell::Point& point, Cell cell, ConstReals X) {
  Mat3 J = Mat3::Zero();
  for (std::size_t a = 0; a < cell.size(); ++a) {
    J += block(X, cell[a]) * Eigen::Map<const Eigen::RowVector3d>(point.gradients[a].data());
  }
  return J;
}

/// Some unit vector across t.
Vec3 across(const Vec3& t) {
  Eigen::Index smallest = 0;
  t.cwiseAbs().minCoeff(&smallest);
  return t.cross(Vec3(Vec3::Unit(smallest))).normalized();
}

/// J = Q R with the columns beyond m completed by unit vectors across the others.
struct Split {
  Mat3 Q = Mat3::Identity();
  Mat3 R;
  double det = 0.0;
  bool flat = true;
};

/// Q of J = Q R with R upper triangular and positive on its diagonal, where J has a volume.
Mat3 triangular_axes(const Mat3& J) {
  Mat3 Q;
  Q.col(0) = J.col(0).normalized();
  Q.col(1) = (J.col(1) - J.col(1).dot(Q.col(0)) * Q.col(0)).normalized();
  Q.col(2) = Q.col(0).cross(Q.col(1));
  return Q;
}

Split split(const Mat3& J, int m, bool in_plane, bool triangular) {
  Split s{Mat3::Identity(), J};
  if (m == 2) {
    const Vec3 normal = J.col(0).cross(J.col(1)).normalized();
    s.Q.col(2) = normal;
    if (!in_plane) {
      s.Q.col(0) = J.col(0).normalized();
      s.Q.col(1) = normal.cross(s.Q.col(0));
    }
  } else if (m == 1) {
    s.Q.col(0) = J.col(0).normalized();
    s.Q.col(1) = across(s.Q.col(0));
    s.Q.col(2) = s.Q.col(0).cross(s.Q.col(1));
  }
  if (m == 3 && triangular) s.Q = triangular_axes(J);
  for (int k = m; k < 3; ++k) s.R.col(k) = s.Q.col(k);
  s.det = s.R.determinant() * s.Q.determinant();
  s.R = s.Q.transpose() * s.R;
  const double scale = J.cwiseAbs().maxCoeff();
  s.flat = !(std::abs(s.det) > kFlat * std::pow(scale, m)) || (m == 3 && s.det < 0.0);
  s.det = std::abs(s.det);
  return s;
}

/// Points of one cell look the same way: a surface is not folded, a line does not turn back.
bool same_side(const Mat3& Q, const Mat3& first, int m) {
  if (m == 3) return true;
  const Eigen::Index side = m == 2 ? 2 : 0;
  return Q.col(side).dot(first.col(side)) > 0.0;
}

bool lies_in_plane(const std::vector<std::int32_t>& nodes, ConstReals X) {
  return std::ranges::all_of(nodes,
                             [&](std::int32_t n) { return block(X, n)[2] == block(X, nodes.front())[2]; });
}

double of_cell(const std::vector<double>& values, std::size_t e) {
  return values.size() == 1 ? values.front() : values[e];
}

/// Writes the rest shape of the cells, lane by lane.
class Layout {
 public:
  Layout(const RestCells& cells, const ElementOrder& order, RestForm form)
      : cells_(cells),
        order_(order),
        m_(static_cast<std::size_t>(cells.reference.dimension)),
        triangular_(form.triangular && m_ == 3),
        in_plane_(m_ == 2 && lies_in_plane(cells.nodes, cells.X)) {
    const auto& points = cells.reference.points;
    const std::vector<char> affine = affine_cells(cells.reference, cells.nodes, cells.X);
    const bool all_affine = std::ranges::all_of(affine, [](char a) { return a != 0; });
    double total = 0.0;
    for (const auto& point : points) total += point.weight;
    for (const auto& point : points) shape_.weights.push_back(all_affine ? point.weight / total : 1.0);
    shape_.rest_points = all_affine ? 1 : static_cast<int>(points.size());
    for (const auto& point : points) volume_of_point_.push_back(all_affine ? total : point.weight);
    const std::size_t entries = order.element.size() * static_cast<std::size_t>(shape_.rest_points);
    shape_.reals = triangular_ ? 7 : m_ * m_ + 1;
    shape_.rest.resize(entries * shape_.reals);
    if (form.frames && m_ < 3 && !in_plane_) shape_.frames.resize(entries * 9);
    shape_.volumes.assign(affine.size(), 0.0);
  }

  /// To lay volume cells anew in a shape that is there.
  Layout(const RestCells& cells, const ElementOrder& order, RestShape shape)
      : cells_(cells),
        order_(order),
        m_(static_cast<std::size_t>(cells.reference.dimension)),
        triangular_(shape.reals == 7),
        in_plane_(false),
        shape_(std::move(shape)) {
    const auto& points = cells.reference.points;
    double total = 0.0;
    for (const auto& point : points) total += point.weight;
    for (const auto& point : points)
      volume_of_point_.push_back(shape_.rest_points == 1 ? total : point.weight);
    const std::size_t entries = order.element.size() * static_cast<std::size_t>(shape_.rest_points);
    shape_.rest.resize(entries * shape_.reals);
    shape_.volumes.resize(cells.nodes.size() / static_cast<std::size_t>(cells.reference.nodes), 0.0);
  }

  RestShape lay(std::span<const ElementOrder::Run> runs) {
    for (const ElementOrder::Run run : runs) {
      const auto end = static_cast<std::size_t>(run.end) * kLanes;
      for (std::size_t i = static_cast<std::size_t>(run.begin) * kLanes; i < end; ++i) {
        if (order_.real[i] != 0) shape_.volumes[static_cast<std::size_t>(order_.element[i])] = 0.0;
        lay_cell(i);
      }
    }
    return std::move(shape_);
  }

  RestShape lay() {
    for (std::size_t i = 0; i < order_.element.size(); ++i) {
      const bool good = lay_cell(i);
      if (!good && order_.real[i] != 0) shape_.bad.push_back(order_.element[i]);
    }
    std::ranges::sort(shape_.bad);
    return std::move(shape_);
  }

 private:
  bool lay_cell(std::size_t i) {
    const auto e = static_cast<std::size_t>(order_.element[i]);
    const Cell cell = cell_of(cells_.reference, cells_.nodes, e);
    bool good = true;
    Mat3 first;
    for (std::size_t g = 0; g < static_cast<std::size_t>(shape_.rest_points); ++g) {
      const Split s = split(jacobian(cells_.reference.points[g], cell, cells_.X), static_cast<int>(m_),
                            in_plane_, triangular_);
      if (g == 0) first = s.Q;
      good = good && !s.flat && same_side(s.Q, first, static_cast<int>(m_));
      const double size = of_cell(cells_.cross_section, e) * of_cell(cells_.share, e);
      const double volume = s.flat ? 0.0 : volume_of_point_[g] * s.det * size;
      write(i, g, s, order_.real[i] != 0 ? volume : 0.0);
      if (order_.real[i] != 0) shape_.volumes[e] += volume;
    }
    return good;
  }

  void write(std::size_t i, std::size_t g, const Split& s, double volume) {
    const std::size_t at = i / kLanes * static_cast<std::size_t>(shape_.rest_points) + g;
    double* to = shape_.rest.data() + at * shape_.reals * kLanes + i % kLanes;
    const Mat3 inverse = s.flat ? Mat3(Mat3::Identity()) : Mat3(s.R.inverse());
    for (std::size_t row = 0; row < m_; ++row) {
      for (std::size_t column = triangular_ ? row : 0; column < m_; ++column, to += kLanes) {
        *to = inverse(static_cast<Eigen::Index>(row), static_cast<Eigen::Index>(column));
      }
    }
    *to = volume;
    if (shape_.frames.empty()) return;
    double* frame = shape_.frames.data() + at * 9 * kLanes + i % kLanes;
    for (std::size_t k = 0; k < 9; ++k) {
      frame[k * kLanes] = s.Q(static_cast<Eigen::Index>(k / 3), static_cast<Eigen::Index>(k % 3));
    }
  }

  const RestCells& cells_;
  const ElementOrder& order_;
  std::size_t m_;
  bool triangular_;
  bool in_plane_;  ///< z is the same everywhere: the axes of space serve
  std::vector<double> volume_of_point_;
  RestShape shape_;
};

}  // namespace

std::vector<char> affine_cells(const ReferenceCell& reference, const std::vector<std::int32_t>& cells,
                               ConstReals X) {
  std::vector<char> affine(cells.size() / static_cast<std::size_t>(reference.nodes), 1);
  if (reference.points.size() == 1 && find_element(reference.element)->affine) return affine;
  for (std::size_t e = 0; e < affine.size(); ++e) {
    const Cell cell = cell_of(reference, cells, e);
    const Mat3 first = jacobian(reference.points.front(), cell, X);
    const double tolerance = kAffine * first.cwiseAbs().maxCoeff();
    affine[e] = std::ranges::all_of(reference.points, [&](const ReferenceCell::Point& point) {
      return (jacobian(point, cell, X) - first).cwiseAbs().maxCoeff() <= tolerance;
    });
  }
  return affine;
}

RestShape rest_shape(const RestCells& cells, const ElementOrder& order, RestForm form) {
  return Layout(cells, order, form).lay();
}

void lay_rest(const RestCells& cells, const ElementOrder& order, std::span<const ElementOrder::Run> runs,
              RestShape& shape) {
  shape = Layout(cells, order, std::move(shape)).lay(runs);
}

}  // namespace tissu
