#include "body_surface.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <optional>
#include <set>
#include <span>
#include <string_view>

#include "cut_surface.h"
#include "edit/cut/quad_halves.h"
#include "flat_rim.h"
#include "tissu/base/error.h"
#include "tissu/base/index.h"
#include "tissu/element/reference_cell.h"
#include "tissu/mesh/topology.h"

namespace tissu {
namespace {

template <std::size_t n>
using Corners = std::array<std::int32_t, n>;

/// Faces of sheets and pieces of lines, by the nodes of a cell.
struct Pieces {
  std::string_view element;
  std::vector<Corners<3>> triangles = {};
  std::vector<Corners<4>> quads = {};
  std::vector<Corners<2>> lines = {};
};

const std::vector<Pieces>& pieces() {
  static const std::vector<Pieces> all = {
      {.element = "triangle", .triangles = {{0, 1, 2}}},
      {.element = "triangle6", .triangles = {{0, 3, 5}, {3, 1, 4}, {5, 4, 2}, {3, 4, 5}}},
      {.element = "quad8", .triangles = {{0, 4, 7}, {4, 1, 5}, {5, 2, 6}, {6, 3, 7}, {4, 5, 6}, {4, 6, 7}}},
      {.element = "quad", .quads = {{0, 1, 2, 3}}},
      {.element = "quad9", .quads = {{0, 4, 8, 7}, {4, 1, 5, 8}, {8, 5, 2, 6}, {7, 8, 6, 3}}},
      {.element = "line", .lines = {{0, 1}}},
      {.element = "line3", .lines = {{0, 2}, {2, 1}}}};
  return all;
}

template <std::size_t n>
Corners<n> sorted(Corners<n> nodes) {
  std::ranges::sort(nodes);
  return nodes;
}

/// Cells of one element that stand next to each other in the order of their numbers.
struct Run {
  std::string_view element;
  int nodes;
  int dimension;
  std::vector<std::int32_t> cells;
  std::vector<double> cross_sections;
  [[nodiscard]] std::size_t size() const { return cross_sections.size(); }
  [[nodiscard]] std::span<const std::int32_t> cell(std::size_t i) const {
    return std::span(cells).subspan(i * at(nodes), at(nodes));
  }
};

std::vector<Run> runs_of(const BodyDescription& body) {
  struct Cell {
    std::int32_t number;
    const ElasticBlock* block;
    std::int32_t in_block;
  };
  std::vector<Cell> cells;
  for (const ElasticBlock& block : body.elastic) {
    for (std::size_t i = 0; i < block.cell_numbers.size(); ++i) {
      cells.push_back({block.cell_numbers[i], &block, static_cast<std::int32_t>(i)});
    }
  }
  std::ranges::sort(cells, {}, &Cell::number);
  std::vector<Run> runs;
  for (const Cell& cell : cells) {
    if (runs.empty() || runs.back().element != cell.block->element) {
      const ElementInfo& element = *find_element(cell.block->element);
      runs.push_back({element.name, element.nodes, element.dimension, {}, {}});
    }
    Run& run = runs.back();
    const auto first = cell.block->cells.begin() + static_cast<std::ptrdiff_t>(cell.in_block) * run.nodes;
    run.cells.insert(run.cells.end(), first, first + run.nodes);
    run.cross_sections.push_back(of_cell(cell.block->cross_section, cell.in_block));
  }
  return runs;
}

/// A piece of a sheet or line, and the thickness or area of its cell.
template <std::size_t n>
struct Piece {
  Corners<n> nodes;
  double cross_section;
};

template <std::size_t n>
std::vector<Piece<n>> pieces_of(const std::vector<Run>& runs, std::vector<Corners<n>> Pieces::*of) {
  std::vector<Piece<n>> found;
  for (const Run& run : runs) {
    const auto kind = std::ranges::find(pieces(), run.element, &Pieces::element);
    if (kind == pieces().end()) continue;
    for (const Corners<n>& corners : (*kind).*of) {
      for (std::size_t i = 0; i < run.size(); ++i) {
        Piece<n> piece{{}, run.cross_sections[i]};
        for (std::size_t k = 0; k < n; ++k) piece.nodes[k] = run.cell(i)[at(corners[k])];
        found.push_back(piece);
      }
    }
  }
  return found;
}

/// The volume cells at each node.
class VolumeCells {
 public:
  VolumeCells(const std::vector<Run>& runs, std::size_t nodes) : at_(nodes) {
    for (const Run& run : runs) {
      if (run.dimension != 3) continue;
      for (std::size_t i = 0; i < run.size(); ++i) {
        for (const std::int32_t node : run.cell(i)) at_[at(node)].push_back(run.cell(i));
      }
    }
  }
  [[nodiscard]] bool has(std::int32_t node) const { return !at_[at(node)].empty(); }
  /// Whether one cell has all these nodes.
  [[nodiscard]] bool any_has(std::span<const std::int32_t> nodes) const {
    return std::ranges::any_of(at_[at(nodes[0])], [&](std::span<const std::int32_t> cell) {
      return std::ranges::all_of(
          nodes, [&](std::int32_t node) { return std::ranges::find(cell, node) != cell.end(); });
    });
  }

 private:
  std::vector<std::vector<std::span<const std::int32_t>>> at_;
};

Surface volume_surface(const BodyDescription& body, const std::vector<Run>& runs) {
  Mesh mesh{body.positions, {}};
  for (const Run& run : runs) {
    const std::optional<CellType> volume = cell_type(run.element);
    if (volume) mesh.blocks.push_back({*volume, run.cells});
  }
  return boundary_surface(mesh);
}

/// Adds sheets to the outer faces: those that do not lie on one of them, or inside the volume. Whether any
/// was added.
template <std::size_t n>
bool add_sheets(const std::vector<Piece<n>>& sheets, const VolumeCells& volume,
                std::vector<Corners<n>>& faces) {
  std::set<Corners<n>> known;
  for (const Corners<n>& face : faces) known.insert(sorted(face));
  const std::size_t before = faces.size();
  for (const Piece<n>& sheet : sheets) {
    if (!known.contains(sorted(sheet.nodes)) && !volume.any_has(sheet.nodes)) faces.push_back(sheet.nodes);
  }
  return faces.size() > before;
}

/// Sheets that are among the faces thicken their nodes.
template <std::size_t n>
void thicken(const std::vector<Piece<n>>& sheets, const std::vector<Corners<n>>& faces,
             std::vector<double>& radius) {
  std::set<Corners<n>> known;
  for (const Corners<n>& face : faces) known.insert(sorted(face));
  for (const Piece<n>& sheet : sheets) {
    if (!known.contains(sorted(sheet.nodes))) continue;
    for (const std::int32_t node : sheet.nodes) radius[at(node)] = 0.5 * sheet.cross_section;
  }
}

/// Pieces of lines outside the volume that are not an edge of a triangle, each once, with their radius.
void add_lines(const std::vector<Piece<2>>& lines, const VolumeCells& volume, SurfaceDescription& surface) {
  std::set<Corners<2>> known;
  for (const Corners<3>& t : surface.triangles) {
    for (std::size_t i = 0; i < 3; ++i) known.insert(sorted(Corners<2>{t[i], t[(i + 1) % 3]}));
  }
  for (const Piece<2>& line : lines) {
    if (volume.has(line.nodes[0]) && volume.has(line.nodes[1])) continue;
    for (const std::int32_t node : line.nodes) {
      double& radius = surface.radius[at(node)];
      radius = std::max(radius, std::sqrt(line.cross_section / std::numbers::pi));
    }
    if (known.insert(sorted(line.nodes)).second) surface.edges.push_back(sorted(line.nodes));
  }
}

SurfaceDescription flat_surface(const BodyDescription& body, const std::vector<Run>& runs) {
  std::vector<FlatCells> cells;
  for (const Run& run : runs) {
    constexpr std::array<int, 2> kOfTriangles = {3, 6};
    const bool is_triangle = std::ranges::find(kOfTriangles, run.nodes) != kOfTriangles.end();
    if (run.dimension == 2) cells.push_back({at(run.nodes), is_triangle ? 3U : 4U, run.cells});
  }
  SurfaceDescription surface;
  surface.name = body.name;
  surface.edges = rim_of(body.positions, cells);
  surface.closed = true;
  return surface;
}

}  // namespace

SurfaceDescription body_surface(const BodyDescription& body) {
  const std::vector<Run> runs = runs_of(body);
  if (is_flat(body)) return flat_surface(body, runs);
  const VolumeCells volume(runs, body.positions.size() / 3);
  Surface outer = volume_surface(body, runs);
  const auto triangles = pieces_of(runs, &Pieces::triangles);
  const auto quads = pieces_of(runs, &Pieces::quads);
  const bool open = add_sheets(triangles, volume, outer.triangles);
  const bool open_too = add_sheets(quads, volume, outer.quads);
  SurfaceDescription surface;
  surface.name = body.name;
  surface.radius.assign(body.positions.size() / 3, 0.0);
  thicken(triangles, outer.triangles, surface.radius);
  thicken(quads, outer.quads, surface.radius);
  surface.triangles = std::move(outer.triangles);
  for (const Corners<4>& quad : outer.quads) {
    add_halves(body.positions, quad, std::identity(), surface.triangles);
  }
  add_lines(pieces_of(runs, &Pieces::lines), volume, surface);
  surface.closed = !open && !open_too && !surface.triangles.empty();
  if (std::ranges::all_of(surface.radius, [](double r) { return r == 0.0; })) surface.radius.clear();
  return surface;
}

bool has_own_mesh(const SurfaceDescription& surface) {
  return !surface.riders.vertex.empty() && surface.roots.empty();
}

namespace {

/// A surface that is a mesh of its own stays, so that each vertex needs a cell that has all its nodes.
void require_carried(const SurfaceDescription& surface, const BodyDescription& body) {
  const std::vector<Run> runs = runs_of(body);
  const VolumeCells volume(runs, body.positions.size() / 3);
  const SurfaceRiders& riders = surface.riders;
  std::size_t lost = 0;
  for (std::size_t i = 0; i < riders.vertex.size(); ++i) {
    const auto first = at(riders.begin[i]);
    if (!volume.any_has(std::span(riders.node).subspan(first, at(riders.begin[i + 1]) - first))) ++lost;
  }
  if (lost == 0) return;
  throw ParameterError("the cells that are removed carry " + std::to_string(lost) +
                       (lost == 1 ? " vertex" : " vertices") + " of the surface that surface_of gives \"" +
                       body.name +
                       "\" in contact, which cannot be opened; cells that carry none are accepted, or leave "
                       "the body out of surface_of.");
}

}  // namespace

void renew_surface(WorldDescription& description, const BodyDescription& body) {
  if (!description.contact) return;
  for (SurfaceDescription& surface : description.contact->bodies) {
    if (surface.name != body.name) continue;
    if (has_own_mesh(surface)) {
      require_carried(surface, body);
      continue;
    }
    surface = body.cut == nullptr ? body_surface(body) : cut_surface(body, *description.contact);
  }
}

}  // namespace tissu
