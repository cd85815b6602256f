#include "edit/cut/open.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <span>

#include "edit/cut/side.h"

namespace tissu {
namespace {

std::size_t at(std::int32_t i) { return static_cast<std::size_t>(i); }

constexpr double kCoverShare = 0.2;
constexpr double kRoundOff = 1e-12;
constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

/// A face of a tetrahedron by its vertices in ascending order.
struct FaceSide {
  std::array<std::int32_t, 3> key;
  std::int32_t tetra;
  std::uint8_t local;
};

class Opener {
 public:
  Opener(Patch& patch, const SweepPart& part, const NearCells& near, const OnCut& known)
      : patch_(patch),
        part_(part),
        near_(near),
        known_(known),
        all_(part.triangles.size()),
        heights_(patch.vertices.size(), kUnknown) {
    std::iota(all_.begin(), all_.end(), 0);
  }

  OpenedFaces open() {
    const std::vector<FaceSide> sides = faces_on_cut();
    for (std::size_t i = 0; i + 1 < sides.size(); ++i) {
      if (sides[i].key != sides[i + 1].key) continue;
      if (is_open(sides[i]) || is_open(sides[i + 1])) continue;
      if (above(sides[i].tetra) != above(sides[i + 1].tetra) && covered(sides[i], sides[i + 1])) {
        open(sides[i], sides[i + 1]);
      }
    }
    std::ranges::sort(opened_.vertices);
    opened_.vertices.erase(std::unique(opened_.vertices.begin(), opened_.vertices.end()),
                           opened_.vertices.end());
    return std::move(opened_);
  }

 private:
  [[nodiscard]] std::vector<FaceSide> faces_on_cut() const {
    std::vector<FaceSide> sides;
    for (std::size_t t = 0; t < patch_.tetrahedra.size(); ++t) {
      const auto& v = patch_.tetrahedra[t].vertices;
      for (std::uint8_t f = 0; f < 4; ++f) {
        std::array<std::int32_t, 3> key{v[kOpposite[f][0]], v[kOpposite[f][1]], v[kOpposite[f][2]]};
        if (!std::ranges::all_of(key, [&](std::int32_t i) { return known_.on(i); })) continue;
        std::ranges::sort(key);
        sides.push_back({key, static_cast<std::int32_t>(t), f});
      }
    }
    std::ranges::sort(sides, [](const FaceSide& a, const FaceSide& b) {
      return a.key != b.key ? a.key < b.key : a.tetra < b.tetra;
    });
    return sides;
  }

  [[nodiscard]] bool is_open(const FaceSide& side) const {
    return (patch_.tetra(side.tetra).cut >> side.local & 1U) != 0;
  }

  [[nodiscard]] std::span<const std::int32_t> triangles(std::int32_t tetra) const {
    return near_.triangles(patch_.cell(patch_.tetra(tetra).cell).number);
  }

  /// Height of a vertex above the blade; its crossed edges decide its side, else the triangles near the cells
  /// around.
  double height_of(std::int32_t v) {
    double& known = heights_[at(v)];
    if (!std::isnan(known)) return known;
    std::vector<std::int32_t> candidates;
    for (const std::int32_t t : patch_.tetrahedra_at(v)) {
      candidates.insert(candidates.end(), triangles(t).begin(), triangles(t).end());
    }
    std::ranges::sort(candidates);
    candidates.erase(std::unique(candidates.begin(), candidates.end()), candidates.end());
    if (candidates.empty()) candidates = all_;
    known = signed_height(part_, candidates, patch_.vertex(v).place);
    const int votes = known_[v].votes;
    if (!known_.on(v) && votes != 0) {
      known = std::copysign(std::max(std::abs(known), std::numeric_limits<double>::min()), votes);
    }
    return known;
  }

  /// Above what an earlier sweep of the incision opened, a tetrahedron is above the blade: 1; below: -1; at
  /// no such face: 0.
  [[nodiscard]] int side_of_earlier(const Patch::Tetra& tetra) const {
    for (std::size_t f = 0; f < 4; ++f) {
      if ((tetra.cut >> f & 1U) == 0) continue;
      const auto corner = [&](std::size_t i) { return tetra.vertices[kOpposite[f][i]]; };
      if (!known_[corner(0)].before || !known_[corner(1)].before || !known_[corner(2)].before) continue;
      const Vec3& a = patch_.vertex(corner(0)).place;
      const Vec3& b = patch_.vertex(corner(1)).place;
      const Vec3& c = patch_.vertex(corner(2)).place;
      const Vec3 normal = nearest_normal(part_, all_, (a + b + c) / 3.0);
      return (b - a).cross(c - a).dot(normal) < 0.0 ? 1 : -1;  // outward of the tetrahedron
    }
    return 0;
  }

  /// Whether a tetrahedron is above the blade: its vertices that are not on the cut decide, its middle if all
  /// are.
  bool above(std::int32_t number) {
    const Patch::Tetra& tetra = patch_.tetra(number);
    if (const int earlier = side_of_earlier(tetra); earlier != 0) return earlier > 0;
    double sum = 0.0;
    bool all = true;
    Vec3 middle = Vec3::Zero();
    for (const std::int32_t v : tetra.vertices) {
      middle += 0.25 * patch_.vertex(v).place;
      if (known_.on(v)) continue;
      all = false;
      sum += height_of(v);
    }
    if (all) sum = signed_height(part_, near_or_all(triangles(number)), middle);
    return sum >= 0.0;
  }

  [[nodiscard]] std::span<const std::int32_t> near_or_all(std::span<const std::int32_t> list) const {
    return list.empty() ? std::span<const std::int32_t>(all_) : list;
  }

  [[nodiscard]] bool covered(const FaceSide& a, const FaceSide& b) const {
    const auto before = std::ranges::count_if(a.key, [&](std::int32_t v) { return known_[v].before; });
    if (before == 1 || before == 2) return true;  // the blade went from those to the others
    std::array<Vec3, 3> met;
    for (std::size_t i = 0; i < 3; ++i) met[i] = known_[a.key[i]].met;
    const Vec3 mean = (met[0] + met[1] + met[2]) / 3.0;
    double longest = 0.0;
    for (std::size_t i = 0; i < 3; ++i) longest = std::max(longest, (met[i] - met[(i + 1) % 3]).norm());
    const double reach = kCoverShare * longest + kRoundOff * mean.cwiseAbs().maxCoeff();
    const auto within = [&](std::span<const std::int32_t> list) {
      return distance(part_, list, mean) <= reach;
    };
    return within(triangles(a.tetra)) || within(triangles(b.tetra)) || within(all_);
  }

  void open(const FaceSide& a, const FaceSide& b) {
    for (const FaceSide& side : {a, b}) {
      Patch::Tetra& tetra = patch_.tetrahedra[at(side.tetra)];
      tetra.cut |= static_cast<std::uint8_t>(1U << side.local);
      patch_.cells[at(tetra.cell)].opened = true;
    }
    const auto corner = [&](std::size_t i) -> const Patch::Vertex& { return patch_.vertex(a.key[i]); };
    const auto area = [](const Vec3& p, const Vec3& q, const Vec3& r) {
      return 0.5 * (q - p).cross(r - p).norm();
    };
    ++opened_.count;
    opened_.area += area(corner(0).place, corner(1).place, corner(2).place);
    opened_.rest_area += area(corner(0).rest, corner(1).rest, corner(2).rest);
    opened_.vertices.insert(opened_.vertices.end(), a.key.begin(), a.key.end());
  }

  Patch& patch_;
  const SweepPart& part_;
  const NearCells& near_;
  const OnCut& known_;
  std::vector<std::int32_t> all_;
  std::vector<double> heights_;
  OpenedFaces opened_;
};

}  // namespace

OpenedFaces open_faces(Patch& patch, const SweepPart& part, const NearCells& near, const OnCut& known) {
  return Opener(patch, part, near, known).open();
}

}  // namespace tissu
