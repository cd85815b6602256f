#include "operations.h"

#include "tissu/law/generated/all.h"

namespace tissu::bench {
namespace {

double counted = 0.0;

/// A number that only counts what is done with it.
struct Tally {
  Tally() = default;
  explicit Tally(double /*value*/) {}
};
Tally after(double operations) {
  counted += operations;
  return {};
}
Tally operator+(Tally, Tally) { return after(1.0); }
Tally operator-(Tally, Tally) { return after(1.0); }
Tally operator*(Tally, Tally) { return after(1.0); }
Tally operator/(Tally, Tally) { return after(1.0); }
Tally operator-(Tally) { return {}; }
[[maybe_unused]] Tally sqrt(Tally) { return after(1.0); }
Tally positive(Tally) { return {}; }
Tally step(Tally) { return {}; }
// As batch_math.h has them.
Tally log(Tally) { return after(32.0); }
Tally exp(Tally) { return after(39.0); }
Tally cbrt(Tally) { return after(46.0); }

template <class Function>
double count(Function&& f) {
  counted = 0.0;
  f();
  return counted;
}

double cost(double factor) { return factor == 0.0 ? 0.0 : factor * factor == 1.0 ? 1.0 : 2.0; }

template <class Law, int M>
LawOperations count_law() {
  const Law made{};
  const Columns<Tally, M> F{};
  return {count([&] { (void)made.stress(F); }), count([&] { (void)made.stress_change(F, F); }),
          count([&] { (void)made.tangent(F); })};
}

template <int M, class List>
std::optional<LawOperations> find_law_count(std::string_view name) {
  std::optional<LawOperations> found;
  List::for_each([&](auto tag) {
    using Law = typename decltype(tag)::template Of<Tally>;
    if (Law::kName == name) found = count_law<Law, M>();
  });
  return found;
}

}  // namespace

std::string_view name(Job job) {
  return job == Job::force ? "force" : job == Job::product ? "product" : "assembly";
}

std::optional<LawOperations> law_operations(std::string_view law, int dimension) {
  switch (dimension) {
    case 3:
      return find_law_count<3, AllLaws>(law);
    case 2:
      return find_law_count<2, ThinLaws>(law);
    default:
      return find_law_count<1, ThinLaws>(law);
  }
}

double operations(const ReferenceCell& cell, bool affine, const LawOperations& law, Job job) {
  const double m = cell.dimension;
  const double n = affine ? cell.nodes - 1 : cell.nodes;
  double sum = job == Job::assembly && affine ? 9.0 * (n * n + n) : 0.0;
  for (const ReferenceCell::Point& point : cell.points) {
    double c = 0.0;
    for (const auto& gradient : point.gradients) {
      for (const double entry : gradient) c += cost(entry);
    }
    const double gradient = 3.0 * c + 6.0 * m * m;
    const double spread = gradient + 3.0 * m;
    if (job == Job::force) sum += gradient + law.stress + spread;
    if (job == Job::product) sum += 2.0 * gradient + law.stress_change + spread;
    if (job == Job::assembly) {
      sum += gradient + law.tangent + 3.0 * m * (3.0 * m + 1.0) / 2.0 + m * c;
      sum += 18.0 * m * m * n + 9.0 * m * n * (n + 1.0);
    }
  }
  return sum;
}

}  // namespace tissu::bench
