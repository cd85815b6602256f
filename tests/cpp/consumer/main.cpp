// Links an installed tissu from outside: a unit cube of 2 x 2 x 2 cells, each cut into six tetrahedra.
#include <cstdio>

#include "tissu/mesh/box.h"

int main() {
  const tissu::Mesh mesh =
      tissu::box_mesh(tissu::Vec3(0.0, 0.0, 0.0), tissu::Vec3(1.0, 1.0, 1.0), {2, 2, 2}, tissu::Split::six);
  std::printf("%d nodes, %d cells\n", static_cast<int>(mesh.node_count()),
              static_cast<int>(mesh.cell_count()));
  return 0;
}
