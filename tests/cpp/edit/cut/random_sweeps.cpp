#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>

#include "cut_body.h"
#include "tissu/base/error.h"
#include "tissu/mesh/box.h"
#include "tissu/mesh/cell_shape.h"

namespace tissu::test {
namespace {

using Generator = std::mt19937_64;

double real(Generator& random, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(random);
}

Vec3 direction(Generator& random) {
  std::normal_distribution<double> normal;
  if (random() % 4 == 0) return Vec3::Unit(static_cast<int>(random() % 3));
  return Vec3(normal(random), normal(random), normal(random)).normalized();
}

/// An edge of `points` points that turns and moves through `moments` moments.
Sweep bent(Generator& random, const Vec3& start, double size) {
  const int points = 2 + static_cast<int>(random() % 4);
  const int moments = 2 + static_cast<int>(random() % 5);
  const Vec3 along = direction(random);
  const Vec3 forth = (along.cross(direction(random)) + 0.3 * direction(random)).normalized();
  const double turn = real(random, -0.8, 0.8);
  std::vector<double> places;
  for (int k = 0; k < moments; ++k) {
    const double time = static_cast<double>(k) / (moments - 1);
    const Vec3 edge = Eigen::AngleAxisd(turn * time, forth) * along;
    for (int i = 0; i < points; ++i) {
      const double share = static_cast<double>(i) / (points - 1) - 0.5;
      const Vec3 bow = 0.1 * std::sin(4.0 * time + 3.0 * share) * along.cross(forth);
      const Vec3 p = start + size * (share * edge + (time - 0.5) * forth + bow);
      places.insert(places.end(), p.data(), p.data() + 3);
    }
  }
  return edge_sweep(places, moments, points);
}

/// Nodes of a linear mesh and those in the middles of its edges, faces and cells.
class Raiser {
 public:
  Raiser(const Mesh& mesh, CellType type)
      : linear_(mesh), type_(type), raised_{mesh.positions, {{type, {}}}} {}

  Mesh raise() {
    for (const CellBlock& block : linear_.blocks) {
      for (std::int32_t i = 0; i < block.size(); ++i) add(block.type, block.cell(i));
    }
    return std::move(raised_);
  }

 private:
  std::int32_t middle(std::vector<std::int32_t> corners) {
    std::ranges::sort(corners);
    const auto [entry, is_new] = middles_.try_emplace(corners, raised_.node_count());
    if (is_new) {
      Vec3 mean = Vec3::Zero();
      for (const std::int32_t c : corners) mean += linear_.node(c);
      mean /= static_cast<double>(corners.size());
      raised_.positions.insert(raised_.positions.end(), mean.data(), mean.data() + 3);
    }
    return entry->second;
  }

  void add(CellType linear, std::span<const std::int32_t> corners) {
    std::vector<std::int32_t> nodes(corners.begin(), corners.end());
    for (const auto& [a, b] : edges(linear)) nodes.push_back(middle({corners[a], corners[b]}));
    nodes.resize(static_cast<std::size_t>(info(type_).nodes));
    for (const LocalFace& face : faces(type_)) {
      if (face.nodes != 9) continue;
      std::vector<std::int32_t> around;
      for (std::size_t c = 0; c < 4; ++c) around.push_back(corners[face.node[c]]);
      nodes[face.node[8]] = middle(around);
    }
    if (type_ == CellType::hexahedron27) nodes.back() = middle({corners.begin(), corners.end()});
    raised_.blocks[0].nodes.insert(raised_.blocks[0].nodes.end(), nodes.begin(), nodes.end());
  }

  const Mesh& linear_;
  CellType type_;
  Mesh raised_;
  std::map<std::vector<std::int32_t>, std::int32_t> middles_;
};

void jitter_inside(Mesh& mesh, const Vec3& size, double reach, Generator& random) {
  for (std::int32_t n = 0; n < mesh.node_count(); ++n) {
    for (std::size_t i = 0; i < 3; ++i) {
      double& place = mesh.positions[3 * static_cast<std::size_t>(n) + i];
      const double end = size[static_cast<int>(i)];
      if (place > 1e-9 * end && place < end * (1.0 - 1e-9)) place += real(random, -reach, reach);
    }
  }
}

Mesh wedges(const Mesh& boxes) {
  Mesh mesh{boxes.positions, {{CellType::wedge, {}}}};
  for (std::int32_t i = 0; i < boxes.cell_count(); ++i) {
    const auto c = boxes.blocks[0].cell(i);
    for (const std::array<std::size_t, 6>& local :
         {std::array<std::size_t, 6>{0, 1, 2, 4, 5, 6}, {0, 2, 3, 4, 6, 7}}) {
      for (const std::size_t l : local) mesh.blocks[0].nodes.push_back(c[l]);
    }
  }
  return mesh;
}

Mesh pyramids(const Mesh& boxes) {
  Mesh mesh{boxes.positions, {{CellType::pyramid, {}}}};
  for (std::int32_t i = 0; i < boxes.cell_count(); ++i) {
    const auto c = boxes.blocks[0].cell(i);
    Vec3 mean = Vec3::Zero();
    for (const std::int32_t n : c) mean += boxes.node(n) / 8.0;
    const std::int32_t apex = mesh.node_count();
    mesh.positions.insert(mesh.positions.end(), mean.data(), mean.data() + 3);
    for (const LocalFace& face : faces(CellType::hexahedron)) {
      for (const std::size_t corner : {0U, 3U, 2U, 1U}) mesh.blocks[0].nodes.push_back(c[face.node[corner]]);
      mesh.blocks[0].nodes.push_back(apex);
    }
  }
  return mesh;
}

Sweep try_sweep(Generator& random, const CutBody& body) {
  const auto node = static_cast<std::int32_t>(random() % static_cast<std::uint64_t>(body.hosts.node_count()));
  Vec3 through = block(ConstReals(body.x), node);
  Eigen::AlignedBox3d box;
  for (std::int32_t n = 0; n < body.hosts.node_count(); ++n) box.extend(block(ConstReals(body.x), n).eval());
  if (random() % 3 != 0) {
    for (int i = 0; i < 3; ++i) through[i] = real(random, box.min()[i], box.max()[i]);
  }
  const double size = box.sizes().maxCoeff();
  switch (random() % 4) {
    case 0:
      return body.plane(through, direction(random));
    case 1:
      return disc_sweep(through, direction(random), size * real(random, 0.1, 0.8));
    case 2: {
      const Vec3 u = direction(random);
      const Vec3 v = direction(random);
      const Vec3 w = direction(random);
      std::vector<double> points;
      const double length = size * real(random, 0.2, 1.5);
      for (const Vec3& p :
           {through, Vec3(through + length * u), Vec3(through + length * v), Vec3(through - length * w)}) {
        points.insert(points.end(), p.data(), p.data() + 3);
      }
      const std::vector<std::array<std::int32_t, 3>> triangles{{0, 1, 2}, {0, 2, 3}};
      return triangle_sweep(points, triangles);
    }
    default:
      return bent(random, through, size * real(random, 0.2, 1.5));
  }
}

}  // namespace

Mesh typed_box(CellType type, const Vec3& size, std::array<int, 3> cells, double jitter, std::uint64_t seed) {
  const int corners = info(type).corners;
  Mesh mesh = box_mesh(Vec3::Zero(), size, cells,
                       corners == 4 ? (seed % 2 == 0 ? Split::five : Split::six) : Split::none);
  Generator random(seed);
  double edge = size[0];
  for (int i = 0; i < 3; ++i) edge = std::min(edge, size[i] / cells[static_cast<std::size_t>(i)]);
  jitter_inside(mesh, size, jitter * edge, random);
  if (corners == 6) mesh = wedges(mesh);
  if (corners == 5) mesh = pyramids(mesh);
  return info(type).order == 1 ? mesh : Raiser(mesh, type).raise();
}

Sweep random_sweep(std::mt19937_64& random, const CutBody& body) {
  for (;;) {
    try {
      return try_sweep(random, body);
    } catch (const ParameterError&) {  // two of the directions were one
    }
  }
}

}  // namespace tissu::test
