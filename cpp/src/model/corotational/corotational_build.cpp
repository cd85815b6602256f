#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <span>
#include <utility>

#include "base/kernel_choice.h"
#include "kernels/corotational_lists.h"
#include "tissu/base/error.h"
#include "tissu/model/corotational/corotational.h"

namespace tissu {
namespace {

constexpr std::array<std::string_view, 3> kRotations = {"small", "frame", "polar"};  // as in Rotation

/// The words of CorotationalOptions, and a quadrature that K is exact with on affine cells.
void check_words(const ElasticBlock& block) {
  const auto refuse = [&](std::string_view what, const std::string& found, std::string_view taken) {
    throw ParameterError("body \"" + block.body + "\" asks for the model corotational with the " +
                         std::string(what) + " \"" + found + "\"; there are " + std::string(taken) + ".");
  };
  const auto model = options_or_defaults<CorotationalOptions>(block.model);
  if (std::ranges::find(kRotations, model.rotation) == kRotations.end()) {
    refuse("rotation", model.rotation, "small, frame and polar");
  }
  if (model.tangent != "approximate" && model.tangent != "exact") {
    refuse("tangent", model.tangent, "approximate and exact");
  }
  if (block.quadrature == "full") return;
  throw ParameterError("body \"" + block.body + "\" asks for the model corotational with the quadrature \"" +
                       block.quadrature + "\"; this model takes full.");
}

/// J at a point: sum_a X_a (x) dN_a/dxi.
Mat3 jacobian(const ReferenceCell::Point& point, std::span<const std::int32_t> cell, ConstReals X) {
  Mat3 J = Mat3::Zero();
  for (std::size_t a = 0; a < cell.size(); ++a) {
    J += block(X, cell[a]) * Eigen::Map<const Eigen::RowVector3d>(point.gradients[a].data());
  }
  return J;
}

/// Q of J = Q T with T upper triangular and positive on its diagonal.
Mat3 edge_axes(const Mat3& J) {
  Mat3 Q;
  Q.col(0) = J.col(0).normalized();
  Q.col(1) = (J.col(1) - J.col(1).dot(Q.col(0)) * Q.col(0)).normalized();
  Q.col(2) = Q.col(0).cross(Q.col(1));
  return Q;
}

}  // namespace

const CorotationalKernels* find_corotational_kernels(Isa isa, std::string_view element, bool affine,
                                                     bool exact) {
  const auto made_for = [&](const CorotationalKernels& k) {
    return k.element == element && k.affine == affine && k.exact == exact;
  };
  for (const KernelList<CorotationalKernels>& list :
       {TISSU_KERNELS_OF(isa, corotational_tetra()), TISSU_KERNELS_OF(isa, corotational_hexahedron()),
        TISSU_KERNELS_OF(isa, corotational_wedge()), TISSU_KERNELS_OF(isa, corotational_pyramid())}) {
    if (const CorotationalKernels* found = find_kernels(list, made_for)) return found;
  }
  return nullptr;
}

ModelInfo Corotational::info() {
  using enum Ability::Can;
  return {.name = "corotational",
          .form = "Hooke's law in axes that turn with each cell",
          .laws = {"hooke"},
          .elements = {"tetra", "hexahedron", "wedge", "pyramid"},
          .poisson = {yes, "of the law"},
          .rotation = {yes, "any rotation, except with `rotation: small`"},
          .strain = {partly, "linear in the cell's axes"},
          .inversion = {yes, "with the approximate tangent"},
          .topology = {yes, "cell by cell"}};
}

Corotational::Corotational(ElasticBlock block, ConstReals rest_positions, Isa isa, Threads threads)
    : CellModel(std::move(block), threads) {
  check_words(block_);
  check_laws(block_, static_cast<std::size_t>(cell_count()));
  const auto options = options_or_defaults<CorotationalOptions>(block_.model);
  rotation_ = static_cast<Rotation>(std::ranges::find(kRotations, options.rotation) - kRotations.begin());
  const bool affine = std::ranges::all_of(affine_cells(reference_, block_.cells, rest_positions),
                                          [](char a) { return a != 0; });
  const bool one_jacobian = affine && rotation_ != Rotation::small;
  choose_kernels(isa, one_jacobian, options.tangent == "exact");
  lay_cells(rest_positions, {.frames = false, .triangular = one_jacobian});
  if (!one_jacobian && rotation_ != Rotation::small) lay_centres(rest_positions);
  take_constants(lay_law_constants(block_, order_.element, 3));
}

void Corotational::choose_kernels(Isa isa, bool one_jacobian, bool exact_tangent) {
  const bool exact = exact_tangent && rotation_ != Rotation::small;
  tangents_ = find_corotational_kernels(isa, block_.element, one_jacobian, exact);
  forces_ =
      find_corotational_kernels(isa, block_.element, one_jacobian, exact || rotation_ == Rotation::polar);
  if (forces_ != nullptr && tangents_ != nullptr) return;
  throw ParameterError("body \"" + block_.body + "\" asks for the model corotational with the element " +
                       block_.element + "; this model takes tetra, hexahedron, wedge and pyramid.");
}

/// The axes of J = Q T at the centre serve the whole cell: J^-1 of its points becomes J^-1 Q, and T^-1 is
/// kept of the centre, where the rotation of F Q is found.
void Corotational::lay_centres(ConstReals rest_positions) {
  const ReferenceCell centre = reference_cell(block_.element, "reduced");
  const auto nodes = static_cast<std::size_t>(reference_.nodes);
  const auto points = static_cast<std::size_t>(shape_.rest_points);
  centres_.resize(order_.element.size() * 6);
  for (std::size_t i = 0; i < order_.element.size(); ++i) {
    const std::span cell(block_.cells.data() + static_cast<std::size_t>(order_.element[i]) * nodes, nodes);
    const Mat3 J = jacobian(centre.points.front(), cell, rest_positions);
    const Mat3 Q = edge_axes(J);
    const Mat3 inverse = (Q.transpose() * J).inverse();
    double* to = centres_.data() + i / kLanes * 6 * kLanes + i % kLanes;
    for (Eigen::Index row = 0; row < 3; ++row) {
      for (Eigen::Index column = row; column < 3; ++column, to += kLanes) *to = inverse(row, column);
    }
    for (std::size_t g = 0; g < points; ++g) {
      double* rest = shape_.rest.data() + (i / kLanes * points + g) * shape_.reals * kLanes + i % kLanes;
      Mat3 turned;
      for (std::size_t k = 0; k < 9; ++k) {
        turned(static_cast<Eigen::Index>(k / 3), static_cast<Eigen::Index>(k % 3)) = rest[k * kLanes];
      }
      turned *= Q;
      for (std::size_t k = 0; k < 9; ++k) {
        rest[k * kLanes] = turned(static_cast<Eigen::Index>(k / 3), static_cast<Eigen::Index>(k % 3));
      }
    }
  }
}

}  // namespace tissu
