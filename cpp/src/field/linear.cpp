#include <algorithm>
#include <array>
#include <limits>

#include "shape_row.h"
#include "simplex.h"

/// Barycentric coordinates of a simplex of frames near the point: a tetrahedron, or a triangle or segment
/// where all frames lie in one plane or on one line; a point outside that plane or line has the weights of
/// its projection. The nearest frame is always a corner, so that a frame has its own weight alone; of the
/// others, taken from the kCandidates nearest, the first well-shaped simplex that contains the point, else
/// the one that leaves it outside least.

namespace tissu {
namespace {

constexpr int kCandidates = 12;
constexpr int kMoreCandidates = 24;  ///< where all simplices of the first are flat
constexpr double kWellShaped = 0.4;
constexpr double kFlattest = 0.02;
constexpr double kInside = 1.0 + 1e-9;
constexpr double kMostExcess = 100.0;  ///< sum |w_i| of an extrapolation

using Choice = std::array<int, 3>;  ///< candidates beside the nearest; ascending, the last is the farthest

/// All choices of `size` of the candidates 1 .. kMoreCandidates - 1, those of the nearer candidates first.
std::vector<Choice> choices(int size) {
  std::vector<Choice> all{{0, 0, 0}};
  for (int chosen = 0; chosen < size; ++chosen) {
    std::vector<Choice> longer;
    const auto n = static_cast<std::size_t>(chosen);
    for (const Choice& choice : all) {
      for (int next = n == 0 ? 1 : choice[n - 1] + 1; next < kMoreCandidates; ++next) {
        longer.push_back(choice);
        longer.back()[n] = next;
      }
    }
    all = std::move(longer);
  }
  std::ranges::stable_sort(all, {}, [&](const Choice& c) { return *std::ranges::max_element(c); });
  return all;
}

int farthest(const Choice& choice) { return *std::ranges::max_element(choice); }

class Linear final : public ShapeFunction {
 public:
  explicit Linear(const ShapeRequest& request)
      : frames_(request.frames),
        nearest_(request.nearest),
        span_(affine_span(Eigen::Map<const Eigen::Matrix3Xd>(frames_.data(), 3, nearest_.count()))),
        choices_(choices(span_.dimension)) {
    constexpr std::array<std::string_view, 4> kBecause{"there is one frame", "its frames lie on one line",
                                                       "its frames lie in one plane",
                                                       "its corners are those of a tetrahedron"};
    check_implied_neighbours(request, neighbours(), kBecause[static_cast<std::size_t>(span_.dimension)]);
  }
  [[nodiscard]] int neighbours() const override { return span_.dimension + 1; }
  [[nodiscard]] std::string fill(const Vec3& x, ShapeRow& row) override;

 private:
  struct Best {
    Simplex simplex;
    Choice choice{};
    double score = std::numeric_limits<double>::infinity();  ///< excess, more where the shape is poor
    [[nodiscard]] bool inside() const { return score <= kInside; }
  };
  [[nodiscard]] Best best_of(const Vec3& x, int candidates);
  [[nodiscard]] std::array<Vec3, 4> corners(const Choice& choice) const;

  ConstReals frames_;
  const Nearest& nearest_;
  AffineSpan span_;
  std::vector<Choice> choices_;
  std::vector<Nearest::Found> found_;
};

std::array<Vec3, 4> Linear::corners(const Choice& choice) const {
  std::array<Vec3, 4> x{block(frames_, found_[0].number), Vec3::Zero(), Vec3::Zero(), Vec3::Zero()};
  for (std::size_t i = 0; i < static_cast<std::size_t>(span_.dimension); ++i) {
    x[i + 1] = block(frames_, found_[static_cast<std::size_t>(choice[i])].number);
  }
  return x;
}

Linear::Best Linear::best_of(const Vec3& x, int candidates) {
  nearest_.find(x, candidates, found_);
  const auto count = static_cast<int>(found_.size());
  Best best;
  for (const Choice& choice : choices_) {
    const int last = farthest(choice);
    if (last >= count || (best.inside() && last > farthest(best.choice))) break;
    const Simplex simplex = barycentric(span_, corners(choice), x);
    if (simplex.quality < kFlattest) continue;
    const double score = simplex.excess * std::max(1.0, kWellShaped / simplex.quality);
    const bool both_inside = best.inside() && score <= kInside;
    if (both_inside ? simplex.quality > best.simplex.quality : score < best.score) {
      best = {simplex, choice, score};
    }
  }
  return best;
}

std::string Linear::fill(const Vec3& x, ShapeRow& row) {
  Best best = best_of(x, kCandidates);
  if (best.simplex.quality == 0.0 && nearest_.count() > kCandidates) best = best_of(x, kMoreCandidates);
  if (best.simplex.quality == 0.0) {
    return "has near frames that are in one plane or on one line, though the frames as a whole are not; "
           "move or add frames there, or take another shape function";
  }
  if (best.simplex.excess > kMostExcess) {
    return "lies far outside of its frames, so that their weights would exceed " +
           std::to_string(static_cast<int>(kMostExcess)) + "; add frames around it";
  }
  row.frames[0] = found_[0].number;
  for (std::size_t i = 0; i < row.weights.size(); ++i) {
    if (i > 0) row.frames[i] = found_[static_cast<std::size_t>(best.choice[i - 1])].number;
    row.weights[i] = best.simplex.weights[i];
    row.gradients[i] = best.simplex.gradients[i];
  }
  return {};
}

}  // namespace

std::unique_ptr<ShapeFunction> make_linear(const ShapeRequest& request) {
  return std::make_unique<Linear>(request);
}

}  // namespace tissu
