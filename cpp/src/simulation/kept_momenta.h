#pragma once

/// Momenta that moved nodes and other cells change are given back, part by part.

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "tissu/edit/body_totals.h"
#include "tissu/edit/edit_body.h"
#include "tissu/step/parts.h"

namespace tissu {

/// Those of the connected parts of a body before an edit. Pieces that nothing joins exchange none.
class KeptMomenta {
 public:
  KeptMomenta(const World& world, const State& state, std::string_view body);
  /// Of a part before the edit, which it may have divided: what it lacks, and the rows that take it.
  struct Lack {
    Vec3 momentum = Vec3::Zero();
    Vec3 angular_momentum = Vec3::Zero();
    std::vector<std::int32_t> rows;
  };
  /// `world`, `state`: after the edit, in which rows were born. `around`: rows that take what their part
  /// lacks; a part that has none of these, but rows that were born, takes it as a whole.
  [[nodiscard]] std::vector<Lack> lacks(const World& world, const State& state, const RowsBorn& born,
                                        std::span<const std::int32_t> around) const;

 private:
  std::string_view body_;
  std::vector<std::int32_t> part_of_;  ///< each row; -1: of none
  std::vector<BodyTotals> before_;     ///< of each part
};

}  // namespace tissu
