#pragma once

/// The second of the two phases of detection: which candidates are contacts.

#include <array>

#include "tissu/contact/candidates.h"
#include "tissu/contact/surface_set.h"

namespace tissu {

/// A contact between the parts that are nearest: a vertex and the inside of a face, of an edge, or a vertex;
/// two edges inside both.
struct Found {
  PairKind kind;
  std::int32_t a;
  std::int32_t b;
  std::array<std::int32_t, 4> vertex;
  std::array<double, 4> beta;
  Vec3 r;
  double distance;
  double weight;  ///< below 1 for edges that are nearly parallel
  double area;    ///< [m2]
};

/// Whether a candidate is a contact at these places, no farther apart than `reach`. Each contact is found
/// once (Chen et al. 2025, ACM Transactions on Graphics 44(4), Offset Geometric Contact): a vertex meets the
/// inside of a face that it projects into; an edge only where it lies before none of the faces beside it; a
/// vertex only where it lies before none of its edges. Closed surfaces are met from outside only.
bool find_contact(const SurfaceSet& surfaces, ConstReals places, const Candidate& candidate, double reach,
                  Found& found);

/// By how much the contact of two edges counts: 1, and less where they are nearly parallel, for there the
/// places where they are nearest jump; their ends carry such contacts. 0 where nothing is left.
double weight_of_edges(const SurfaceSet& surfaces, ConstReals places, std::int32_t e, std::int32_t f);

}  // namespace tissu
