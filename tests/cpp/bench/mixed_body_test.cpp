// The mixed body that the benchmark steps is what its header says: its cells fill the box, none is inside
// out, and their faces match.

#include "../../../bench/target/mixed_body.h"

#include <gtest/gtest.h>

#include <map>
#include <numeric>

#include "tissu/mesh/quality.h"
#include "tissu/mesh/topology.h"

namespace tissu {
namespace {

Mesh mixed_mesh() {
  const WorldDescription description = bench::mixed_body(1);
  Mesh mesh{description.bodies.front().positions, {}};
  for (const ElasticBlock& block : description.bodies.front().elastic) {
    mesh.blocks.push_back({cell_type(block.element).value(), block.cells});
  }
  return mesh;
}

TEST(MixedBody, HasFourElementTypesAndTheSizeOfTheTarget) {
  const Mesh mesh = mixed_mesh();
  EXPECT_EQ(mesh.node_count(), 2008);
  EXPECT_EQ(mesh.cell_count(), 3072);
  std::map<CellType, std::int32_t> count;
  for (const CellBlock& block : mesh.blocks) count[block.type] = block.size();
  EXPECT_EQ(count[CellType::hexahedron], 15 * 64);
  EXPECT_EQ(count[CellType::wedge], 4 * 64 * 2);
  EXPECT_EQ(count[CellType::pyramid], 64 * 5);
  EXPECT_EQ(count[CellType::tetra], 3 * 64 * 6 + 64 * 2);
}

TEST(MixedBody, FillsItsBoxWithoutGapsOrTornFaces) {
  const Mesh mesh = mixed_mesh();
  const std::vector<double> all = volumes(mesh);
  for (const double volume : all) EXPECT_GT(volume, 0.0);
  EXPECT_NEAR(std::accumulate(all.begin(), all.end(), 0.0), 0.23 * 0.08 * 0.08, 1e-12);
  EXPECT_EQ(nonconforming_faces(mesh).count, 0);
  EXPECT_EQ(overfull_face_count(mesh), 0);
  const Surface surface = boundary_surface(mesh);
  double area = 0.0;
  const auto half = [&](std::int32_t a, std::int32_t b, std::int32_t c) {
    return 0.5 * (mesh.node(b) - mesh.node(a)).cross(mesh.node(c) - mesh.node(a)).norm();
  };
  for (const auto& t : surface.triangles) area += half(t[0], t[1], t[2]);
  for (const auto& q : surface.quads) area += half(q[0], q[1], q[2]) + half(q[0], q[2], q[3]);
  EXPECT_NEAR(area, 2 * (2 * 0.23 * 0.08 + 0.08 * 0.08), 1e-12);  // nothing open inside
}

}  // namespace
}  // namespace tissu
