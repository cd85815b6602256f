#pragma once

/// Heaps of triangles without order, many of them without area, and what testing every pair of them finds.

#include <vector>

#include "contact/narrow.h"
#include "tissu/contact/candidates.h"

namespace tissu::test {

/// 200 triangles in two bodies, beside twenty pieces of lines and ten points. All meet all.
struct Soup {
  static constexpr int kTimes = 3;

  ContactDescription description;
  std::vector<std::int32_t> first_row;
  std::vector<std::vector<double>> places;  ///< of all rows: at rest, then as the soup is stirred
};

/// The same one for the same number.
Soup soup(unsigned number);

/// Every pair of features that a list of candidates may hold, by testing all with all; a pair is left out
/// where spheres around its features are farther apart than the pair reaches at any of these two places.
std::vector<Candidate> every_candidate(const Soup& soup, const SurfaceSet& surfaces, ConstReals from,
                                       ConstReals to);

/// Contacts of a list at these places, as a step looks for them, in the order of their keys. `is_far` says
/// which of the list are not looked at.
template <class IsFar>
std::vector<Found> contacts_of(const Soup& soup, const SurfaceSet& surfaces,
                               const std::vector<Candidate>& list, ConstReals places, const IsFar& is_far) {
  std::vector<Found> all;
  Found found{};
  for (std::size_t i = 0; i < list.size(); ++i) {
    const ContactPair& pair = soup.description.pairs[static_cast<std::size_t>(list[i].pair)];
    const double reach = list[i].apart + pair.gap;
    if (is_far(i, reach)) continue;
    if (find_contact(surfaces, places, list[i], reach, found)) all.push_back(found);
  }
  const auto key = [](const Found& f) { return std::tuple(f.kind, f.a, f.b); };
  std::ranges::sort(all, {}, key);
  return all;
}

/// Whether two contacts are the same, to the bit.
bool same(const Found& one, const Found& other);

/// Which soups a test takes: the first `few`, or what TISSU_SOUPS says, as in 0-10000.
struct SoupRange {
  explicit SoupRange(unsigned few);
  unsigned first;
  unsigned end;
};

}  // namespace tissu::test
