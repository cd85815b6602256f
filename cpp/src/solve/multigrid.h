#pragma once

#include <Eigen/Cholesky>
#include <memory>
#include <vector>

#include "chebyshev.h"
#include "coarse_couplings.h"
#include "preconditioner.h"
#include "prolongation.h"

namespace tissu {

/// One V-cycle of a multigrid made from the matrix and the places of its rows, by smoothed aggregation. Every
/// level consists of rigid frames: aggregates of rows, each with a translation and a rotation about its
/// centre, so that each is a matrix of 3x3 blocks as the first. Iterations on a mesh that is refined do not
/// grow.
///
/// Who belongs to which aggregate is decided once for a pattern and for what is given, by the first matrix
/// that binds rows to each other; values follow the matrix. Without places of the rows only translations are
/// carried to the coarser levels.
template <class T>
class Multigrid final : public Preconditioner<T> {
 public:
  void make(const LinearOperator& A, double scale) override;
  bool make_part(const LinearOperator& A, double scale) override;
  [[nodiscard]] double price() const override { return price_; }
  [[nodiscard]] double making() const override { return making_; }
  [[nodiscard]] double once() const override { return once_; }
  [[nodiscard]] double application() const override { return application_; }
  void apply(std::span<const T> r, std::span<T> z) override;
  void forget() override {
    levels_.clear();
    part_ = Part::smoother;
    part_level_ = 0;
    renewals_ = 0;
  }
  [[nodiscard]] std::size_t bytes() const override;
  /// Rows of each level, the coarsest last.
  [[nodiscard]] std::vector<std::int32_t> level_rows() const;

 private:
  struct Level {
    RowPlaces places;
    RowPlaces next_places;  ///< of the next level
    Couplings couplings;    ///< as they were when it was made
    Chebyshev<T> smoother;
    Aggregates aggregates;
    std::unique_ptr<CoarsePattern> pattern;  ///< to the next level; nothing on the coarsest
    RowPattern prolongation;                 ///< of 3x3 blocks
    RowPattern restriction;
    RowPattern next_pattern;
    BlockRows<T> P;
    BlockRows<T> R;
    AlignedVector<double> next_values;
    std::vector<T> right;   ///< of the next level
    std::vector<T> answer;  ///< of the next level
    std::vector<T> change;
  };
  void take(const LinearOperator& A);
  [[nodiscard]] LevelMatrix fine_matrix(const LinearOperator& A, double scale) const;
  [[nodiscard]] LevelMatrix level_matrix(std::size_t n, const LinearOperator& A, double scale) const;
  [[nodiscard]] bool smooths(std::size_t n, const LinearOperator& A, double scale) const;
  /// The smoother of a level and its prolongation; false: it is the last one.
  bool refresh(std::size_t n, const LinearOperator& A, double scale, bool fresh);
  /// The prolongation of a level and its transpose.
  void fill_transfer(std::size_t n, const LinearOperator& A, double scale);
  /// The matrix of the next level.
  void project(std::size_t n, const LinearOperator& A, double scale);
  void finish(const LinearOperator& A, double scale);
  void start(const LevelMatrix& A);
  bool coarsen(const LevelMatrix& A, Level& level) const;
  void factor(const LevelMatrix& A);
  void cycle(std::size_t number, const T* b, T* x);
  void set_price(const LinearOperator& A);

  std::uint64_t id_ = 0;
  const std::vector<std::uint8_t>* given_ = nullptr;
  Isa isa_{};
  Threads threads_;
  std::vector<std::unique_ptr<Level>> levels_;
  CoarseScratch scratch_;
  std::vector<CarriedPart> carried_;
  static constexpr int kMeasured = 4;  ///< makings in parts, of which one measures the largest eigenvalues
  /// What a making in parts does next, and on which level.
  enum class Part : std::uint8_t { smoother, eigenvalue, prolongation, next_matrix };
  Part part_ = Part::smoother;
  std::size_t part_level_ = 0;
  int renewals_ = 0;  ///< makings in parts, modulo kMeasured
  bool has_couplings_ = false;
  bool complete_ = false;  ///< the latest making came to its end
  bool direct_ = false;    ///< the coarsest level is solved by its factor
  Eigen::LLT<Eigen::MatrixXd> factor_;
  Eigen::MatrixXd dense_;
  Eigen::VectorXd vector_;
  std::int32_t row_ = 0;  ///< at which a making in parts goes on
  double price_ = 0.0;
  double iteration_bytes_ = 1.0;
  double making_ = 0.0;
  double once_ = 0.0;
  double application_ = 0.0;
};

}  // namespace tissu
