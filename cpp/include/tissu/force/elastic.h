#pragma once

/// The elasticity of one block of like cells: an element, a quadrature and a law.

#include <map>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "tissu/base/array.h"
#include "tissu/base/parallel.h"
#include "tissu/force/elastic_kernels.h"
#include "tissu/force/element_order.h"
#include "tissu/force/force_model.h"
#include "tissu/force/loaded_law.h"
#include "tissu/force/rest_shape.h"

namespace tissu {

/// Parameters of a law by name, in SI units: one number, or one for each cell.
using LawParameters = std::map<std::string, std::vector<double>>;

/// A law with its parameters.
struct LawUse {
  std::string law;
  LawParameters parameters;
  std::shared_ptr<const LoadedLaw> loaded = nullptr;  ///< null: the library's law of this name
};

/// What holds across a surface: no stress, as in a sheet, or no strain, as in a slice of a long body. Along a
/// line nothing holds it sideways under `stress`, and it cannot thin under `strain`.
enum class Plane : std::uint8_t { stress, strain };

/// What an elastic block is made of. `density` holds one number, or one for each cell.
struct ElasticBlock {
  std::string body;
  std::string element = "tetra";
  std::string law = "stvk";
  std::string quadrature = "full";
  std::vector<std::int32_t> cells;         ///< cell after cell, node numbers of the world, VTK order
  std::vector<std::int32_t> cell_numbers;  ///< of each cell in its body; empty: 0, 1, 2, …
  LawParameters parameters;                ///< of the law
  std::shared_ptr<const LoadedLaw> loaded = nullptr;  ///< the law itself; null: the library's of this name
  std::vector<LawUse> reinforcements;                 ///< laws whose energies are added: fibres
  std::vector<double> density;                        ///< [kg/m3]
  /// Of surfaces the thickness [m], of lines the area [m2]; one, or one for each cell. Volumes have none.
  std::vector<double> cross_section = {1.0};
  Plane plane = Plane::stress;
  bool fused = true;  ///< kernels made for this element and law where there are such; else those of its shape
};

/// Some of a block's cells, `which` in ascending order, with what belongs to them.
ElasticBlock part_of(const ElasticBlock& block, const std::vector<std::size_t>& which);

/// A block's affine cells and its others apart, when it has both: one J serves an affine cell. `first_cell`
/// is the number in its body of a block whose cells have none. What is not known is left to the model to
/// refuse.
std::vector<ElasticBlock> split_affine(ElasticBlock block, std::int32_t first_cell,
                                       ConstReals rest_positions);

/// Mean values over each cell, in the order of the block's cells.
struct CellFields {
  std::vector<double> von_mises;       ///< of the Cauchy stress [Pa]
  std::vector<double> energy_density;  ///< per rest volume [J/m3]
  std::vector<double> volume_ratio;    ///< det F
};

class Elastic final : public ForceModel {
 public:
  /// Refuses unknown names, parameters out of range and cells that are inverted or have no volume.
  Elastic(ElasticBlock block, ConstReals rest_positions, Isa isa, Threads threads);

  [[nodiscard]] std::string_view effect() const override { return "elasticity"; }
  [[nodiscard]] ForceKind kind() const override { return ForceKind::elastic; }
  [[nodiscard]] bool has_constant_stiffness() const override;
  void couple(SparsityBuilder& builder) const override;
  void bind(const Sparsity& pattern) override;
  void add_force(const State& state, Reals f) const override;
  void add_stiffness(const State& state, StiffnessScale scale, BlockMatrix& matrix) const override;
  void add_product(const State& state, StiffnessScale scale, ConstReals p, Reals out) const override;
  [[nodiscard]] double energy(const State& state) const override;

  [[nodiscard]] const ElasticBlock& block() const { return block_; }
  [[nodiscard]] std::int32_t cell_count() const;
  [[nodiscard]] int nodes_per_cell() const { return kernels_->nodes; }
  [[nodiscard]] const std::vector<double>& volumes() const { return shape_.volumes; }  ///< at rest [m3]
  /// Adds each node's lumped mass [kg]: sum_g w_g rho N_a for elements of first order; for the others the
  /// mass of the cell in proportion to the integral of N_a^2 (Hinton, Rock and Zienkiewicz 1976), which is
  /// never negative.
  void add_masses(std::vector<double>& nodal) const;
  /// Adds each node's share of a body force, sum_g w_g rho N_a [kg]: consistent, and negative at some corners
  /// of quadratic elements.
  void add_weights(std::vector<double>& nodal) const;
  [[nodiscard]] CellFields fields(const State& state) const;
  /// What it holds of its cells, node and matrix places included.
  [[nodiscard]] std::size_t bytes() const;
  /// Numbers kept of each cell's rest shape and law; those of a law that all cells share are kept once.
  [[nodiscard]] std::size_t reals_per_cell() const;

 private:
  void choose_kernels(Isa isa);
  void check_numbers() const;
  void lay_constants();
  [[nodiscard]] ElasticView view() const;
  template <class Function>
  void for_nodes(Function&& f) const;
  template <class Function>
  void for_chunks(Function&& f) const;
  [[nodiscard]] std::vector<double> energies(const State& state) const;

  ElasticBlock block_;
  Threads threads_;
  const ElasticKernels* kernels_ = nullptr;
  std::vector<const LawKernels*> laws_;
  ReferenceCell reference_;
  std::vector<double> gradients_;  ///< [point][node][m]
  ElementOrder order_;
  AlignedVector<std::int32_t> slots_;
  AlignedVector<double> constants_;
  std::ptrdiff_t constants_stride_ = 0;
  RestShape shape_;
};

}  // namespace tissu
