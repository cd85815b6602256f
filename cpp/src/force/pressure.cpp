#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <iterator>
#include <span>
#include <string>
#include <utility>

#include "tissu/base/error.h"
#include "tissu/base/sort_unique.h"
#include "tissu/element/reference_cell.h"
#include "tissu/element/reference_part.h"
#include "tissu/force/load.h"

namespace tissu {
namespace {

using Nodes = std::span<const std::int32_t>;

/// The rule that integrates N_a (x,1 x x,2) exactly: of degree p + 2 (p - 1) on triangles, p + 2 p - 1 along
/// each side of a quadrangle, p + p - 1 along an edge.
ReferenceCell exact_rule(const FaceCells& faces) {
  const std::string& element = faces.element;
  const ElementInfo* info = find_element(element);
  const bool edge = info != nullptr && info->dimension == 1 && faces.thickness > 0.0;
  if (info == nullptr || (info->dimension != 2 && !edge)) {
    throw ParameterError(
        "faces of type \"" + element +
        "\" carry no load; triangle, triangle6, quad, quad8 and quad9 do, and line and line3 "
        "that are edges of a flat body and have its thickness.");
  }
  const bool triangle = element.starts_with("triangle");
  const int degree = edge ? 2 * info->order - 1 : 3 * info->order - (triangle ? 2 : 1);
  const auto* enough =
      std::ranges::find_if(info->rules, [&](const RuleInfo& rule) { return rule.degree >= degree; });
  return reference_cell(element, enough == info->rules.end() ? info->rules.back().name : enough->name);
}

/// The same on the pieces of a face: in all, a quadrangle has twice the degree along each side.
ReferenceCell exact_rule(const FacePart& part) {
  if (part.pieces.empty()) return exact_rule(FaceCells{std::string(part.element), part.nodes});
  const ElementInfo& info = *find_element(part.element);
  const int degree = part.element.starts_with("triangle") ? 3 * info.order - 2 : 2 * (3 * info.order - 1);
  ReferenceCell all{part.element, info.nodes, info.dimension, {}};
  for (const std::vector<ReferencePoint>& piece : part.pieces) {
    ReferenceCell rule = reference_part(part.element, piece, degree);
    std::ranges::move(rule.points, std::back_inserter(all.points));
  }
  return all;
}

/// x,1 and x,2 at a point.
std::array<Vec3, 2> tangents(const ReferenceCell::Point& point, Nodes face, double thickness, ConstReals x) {
  std::array<Vec3, 2> t = {Vec3::Zero(), thickness * Vec3::UnitZ()};
  for (std::size_t a = 0; a < face.size(); ++a) {
    for (std::size_t k = 0; k < 2; ++k) t[k] += point.gradients[a][k] * block(x, face[a]);
  }
  return t;
}

/// Calls f(nodes of the face, point, x,1 and x,2) for each point of each face.
template <class Function>
void for_points(const FaceCells& faces, const ReferenceCell& rule, ConstReals x, Function&& f) {
  const auto count = static_cast<std::size_t>(rule.nodes);
  for (std::size_t first = 0; first + count <= faces.nodes.size(); first += count) {
    const Nodes face = Nodes(faces.nodes).subspan(first, count);
    for (const ReferenceCell::Point& point : rule.points) {
      f(face, point, tangents(point, face, faces.thickness, x));
    }
  }
}

/// [a]x, the matrix of b -> a x b
Mat3 cross_matrix(const Vec3& a) {
  Mat3 m;
  m << 0.0, -a.z(), a.y(), a.z(), 0.0, -a.x(), -a.y(), a.x(), 0.0;
  return m;
}

/// Where a point is that rides on nodes.
Vec3 place_of(const std::vector<CarriedNode>& point, ConstReals x) {
  Vec3 place = Vec3::Zero();
  for (const CarriedNode& one : point) place += one.weight * block(x, one.node);
  return place;
}

std::array<Vec3, 3> places_of(const CarriedFace& face, ConstReals x) {
  return {place_of(face[0], x), place_of(face[1], x), place_of(face[2], x)};
}

/// As long as its area.
Vec3 normal_of(const std::array<Vec3, 3>& p) { return 0.5 * (p[1] - p[0]).cross(p[2] - p[0]); }

}  // namespace

void add_areas(const FaceCells& faces, ConstReals positions, std::vector<double>& nodal,
               const ReferenceCell* part) {
  for_points(faces, part == nullptr ? exact_rule(faces) : *part, positions,
             [&](Nodes face, const ReferenceCell::Point& point, const auto& t) {
               const double area = point.weight * t[0].cross(t[1]).norm();
               for (std::size_t a = 0; a < face.size(); ++a)
                 nodal[static_cast<std::size_t>(face[a])] += area * point.values[a];
             });
}

void add_normals(const FaceCells& faces, ConstReals positions, std::vector<double>& nodal,
                 const ReferenceCell* part) {
  for_points(faces, part == nullptr ? exact_rule(faces) : *part, positions,
             [&](Nodes face, const ReferenceCell::Point& point, const auto& t) {
               const Vec3 normal = point.weight * t[0].cross(t[1]);
               for (std::size_t a = 0; a < face.size(); ++a)
                 block(Reals(nodal), face[a]) += point.values[a] * normal;
             });
}

Pressure::Pressure(std::string name, std::vector<FaceCells> faces, double pressure, History history,
                   std::vector<CarriedFace> carried, std::vector<FacePart> parts)
    : name_(std::move(name)), pressure_(pressure), history_(std::move(history)) {
  act_on(std::move(faces), std::move(carried), std::move(parts));
}

void Pressure::act_on(std::vector<FaceCells> faces, std::vector<CarriedFace> carried,
                      std::vector<FacePart> parts) {
  carried_ = std::move(carried);
  faces_.clear();
  for (FaceCells& some : faces) {
    ReferenceCell rule = exact_rule(some);
    faces_.push_back({std::move(some), std::move(rule)});
  }
  for (FacePart& part : parts) {
    ReferenceCell rule = exact_rule(part);
    faces_.push_back({{std::string(part.element), std::move(part.nodes)}, std::move(rule)});
  }
}

double Pressure::pressure_at(const State& state) const {
  const double* changed = change_.values(state);
  return (changed == nullptr ? pressure_ : *changed) * change_.factor(state, history_);
}

void Pressure::carry_memory(const ForceModel& before, const Memory& then, Memory& now) const {
  const auto* pressure = dynamic_cast<const Pressure*>(&before);
  if (pressure != nullptr && pressure->name_ == name_) change_.carry(pressure->change_, then, now);
}

void Pressure::couple(SparsityBuilder& builder) const {
  for (const Ruled& some : faces_) builder.add_cells(some.faces.nodes, some.rule.nodes);
  for (const CarriedFace& face : carried_) {
    std::vector<std::int32_t> nodes;
    for (const auto& point : face) {
      for (const CarriedNode& one : point) nodes.push_back(one.node);
    }
    sort_unique(nodes);
    builder.add_cells(nodes, static_cast<int>(nodes.size()));
  }
}

void Pressure::add_force(const State& state, Scratch& /*scratch*/, Reals f) const {
  const double p = state.load_factor * pressure_at(state);
  for (const Ruled& some : faces_) {
    for_points(some.faces, some.rule, state.positions,
               [&](Nodes face, const ReferenceCell::Point& point, const auto& t) {
                 const Vec3 push = -p * point.weight * t[0].cross(t[1]);
                 for (std::size_t a = 0; a < face.size(); ++a) block(f, face[a]) += point.values[a] * push;
               });
  }
  for (const CarriedFace& face : carried_) {
    const Vec3 push = -p / 3.0 * normal_of(places_of(face, state.positions));
    for (const auto& point : face) {
      for (const CarriedNode& one : point) block(f, one.node) += one.weight * push;
    }
  }
}

/// The normal changes with x_b by D_b = N_b,2 [x,1]x - N_b,1 [x,2]x, which is skew; so the symmetric part of
/// the stiffness has the blocks (N_a D_b - N_b D_a) / 2.
template <class Function>
void Pressure::for_blocks(const State& state, double scale, Function&& f) const {
  const double p = scale * state.load_factor * pressure_at(state);
  for (const Ruled& some : faces_) {
    for_points(some.faces, some.rule, state.positions,
               [&](Nodes face, const ReferenceCell::Point& point, const auto& t) {
                 const std::array<Mat3, 2> skew = {cross_matrix(t[0]), cross_matrix(t[1])};
                 const auto D = [&](std::size_t b) {
                   return Mat3(point.gradients[b][1] * skew[0] - point.gradients[b][0] * skew[1]);
                 };
                 for (std::size_t a = 0; a < face.size(); ++a) {
                   for (std::size_t b = 0; b < face.size(); ++b) {
                     if (a == b) continue;
                     f(face[a], face[b],
                       Mat3(-0.5 * p * point.weight * (point.values[a] * D(b) - point.values[b] * D(a))));
                   }
                 }
               });
  }
  // Of a flat triangle D_b is half of [the side opposite to b]x, against its sense: n = 1/2 sum x_b x x_c.
  for (const CarriedFace& face : carried_) {
    const std::array<Vec3, 3> x = places_of(face, state.positions);
    const auto D = [&](std::size_t b) { return Mat3(0.5 * cross_matrix(x[(b + 2) % 3] - x[(b + 1) % 3])); };
    for (std::size_t a = 0; a < 3; ++a) {
      for (std::size_t b = 0; b < 3; ++b) {
        if (a == b) continue;
        const Mat3 B = -p / 6.0 * (D(b) - D(a));
        for (const CarriedNode& one : face[a]) {
          for (const CarriedNode& other : face[b])
            f(one.node, other.node, Mat3(one.weight * other.weight * B));
        }
      }
    }
  }
}

void Pressure::add_stiffness(const State& state, Scratch& /*scratch*/, StiffnessScale scale,
                             BlockMatrix& matrix) const {
  if (scale.definite) return;
  for_blocks(state, scale.position,
             [&](std::int32_t a, std::int32_t b, const Mat3& B) { matrix.add(a, b, B); });
}

void Pressure::add_product(const State& state, Scratch& /*scratch*/, StiffnessScale scale, ConstReals p,
                           Reals out) const {
  for_blocks(state, scale.position,
             [&](std::int32_t a, std::int32_t b, const Mat3& B) { block(out, a) += B * block(p, b); });
}

/// A third of the flux of x; of a flat body half of it.
double Pressure::energy(const State& state, Scratch& /*scratch*/) const {
  const ConstReals x(state.positions);
  double volume = 0.0;
  for (const Ruled& some : faces_) {
    const double share = 1.0 / (some.rule.dimension + 1.0);
    for_points(some.faces, some.rule, x, [&](Nodes face, const ReferenceCell::Point& point, const auto& t) {
      Vec3 place = Vec3::Zero();
      for (std::size_t a = 0; a < face.size(); ++a) place += point.values[a] * block(x, face[a]);
      volume += share * point.weight * place.dot(t[0].cross(t[1]));
    });
  }
  for (const CarriedFace& face : carried_) {
    const std::array<Vec3, 3> p = places_of(face, x);
    volume += (p[0] + p[1] + p[2]).dot(normal_of(p)) / 9.0;
  }
  return state.load_factor * pressure_at(state) * volume;
}

}  // namespace tissu
