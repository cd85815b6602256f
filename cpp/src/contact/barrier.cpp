#include "tissu/contact/barrier.h"

#include <algorithm>
#include <cmath>

#include "tissu/base/index.h"
#include "tissu/contact/penalty_law.h"

namespace tissu {
namespace {

constexpr double kLeast = 0.1;      ///< of the gap, beside the radii: d_m
constexpr double kUsual = 0.25;     ///< sigma at which the stiffness is k
constexpr double kSteepest = 1e-4;  ///< sigma below which b is a quadratic
constexpr double kSpeed = 1e-3;     ///< extents a second: slower sliding sticks
constexpr double kStiff = 3.0;      ///< times as stiff as the surfaces' mean node
constexpr double kNear = 1e-2;      ///< sigma below which contacts that stay there become …
constexpr double kNearGap = 0.6;    ///< … where surfaces rest at their gap, …
constexpr double kStiffer = 4.0;    ///< … by this stiffer, …
constexpr double kStiffest = 1e6;   ///< … no further than this

/// b, b' and b'' where it has them all.
BarrierValue plain_value(double sigma) {
  const double s = sigma - 1.0;
  const double log = std::log(sigma);
  return {-s * s * log, -2.0 * s * log - s * s / sigma,
          -2.0 * log - 4.0 * s / sigma + s * s / (sigma * sigma)};
}

/// Of the largest rigid body that unknowns move: the diagonal of its box at rest [m]. The extent of a scene
/// is that of its rows, which for such a body are a point.
double largest_carried(const SurfaceSet& surfaces) {
  double largest = 0.0;
  for (const auto& surface : surfaces.surfaces()) {
    if (surface.carrier < 0) continue;
    Box box = Box::none();
    double radius = 0.0;
    for (std::int32_t v = surface.first_vertex; v < surface.last_vertex; ++v) {
      box.add(block(ConstReals(surfaces.rest()), v));
      radius = std::max(radius, surfaces.vertices()[at(v)].radius);
    }
    box.grow(radius);
    const Vec3 sides(box.high[0] - box.low[0], box.high[1] - box.low[1], box.high[2] - box.low[2]);
    largest = std::max(largest, sides.norm());
  }
  return largest;
}

}  // namespace

BarrierValue barrier_value(double sigma) {
  if (sigma >= 1.0) return {};
  if (sigma >= kSteepest) return plain_value(sigma);
  const BarrierValue end = plain_value(kSteepest);
  const double more = sigma - kSteepest;
  return {end.energy + more * (end.slope + 0.5 * more * end.curvature), end.slope + more * end.curvature,
          end.curvature};
}

BarrierContact::BarrierContact(const Contact& contact, const FixedDofs& fixed, double extent)
    : ImplicitContact(contact, fixed), extent_(std::max(extent, largest_carried(contact.surfaces()))) {
  run_.take_every_pair();
  const std::size_t pairs = contact.description().pairs.size();
  stiffnesses_.assign(pairs, 0.0);
  stiffer_.assign(pairs, 1.0);
  nearest_.assign(pairs, 1.0);
  stays_.assign(pairs, 0);
}

void BarrierContact::begin_press() {
  energy_ = 0.0;
  std::ranges::fill(nearest_, 1.0);
}

bool BarrierContact::stiffen() {
  bool any = false;
  for (std::size_t k = 0; k < nearest_.size(); ++k) {
    const bool stays = stays_[k] != 0;
    stays_[k] = nearest_[k] < (rests_at_gap_ ? kNearGap : kNear) ? 1 : 0;
    if (!stays || stays_[k] == 0 || stiffer_[k] >= kStiffest) continue;
    stiffer_[k] *= kStiffer;
    stays_[k] = 0;
    any = true;
  }
  return any;
}

void BarrierContact::go_on_from(const ContactTable& before) {
  const auto normal_forces = [&](const auto& contacts) {
    std::vector<double> sums(stiffer_.size(), 0.0);
    for (std::size_t i = 0; i < contacts.size(); ++i) {
      const ContactNumbers& c = contacts[i];
      sums[static_cast<std::size_t>(c.pair)] += vector_of(c.normal).dot(vector_of(c.push));
    }
    return sums;
  };
  const std::vector<double> had = normal_forces(before);
  const std::vector<double> have = normal_forces(run_.acting());
  for (std::size_t k = 0; k < stiffer_.size(); ++k) {
    if (!(have[k] > 0.0 && had[k] > have[k])) continue;
    const double power = std::round(std::log(had[k] / have[k]) / std::log(kStiffer));
    stiffer_[k] = std::min(kStiffest, std::pow(kStiffer, power));
  }
}

/// The mean node's share of a compliance, of both sides.
void BarrierContact::set_matrix(std::span<const double> blocks, double scale, const ContactStage& stage) {
  ImplicitContact::set_matrix(blocks, scale, stage);
  const SurfaceSet& surfaces = contact_.surfaces();
  std::vector<double> compliances(surfaces.surfaces().size(), 0.0);
  std::vector<double> counts(compliances.size(), 0.0);
  const auto count = [&](std::int32_t row, std::int32_t surface) {
    if (row < 0) return;
    const double* A = blocks.data() + 9 * static_cast<std::ptrdiff_t>(row);
    const double trace = A[0] + A[4] + A[8];
    if (!(trace > 0.0)) return;
    compliances[at(surface)] += 3.0 / trace;
    counts[at(surface)] += 1.0;
  };
  for (const SurfaceVertex& vertex : surfaces.vertices()) count(vertex.row, vertex.surface);
  for (const auto& inner : surfaces.inner_rows()) count(inner.row, inner.surface);
  for (const auto& surface : surfaces.surfaces()) {
    if (surface.carrier < 0) continue;
    const auto number = static_cast<std::int32_t>(&surface - surfaces.surfaces().data());
    count(surfaces.carriers()[at(surface.carrier)].row, number);
  }
  for (std::size_t s = 0; s < counts.size(); ++s) compliances[s] /= std::max(1.0, counts[s]);
  for (std::size_t k = 0; k < stiffnesses_.size(); ++k) {
    const ContactPair& pair = contact_.description().pairs[k];
    const double sum = compliances[at(pair.a)] + (pair.b == pair.a ? 0.0 : compliances[at(pair.b)]);
    stiffnesses_[k] = sum > 0.0 ? kStiff / (sum * scale) : 0.0;
    stiffer_[k] = 1.0;
    stays_[k] = 0;
  }
}

bool BarrierContact::may_press(std::size_t i) const { return run_.gap(i) < pair_of(run_.looked()[i]).gap; }

std::optional<double> BarrierContact::press(std::size_t i, ContactNumbers& c) {
  const double range = rests_at_gap_ ? 0.0 : spring_range(contact_, c);
  const double gap = std::min(pair_of(c).gap, c.apart);
  const double least = c.apart - (1.0 - kLeast) * gap;
  const double d = c.apart + run_.gap(i);
  const double far = c.apart + range;
  const double whole = far * far - least * least;
  const double sigma = (d * d - least * least) / whole;
  if (!(sigma < 1.0)) return std::nullopt;
  const double usual = least * least + kUsual * whole;
  const auto pair = static_cast<std::size_t>(c.pair);
  const double k = stiffer_[pair] * stiffnesses_[pair];
  nearest_[pair] = std::min(nearest_[pair], sigma);
  const double B = run_.weight(i) * k * whole * whole / (4.0 * usual * barrier_value(kUsual).curvature);
  const BarrierValue b = barrier_value(sigma);
  energy_ += B * b.energy;
  const double force = -B * b.slope * 2.0 * d / whole;
  give(c, force, B * b.curvature * 4.0 * d * d / (whole * whole));
  c.drag = {};
  c.sliding = 0.0;
  return force;
}

void BarrierContact::rub(ContactNumbers& c, double /*bound*/, double /*k*/, double /*share*/) {
  const double F = pair_of(c).friction * c.force;
  const Vec3 n = vector_of(c.normal);
  Vec3 slid = run_.gone(c);
  slid -= n.dot(slid) * n;
  const double y = slid.norm();
  const double e = kSpeed * extent_ * (h() > 0.0 ? h() : 1.0);
  const bool slides = y >= e;
  energy_ += F * (slides ? y - e / 3.0 : y * y / e - y * y * y / (3.0 * e * e));
  const double along = slides ? 1.0 / y : 2.0 / e - y / (e * e);  // f1 / y
  const double steep = slides ? 0.0 : 2.0 / e - 2.0 * y / (e * e);
  Mat3 H = F * along * (Mat3::Identity() - n * n.transpose());
  if (y > 0.0) H += F * (steep - along) / (y * y) * slid * slid.transpose();
  c.sliding = slides ? 1.0 : 0.0;
  c.drag = numbers_of(-F * along * slid);
  add(c, vector_of(c.drag), H);
}

double BarrierContact::lag() {
  double change = 0.0;
  double size = 0.0;
  for (ContactNumbers& c : run_.acting()) {
    const double force = vector_of(c.normal).dot(vector_of(c.push));
    change += pair_of(c).friction * std::abs(force - c.force);
    size += pair_of(c).friction * force;
    c.force = force;
  }
  return size > 0.0 ? change / size : 0.0;
}

}  // namespace tissu
