#pragma once

/// What a linear solver is given: a symmetric matrix, assembled or not.

#include <cstdint>
#include <vector>

#include "tissu/base/parallel.h"
#include "tissu/base/vec.h"

namespace tissu {

class BlockMatrix;
class Couplings;
struct RowPlaces;

class LinearOperator {
 public:
  LinearOperator() = default;
  virtual ~LinearOperator() = default;
  LinearOperator(const LinearOperator&) = delete;
  LinearOperator& operator=(const LinearOperator&) = delete;

  /// 3-vectors of the unknown.
  [[nodiscard]] virtual std::int32_t rows() const = 0;
  [[nodiscard]] virtual const Threads& threads() const = 0;
  /// out = A p
  virtual void multiply(ConstReals p, Reals out) const = 0;
  /// The 3x3 blocks on the diagonal, [row][9], column by column.
  virtual void diagonal_blocks(Reals blocks) const = 0;
  /// What the diagonal blocks cost, counted in products.
  [[nodiscard]] virtual double diagonal_cost() const = 0;
  /// epsilon |diag(A) x|: what round-off alone leaves in A x.
  [[nodiscard]] virtual double round_off(ConstReals x) const = 0;
  /// Bytes that a product reads.
  [[nodiscard]] virtual std::size_t bytes() const = 0;
  /// Its blocks, null when it has none.
  [[nodiscard]] virtual const BlockMatrix* matrix() const { return nullptr; }

  /// No two operators have the same, and one keeps its own as long as it keeps its pattern.
  [[nodiscard]] std::uint64_t id() const { return id_; }
  /// Grows with every change of the values, …
  [[nodiscard]] std::uint64_t version() const { return version_; }
  /// … and this one with every change that is not of the couplings alone.
  [[nodiscard]] std::uint64_t values_version() const { return values_version_; }
  /// What is coupled beside it and counts as a part of it; null: nothing.
  [[nodiscard]] const Couplings* couplings() const { return couplings_; }
  /// Couplings, closed for these rows, that outlive it; null: none. They count as changed.
  void set_couplings(const Couplings* couplings) {
    if (couplings_ != nullptr || couplings != nullptr) ++version_;
    couplings_ = couplings;
  }
  /// For each row the axes (bits x=1 y=2 z=4) that were made those of the identity; null when there are none.
  [[nodiscard]] const std::vector<std::uint8_t>* given() const { return given_; }
  /// Where the rows are; null where that is not known.
  [[nodiscard]] const RowPlaces* places() const { return places_; }
  /// Places that outlive it.
  void set_places(const RowPlaces* places) { places_ = places; }
  [[nodiscard]] bool is_given(std::int32_t row, int axis) const {
    return given_ != nullptr && (((*given_)[static_cast<std::size_t>(row)] >> axis) & 1) != 0;
  }

 protected:
  void count_change() {
    ++version_;
    ++values_version_;
  }
  void set_given(const std::vector<std::uint8_t>* masks) { given_ = masks; }
  /// Of an operator whose pattern has changed.
  void renew_id() {
    id_ = next_id();
    count_change();
  }

 private:
  static std::uint64_t next_id();
  std::uint64_t id_ = next_id();
  std::uint64_t version_ = 0;
  std::uint64_t values_version_ = 0;
  const std::vector<std::uint8_t>* given_ = nullptr;
  const RowPlaces* places_ = nullptr;
  const Couplings* couplings_ = nullptr;
};

}  // namespace tissu
