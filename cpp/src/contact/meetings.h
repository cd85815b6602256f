#pragma once

/// A plan of a search, checked, and the boxes of each call, checked.

#include <cstdint>
#include <span>
#include <vector>

#include "tissu/contact/broad_phase.h"

namespace tissu {

class Meetings {
 public:
  explicit Meetings(const SearchPlan& plan);

  /// Throws ParameterError unless there is one finite box for each primitive.
  void check(std::span<const Box> boxes) const;

  [[nodiscard]] std::int32_t primitive_count() const { return first_.back(); }
  [[nodiscard]] std::int32_t surface_count() const { return static_cast<std::int32_t>(first_.size()) - 1; }
  /// The first primitive of a surface; that of the surface after the last one is the number of primitives.
  [[nodiscard]] std::int32_t first(std::int32_t surface) const {
    return first_[static_cast<std::size_t>(surface)];
  }
  /// Ascending, a <= b, each once.
  [[nodiscard]] std::span<const SearchPlan::Meeting> all() const { return meetings_; }
  /// Primitives of surfaces that meet any surface, ascending.
  [[nodiscard]] std::span<const std::int32_t> searched() const { return searched_; }
  /// Primitives of a surface that meets any; else none.
  [[nodiscard]] std::span<const std::int32_t> of(std::int32_t surface) const {
    const auto begin = static_cast<std::size_t>(first_searched_[static_cast<std::size_t>(surface)]);
    const auto end = static_cast<std::size_t>(first_searched_[static_cast<std::size_t>(surface) + 1]);
    return std::span(searched_).subspan(begin, end - begin);
  }
  /// Whether the surfaces of two primitives meet. With one surface alone it is answered at once.
  [[nodiscard]] bool meet(std::int32_t p, std::int32_t q) const {
    return only_one_ ||
           surfaces_meet(surface_of_[static_cast<std::size_t>(p)], surface_of_[static_cast<std::size_t>(q)]);
  }
  [[nodiscard]] bool has_meeting(std::int32_t surface) const {
    return row_[static_cast<std::size_t>(surface)] < row_[static_cast<std::size_t>(surface) + 1];
  }
  [[nodiscard]] std::size_t bytes() const;

 private:
  void fill_rows();
  void fill_searched();
  [[nodiscard]] bool surfaces_meet(std::int32_t a, std::int32_t b) const;

  std::vector<std::int32_t> first_;
  std::vector<SearchPlan::Meeting> meetings_;
  std::vector<std::int32_t> row_;         ///< of each surface in `met_`, and the end
  std::vector<std::int32_t> met_;         ///< surfaces that a surface meets, ascending
  std::vector<std::int32_t> surface_of_;  ///< of each primitive
  std::vector<std::int32_t> searched_;
  std::vector<std::int32_t> first_searched_;  ///< of each surface in `searched_`, and the end
  bool only_one_;                             ///< surface that is searched, and it meets itself
};

}  // namespace tissu
