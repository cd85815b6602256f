#include "mixed_surface.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <set>

#include "edit/cut/material_faces.h"
#include "edit/cut/quad_halves.h"
#include "tissu/base/index.h"

namespace tissu {
namespace {

using Triangle = std::array<std::int32_t, 3>;

Triangle sorted(Triangle vertices) {
  std::ranges::sort(vertices);
  return vertices;
}

class Adder {
 public:
  Adder(const BodyDescription& body, const CutState& cut, KerfSurface& surface)
      : hosts_(cut.hosts),
        material_(cut.material),
        surface_(surface),
        carried_(surface.carried.begin(), surface.carried.end()) {
    for (const MaterialFace& face : material_faces(hosts_, material_, 3).faces) {
      if (face.across < 0) outer_.insert(sorted(face.vertices));
    }
    thin_.radius.assign(body.positions.size() / 3, 0.0);
  }

  ThinSurface add() {
    for (const Triangle& t : surface_.triangles) thin_.material.still.insert(t.begin(), t.end());
    for (const std::int32_t cell : hosts_.numbers()) {
      if (dimension(cell) == 2) add_sheet(cell);
    }
    for (const Triangle& t : surface_.triangles) {
      for (std::size_t i = 0; i < 3; ++i) sides_.insert(std::minmax(t[i], t[(i + 1) % 3]));
    }
    for (const std::int32_t cell : hosts_.numbers()) {
      if (dimension(cell) == 1) add_line(cell);
    }
    surface_.carried.assign(carried_.begin(), carried_.end());
    if (std::ranges::all_of(thin_.radius, [](double r) { return r == 0.0; })) thin_.radius.clear();
    return std::move(thin_);
  }

 private:
  [[nodiscard]] int dimension(std::int32_t cell) const { return info(hosts_.type(cell)).dimension; }

  void add_sheet(std::int32_t cell) {
    const std::vector<MaterialTetra> parts = material_of(hosts_, material_, cell);
    std::vector<Triangle> own;
    own.reserve(parts.size());
    for (const MaterialTetra& part : parts)
      own.push_back({part.vertices[0], part.vertices[1], part.vertices[2]});
    if (hosts_.lies_in_volume(cell)) {
      const auto is_outer = [&](const Triangle& triangle) { return outer_.contains(sorted(triangle)); };
      if (std::ranges::any_of(own, is_outer)) thicken(cell, 0.5 * hosts_.thickness(cell));
      return;
    }
    thin_.material.triangles.insert(thin_.material.triangles.end(), parts.begin(), parts.end());
    const auto corners = hosts_.corners(cell);
    if (corners.size() == 4 && !material_.cells.contains(cell)) {
      own.clear();
      add_halves(
          hosts_.rest(), {corners[0], corners[1], corners[2], corners[3]},
          [&](std::int32_t node) { return hosts_.root(node); }, own);
    }
    for (const Triangle& triangle : own) {
      surface_.triangles.push_back(triangle);
      for (const std::int32_t v : triangle) carry(v);
    }
    thin_.open = true;
    thicken(cell, 0.5 * hosts_.thickness(cell));
  }

  void add_line(std::int32_t cell) {
    const auto is_solid = [&](std::int32_t node) {
      return std::ranges::any_of(hosts_.cells_at(node),
                                 [&](std::int32_t one) { return dimension(one) == 3; });
    };
    if (std::ranges::all_of(hosts_.corners(cell), is_solid)) return;
    thicken(cell, std::sqrt(hosts_.thickness(cell) / std::numbers::pi));
    for (const MaterialTetra& piece : material_of(hosts_, material_, cell)) {
      const std::pair<std::int32_t, std::int32_t> side = std::minmax(piece.vertices[0], piece.vertices[1]);
      if (!sides_.insert(side).second) continue;
      thin_.edges.push_back({side.first, side.second});
      thin_.material.lines.push_back(piece);
      carry(side.first);
      carry(side.second);
    }
  }

  void thicken(std::int32_t cell, double radius) {
    for (const std::int32_t node : hosts_.nodes(cell))
      thin_.radius[at(node)] = std::max(thin_.radius[at(node)], radius);
  }

  void carry(std::int32_t vertex) {
    if (vertex < 0) carried_.try_emplace(vertex, material_.riders[at(-1 - vertex)]);
  }

  const Hosts& hosts_;
  const Material& material_;
  KerfSurface& surface_;
  std::map<std::int32_t, Rider> carried_;
  std::set<Triangle> outer_;  ///< faces of volumes on the surface
  std::set<std::pair<std::int32_t, std::int32_t>> sides_;
  ThinSurface thin_;
};

}  // namespace

ThinSurface add_thin(const BodyDescription& body, const CutState& cut, KerfSurface& surface) {
  return Adder(body, cut, surface).add();
}

}  // namespace tissu
