#pragma once

#include <vector>

#include "preconditioner.h"
#include "sparse_factor.h"

namespace tissu {

/// The factor of an earlier matrix, without couplings where it is positive definite without them. Its price
/// is that of its operations and bytes, as the factor counts them.
template <class T>
class StaleCholesky final : public Preconditioner<T> {
 public:
  void make(const LinearOperator& A, double scale) override;
  [[nodiscard]] double price() const override { return price_; }
  [[nodiscard]] double making() const override { return factor_.making(); }
  [[nodiscard]] double once() const override { return factor_.once(); }
  [[nodiscard]] double application() const override { return factor_.application(); }
  [[nodiscard]] bool takes_couplings() const override { return false; }
  void apply(std::span<const T> r, std::span<T> z) override;
  [[nodiscard]] std::size_t bytes() const override { return factor_.bytes() + 16 * right_.size(); }

 private:
  SparseFactor factor_;
  double price_ = 0.0;
  double inverse_scale_ = 1.0;
  std::vector<double> right_;
  std::vector<double> answer_;
};

}  // namespace tissu
