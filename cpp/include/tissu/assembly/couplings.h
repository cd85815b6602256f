#pragma once

/// A list of small couplings beside a constant matrix: what is coupled only while a world runs (links,
/// contact) never changes the matrix's pattern.
///
///     C = sum_c J_c^T H_c J_c,   J_c p = sum_v beta_v (motion of vertex v)
///
/// A coupling has up to four vertices, whose beta sum to zero, so that a translation of all costs nothing, or
/// one vertex, which is drawn to a place in space; and a positive semi-definite H of 3x3. A vertex is a row
/// itself, or is carried by rows (a point of a frame, of a cell): the sum of weight p_row and, for rotations,
/// weight p_row x arm.
///
/// Every coupling computes s_c = H_c J_c p alone, then every row adds what its couplings give it in the order
/// of the list, so that the bits do not depend on the number of threads.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "tissu/base/parallel.h"
#include "tissu/base/vec.h"

namespace tissu {

/// What a row does to a vertex that it carries.
struct CarriedPart {
  std::int32_t row;
  double weight;
  Vec3 arm = Vec3::Zero();  ///< from the frame's origin to the vertex [m]
  bool turns = false;       ///< the row is a rotation

  /// What of the vertex's motion is the row's, …
  [[nodiscard]] Vec3 motion(const Vec3& p) const {
    return turns ? Vec3(weight * p.cross(arm)) : Vec3(weight * p);
  }
  /// … and what of a force on the vertex: a moment for a rotation.
  [[nodiscard]] Vec3 load(const Vec3& force) const {
    return turns ? Vec3(weight * arm.cross(force)) : Vec3(weight * force);
  }
  /// B X B^T, where B p is that motion.
  [[nodiscard]] Mat3 carried(const Mat3& X) const {
    if (!turns) return weight * weight * X;
    Mat3 arms;
    arms << 0.0, -arm.z(), arm.y(), arm.z(), 0.0, -arm.x(), -arm.y(), arm.x(), 0.0;
    return weight * weight * arms * X * arms.transpose();
  }
};

struct Coupling {
  std::array<std::int32_t, 4> vertex;  ///< a row; kCarried and below: carried
  std::array<double, 4> beta;          ///< 0: no vertex
  Mat3 H;
  /// No stiffer than a few times the matrix's own blocks, whatever the scene: a preconditioner that does not
  /// have it serves on.
  bool mild = false;
};

class Couplings {
 public:
  static constexpr std::int32_t kCarried = -1;

  /// Begins a new list; the room of the old one is kept.
  void clear();
  /// A vertex that rows carry, for `add`.
  std::int32_t carry(std::span<const CarriedPart> parts);
  void add(const Coupling& coupling);
  /// Ends the list, of a matrix of so many rows. `given`: for each row the axes (bits) that are those of the
  /// identity, skipped from now on; null: none. It outlives the next `clear`.
  void close(std::int32_t rows, const std::vector<std::uint8_t>* given);

  [[nodiscard]] bool empty() const { return list_.empty(); }
  [[nodiscard]] std::size_t size() const { return list_.size(); }
  [[nodiscard]] const std::vector<Coupling>& list() const { return list_; }
  /// The rows that carry a vertex.
  [[nodiscard]] std::span<const CarriedPart> parts(std::int32_t vertex) const;
  /// Rows that are coupled, ascending.
  [[nodiscard]] const std::vector<std::int32_t>& rows() const { return rows_; }

  /// s_c of all couplings, …
  template <class T>
  void gather(const Threads& threads, const T* p) const;
  /// … and factor times their sums, added to rows [begin, end) of `out`.
  template <class T>
  void scatter(std::int32_t begin, std::int32_t end, double factor, T* out) const;
  /// out += factor C p
  template <class T>
  void add_product(const Threads& threads, double factor, const T* p, T* out) const;

  /// Number among `rows()`, -1 for a row without couplings.
  [[nodiscard]] std::int32_t place(std::int32_t row) const;
  /// Block on the diagonal of C of the row with that number, zero in given axes.
  [[nodiscard]] const Mat3& diagonal(std::int32_t place) const {
    return diagonal_[static_cast<std::size_t>(place)];
  }
  /// Adds them to [row][9].
  void add_diagonal(Reals blocks) const;
  /// A row of one coupling and its share of J_c: J_c p = sum B p_row.
  struct Term {
    std::int32_t row;
    Mat3 B;
  };
  /// The rows of a coupling, each once, without given axes; valid until the next call.
  [[nodiscard]] std::span<const Term> terms(std::size_t coupling) const;
  /// Calls f(row, column, block) for every block of every coupling.
  template <class Function>
  void for_blocks(Function&& f) const {
    for (std::size_t c = 0; c < list_.size(); ++c) {
      const std::span<const Term> all = terms(c);
      for (const Term& a : all) {
        const Mat3 left = a.B.transpose() * list_[c].H;
        for (const Term& b : all) f(a.row, b.row, Mat3(left * b.B));
      }
    }
  }
  /// Which rows each coupling begins with: tells lists of other couplings apart, whatever their H. Mild ones
  /// are left out.
  using Key = std::array<std::int32_t, 4>;
  void keys(std::vector<Key>& sorted) const;
  [[nodiscard]] std::size_t bytes() const;

 private:
  struct Entry {
    std::int32_t coupling;
    std::int32_t part;  ///< number in parts_, -1: the row is the vertex
    double beta;        ///< of the vertex, times the part's weight
  };
  template <class Function>
  void for_entries(Function&& f) const;
  [[nodiscard]] Vec3 free(std::int32_t row, Vec3 value) const;
  [[nodiscard]] Mat3 share(const Entry& entry, std::int32_t row) const;
  void lay_rows(std::int32_t rows);
  void lay_diagonal();

  std::vector<Coupling> list_;
  std::vector<CarriedPart> parts_;
  std::vector<std::int32_t> parts_begin_ = {0};  ///< of each carried vertex, and the end
  const std::vector<std::uint8_t>* given_ = nullptr;
  std::vector<std::int32_t> rows_;
  std::vector<std::int32_t> place_;  ///< of each row of the matrix in rows_, -1 where it has none
  std::vector<std::int32_t> row_begin_;
  std::vector<Entry> entries_;  ///< of each row in the order of the list
  std::vector<Mat3> diagonal_;
  // Scratch of the matrix that holds it: one product at a time.
  mutable std::vector<Vec3> sums_;  ///< s_c
  mutable std::vector<Term> terms_;
};

}  // namespace tissu
