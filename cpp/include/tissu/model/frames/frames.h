#pragma once

/// Frame-based continuum (Bosman, Duriez and Cotin 2014): the motion of a few frames, six degrees of freedom
/// each, carries many integration points,
///   p = sum_i w_i (x_i + R_i l_i),   F = sum_i (x_i + R_i l_i) (x) grad w_i + w_i R_i,
/// with l_i from frame to point at rest, where every frame has the axes of space. Any law of volumes.
///
/// Points may listen to plain nodes beside frames, x_b (x) g_b alone: so they ride on cells of other bodies.
/// The place of a cell's node j with the cell's own gradient, x_j + F l, weighs node b by
/// w_b = w_j (delta_jb + grad N_b . l), g_b = w_b / w_j grad w_j + w_j grad N_b.

#include "tissu/model/body_model.h"
#include "tissu/model/frames/frame_kernels.h"
#include "tissu/model/frames/frame_material.h"
#include "tissu/model/frames/frame_order.h"
#include "tissu/model/frames/rotation_tie.h"
#include "tissu/model/model_info.h"

namespace tissu {

class Frames final : public BodyModel {
 public:
  static ModelInfo info();
  /// Refuses elements, laws, densities and cells that cannot be, and frames that the block does not know.
  Frames(ElasticBlock block, ConstReals rest_positions, Isa isa, Threads threads);

  [[nodiscard]] std::string_view effect() const override { return "frames"; }
  void couple(SparsityBuilder& builder) const override;
  void bind(const Sparsity& pattern) override;
  [[nodiscard]] std::size_t scratch_size() const override { return motion_size() + shares_size(); }
  void add_force(const State& state, Scratch& scratch, Reals f) const override;
  void add_stiffness(const State& state, Scratch& scratch, StiffnessScale scale,
                     BlockMatrix& matrix) const override;
  void add_product(const State& state, Scratch& scratch, StiffnessScale scale, ConstReals p,
                   Reals out) const override;
  [[nodiscard]] double energy(const State& state, Scratch& scratch) const override;

  [[nodiscard]] const ElasticBlock& block() const override { return block_; }
  [[nodiscard]] std::int32_t cell_count() const override {
    return static_cast<std::int32_t>(volumes_.size());
  }
  [[nodiscard]] int nodes_per_cell() const override { return nodes_per_cell_; }
  [[nodiscard]] const std::vector<double>& volumes() const override { return volumes_; }
  /// Each point's mass goes to its frames in proportion to their weights, or to the squares of these where
  /// one is below zero (Hinton, Rock and Zienkiewicz 1976).
  void add_masses(std::vector<double>& nodal) const override;
  void add_weights(std::vector<double>& nodal) const override;
  /// sum_s m_s (l^2 I - l l^T), and what a point has on its own: that of a cube of its volume.
  void add_inertias(std::vector<Mat3>& of_frames) const override;
  void add_moments(std::vector<Vec3>& of_frames) const override;
  [[nodiscard]] CellFields fields(const State& state) const override;
  [[nodiscard]] double least_volume_ratio(const State& state, Scratch& scratch) const override;
  [[nodiscard]] PointFields point_fields(const PointQuery& query) const override;
  [[nodiscard]] std::size_t bytes() const override;
  [[nodiscard]] std::size_t reals_per_cell() const override;

  /// Where the points are now [m], three each, in the order of the block's points or of its cells' points.
  [[nodiscard]] std::vector<double> points(const State& state) const override;
  [[nodiscard]] const FramePoints& sample() const { return points_; }

 private:
  static constexpr std::size_t kLanes = FrameOrder::kLanes;
  static constexpr std::int32_t kPiece = 4;  ///< groups whose tensors are held at a time

  void lay_frames();
  [[nodiscard]] FramePoints stressed_points() const;
  void lay_coefficients(ConstReals rest_positions);
  /// What of the way from frame to point follows the frame's rotation.
  [[nodiscard]] Mat3 along(std::size_t point) const;
  void check_rest(ConstReals rest_positions) const;
  void lay_holds();
  void lay_tie();
  [[nodiscard]] FrameView view() const;
  /// What it works with, in the caller's room.
  struct Room {
    double* q;       ///< [frame][12]
    double* dq;      ///< [frame][6]
    double* shares;  ///< [group][k][6][8]
  };
  [[nodiscard]] Room room(Scratch& scratch) const;
  [[nodiscard]] std::size_t motion_size() const { return (18 * blocks_.size() + 7) / 8 * 8; }
  [[nodiscard]] std::size_t shares_size() const;
  void gather(const State& state, double* q) const;
  /// Of each lane [J]
  void energies(double* q, double* of_lanes) const;
  /// Calls f(begin, end) for pieces of groups; those that run at the same time share no frame.
  template <class Function>
  void for_coloured(Function&& f) const;
  /// Calls f(begin, end) for pieces of groups, all at the same time.
  template <class Function>
  void for_pieces(Function&& f) const;
  /// to += scale times the shares of each frame
  void add_shares(const double* shares, double scale, Reals to) const;
  /// Calls f(entry [point][k], mass of the point, share of it) for every point and frame.
  template <class Function>
  void for_neighbours(Function&& f) const;
  /// The row of a frame's rotation; of a plain node its own, which takes the zeros in the rotation's place.
  [[nodiscard]] std::int32_t rotation_row(std::size_t frame) const {
    return rotations_[frame] < 0 ? blocks_[frame] : rotations_[frame];
  }
  [[nodiscard]] double density(std::size_t point) const;
  /// Inertia per mass of a point on its own [m2].
  [[nodiscard]] double own_turning(std::size_t point) const;

  ElasticBlock block_;
  FramesOptions options_;
  Threads threads_;
  const FrameKernels* kernels_;
  FramePoints points_;
  int nodes_per_cell_;
  std::vector<double> volumes_;          ///< of cells
  std::vector<std::int32_t> blocks_;     ///< of each frame of the model: its origin, …
  std::vector<std::int32_t> rotations_;  ///< … its rotation, …
  std::vector<std::int32_t> numbers_;    ///< … and its number in the state; both -1 of plain nodes
  std::vector<std::int32_t> listened_;   ///< [point][k], frames of the model
  std::vector<double> levers_;           ///< [point][k][3], l
  FrameOrder order_;
  AlignedVector<std::int32_t> lanes_;   ///< [group][k][8], frames of the model
  AlignedVector<double> coefficients_;  ///< [group][k][12][8]
  AlignedVector<double> lane_volumes_;  ///< [group][8]
  AlignedVector<std::int32_t> slots_;   ///< [group][a][b][4][8]
  FrameMaterial material_;
  RotationTie tie_;  ///< of volumes with half levers; else empty
  /// [J/rad2] of each frame. Some rotations of trilinear and linear frames move no point, such as turns about
  /// x that depend on x alone: the matrix, and only it, holds them, so that a factor exists and each step of
  /// Newton's leaves them where they are.
  std::vector<double> holds_;
};

}  // namespace tissu
