#include "edit/cut/at_sheets.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "edit/cut/side.h"

namespace tissu {
namespace {

constexpr double kMargin = 0.05;  ///< of the diagonal of a box, on each side
constexpr double kCoverShare = 0.2;

}  // namespace

bool FacesAtSheets::parts(std::span<const std::int32_t> face, std::int32_t a, std::int32_t b) const {
  const BladeSheets::Inside inside = sheets_.in(around(face, a, b));
  for (std::int32_t sheet = 0; sheet < inside.count; ++sheet) {
    if (!std::ranges::all_of(face, [&](std::int32_t v) { return is_on(v, inside, sheet); })) continue;
    const std::vector<std::int32_t> triangles = inside.members(sheet);
    if (above(a, inside, sheet, triangles) == above(b, inside, sheet, triangles)) continue;
    if (covers(face, inside, sheet, triangles)) return true;
  }
  return false;
}

/// The box of both tetrahedra and of the places where the blade met the vertices of the face.
Eigen::AlignedBox3d FacesAtSheets::around(std::span<const std::int32_t> face, std::int32_t a,
                                          std::int32_t b) const {
  Eigen::AlignedBox3d box;
  for (const std::int32_t t : {a, b}) {
    for (std::size_t i = 0; i < patch_.tetra(t).corners(); ++i)
      box.extend(patch_.vertex(patch_.tetra(t).vertices[i]).place);
  }
  for (const std::int32_t v : face) {
    known_.each_meeting(v, [&](const OnCut::Meeting& meeting) {
      if (meeting.on) box.extend(meeting.place);
    });
  }
  const Vec3 margin = Vec3::Constant(kMargin * box.diagonal().norm());
  return {box.min() - margin, box.max() + margin};
}

bool FacesAtSheets::is_on(std::int32_t v, const BladeSheets::Inside& inside, std::int32_t sheet) const {
  bool on = false;
  known_.each_meeting(v, [&](const OnCut::Meeting& meeting) {
    on = on || (meeting.on && inside.of(meeting.triangle) == sheet);
  });
  return on;
}

/// The vertices of a tetrahedron that are not on the sheet decide, its middle if all are.
bool FacesAtSheets::above(std::int32_t tetra, const BladeSheets::Inside& inside, std::int32_t sheet,
                          std::span<const std::int32_t> triangles) const {
  const std::size_t corners = patch_.tetra(tetra).corners();
  double sum = 0.0;
  bool all = true;
  Vec3 middle = Vec3::Zero();
  for (std::size_t i = 0; i < corners; ++i) {
    const std::int32_t v = patch_.tetra(tetra).vertices[i];
    const Vec3& place = patch_.vertex(v).place;
    middle += place / static_cast<double>(corners);
    if (is_on(v, inside, sheet)) continue;
    all = false;
    double height = signed_height(part_, triangles, place);
    int votes = 0;
    known_.each_meeting(v, [&](const OnCut::Meeting& meeting) {
      if (inside.of(meeting.triangle) == sheet) votes += meeting.vote;
    });
    if (votes != 0)
      height = std::copysign(std::max(std::abs(height), std::numeric_limits<double>::min()), votes);
    sum += height;
  }
  if (all) sum = signed_height(part_, triangles, middle);
  return sum >= 0.0;
}

/// The mean of the places where the blade met the vertices lies near the sheet, or not beyond its border.
bool FacesAtSheets::covers(std::span<const std::int32_t> face, const BladeSheets::Inside& inside,
                           std::int32_t sheet, std::span<const std::int32_t> triangles) const {
  std::vector<Vec3> met;
  for (const std::int32_t v : face) {
    double least = std::numeric_limits<double>::infinity();
    met.emplace_back(Vec3::Zero());
    known_.each_meeting(v, [&](const OnCut::Meeting& meeting) {
      if (!meeting.on || inside.of(meeting.triangle) != sheet) return;
      const double away = (meeting.place - patch_.vertex(v).place).norm();
      if (away >= least) return;
      least = away;
      met.back() = meeting.place;
    });
  }
  Vec3 mean = Vec3::Zero();
  double longest = 0.0;
  for (std::size_t i = 0; i < met.size(); ++i) {
    mean += met[i] / static_cast<double>(met.size());
    longest = std::max(longest, (met[i] - met[(i + 1) % met.size()]).norm());
  }
  if (met.size() == 1 || distance(part_, triangles, mean) <= kCoverShare * longest) return true;
  return !is_beyond_border(part_, triangles, mean);
}

}  // namespace tissu
