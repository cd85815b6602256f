#include "contact/meetings.h"

#include <algorithm>
#include <limits>
#include <string>
#include <tuple>

#include "tissu/base/error.h"
#include "tissu/base/number_text.h"

namespace tissu {
namespace {

std::string text(const Box& box) {
  std::string out;
  for (std::size_t k = 0; k < 3; ++k) {
    out += (k == 0 ? "[" : ", [") + number_text(box.low[k]) + ", " + number_text(box.high[k]) + "]";
  }
  return out;
}

/// False for NaN too.
bool is_finite(const Box& box) {
  constexpr float largest = std::numeric_limits<float>::max();
  bool good = true;
  for (std::size_t k = 0; k < 3; ++k) {
    good = good && box.low[k] <= box.high[k] && box.low[k] >= -largest && box.high[k] <= largest;
  }
  return good;
}

void check_first(const std::vector<std::int32_t>& first) {
  if (first.front() != 0 || !std::ranges::is_sorted(first)) {
    throw ParameterError("found first primitives of surfaces that begin with " +
                         std::to_string(first.front()) +
                         " or descend; numbers that begin with 0 and do not descend are accepted.");
  }
}

}  // namespace

Meetings::Meetings(const SearchPlan& plan) : first_(plan.first), meetings_(plan.meetings), only_one_(false) {
  if (first_.empty()) first_.push_back(0);
  check_first(first_);
  const std::int32_t surfaces = surface_count();
  for (SearchPlan::Meeting& meeting : meetings_) {
    if (std::min(meeting.a, meeting.b) < 0 || std::max(meeting.a, meeting.b) >= surfaces) {
      throw ParameterError("found a meeting of surfaces " + std::to_string(meeting.a) + " and " +
                           std::to_string(meeting.b) + "; numbers from 0 to below " +
                           std::to_string(surfaces) + " are accepted.");
    }
    if (meeting.b < meeting.a) std::swap(meeting.a, meeting.b);
  }
  const auto key = [](const SearchPlan::Meeting& m) { return std::tuple(m.a, m.b); };
  std::ranges::sort(meetings_, {}, key);
  const auto twice = std::ranges::unique(meetings_, {}, key);
  meetings_.erase(twice.begin(), twice.end());
  fill_rows();
  fill_searched();
  only_one_ = meetings_.size() == 1 && meetings_[0].a == meetings_[0].b;
}

void Meetings::fill_rows() {
  std::vector<std::tuple<std::int32_t, std::int32_t>> both;
  for (const SearchPlan::Meeting& m : meetings_) {
    both.emplace_back(m.a, m.b);
    if (m.a != m.b) both.emplace_back(m.b, m.a);
  }
  std::ranges::sort(both);
  row_.assign(static_cast<std::size_t>(surface_count()) + 1, 0);
  for (const auto& [a, b] : both) {
    ++row_[static_cast<std::size_t>(a) + 1];
    met_.push_back(b);
  }
  for (std::size_t s = 0; s + 1 < row_.size(); ++s) row_[s + 1] += row_[s];
}

void Meetings::fill_searched() {
  surface_of_.resize(static_cast<std::size_t>(primitive_count()));
  first_searched_.push_back(0);
  for (std::int32_t s = 0; s < surface_count(); ++s) {
    for (std::int32_t p = first(s); p < first(s + 1); ++p) {
      surface_of_[static_cast<std::size_t>(p)] = s;
      if (has_meeting(s)) searched_.push_back(p);
    }
    first_searched_.push_back(static_cast<std::int32_t>(searched_.size()));
  }
}

void Meetings::check(std::span<const Box> boxes) const {
  if (boxes.size() != static_cast<std::size_t>(primitive_count())) {
    throw ParameterError("found " + std::to_string(boxes.size()) +
                         " boxes; one for each of the plan's primitives, " +
                         std::to_string(primitive_count()) + ", is accepted.");
  }
  bool good = true;
  for (const Box& box : boxes) good &= is_finite(box);
  if (good) return;
  const auto bad = std::ranges::find_if_not(boxes, is_finite);
  throw ParameterError("found the box " + text(*bad) + " of primitive " +
                       std::to_string(bad - boxes.begin()) +
                       "; finite numbers, the lower one first, are accepted.");
}

bool Meetings::surfaces_meet(std::int32_t a, std::int32_t b) const {
  const auto begin = met_.begin() + row_[static_cast<std::size_t>(a)];
  const auto end = met_.begin() + row_[static_cast<std::size_t>(a) + 1];
  return std::binary_search(begin, end, b);
}

std::size_t Meetings::bytes() const {
  return meetings_.capacity() * sizeof(SearchPlan::Meeting) +
         (first_.capacity() + row_.capacity() + met_.capacity() + surface_of_.capacity() +
          searched_.capacity() + first_searched_.capacity()) *
             sizeof(std::int32_t);
}

}  // namespace tissu
