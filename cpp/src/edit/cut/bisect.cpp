#include "edit/cut/bisect.h"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

namespace tissu {
namespace {

constexpr int kRounds = 4;
constexpr double kLeastT = 1e-9;     ///< nearer to an end is the end, whatever t0 is
constexpr double kShortShare = 0.1;  ///< of the longest edge of the cell: shorter parts of edges stay whole

double rest_length(const Patch& patch, std::int32_t p, std::int32_t q) {
  return (patch.vertex(p).rest - patch.vertex(q).rest).norm();
}

class Divider {
 public:
  Divider(Patch& patch, const std::function<double(std::int32_t)>& t0, OnCut& known,
          const std::function<bool(std::int32_t)>& turned, int on)
      : patch_(patch), t0_(t0), known_(known), turned_(turned), on_(on) {}

  LeftEdges divide(std::vector<CrossedEdge> edges) {
    for (int round = 0; round < kRounds && !edges.empty(); ++round) edges = one_round(edges, round == 0);
    for (const CrossedEdge& edge : edges) {
      for (const std::int32_t t : patch_.around(edge.p, edge.q)) left_.folded.push_back(patch_.tetra(t).cell);
    }
    for (auto* list : {&left_.unsound, &left_.folded, &left_.merged}) {
      std::ranges::sort(*list);
      list->erase(std::ranges::unique(*list).begin(), list->end());
    }
    return std::move(left_);
  }

 private:
  /// An edge and which of its crossings is nearest to the middle.
  struct Choice {
    double rank;  ///< the longest first: the length at rest, negative; its own sign where turned
    bool turned;
    CrossedEdge edge;
    std::size_t which;
  };

  /// Divides edges, and returns the halves that are crossed again.
  std::vector<CrossedEdge> one_round(std::vector<CrossedEdge>& edges, bool first) {
    std::vector<Choice> choices;
    for (CrossedEdge& edge : edges) {
      const auto nearest = std::ranges::min_element(
          edge.crossings, {}, [](const BladeCrossing& crossing) { return std::abs(crossing.t - 0.5); });
      const auto which = static_cast<std::size_t>(nearest - edge.crossings.begin());
      if (goes_to_end(edge, *nearest)) continue;
      const double length = rest_length(patch_, edge.p, edge.q);
      const bool turned = is_turned(edge);
      choices.push_back({turned ? length : -length, turned, std::move(edge), which});
    }
    std::erase_if(choices, [&](const Choice& choice) {
      const int ends = (known_.on(choice.edge.p) ? 1 : 0) + (known_.on(choice.edge.q) ? 1 : 0);
      return ends > (first ? on_ : std::max(on_, 1));
    });
    std::ranges::sort(choices, [](const Choice& a, const Choice& b) {
      return std::tuple(a.turned, a.rank, a.edge.p, a.edge.q) <
             std::tuple(b.turned, b.rank, b.edge.p, b.edge.q);
    });
    std::vector<CrossedEdge> halves;
    for (const Choice& choice : choices) cross(choice, halves);
    return halves;
  }

  [[nodiscard]] bool is_turned(const CrossedEdge& edge) const {
    if (!turned_) return false;
    return std::ranges::any_of(patch_.around(edge.p, edge.q),
                               [&](std::int32_t t) { return turned_(patch_.tetra(t).cell); });
  }

  /// Whether the cut goes to an end of the edge, which is then on the cut, or the edge has to stay.
  bool goes_to_end(const CrossedEdge& edge, const BladeCrossing& nearest) {
    double share = kLeastT;
    bool sound = true;
    const std::vector<std::int32_t> around = patch_.around(edge.p, edge.q);
    for (const std::int32_t tetra : around) {
      const std::int32_t cell = patch_.tetra(tetra).cell;
      share = std::max(share, t0_(cell));
      sound = sound && patch_.cell(cell).sound;
    }
    if (is_short(patch_, edge.p, edge.q)) share = 0.5;
    const double t = nearest.t;
    if (t <= share || t >= 1.0 - share) {
      for (const BladeCrossing& crossing : edge.crossings) put_on_end(edge, crossing);  // all are that near
      const auto to_p = [](const BladeCrossing& crossing) { return crossing.t <= 0.5; };
      const auto of_p = std::ranges::count_if(edge.crossings, to_p);
      const bool merges = of_p > 1 || static_cast<std::ptrdiff_t>(edge.crossings.size()) - of_p > 1;
      if (!merges || is_short(patch_, edge.p, edge.q)) return true;
      for (const std::int32_t tetra : around) left_.merged.push_back(patch_.tetra(tetra).cell);
      return true;
    }
    if (sound) return false;
    for (const std::int32_t tetra : around) {
      const std::int32_t cell = patch_.tetra(tetra).cell;
      if (!patch_.cell(cell).sound) left_.unsound.push_back(cell);
    }
    return true;
  }

  void put_on_end(const CrossedEdge& edge, const BladeCrossing& crossing) {
    const Vec3& a = patch_.vertex(edge.p).place;
    const Vec3& b = patch_.vertex(edge.q).place;
    const bool to_p = crossing.t <= 0.5;
    known_.put_on(to_p ? edge.p : edge.q, to_p ? a : b, (1.0 - crossing.t) * a + crossing.t * b,
                  crossing.triangle);
  }

  void cross(const Choice& choice, std::vector<CrossedEdge>& halves) {
    const CrossedEdge& edge = choice.edge;
    const double t = edge.crossings[choice.which].t;
    const std::int32_t middle = patch_.divide(edge.p, edge.q, t);
    known_.vertices.resize(patch_.vertices.size());
    const Vec3& place = patch_.vertex(middle).place;
    known_.put_on(middle, place, place, edge.crossings[choice.which].triangle);
    CrossedEdge before{edge.p, middle, {}};
    CrossedEdge after{middle, edge.q, {}};
    for (std::size_t i = 0; i < edge.crossings.size(); ++i) {
      const auto& [at, direction, triangle] = edge.crossings[i];
      if (i < choice.which) before.crossings.push_back({at / t, direction, triangle});
      if (i > choice.which) after.crossings.push_back({(at - t) / (1.0 - t), direction, triangle});
    }
    if (!before.crossings.empty()) halves.push_back(std::move(before));
    if (!after.crossings.empty()) halves.push_back(std::move(after));
  }

  Patch& patch_;
  const std::function<double(std::int32_t)>& t0_;
  OnCut& known_;
  const std::function<bool(std::int32_t)>& turned_;
  int on_;
  LeftEdges left_;
};

}  // namespace

LeftEdges divide_crossed(Patch& patch, std::vector<CrossedEdge> edges,
                         const std::function<double(std::int32_t)>& t0, OnCut& known,
                         const std::function<bool(std::int32_t)>& turned, int on) {
  return Divider(patch, t0, known, turned, on).divide(std::move(edges));
}

bool is_short(const Patch& patch, std::int32_t p, std::int32_t q) {
  if (patch.vertex(p).number >= 0 && patch.vertex(q).number >= 0) return false;
  double size = 0.0;
  for (const std::int32_t t : patch.around(p, q)) {
    if (patch.tetra(t).corners() == 2) return false;
    size = std::max(size, patch.cell(patch.tetra(t).cell).size);
  }
  return rest_length(patch, p, q) < kShortShare * size;
}

void divide_longest(Patch& patch, std::int32_t tetra) {
  const auto& v = patch.tetra(tetra).vertices;
  std::tuple<double, std::int32_t, std::int32_t> longest{-1.0, 0, 0};
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t j = 0; j < i && v[i] >= 0; ++j) {
      const auto [p, q] = std::minmax(v[i], v[j]);
      longest = std::max(longest, {rest_length(patch, p, q), p, q});
    }
  }
  patch.divide(std::get<1>(longest), std::get<2>(longest), 0.5);
}

}  // namespace tissu
