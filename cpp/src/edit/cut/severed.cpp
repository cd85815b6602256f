#include "tissu/edit/cut/severed.h"

#include <algorithm>
#include <string>

#include "tissu/base/error.h"
#include "tissu/base/exact.h"

namespace tissu {
namespace {

using Triangle = std::array<Vec3, 3>;

bool lies_above(const Triangle& t, const Vec3& p) { return orientation(t[0], t[1], t[2], p) >= 0; }

bool severs(const Triangle& t, const Vec3& a, const Vec3& b) {
  if (lies_above(t, a) == lies_above(t, b)) return false;
  // The line a b, which is not in the plane, passes the triangle: it turns round all its edges alike.
  const auto [low, high] = std::minmax(
      {orientation(a, b, t[0], t[1]), orientation(a, b, t[1], t[2]), orientation(a, b, t[2], t[0])});
  return low >= 0 || high <= 0;
}

Eigen::AlignedBox3d box_of(const Triangle& t) {
  Eigen::AlignedBox3d box;
  for (const Vec3& corner : t) box.extend(corner);
  return box;
}

}  // namespace

std::vector<char> severed(const Sweep& sweep, std::span<const double> a, std::span<const double> b) {
  if (a.size() != b.size() || a.size() % 3 != 0) {
    throw ParameterError("found " + std::to_string(a.size()) + " and " + std::to_string(b.size()) +
                         " coordinates of the ends of segments; three for each end are accepted.");
  }
  std::vector<Eigen::AlignedBox3d> boxes;
  std::vector<const Triangle*> triangles;
  for (const SweepPart& part : sweep.parts) {
    for (const Triangle& triangle : part.triangles) {
      triangles.push_back(&triangle);
      boxes.push_back(box_of(triangle));
    }
  }
  std::vector<char> result(a.size() / 3, 0);
  for (std::size_t i = 0; i < result.size(); ++i) {
    const Vec3 from(a[3 * i], a[3 * i + 1], a[3 * i + 2]);
    const Vec3 to(b[3 * i], b[3 * i + 1], b[3 * i + 2]);
    Eigen::AlignedBox3d box(from);
    box.extend(to);
    for (std::size_t t = 0; t < triangles.size() && result[i] == 0; ++t)
      result[i] = box.intersects(boxes[t]) && severs(*triangles[t], from, to) ? 1 : 0;
  }
  return result;
}

}  // namespace tissu
