#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <array>
#include <cstring>
#include <string>
#include <utility>
#include <vector>

#include "tissu/base/error.h"
#include "tissu/element/measure.h"
#include "tissu/element/reference_cell.h"
#include "tissu/force/load.h"
#include "tissu/mesh/box.h"
#include "tissu/mesh/cell_shape.h"
#include "tissu/mesh/quality.h"
#include "tissu/mesh/topology.h"

namespace py = pybind11;
using namespace py::literals;

namespace {

using Reals = py::array_t<double, py::array::c_style | py::array::forcecast>;
using Ints = py::array_t<std::int32_t, py::array::c_style | py::array::forcecast>;
using Blocks = std::vector<std::pair<std::string, Ints>>;

/// A numpy array with a copy of `values`, whose items are `width` numbers each; width 0: one-dimensional.
template <class Number, class Item>
py::array_t<Number> to_array(const std::vector<Item>& values, py::ssize_t width = 0) {
  static_assert(std::is_trivially_copyable_v<Item> && sizeof(Item) % sizeof(Number) == 0);
  const auto numbers = static_cast<py::ssize_t>(values.size() * (sizeof(Item) / sizeof(Number)));
  const std::vector<py::ssize_t> shape =
      width == 0 ? std::vector<py::ssize_t>{numbers} : std::vector<py::ssize_t>{numbers / width, width};
  py::array_t<Number> result(shape);
  if (numbers > 0) std::memcpy(result.mutable_data(), values.data(), values.size() * sizeof(Item));
  return result;
}

tissu::CellType named_type(const std::string& name) {
  const auto type = tissu::cell_type(name);
  if (!type) throw tissu::MeshError("cells of type '" + name + "' are not handled");
  return *type;
}

tissu::Mesh to_mesh(const Reals& positions, const Blocks& blocks) {
  tissu::Mesh mesh;
  mesh.positions.assign(positions.data(), positions.data() + positions.size());
  for (const auto& [name, nodes] : blocks)
    mesh.blocks.push_back({named_type(name), {nodes.data(), nodes.data() + nodes.size()}});
  return mesh;
}

py::list to_blocks(const tissu::Mesh& mesh) {
  py::list result;
  for (const tissu::CellBlock& block : mesh.blocks) {
    const auto& type = tissu::info(block.type);
    result.append(py::make_tuple(std::string(type.name), to_array<std::int32_t>(block.nodes, type.nodes)));
  }
  return result;
}

py::list cell_types() {
  py::list result;
  for (const auto& type : tissu::cell_types())
    result.append(
        py::make_tuple(std::string(type.name), type.nodes, type.dimension, type.order, type.corners));
  return result;
}

std::vector<std::vector<int>> cell_edges(const std::string& name) {
  std::vector<std::vector<int>> result;
  for (const auto& edge : tissu::edges(named_type(name))) result.emplace_back(edge.begin(), edge.end());
  return result;
}

py::list cell_faces(const std::string& name) {
  py::list result;
  for (const auto& face : tissu::faces(named_type(name)))
    result.append(
        py::make_tuple(face.corners, std::vector<int>(face.node.begin(), face.node.begin() + face.nodes)));
  return result;
}

py::tuple box_mesh(const std::array<double, 3>& origin, const std::array<double, 3>& size,
                   const std::array<int, 3>& cells, tissu::Split split) {
  const tissu::Mesh mesh =
      tissu::box_mesh(tissu::Vec3(origin.data()), tissu::Vec3(size.data()), cells, split);
  return py::make_tuple(to_array<double>(mesh.positions, 3), to_blocks(mesh));
}

py::tuple boundary_surface(const Reals& positions, const Blocks& blocks) {
  const tissu::Surface surface = tissu::boundary_surface(to_mesh(positions, blocks));
  return py::make_tuple(to_array<std::int32_t>(surface.triangles, 3),
                        to_array<std::int32_t>(surface.triangle_cell),
                        to_array<std::int32_t>(surface.quads, 4), to_array<std::int32_t>(surface.quad_cell));
}

py::list boundary_faces(const Reals& positions, const Blocks& blocks) {
  py::list result;
  for (const tissu::FaceBlock& some : tissu::boundary_face_blocks(to_mesh(positions, blocks))) {
    const auto columns = static_cast<py::ssize_t>(some.nodes.size() / some.cells.size());
    result.append(py::make_tuple(std::string(some.type), to_array<std::int32_t>(some.nodes, columns),
                                 to_array<std::int32_t>(some.cells)));
  }
  return result;
}

/// Each node's share of the area of the faces [m2].
py::array_t<double> face_areas(const std::string& type, const Reals& positions, const Ints& faces,
                               double thickness) {
  std::vector<double> areas(static_cast<std::size_t>(positions.shape(0)), 0.0);
  const tissu::FaceCells some{type, {faces.data(), faces.data() + faces.size()}, thickness};
  tissu::add_areas(some, {positions.data(), static_cast<std::size_t>(positions.size())}, areas);
  return to_array<double>(areas);
}

/// Each node's share of the outward normal of the faces (n, 3) [m2].
py::array_t<double> face_normals(const std::string& type, const Reals& positions, const Ints& faces,
                                 double thickness) {
  std::vector<double> normals(static_cast<std::size_t>(positions.size()), 0.0);
  const tissu::FaceCells some{type, {faces.data(), faces.data() + faces.size()}, thickness};
  tissu::add_normals(some, {positions.data(), static_cast<std::size_t>(positions.size())}, normals);
  return to_array<double>(normals, 3);
}

py::tuple turn_reversed_cells(const Reals& positions, const Blocks& blocks) {
  tissu::Mesh mesh = to_mesh(positions, blocks);
  const std::int32_t count = tissu::turn_reversed_cells(mesh);
  return py::make_tuple(to_blocks(mesh), count);
}

py::array_t<double> cell_measures(const Reals& positions, const std::string& name, const Ints& nodes) {
  const tissu::ReferenceCell reference = tissu::reference_cell(name, "full");
  if (reference.points.empty()) throw tissu::MeshError("cells of type '" + name + "' are not handled");
  return to_array<double>(tissu::measures(reference, {nodes.data(), static_cast<std::size_t>(nodes.size())},
                                          {positions.data(), static_cast<std::size_t>(positions.size())}));
}

py::list elements() {
  py::list result;
  for (const auto& element : tissu::elements())
    result.append(py::make_tuple(std::string(element.name), element.nodes, element.dimension, element.order));
  return result;
}

}  // namespace

void bind_mesh(py::module_& m) {
  py::enum_<tissu::Split>(m, "Split")
      .value("none", tissu::Split::none)
      .value("six", tissu::Split::six)
      .value("five", tissu::Split::five)
      .value("six_mirrored", tissu::Split::six_mirrored);
  m.def("cell_types", &cell_types);
  m.def("elements", &elements);
  m.def("cell_measures", &cell_measures, py::kw_only(), "positions"_a, "cell_type"_a, "nodes"_a);
  m.def(
      "zero_energy_modes",
      [](const std::string& type, const std::string& quadrature) {
        const tissu::ElementInfo* element = tissu::find_element(type);
        const tissu::RuleInfo* rule = element == nullptr ? nullptr : element->rule(quadrature);
        if (rule == nullptr) {
          throw tissu::ParameterError("there is no element \"" + type + "\" with a quadrature \"" +
                                      quadrature + "\".");
        }
        return rule->zero_energy_modes;
      },
      py::kw_only(), "cell_type"_a, "quadrature"_a);
  m.def("cell_edges", &cell_edges, py::kw_only(), "cell_type"_a);
  m.def("cell_faces", &cell_faces, py::kw_only(), "cell_type"_a);
  m.def("box_mesh", &box_mesh, py::kw_only(), "origin"_a, "size"_a, "cells"_a, "split"_a);
  m.def("boundary_surface", &boundary_surface, py::kw_only(), "positions"_a, "blocks"_a);
  m.def("boundary_faces", &boundary_faces, py::kw_only(), "positions"_a, "blocks"_a);
  m.def("face_areas", &face_areas, py::kw_only(), "type"_a, "positions"_a, "faces"_a, "thickness"_a);
  m.def("face_normals", &face_normals, py::kw_only(), "type"_a, "positions"_a, "faces"_a, "thickness"_a);
  m.def("turn_reversed_cells", &turn_reversed_cells, py::kw_only(), "positions"_a, "blocks"_a);
  const auto measure = [&m](const char* name, auto function) {
    m.def(
        name,
        [function](const Reals& positions, const Blocks& blocks) {
          return function(to_mesh(positions, blocks));
        },
        py::kw_only(), "positions"_a, "blocks"_a);
  };
  measure("overfull_face_count", &tissu::overfull_face_count);
  measure("nonconforming_faces", [](const tissu::Mesh& mesh) {
    const tissu::NonconformingFaces found = tissu::nonconforming_faces(mesh);
    return py::make_tuple(found.count, to_array<std::int32_t>(found.cells));
  });
  measure("connected_parts",
          [](const tissu::Mesh& mesh) { return to_array<std::int32_t>(tissu::connected_parts(mesh)); });
  measure("cell_volumes", [](const tissu::Mesh& mesh) { return to_array<double>(tissu::volumes(mesh)); });
  measure("jacobian_ranges",
          [](const tissu::Mesh& mesh) { return to_array<double>(tissu::jacobian_ranges(mesh), 2); });
  measure("shape_qualities",
          [](const tissu::Mesh& mesh) { return to_array<double>(tissu::shape_qualities(mesh)); });
}
