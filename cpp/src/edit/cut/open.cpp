#include "edit/cut/open.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <span>

#include "edit/cut/at_sheets.h"
#include "edit/cut/carriers.h"
#include "edit/cut/crumbs.h"
#include "edit/cut/outward.h"
#include "edit/cut/side.h"
#include "tissu/base/error.h"
#include "tissu/base/index.h"
#include "tissu/base/sort_unique.h"

namespace tissu {
namespace {

constexpr double kCoverShare = 0.2;
constexpr double kRoundOff = 1e-12;
constexpr double kLeastAlong = 0.5;  ///< cosine between the normals of a face of the cut and of the blade
constexpr double kBetween = 0.05;    ///< of a cell's longest edge: so far a blade lies inside of another wall
constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

/// A face of a tetrahedron by its vertices in ascending order; an edge of a triangle after -1, an end of a
/// line after two.
struct FaceSide {
  std::array<std::int32_t, 3> key;
  std::int32_t tetra;
  std::uint8_t local;
};

class Opener {
 public:
  Opener(Patch& patch, const Blade& blade, const NearCells& near, const OnCut& known, double t0)
      : patch_(patch),
        blade_(blade),
        part_(blade.part),
        near_(near),
        crowded_(blade.crowded),
        at_sheets_(patch, blade.part, blade.sheets, known),
        known_(known),
        between_own_(std::max(kBetween, t0)),
        all_(blade.part.triangles.size()),
        heights_(patch.vertices.size(), kUnknown) {
    std::iota(all_.begin(), all_.end(), 0);
  }

  OpenedFaces open() {
    const std::vector<FaceSide> sides = faces_on_cut();
    const std::vector<char> carried = carried_sides(sides);
    std::vector<std::size_t> places;
    std::vector<InnerFace> faces;
    for (std::size_t i = 0; i + 1 < sides.size(); ++i) {
      if (sides[i].key != sides[i + 1].key || carried[i] != 0) continue;
      places.push_back(i);
      faces.push_back(inner_face(sides, i));
    }
    keep_crumbs(patch_, blade_, known_, faces);
    for (std::size_t i = 0; i < faces.size(); ++i) {
      if (faces[i].opens) open(sides[places[i]], sides[places[i] + 1]);
    }
    const auto side = [&](std::int32_t piece) { return above(piece); };
    const auto open = [&](std::int32_t piece, std::uint8_t face) { open_face(piece, face); };
    if (patch_.is_mixed()) {
      choose_carriers(patch_, known_, side, open);
      open_carried(sides, carried, 3);
      open_carried(sides, carried, 2);
    }
    std::ranges::sort(opened_.vertices);
    opened_.vertices.erase(std::ranges::unique(opened_.vertices).begin(), opened_.vertices.end());
    return std::move(opened_);
  }

 private:
  /// Sides of thin faces of which every piece lies on a carrier, all of one dimension: 1.
  [[nodiscard]] std::vector<char> carried_sides(const std::vector<FaceSide>& sides) const {
    std::vector<char> carried(sides.size(), 0);
    if (!patch_.is_mixed()) return carried;
    for (std::size_t begin = 0, end = 0; begin < sides.size(); begin = end) {
      std::size_t corners = 0;
      bool all = true;
      for (end = begin; end < sides.size() && sides[end].key == sides[begin].key; ++end) {
        const std::int32_t carrier = top_carrier(patch_, sides[end].tetra);
        const std::size_t own = carrier < 0 ? 0 : patch_.tetra(carrier).corners();
        all = all && own != 0 && (corners == 0 || own == corners);
        corners = own;
      }
      if (all)
        std::fill(carried.begin() + static_cast<std::ptrdiff_t>(begin),
                  carried.begin() + static_cast<std::ptrdiff_t>(end), char{1});
    }
    return carried;
  }

  /// Where pieces of so many corners meet whose carriers the blade has parted.
  void open_carried(const std::vector<FaceSide>& sides, const std::vector<char>& carried,
                    std::size_t corners) {
    for (std::size_t begin = 0, end = 0; begin < sides.size(); begin = end) {
      for (end = begin; end < sides.size() && sides[end].key == sides[begin].key; ++end) {
      }
      if (carried[begin] == 0 || patch_.tetra(sides[begin].tetra).corners() != corners || end - begin < 2)
        continue;
      const std::int32_t first = top_carrier(patch_, sides[begin].tetra);
      bool parted = false;
      for (std::size_t i = begin + 1; i < end; ++i)
        parted = parted ||
                 !hang_together(patch_, first, top_carrier(patch_, sides[i].tetra), vertices_of(sides[i]));
      if (!parted || is_open(sides[begin])) continue;
      open(sides[begin], sides[begin + 1]);
      for (std::size_t i = begin + 2; i < end; ++i) mark_open(sides[i]);
    }
  }

  /// A face by the place of its first side, and whether it opens.
  InnerFace inner_face(const std::vector<FaceSide>& sides, std::size_t i) {
    const FaceSide& a = sides[i];
    const FaceSide& b = sides[i + 1];
    InnerFace face{a.tetra, b.tetra, size_of(a), is_open(a) || is_open(b), false};
    if (face.open) return face;
    face.opens = is_crowded(a, b) ? at_sheets_.parts(vertices_of(a), a.tetra, b.tetra) : parts(a, b);
    const bool is_junction =
        (i > 0 && sides[i - 1].key == a.key) || (i + 2 < sides.size() && sides[i + 2].key == a.key);
    if (face.opens && is_junction) refuse_junction(a);
    return face;
  }

  /// Where the blade covers it.
  void open_face(std::int32_t piece, std::uint8_t face) {
    FaceSide side{{-1, -1, -1}, piece, face};
    const auto vertices = thin_vertices(patch_.tetra(piece), face);
    std::ranges::copy(vertices, side.key.end() - static_cast<std::ptrdiff_t>(vertices.size()));
    std::ranges::sort(side.key);
    const auto is_new = [&](std::int32_t v) { return !is_earlier(v); };
    if (std::ranges::any_of(vertices, is_new) && covered(side, side)) open(side, side);
  }

  /// Whether its vertices are on the cut, or some at walls beside it.
  [[nodiscard]] bool may_be_open(const std::array<std::int32_t, 3>& key) const {
    const auto is_on = [&](std::int32_t v) { return v >= 0 && known_.on(v); };
    const auto may_be = [&](std::int32_t v) { return v < 0 || known_.may_end(v); };
    return std::ranges::any_of(key, is_on) && std::ranges::all_of(key, may_be);
  }

  /// What an earlier sweep of the incision put on the cut, and this one not.
  [[nodiscard]] bool is_earlier(std::int32_t v) const {
    return known_[v].before || (known_[v].wall && !known_.on(v));
  }

  [[nodiscard]] std::vector<FaceSide> faces_on_cut() const {
    std::vector<FaceSide> sides;
    for (std::size_t t = 0; t < patch_.tetrahedra.size(); ++t) {
      const auto& v = patch_.tetrahedra[t].vertices;
      for (std::size_t f = 0; f < patch_.tetrahedra[t].corners(); ++f) {
        std::array<std::int32_t, 3> key{v[kOpposite[f][0]], v[kOpposite[f][1]], v[kOpposite[f][2]]};
        if (!may_be_open(key)) continue;
        std::ranges::sort(key);
        sides.push_back({key, static_cast<std::int32_t>(t), static_cast<std::uint8_t>(f)});
      }
    }
    std::ranges::sort(sides, [](const FaceSide& a, const FaceSide& b) {
      return a.key != b.key ? a.key < b.key : a.tetra < b.tetra;
    });
    return sides;
  }

  /// What an earlier sweep of the incision put on the cut is not on a sheet of this one.
  [[nodiscard]] bool is_crowded(const FaceSide& a, const FaceSide& b) const {
    if (!crowded_.has(patch_.tetra(a.tetra).cell) && !crowded_.has(patch_.tetra(b.tetra).cell)) return false;
    return std::ranges::none_of(vertices_of(a), [&](std::int32_t v) { return is_earlier(v); });
  }

  /// Whether the blade goes between two tetrahedra at their common face.
  bool parts(const FaceSide& a, const FaceSide& b) {
    if (above(a.tetra) == above(b.tetra)) return false;
    return covered(a, b) || is_bent_away(a);
  }

  [[nodiscard]] bool is_open(const FaceSide& side) const {
    return (patch_.tetra(side.tetra).cut >> side.local & 1U) != 0;
  }

  [[noreturn]] static void refuse_junction(const FaceSide& side) {
    throw ParameterError(
        vertices_of(side).size() == 1
            ? "the blade passes through a node that more than two lines share, where a cut cannot say which "
              "stay together; move the blade a little off the node."
            : "the blade follows an edge that more than two triangles share, where a cut cannot say which "
              "stay "
              "together; move the blade a little off the edge.");
  }

  [[nodiscard]] std::span<const std::int32_t> triangles(std::int32_t tetra) const {
    return near_.triangles(patch_.cell(patch_.tetra(tetra).cell).number);
  }

  /// Height of a vertex above the blade; its crossed edges decide its side, else the nearest triangle of all:
  /// the box of a large one may meet cells from which the blade is far.
  double height_of(std::int32_t v) {
    double& known = heights_[at(v)];
    if (!std::isnan(known)) return known;
    known = signed_height(part_, all_, patch_.vertex(v).place);
    int votes = known_[v].votes;
    if (known_[v].wall && votes == 0) {
      for (const std::int32_t t : patch_.tetrahedra_at(v)) votes += side_of_earlier(patch_.tetra(t));
    }
    if (!known_.on(v) && votes != 0) {
      known = std::copysign(std::max(std::abs(known), std::numeric_limits<double>::min()), votes);
    }
    return known;
  }

  /// Above what an earlier sweep of the incision opened, a tetrahedron is above the blade: 1; below: -1; at
  /// no such face: 0. A face across the blade belongs to another cut, whose vertices lie on both; of several
  /// the one that lies flattest along the blade counts.
  [[nodiscard]] int side_of_earlier(const Patch::Tetra& tetra) const {
    double flattest = kLeastAlong;
    int side = 0;
    for (std::size_t f = 0; f < tetra.corners(); ++f) {
      if ((tetra.cut >> f & 1U) == 0) continue;
      Vec3 middle = Vec3::Zero();
      bool before = true;
      for (const std::uint8_t i : kOpposite[f]) {
        const std::int32_t corner = tetra.vertices[i];
        if (corner < 0) continue;
        before = before && (known_[corner].before || known_[corner].wall);
        middle += patch_.vertex(corner).place / static_cast<double>(tetra.corners() - 1);
      }
      if (!before) continue;
      const Vec3 out = outward(patch_, tetra, f, &Patch::Vertex::place).normalized();
      const NearestPlace blade = nearest_place(part_, all_, middle);
      const double along = out.dot(blade.normal);
      if (std::abs(along) <= flattest) continue;
      // The tetrahedron lies between another wall of the incision and the blade.
      const double between = blade.triangle >= part_.fresh ? kBetween : between_own_;
      if (out.dot(middle - blade.place) > between * patch_.cell(tetra.cell).size) continue;
      flattest = std::abs(along);
      side = along < 0.0 ? 1 : -1;
    }
    return side;
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
      if (v < 0) continue;
      middle += patch_.vertex(v).place / static_cast<double>(tetra.corners());
      if (known_.on(v)) continue;
      all = false;
      sum += height_of(v);
    }
    if (all) sum = signed_height(part_, all_, middle);
    return sum >= 0.0;
  }

  [[nodiscard]] bool covered(const FaceSide& a, const FaceSide& b) const {
    const std::span<const std::int32_t> vertices = vertices_of(a);
    const auto before = std::ranges::count_if(vertices, [&](std::int32_t v) { return known_[v].before; });
    const bool all_on = std::ranges::all_of(vertices, [&](std::int32_t v) { return known_.on(v); });
    // The blade went from those to the others.
    if (all_on && before > 0 && before < static_cast<std::ptrdiff_t>(vertices.size())) return true;
    if (before == 0 && vertices.size() == 1) return true;  // the blade crosses the line there
    const Vec3 mean = met_mean(a);
    double longest = 0.0;
    for (std::size_t i = 0; i < vertices.size(); ++i) {
      const Vec3& met = known_[vertices[i]].met;
      longest = std::max(longest, (met - known_[vertices[(i + 1) % vertices.size()]].met).norm());
    }
    const double reach = kCoverShare * longest + kRoundOff * mean.cwiseAbs().maxCoeff();
    const auto within = [&](std::span<const std::int32_t> list) {
      return distance(part_, list, mean) <= reach;
    };
    return within(triangles(a.tetra)) || within(triangles(b.tetra)) || within(all_);
  }

  /// Whether a face that the blade does not cover is one that the blade passes, and not beyond its border.
  [[nodiscard]] bool is_bent_away(const FaceSide& side) const {
    const auto is_new = [&](std::int32_t v) { return !is_earlier(v); };
    return std::ranges::all_of(vertices_of(side), is_new) && !is_beyond_border(part_, all_, met_mean(side));
  }

  /// Of the places where the blade met the vertices of a face.
  [[nodiscard]] Vec3 met_mean(const FaceSide& side) const {
    Vec3 mean = Vec3::Zero();
    for (const std::int32_t v : vertices_of(side)) mean += known_[v].met;
    return mean / static_cast<double>(vertices_of(side).size());
  }

  static std::span<const std::int32_t> vertices_of(const FaceSide& side) {
    return std::span(side.key).subspan(static_cast<std::size_t>(std::ranges::count(side.key, -1)));
  }

  void mark_open(const FaceSide& side) {
    Patch::Tetra& tetra = patch_.tetrahedra[at(side.tetra)];
    tetra.cut |= static_cast<std::uint8_t>(1U << side.local);
    patch_.cells[at(tetra.cell)].opened = true;
  }

  void open(const FaceSide& a, const FaceSide& b) {
    for (const FaceSide& side : {a, b}) mark_open(side);
    opened_.vertices.insert(opened_.vertices.end(), vertices_of(a).begin(), vertices_of(a).end());
    ++opened_.count;
    add_area(a, b);
  }

  /// Area now; of an edge its length, of a vertex 0.
  [[nodiscard]] double size_of(const FaceSide& side) const {
    const auto vertices = vertices_of(side);
    const auto corner = [&](std::size_t i) -> const Vec3& { return patch_.vertex(vertices[i]).place; };
    if (vertices.size() == 3) return 0.5 * (corner(1) - corner(0)).cross(corner(2) - corner(0)).norm();
    return vertices.size() == 2 ? (corner(1) - corner(0)).norm() : 0.0;
  }

  void add_area(const FaceSide& a, const FaceSide& b) {
    const std::span<const std::int32_t> vertices = vertices_of(a);
    const auto corner = [&](std::size_t i) -> const Patch::Vertex& { return patch_.vertex(vertices[i]); };
    const auto area = [](const Vec3& p, const Vec3& q, const Vec3& r) {
      return 0.5 * (q - p).cross(r - p).norm();
    };
    if (vertices.size() == 3) {
      opened_.area += area(corner(0).place, corner(1).place, corner(2).place);
      opened_.rest_area += area(corner(0).rest, corner(1).rest, corner(2).rest);
    } else {
      const auto thickness = [&](const FaceSide& side) {
        return patch_.cell(patch_.tetra(side.tetra).cell).thickness;
      };
      const double mean = 0.5 * (thickness(a) + thickness(b));
      const bool line = vertices.size() == 1;
      opened_.area += mean * (line ? 1.0 : (corner(1).place - corner(0).place).norm());
      opened_.rest_area += mean * (line ? 1.0 : (corner(1).rest - corner(0).rest).norm());
    }
  }

  Patch& patch_;
  const Blade& blade_;
  const SweepPart& part_;
  const NearCells& near_;
  const CrowdedCells& crowded_;
  FacesAtSheets at_sheets_;
  const OnCut& known_;
  double between_own_;  ///< of a cell's longest edge: so far the cut may be from the blade that made it
  std::vector<std::int32_t> all_;
  std::vector<double> heights_;
  OpenedFaces opened_;
};

}  // namespace

OpenedFaces open_faces(Patch& patch, const Blade& blade, const NearCells& near, const OnCut& known,
                       double t0) {
  return Opener(patch, blade, near, known, t0).open();
}

}  // namespace tissu
