#include "tissu/model/frames/frame_order.h"

#include <algorithm>
#include <bit>
#include <numeric>

namespace tissu {
namespace {

constexpr std::int32_t kLanes = FrameOrder::kLanes;
constexpr std::size_t kWorthPadding =
    4;  ///< points of the same frames fill a group of their own from here on

using Row = std::span<const std::int32_t>;

class Rows {
 public:
  Rows(std::span<const std::int32_t> frames, int k) : frames_(frames), k_(static_cast<std::size_t>(k)) {}
  [[nodiscard]] Row operator[](std::int32_t point) const {
    return frames_.subspan(static_cast<std::size_t>(point) * k_, k_);
  }
  [[nodiscard]] std::int32_t count() const { return static_cast<std::int32_t>(frames_.size() / k_); }

 private:
  std::span<const std::int32_t> frames_;
  std::size_t k_;
};

void add_group(std::span<const std::int32_t> points, bool shared, FrameOrder& order) {
  for (std::size_t lane = 0; lane < static_cast<std::size_t>(kLanes); ++lane) {
    order.point.push_back(points[std::min(lane, points.size() - 1)]);
    order.real.push_back(lane < points.size() ? 1 : 0);
  }
  order.shared.push_back(shared ? 1 : 0);
}

void lay_groups(const Rows& rows, FrameOrder& order) {
  std::vector<std::int32_t> sorted(static_cast<std::size_t>(rows.count()));
  std::iota(sorted.begin(), sorted.end(), 0);
  std::ranges::stable_sort(sorted, [&](std::int32_t a, std::int32_t b) {
    return std::ranges::lexicographical_compare(rows[a], rows[b]);
  });
  std::vector<std::int32_t> mixed;
  const auto flush = [&](std::size_t least) {
    while (mixed.size() >= least && !mixed.empty()) {
      const std::size_t some = std::min(mixed.size(), static_cast<std::size_t>(kLanes));
      add_group(std::span(mixed).first(some), false, order);
      mixed.erase(mixed.begin(), mixed.begin() + static_cast<std::ptrdiff_t>(some));
    }
  };
  for (std::size_t begin = 0, end = 0; begin < sorted.size(); begin = end) {
    end = begin + 1;
    while (end < sorted.size() && std::ranges::equal(rows[sorted[end]], rows[sorted[begin]])) ++end;
    std::size_t at = begin;
    for (; end - at >= kWorthPadding; at = std::min(end, at + static_cast<std::size_t>(kLanes))) {
      add_group(std::span(sorted).subspan(at, std::min(end - at, static_cast<std::size_t>(kLanes))), true,
                order);
    }
    mixed.insert(mixed.end(), sorted.begin() + static_cast<std::ptrdiff_t>(at),
                 sorted.begin() + static_cast<std::ptrdiff_t>(end));
    flush(static_cast<std::size_t>(kLanes));
  }
  flush(1);
}

/// The lowest colour that no chunk with a common frame has; 63 colours at most, then chunks stand alone.
void lay_chunks(const Rows& rows, std::int32_t count, FrameOrder& order) {
  std::vector<std::uint64_t> taken(static_cast<std::size_t>(count), 0);
  std::vector<FrameOrder::Range> chunks;
  std::vector<std::int32_t> colour;
  std::int32_t alone = 64;
  for (std::int32_t begin = 0; begin < order.groups(); begin += FrameOrder::kChunk) {
    const std::int32_t end = std::min(order.groups(), begin + FrameOrder::kChunk);
    const auto for_frames = [&](auto&& f) {
      for (std::int32_t i = begin * kLanes; i < end * kLanes; ++i) {
        for (const std::int32_t frame : rows[order.point[static_cast<std::size_t>(i)]])
          f(taken[static_cast<std::size_t>(frame)]);
      }
    };
    std::uint64_t used = 0;
    for_frames([&](std::uint64_t mask) { used |= mask; });
    const int free = std::countr_one(used);
    if (free < 64) for_frames([&](std::uint64_t& mask) { mask |= std::uint64_t{1} << free; });
    chunks.push_back({begin, end});
    colour.push_back(free < 64 ? free : alone++);
  }
  std::vector<std::size_t> index(chunks.size());
  std::iota(index.begin(), index.end(), std::size_t{0});
  std::ranges::stable_sort(index, {}, [&](std::size_t c) { return colour[c]; });
  order.colour_begin.assign(1, 0);
  for (std::size_t i = 0; i < index.size(); ++i) {
    if (i > 0 && colour[index[i]] != colour[index[i - 1]])
      order.colour_begin.push_back(static_cast<std::int32_t>(i));
    order.chunks.push_back(chunks[index[i]]);
  }
  order.colour_begin.push_back(static_cast<std::int32_t>(chunks.size()));
}

void lay_shares(const Rows& rows, int k, std::int32_t count, FrameOrder& order) {
  order.share_begin.assign(static_cast<std::size_t>(count) + 1, 0);
  const auto for_places = [&](auto&& f) {
    for (std::size_t i = 0; i < order.point.size(); ++i) {
      if (order.real[i] == 0) continue;
      const auto group = static_cast<std::int32_t>(i) / kLanes;
      const auto lane = static_cast<std::int32_t>(i) % kLanes;
      for (int a = 0; a < k; ++a)
        f(rows[order.point[i]][static_cast<std::size_t>(a)], (group * k + a) * kLanes + lane);
    }
  };
  for_places(
      [&](std::int32_t frame, std::int32_t) { ++order.share_begin[static_cast<std::size_t>(frame) + 1]; });
  std::partial_sum(order.share_begin.begin(), order.share_begin.end(), order.share_begin.begin());
  order.share.resize(static_cast<std::size_t>(order.share_begin.back()));
  std::vector<std::int64_t> next(order.share_begin.begin(), order.share_begin.end() - 1);
  for_places([&](std::int32_t frame, std::int32_t place) {
    order.share[static_cast<std::size_t>(next[static_cast<std::size_t>(frame)]++)] = place;
  });
}

}  // namespace

FrameOrder order_points(std::span<const std::int32_t> frames, int k, std::int32_t count) {
  const Rows rows(frames, k);
  FrameOrder order;
  lay_groups(rows, order);
  lay_chunks(rows, count, order);
  lay_shares(rows, k, count, order);
  return order;
}

}  // namespace tissu
