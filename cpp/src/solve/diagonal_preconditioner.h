#pragma once

#include <vector>

#include "preconditioner.h"

namespace tissu {

/// z_i = r_i / |a_ii|
template <class T>
class Jacobi final : public Preconditioner<T> {
 public:
  void make(const LinearOperator& A, double scale) override;
  [[nodiscard]] double price() const override { return price_; }
  [[nodiscard]] double making() const override { return making_; }
  [[nodiscard]] double application() const override { return static_cast<double>(bytes()); }
  [[nodiscard]] bool is_local() const override { return true; }
  void apply_rows(std::int32_t begin, std::int32_t end, const T* r, T* z) override;
  [[nodiscard]] std::size_t bytes() const override { return inverse_.size() * sizeof(T); }

 private:
  double price_ = 0.0;
  double making_ = 0.0;
  std::vector<T> inverse_;
  std::vector<double> blocks_;
};

/// z_i = D_i^-1 r_i with the 3x3 blocks D_i on the diagonal.
template <class T>
class BlockJacobi final : public Preconditioner<T> {
 public:
  void make(const LinearOperator& A, double scale) override;
  [[nodiscard]] double price() const override { return price_; }
  [[nodiscard]] double making() const override { return making_; }
  [[nodiscard]] double application() const override { return static_cast<double>(bytes()); }
  [[nodiscard]] bool is_local() const override { return true; }
  void apply_rows(std::int32_t begin, std::int32_t end, const T* r, T* z) override;
  [[nodiscard]] std::size_t bytes() const override { return inverse_.size() * sizeof(T); }

 private:
  double price_ = 0.0;
  double making_ = 0.0;
  std::vector<T> inverse_;  ///< [row][9], column by column
  std::vector<double> blocks_;
};

}  // namespace tissu
