#include "flat_rim.h"

#include <algorithm>
#include <map>
#include <span>
#include <utility>

namespace tissu {
namespace {

using Edge = std::array<std::int32_t, 2>;

/// An edge of a cell, and the node between its ends; -1: none.
struct Side {
  Edge ends;
  std::int32_t middle;
};

/// Twice the area of a polygon, negative where it runs clockwise seen from +z.
double turned_area(ConstReals points, std::span<const std::int32_t> corners) {
  double sum = 0.0;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Vec3 from = block(points, corners[i]);
    const Vec3 to = block(points, corners[(i + 1) % corners.size()]);
    sum += from.x() * to.y() - to.x() * from.y();
  }
  return sum;
}

/// Of all cells of one kind, side after side.
std::vector<Side> sides_of(ConstReals points, const FlatCells& of) {
  std::vector<Side> sides;
  for (std::size_t side = 0; side < of.corners; ++side) {
    for (std::size_t first = 0; first < of.cells.size(); first += of.nodes) {
      const auto nodes = std::span(of.cells).subspan(first, of.nodes);
      Edge ends = {nodes[side], nodes[(side + 1) % of.corners]};
      if (turned_area(points, nodes.first(of.corners)) < 0.0) std::swap(ends[0], ends[1]);
      sides.push_back({ends, of.nodes > of.corners ? nodes[of.corners + side] : -1});
    }
  }
  return sides;
}

}  // namespace

bool is_flat(const BodyDescription& body) {
  return std::ranges::any_of(body.elastic,
                             [](const ElasticBlock& block) { return block.plane != Plane::free; });
}

std::vector<Edge> rim_of(ConstReals points, const std::vector<FlatCells>& all) {
  std::map<std::pair<std::int32_t, std::int32_t>, int> uses;
  std::vector<std::vector<Side>> sides;
  for (const FlatCells& of : all) {
    sides.push_back(sides_of(points, of));
    for (const Side& side : sides.back()) ++uses[std::minmax(side.ends[0], side.ends[1])];
  }
  std::vector<Edge> rim;
  const auto add = [&](bool curved) {
    for (const std::vector<Side>& own : sides) {
      for (const auto& [ends, middle] : own) {
        if ((middle >= 0) != curved || uses.at(std::minmax(ends[0], ends[1])) > 1) continue;
        if (!curved) {
          rim.push_back(ends);
          continue;
        }
        rim.push_back({ends[0], middle});
        rim.push_back({middle, ends[1]});
      }
    }
  };
  const bool curved_first = !all.empty() && all.front().nodes > all.front().corners;
  add(curved_first);
  add(!curved_first);
  return rim;
}

std::vector<Edge> rim_of(ConstReals rest, const Material& material,
                         const std::vector<MaterialTetra>& triangles) {
  std::map<std::pair<std::int32_t, std::int32_t>, int> uses;
  const auto for_sides = [&](auto&& f) {
    for (const MaterialTetra& t : triangles) {
      for (std::size_t i = 0; i < 3; ++i) {
        f(t, Edge{t.vertices[(i + 1) % 3], t.vertices[(i + 2) % 3]}, (t.cut >> i & 1U) != 0);
      }
    }
  };
  for_sides([&](const MaterialTetra&, const Edge& ends, bool) { ++uses[std::minmax(ends[0], ends[1])]; });
  std::vector<Edge> rim;
  for_sides([&](const MaterialTetra& t, Edge ends, bool is_cut) {
    if (!is_cut && uses.at(std::minmax(ends[0], ends[1])) > 1) return;
    std::vector<double> places;
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec3 place = material.at(t.vertices[i], rest);
      places.insert(places.end(), place.begin(), place.end());
    }
    if (turned_area(places, std::array{0, 1, 2}) < 0.0) std::swap(ends[0], ends[1]);
    rim.push_back(ends);
  });
  return rim;
}

}  // namespace tissu
