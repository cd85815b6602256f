#include "contact/sweep_and_prune.h"

#include <algorithm>
#include <limits>

namespace tissu {
namespace {

constexpr std::int64_t kSwaps = 64;  ///< of an end, in the mean: more than these cost more than to sort anew

}  // namespace

SweepAndPrune::SweepAndPrune(const SearchPlan& plan) : meetings_(plan) {
  const std::size_t n = meetings_.searched().size();
  for (std::vector<End>& ends : ends_) {
    ends.reserve(2 * n);
    for (const std::int32_t p : meetings_.searched()) {
      ends.push_back({0.0F, static_cast<std::uint32_t>(p)});
      ends.push_back({0.0F, static_cast<std::uint32_t>(p) | 0x80000000U});
    }
  }
  merged_.resize(2 * n);
  open_.reserve(n);
  place_.resize(static_cast<std::size_t>(meetings_.primitive_count()));
}

void SweepAndPrune::find(std::span<const Box> boxes, std::vector<BoxPair>& pairs) {
  meetings_.check(boxes);
  begun_.clear();
  read(boxes);
  if (sweeps_ == 0 || !carry_order(boxes)) {
    for (std::vector<End>& ends : ends_) sort_anew(ends);
    begun_.clear();
    kept_.clear();
    sweep(boxes);
  }
  join(boxes, pairs);
}

void SweepAndPrune::read(std::span<const Box> boxes) {
  for (std::size_t k = 0; k < 3; ++k) {
    for (End& end : ends_[k]) {
      const Box& box = boxes[static_cast<std::size_t>(end.primitive())];
      end.value = end.is_high() ? box.high[k] : box.low[k];
    }
  }
}

/// False where the ends are so much out of order that the sorting was given up.
bool SweepAndPrune::carry_order(std::span<const Box> boxes) {
  swaps_ = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    if (!carry_order_along(k, boxes)) return false;
  }
  begun_.remove_repeated();  // found along several axes
  return true;
}

/// An insertion sort. It swaps two ends exactly if their order has changed.
bool SweepAndPrune::carry_order_along(std::size_t axis, std::span<const Box> boxes) {
  std::vector<End>& ends = ends_[axis];
  const std::int64_t most = swaps_ + kSwaps * static_cast<std::int64_t>(ends.size());
  for (std::size_t i = 1; i < ends.size(); ++i) {
    const End moved = ends[i];
    std::size_t to = i;
    for (; to > 0 && moved.before(ends[to - 1]); --to) {
      const End passed = ends[to - 1];
      ends[to] = passed;
      if (moved.is_high() || !passed.is_high()) continue;
      const std::int32_t p = moved.primitive();
      const std::int32_t q = passed.primitive();
      if (boxes[static_cast<std::size_t>(p)].overlaps(boxes[static_cast<std::size_t>(q)]) &&
          meetings_.meet(p, q)) {
        begun_.add(p, q);
      }
    }
    ends[to] = moved;
    swaps_ += static_cast<std::int64_t>(i - to);
    if (swaps_ > most) return false;
  }
  return true;
}

/// A merge sort, from runs of one upwards.
void SweepAndPrune::sort_anew(std::vector<End>& ends) {
  const auto before = [](const End& a, const End& b) { return a.before(b); };
  for (std::size_t run = 1; run < ends.size(); run *= 2) {
    for (std::size_t first = 0; first < ends.size(); first += 2 * run) {
      const std::size_t middle = std::min(first + run, ends.size());
      const std::size_t end = std::min(middle + run, ends.size());
      std::merge(ends.data() + first, ends.data() + middle, ends.data() + middle, ends.data() + end,
                 merged_.data() + first, before);
    }
    ends.swap(merged_);
  }
}

/// The axis along which a box covers the smallest share of the whole.
std::size_t SweepAndPrune::sparsest_axis(std::span<const Box> boxes, std::span<const std::int32_t> searched) {
  std::size_t sparsest = 0;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < 3; ++k) {
    double low = std::numeric_limits<double>::infinity();
    double high = -low;
    double sides = 0.0;
    for (const std::int32_t p : searched) {
      const auto from = static_cast<double>(boxes[static_cast<std::size_t>(p)].low[k]);
      const auto to = static_cast<double>(boxes[static_cast<std::size_t>(p)].high[k]);
      low = std::min(low, from);
      high = std::max(high, to);
      sides += to - from;
    }
    if (!(high > low) || sides / (high - low) >= least) continue;
    least = sides / (high - low);
    sparsest = k;
  }
  return sparsest;
}

/// Along one axis, past all ends: each box is tested against those that the sweep is inside of.
void SweepAndPrune::sweep(std::span<const Box> boxes) {
  ++sweeps_;
  open_.clear();
  for (const End& end : ends_[sparsest_axis(boxes, meetings_.searched())]) {
    const std::int32_t p = end.primitive();
    std::int32_t& place = place_[static_cast<std::size_t>(p)];
    if (end.is_high()) {
      place_[static_cast<std::size_t>(open_.back())] = place;
      open_[static_cast<std::size_t>(place)] = open_.back();
      open_.pop_back();
      continue;
    }
    const Box& box = boxes[static_cast<std::size_t>(p)];
    for (const std::int32_t q : open_) {
      if (box.overlaps(boxes[static_cast<std::size_t>(q)]) && meetings_.meet(p, q)) begun_.add(p, q);
    }
    place = static_cast<std::int32_t>(open_.size());
    open_.push_back(p);
  }
}

/// Pairs that still overlap, and those that begin to.
void SweepAndPrune::join(std::span<const Box> boxes, std::vector<BoxPair>& pairs) {
  sort_.sort(begun_.all(), meetings_.primitive_count(), begun_sorted_);
  const auto parted = [&](const BoxPair& pair) {
    return !boxes[static_cast<std::size_t>(pair.a)].overlaps(boxes[static_cast<std::size_t>(pair.b)]);
  };
  const auto kept_end = std::ranges::remove_if(kept_, parted).begin();
  pairs.resize(static_cast<std::size_t>((kept_end - kept_.begin()) + std::ssize(begun_sorted_)));
  std::merge(kept_.begin(), kept_end, begun_sorted_.begin(), begun_sorted_.end(), pairs.begin());
  kept_.assign(pairs.begin(), pairs.end());
}

std::size_t SweepAndPrune::bytes() const {
  std::size_t sum = meetings_.bytes() + merged_.capacity() * sizeof(End) + begun_.bytes() + sort_.bytes();
  for (const std::vector<End>& ends : ends_) sum += ends.capacity() * sizeof(End);
  sum += (open_.capacity() + place_.capacity()) * sizeof(std::int32_t);
  return sum + (kept_.capacity() + begun_sorted_.capacity()) * sizeof(BoxPair);
}

}  // namespace tissu
