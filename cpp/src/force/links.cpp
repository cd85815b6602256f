#include "tissu/force/links.h"

#include <array>
#include <string>

#include "tissu/base/error.h"

namespace tissu {
namespace {

constexpr std::size_t kNumbers = 11;  ///< of a link

/// From the frame's origin to the point, in space.
Vec3 arm(const State& state, const LinkPoint& point) {
  return point.frame < 0 ? Vec3(Vec3::Zero())
                         : Vec3(state.rotations[static_cast<std::size_t>(point.frame)] * point.place);
}

Vec3 position(const State& state, const LinkPoint& point) {
  return block(ConstReals(state.positions), point.block) + arm(state, point);
}

/// dp/dq of a point, block after block: I for the translation, -[arm]x for the rotation.
struct Jacobian {
  std::array<std::int32_t, 2> block;
  std::array<Mat3, 2> J;
  std::size_t count;
};

Jacobian jacobian(const State& state, const LinkPoint& point) {
  Jacobian result{
      {point.block, point.block + 1}, {Mat3::Identity(), Mat3::Zero()}, point.frame < 0 ? 1U : 2U};
  const Vec3 r = arm(state, point);
  result.J[1] << 0.0, r.z(), -r.y(), -r.z(), 0.0, r.x(), r.y(), -r.x(), 0.0;
  return result;
}

void add_point_force(const State& state, const LinkPoint& point, const Vec3& force, Reals f) {
  block(f, point.block) += force;
  if (point.frame >= 0) block(f, point.block + 1) += arm(state, point).cross(force);
}

/// Calls f(row, column, block of J^T J) for the difference p_b - p_a.
template <class Function>
void for_blocks(const State& state, const LinkPoint& a, const LinkPoint& b, Function&& f) {
  const std::array<Jacobian, 2> ends = {jacobian(state, a), jacobian(state, b)};
  for (std::size_t m = 0; m < 2; ++m) {
    for (std::size_t n = 0; n < 2; ++n) {
      const double sign = m == n ? 1.0 : -1.0;
      for (std::size_t i = 0; i < ends[m].count; ++i) {
        for (std::size_t j = 0; j < ends[n].count; ++j) {
          f(ends[m].block[i], ends[n].block[j], Mat3(sign * ends[m].J[i].transpose() * ends[n].J[j]));
        }
      }
    }
  }
}

}  // namespace

std::vector<double> Links::numbers() const {
  std::vector<double> result;
  for (const Link& link : links_) {
    for (const LinkPoint& point : {link.a, link.b}) {
      result.insert(result.end(), {static_cast<double>(point.block), static_cast<double>(point.frame),
                                   point.place.x(), point.place.y(), point.place.z()});
    }
    result.push_back(link.stiffness);
  }
  return result;
}

void Links::restore(ConstReals numbers) {
  if (numbers.size() % kNumbers != 0) {
    throw ParameterError("found " + std::to_string(numbers.size()) + " numbers of links; a multiple of " +
                         std::to_string(kNumbers) + " is accepted.");
  }
  links_.clear();
  const auto point = [](const double* from) -> LinkPoint {
    return {static_cast<std::int32_t>(from[0]), static_cast<std::int32_t>(from[1]),
            Vec3(from[2], from[3], from[4])};
  };
  for (std::size_t i = 0; i < numbers.size(); i += kNumbers) {
    links_.push_back({point(&numbers[i]), point(&numbers[i + 5]), numbers[i + 10]});
  }
}

std::int32_t Links::add(const LinkPoint& a, const LinkPoint& b, double stiffness) {
  if (!(stiffness > 0.0)) {
    throw ParameterError("a link's stiffness is " + std::to_string(stiffness) + " N/m; it must be positive.");
  }
  links_.push_back({a, b, stiffness});
  return static_cast<std::int32_t>(links_.size()) - 1;
}

std::vector<std::pair<std::int32_t, std::int32_t>> Links::coupled() const {
  std::vector<std::pair<std::int32_t, std::int32_t>> pairs;
  for (const Link& link : links_) {
    for (const LinkPoint& point : {link.a, link.b}) {
      if (point.frame >= 0) pairs.emplace_back(point.block, point.block + 1);
    }
    for (std::int32_t i = 0; i < (link.a.frame < 0 ? 1 : 2); ++i) {
      for (std::int32_t j = 0; j < (link.b.frame < 0 ? 1 : 2); ++j) {
        pairs.emplace_back(link.a.block + i, link.b.block + j);
      }
    }
  }
  return pairs;
}

void Links::add_force(const State& state, Reals f) const {
  for (const Link& link : links_) {
    const Vec3 force = link.stiffness * (position(state, link.b) - position(state, link.a));
    add_point_force(state, link.a, force, f);
    add_point_force(state, link.b, -force, f);
  }
}

void Links::add_stiffness(const State& state, StiffnessScale scale, BlockMatrix& matrix) const {
  for (const Link& link : links_) {
    for_blocks(state, link.a, link.b, [&](std::int32_t row, std::int32_t column, const Mat3& JtJ) {
      matrix.add(row, column, -scale.position * link.stiffness * JtJ);
    });
  }
}

void Links::add_product(const State& state, StiffnessScale scale, ConstReals p, Reals out) const {
  for (const Link& link : links_) {
    for_blocks(state, link.a, link.b, [&](std::int32_t row, std::int32_t column, const Mat3& JtJ) {
      block(out, row) -= scale.position * link.stiffness * (JtJ * block(p, column));
    });
  }
}

double Links::energy(const State& state) const {
  double sum = 0.0;
  for (const Link& link : links_) {
    sum += 0.5 * link.stiffness * (position(state, link.b) - position(state, link.a)).squaredNorm();
  }
  return sum;
}

}  // namespace tissu
