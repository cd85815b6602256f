#include "tissu/mesh/cell_shape.h"

#include <cstddef>

namespace tissu {
namespace {

using Edge = std::array<std::uint8_t, 2>;

template <std::size_t edges_, std::size_t faces_>
struct Shape {
  std::uint8_t corners;
  std::array<Edge, edges_> edges;
  std::array<LocalFace, faces_> faces;  ///< of the linear cell, with the number of its own middle last
};

constexpr Shape<6, 4> kTetra{4,
                             {{{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}}},
                             {{{3, 3, {0, 2, 1}}, {3, 3, {0, 1, 3}}, {3, 3, {1, 2, 3}}, {3, 3, {0, 3, 2}}}}};

constexpr Shape<12, 6> kHexahedron{
    8,
    {{{0, 1}, {1, 2}, {2, 3}, {3, 0}, {4, 5}, {5, 6}, {6, 7}, {7, 4}, {0, 4}, {1, 5}, {2, 6}, {3, 7}}},
    {{{4, 4, {0, 3, 2, 1, 0, 0, 0, 0, 24}},
      {4, 4, {4, 5, 6, 7, 0, 0, 0, 0, 25}},
      {4, 4, {0, 1, 5, 4, 0, 0, 0, 0, 22}},
      {4, 4, {1, 2, 6, 5, 0, 0, 0, 0, 21}},
      {4, 4, {2, 3, 7, 6, 0, 0, 0, 0, 23}},
      {4, 4, {3, 0, 4, 7, 0, 0, 0, 0, 20}}}}};

constexpr Shape<9, 5> kWedge{6,
                             {{{0, 1}, {1, 2}, {2, 0}, {3, 4}, {4, 5}, {5, 3}, {0, 3}, {1, 4}, {2, 5}}},
                             {{{3, 3, {0, 2, 1}},
                               {3, 3, {3, 4, 5}},
                               {4, 4, {0, 1, 4, 3}},
                               {4, 4, {1, 2, 5, 4}},
                               {4, 4, {2, 0, 3, 5}}}}};

constexpr Shape<8, 5> kPyramid{
    5,
    {{{0, 1}, {1, 2}, {2, 3}, {3, 0}, {0, 4}, {1, 4}, {2, 4}, {3, 4}}},
    {{{4, 4, {0, 3, 2, 1}}, {3, 3, {0, 1, 4}}, {3, 3, {1, 2, 4}}, {3, 3, {2, 3, 4}}, {3, 3, {3, 0, 4}}}}};

constexpr std::array<Edge, 3> kTriangleEdges{{{0, 1}, {1, 2}, {2, 0}}};
constexpr std::array<Edge, 4> kQuadEdges{{{0, 1}, {1, 2}, {2, 3}, {3, 0}}};
constexpr std::array<Edge, 1> kLineEdges{{{0, 1}}};

template <std::size_t n>
constexpr std::uint8_t middle(const std::array<Edge, n>& edges, std::uint8_t a, std::uint8_t b) {
  std::uint8_t e = 0;
  while (!((edges[e][0] == a && edges[e][1] == b) || (edges[e][0] == b && edges[e][1] == a))) ++e;
  return e;
}

/// The faces with the middles of their edges, and with their own where `centre` asks for it.
template <std::size_t edges_, std::size_t faces_>
constexpr std::array<LocalFace, faces_> quadratic(const Shape<edges_, faces_>& shape, bool centre) {
  std::array<LocalFace, faces_> result = shape.faces;
  for (LocalFace& face : result) {
    const auto size = static_cast<std::size_t>(face.corners);
    for (std::size_t c = 0; c < size; ++c)
      face.node[size + c] = static_cast<std::uint8_t>(
          shape.corners + middle(shape.edges, face.node[c], face.node[(c + 1) % size]));
    face.nodes = 2 * face.corners + (centre ? 1 : 0);
  }
  return result;
}

constexpr auto kTetra10Faces = quadratic(kTetra, false);
constexpr auto kHexahedron20Faces = quadratic(kHexahedron, false);
constexpr auto kHexahedron27Faces = quadratic(kHexahedron, true);
constexpr auto kWedge15Faces = quadratic(kWedge, false);
constexpr auto kPyramid13Faces = quadratic(kPyramid, false);

/// Mirror images: corners 2 and 3 of a tetrahedron, the bottom and the top of a hexahedron and of a wedge,
/// corners 1 and 3 of a pyramid change places. A linear cell has the first few of the numbers.
constexpr std::array<std::uint8_t, 10> kTetraMirror{0, 1, 3, 2, 4, 8, 7, 6, 5, 9};
constexpr std::array<std::uint8_t, 27> kHexahedronMirror{4,  5,  6,  7,  0,  1,  2,  3,  12, 13, 14, 15, 8, 9,
                                                         10, 11, 16, 17, 18, 19, 20, 21, 22, 23, 25, 24, 26};
constexpr std::array<std::uint8_t, 15> kWedgeMirror{3, 4, 5, 0, 1, 2, 9, 10, 11, 6, 7, 8, 12, 13, 14};
constexpr std::array<std::uint8_t, 6> kTriangleMirror{0, 2, 1, 5, 4, 3};
constexpr std::array<std::uint8_t, 9> kQuadMirror{0, 3, 2, 1, 7, 6, 5, 4, 8};
constexpr std::array<std::uint8_t, 3> kLineMirror{1, 0, 2};
constexpr std::array<std::uint8_t, 13> kPyramidMirror{0, 3, 2, 1, 4, 8, 7, 6, 5, 9, 12, 11, 10};

std::span<const std::uint8_t> mirrored_whole(CellType type) {
  switch (type) {
    case CellType::tetra:
    case CellType::tetra10:
      return kTetraMirror;
    case CellType::hexahedron:
    case CellType::hexahedron20:
    case CellType::hexahedron27:
      return kHexahedronMirror;
    case CellType::wedge:
    case CellType::wedge15:
      return kWedgeMirror;
    case CellType::pyramid:
    case CellType::pyramid13:
      return kPyramidMirror;
    case CellType::triangle:
    case CellType::triangle6:
      return kTriangleMirror;
    case CellType::quad:
    case CellType::quad8:
    case CellType::quad9:
      return kQuadMirror;
    case CellType::line:
    case CellType::line3:
      return kLineMirror;
  }
  return {};
}

}  // namespace

std::span<const LocalFace> faces(CellType type) {
  switch (type) {
    case CellType::tetra:
      return kTetra.faces;
    case CellType::hexahedron:
      return kHexahedron.faces;
    case CellType::tetra10:
      return kTetra10Faces;
    case CellType::hexahedron20:
      return kHexahedron20Faces;
    case CellType::hexahedron27:
      return kHexahedron27Faces;
    case CellType::wedge:
      return kWedge.faces;
    case CellType::wedge15:
      return kWedge15Faces;
    case CellType::pyramid:
      return kPyramid.faces;
    case CellType::pyramid13:
      return kPyramid13Faces;
    case CellType::triangle:
    case CellType::triangle6:
    case CellType::quad:
    case CellType::quad8:
    case CellType::quad9:
    case CellType::line:
    case CellType::line3:
      return {};
  }
  return {};
}

std::span<const std::array<std::uint8_t, 2>> edges(CellType type) {
  switch (type) {
    case CellType::tetra:
    case CellType::tetra10:
      return kTetra.edges;
    case CellType::hexahedron:
    case CellType::hexahedron20:
    case CellType::hexahedron27:
      return kHexahedron.edges;
    case CellType::wedge:
    case CellType::wedge15:
      return kWedge.edges;
    case CellType::pyramid:
    case CellType::pyramid13:
      return kPyramid.edges;
    case CellType::triangle:
    case CellType::triangle6:
      return kTriangleEdges;
    case CellType::quad:
    case CellType::quad8:
    case CellType::quad9:
      return kQuadEdges;
    case CellType::line:
    case CellType::line3:
      return kLineEdges;
  }
  return {};
}

std::span<const std::uint8_t> mirrored(CellType type) {
  return mirrored_whole(type).first(static_cast<std::size_t>(info(type).nodes));
}

}  // namespace tissu
