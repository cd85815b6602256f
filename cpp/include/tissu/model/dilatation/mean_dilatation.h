#pragma once

/// Mean dilatation: each patch of cells has one volume ratio, so that cells of first order do not lock where
/// the material hardly changes its volume (F-bar written as an energy). Equations:
/// src/model/dilatation/kernels: dilated_point.h and mean_dilatation.h.
///
///   E = sum_g w_g W((theta / J_g)^(1/3) F_g),   theta = sum_g w_g J_g / sum_g w_g of the patch
///
/// A patch is one hexahedron (Nagtegaal, Parks and Rice 1974; Simo, Taylor and Pister 1985), or some
/// tetrahedra, wedges or pyramids around a node (de Souza Neto, Andrade Pires and Owen 2005, here with the
/// force as the gradient of E, so that the tangent is symmetric). Patches do not overlap, and each is of one
/// region and one material. A law that is not written by volume and shape is taken at the same Fbar; Hooke's
/// too depends on J here and is no longer linear. What happens where a point is crushed below a tenth of its
/// volume, or inverted: dilated_point.h.

#include <memory>
#include <vector>

#include "tissu/cell/cell_patches.h"
#include "tissu/model/cell_model.h"
#include "tissu/model/dilatation/mean_dilatation_kernels.h"
#include "tissu/model/model_info.h"
#include "tissu/model/part_energies.h"

namespace tissu {

class MeanDilatation final : public CellModel, public PartEnergies {
 public:
  static ModelInfo info();
  /// Refuses unknown names, parameters out of range and cells that are inverted or have no volume.
  MeanDilatation(ElasticBlock block, ConstReals rest_positions, Isa isa, Threads threads);

  [[nodiscard]] std::string_view effect() const override { return "elasticity"; }
  void couple(SparsityBuilder& builder) const override;
  void bind(const Sparsity& pattern) override;
  void add_force(const State& state, Scratch& scratch, Reals f) const override;
  /// `scale.definite` makes the matrix of each patch positive semi-definite.
  void add_stiffness(const State& state, Scratch& scratch, StiffnessScale scale,
                     BlockMatrix& matrix) const override;
  void add_product(const State& state, Scratch& scratch, StiffnessScale scale, ConstReals p,
                   Reals out) const override;
  [[nodiscard]] double energy(const State& state, Scratch& scratch) const override;
  void add_part_energies(const State& state, Scratch& scratch, std::span<const std::int32_t> part_of,
                         Reals energies) const override;

  /// Von Mises of the stress that is in balance; det F of the cell itself, not of its patch.
  [[nodiscard]] CellFields fields(const State& state) const override;
  [[nodiscard]] PointFields point_fields(const PointQuery& query) const override;
  [[nodiscard]] std::size_t bytes() const override;
  [[nodiscard]] std::size_t reals_per_cell() const override;
  /// The other cells stay in their patches.
  [[nodiscard]] std::unique_ptr<BodyModel> without(const ElasticBlock& left,
                                                   const std::vector<std::int32_t>& removed) const override;

  /// The patch of each cell.
  [[nodiscard]] const std::vector<std::int32_t>& patches() const { return of_cell_; }

 private:
  MeanDilatation(ElasticBlock block, std::vector<std::int32_t> of_cell, ConstReals rest_positions, Isa isa,
                 Threads threads);
  void lay(ConstReals rest_positions);
  void choose_kernels();
  [[nodiscard]] Loops<MeanDilatationKernels, MeanDilatationView> loops() const;
  void add_patches(const Chunk& chunk, const PatchParts& parts, StiffnessScale scale, double* blocks) const;

  Isa isa_;
  std::vector<double> X_;  ///< positions at rest of the whole world
  std::vector<std::int32_t> of_cell_;
  PatchTable table_;
  const MeanDilatationKernels* kernels_ = nullptr;
  std::vector<const LawKernels*> laws_;
  std::vector<double> gradients_;  ///< [point][node][3]
};

}  // namespace tissu
