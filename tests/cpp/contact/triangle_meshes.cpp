#include "triangle_meshes.h"

#include <algorithm>
#include <fstream>
#include <limits>
#include <stdexcept>

#include "tissu/mesh/box.h"
#include "tissu/mesh/topology.h"

namespace tissu::test {
namespace {

/// The surface of a mesh, with the vertices that it has.
TriangleMesh surface_of(const Mesh& mesh) {
  TriangleMesh surface;
  std::vector<std::int32_t> number(mesh.positions.size() / 3, -1);
  for (std::array<std::int32_t, 3> triangle : boundary_surface(mesh).triangles) {
    for (std::int32_t& node : triangle) {
      std::int32_t& of = number[static_cast<std::size_t>(node)];
      if (of < 0) {
        of = static_cast<std::int32_t>(surface.points.size());
        surface.points.push_back(block(ConstReals(mesh.positions), node));
      }
      node = of;
    }
    surface.triangles.push_back(triangle);
  }
  return surface;
}

/// Goes on after the tag that has the text.
void skip_to(std::istream& in, const std::string& text) {
  for (std::string line; std::getline(in, line);) {
    if (line.find(text) != std::string::npos) return;
  }
  throw std::runtime_error("no " + text + " in " TISSU_EXAMPLES "/organ.vtu");
}

template <class Number>
std::vector<Number> numbers(std::istream& in) {
  std::vector<Number> all;
  for (Number x; in >> x;) all.push_back(x);
  in.clear();
  return all;
}

}  // namespace

TriangleMesh TriangleMesh::placed(const Quaternion& turn, const Vec3& by) const {
  TriangleMesh mesh = *this;
  for (Vec3& point : mesh.points) point = turn * point + by;
  return mesh;
}

double TriangleMesh::radius() const {
  Vec3 low = points[0];
  Vec3 high = points[0];
  for (const Vec3& point : points) {
    low = low.cwiseMin(point);
    high = high.cwiseMax(point);
  }
  return 0.5 * (high - low).norm();
}

TriangleMesh bumpy_ball(int n, Random& random) {
  TriangleMesh ball = surface_of(box_mesh(Vec3(-1, -1, -1), Vec3(2, 2, 2), {n, n, n}, Split::six));
  for (Vec3& point : ball.points) point = (1.0 + 0.2 * random.number()) * point.normalized();
  return ball;
}

TriangleMesh crumpled_sheet(int n, Random& random) {
  TriangleMesh sheet;
  double x = 0.0;
  for (int i = 0; i <= n; ++i) {
    for (int j = 0; j <= n; ++j) {
      sheet.points.push_back(Vec3(x, static_cast<double>(j) / n, 0.0) + 0.3 / n * random.vector());
    }
    x += (i % 10 == 9 ? 1e-3 : 1.0) / n;
  }
  const auto node = [&](int i, int j) { return static_cast<std::int32_t>(i * (n + 1) + j); };
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) {
      sheet.triangles.push_back({node(i, j), node(i + 1, j), node(i + 1, j + 1)});
      sheet.triangles.push_back({node(i, j), node(i + 1, j + 1), node(i, j + 1)});
    }
  }
  return sheet;
}

TriangleMesh organ() {
  std::ifstream in(TISSU_EXAMPLES "/organ.vtu");
  Mesh mesh;
  skip_to(in, "Name=\"Points\"");
  mesh.positions = numbers<double>(in);
  skip_to(in, "Name=\"connectivity\"");
  const std::vector<std::int32_t> nodes = numbers<std::int32_t>(in);
  if (mesh.positions.size() != 3447 || nodes.size() != 19732) {
    throw std::runtime_error("another mesh than that of 1149 nodes and 4933 tetrahedra in organ.vtu");
  }
  mesh.blocks = {{CellType::tetra, nodes}};
  return surface_of(mesh);
}

TwoMeshes::TwoMeshes(const TriangleMesh& first, const TriangleMesh& second, double gap) {
  for (const TriangleMesh* mesh : {&first, &second}) {
    first_row.push_back(state.blocks());
    SurfaceDescription surface{.name = mesh == &first ? "first" : "second"};
    surface.triangles = mesh->triangles;
    description.bodies.push_back(surface);
    for (const Vec3& point : mesh->points) {
      state.positions.insert(state.positions.end(), point.begin(), point.end());
    }
  }
  description.pairs = {{.a = 0, .b = 1, .gap = gap}};
}

}  // namespace tissu::test
