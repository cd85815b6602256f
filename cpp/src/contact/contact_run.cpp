#include "tissu/contact/contact_run.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <tuple>

#include "hold_back.h"
#include "narrow.h"
#include "nearest_pair.h"
#include "push_ahead.h"
#include "tissu/base/norm.h"
#include "tissu/contact/candidates.h"

namespace tissu {
namespace {

constexpr double kStiff = 3.0;  ///< s: couplings over the block diagonal of the matrix

std::size_t at(std::int32_t i) { return static_cast<std::size_t>(i); }
std::array<double, 3> numbers_of(const Vec3& v) { return {v.x(), v.y(), v.z()}; }

std::tuple<double, double, double> key_of(const ContactNumbers& c) { return {c.kind, c.a, c.b}; }

bool is_of_vertex(const ContactNumbers& c) {
  return c.kind != ContactNumbers::kPlane && c.kind != static_cast<double>(PairKind::edge_edge);
}

void set_stiffness(ContactNumbers& contact, const Mat3& H) {
  contact.stiffness = {H(0, 0), H(1, 1), H(2, 2), H(1, 2), H(0, 2), H(0, 1)};
}

}  // namespace

ContactRun::ContactRun(const Contact& contact, const FixedDofs& fixed) : contact_(contact), fixed_(fixed) {
  const auto& vertices = contact.surfaces().vertices();
  for (const SurfaceVertex& vertex : vertices) {
    const bool given = vertex.row < 0 || fixed.masks()[at(vertex.row)] == FixedDofs::kAllAxes;
    given_.push_back(given ? 1 : 0);
  }
  candidates_ = std::make_unique<Candidates>(contact.description(), contact.surfaces());
  held_ = std::make_unique<HoldBack>(contact.surfaces(), given_);
  ahead_ = std::make_unique<PushAhead>(contact, given_);
  begin_.resize(3 * vertices.size());
  from_ = now_ = begin_;
  counts_.assign(fixed.masks().size(), 0);
  forces_.assign(3 * fixed.masks().size(), 0.0);
}

ContactRun::~ContactRun() = default;

std::int32_t ContactRun::row(double vertex) const {
  return vertex < 0.0 ? -1 : contact_.surfaces().vertices()[static_cast<std::size_t>(vertex)].row;
}

/// r of a contact, of vertices at these places.
Vec3 ContactRun::reach(const ContactNumbers& contact, ConstReals places) const {
  Vec3 r = Vec3::Zero();
  for (std::size_t k = 0; k < 4; ++k) {
    if (contact.vertex[k] >= 0.0) {
      r += contact.beta[k] * block(places, static_cast<std::int32_t>(contact.vertex[k]));
    }
  }
  return r;
}

void ContactRun::begin(const State& start, double end, ConstReals led) {
  start_ = &start;
  end_ = end;
  const ContactTable before = contact_.table(start);
  contacts_.resize(before.size());
  for (std::size_t i = 0; i < before.size(); ++i) contacts_[i] = before[i];
  contact_.place_vertices(start, start.time, begin_);
  from_ = begin_;
  ahead_->push({start, start.time, end, led}, *candidates_, from_, planes_);
  now_ = from_;
}

void ContactRun::set_matrix(std::span<const double> blocks, double scale) {
  blocks_ = blocks;
  scale_ = scale;
}

/// Rows where `state` has them, obstacles where they are at the end of the step.
void ContactRun::gather(const State& state, std::vector<double>& places) const {
  const auto& vertices = contact_.surfaces().vertices();
  for (std::size_t v = 0; v < vertices.size(); ++v) {
    const auto number = static_cast<std::int32_t>(v);
    block(Reals(places), number) = vertices[v].row >= 0
                                       ? Vec3(block(ConstReals(state.positions), vertices[v].row))
                                       : Vec3(block(ConstReals(from_), number));
  }
}

int ContactRun::hold_back(State& to) {
  gather(to, now_);
  goal_ = now_;
  candidates_->cover(from_, now_);
  if (!contact_.description().travel) return 0;
  if (!held_->find(*candidates_, planes_, from_, now_)) return 0;
  int rows = 0;
  const auto& vertices = contact_.surfaces().vertices();
  for (std::size_t v = 0; v < vertices.size(); ++v) {
    const auto number = static_cast<std::int32_t>(v);
    if (given_[v] != 0) continue;
    const double share = held_->share(number);
    if (share == 1.0) continue;
    ++rows;
    const Vec3 from = block(ConstReals(from_), number);
    block(Reals(to.positions), vertices[v].row) = from + share * (block(ConstReals(now_), number) - from);
  }
  return rows;
}

double ContactRun::look(const State& at) {
  gather(at, now_);
  candidates_->cover(from_, now_);
  find();
  keep_multipliers();
  hand_over();
  stiffen();
  press();
  return change();
}

/// |change of the forces on rows| / |forces|, from those of the latest solve to those of the latest look.
double ContactRun::change() {
  std::ranges::fill(forces_, 0.0);
  const auto scatter = [&](const ContactNumbers& c, const Vec3& force) {
    for (std::size_t k = 0; k < 4; ++k) {
      const std::int32_t i = row(c.vertex[k]);
      if (i >= 0) block(Reals(forces_), i) += c.beta[k] * force;
    }
  };
  double size = 0.0;
  double other = 0.0;
  for (const ContactNumbers& c : contacts_) {
    const Vec3 force = c.force * vector_of(c.normal) + vector_of(c.drag);
    size += force.squaredNorm();
    scatter(c, -force);
  }
  for (const ContactNumbers& c : looked_) {
    other += vector_of(c.push).squaredNorm();
    scatter(c, vector_of(c.push));
  }
  const double largest = std::sqrt(std::max(size, other));
  return largest > 0.0 ? norm(forces_) / largest : 0.0;
}

/// Whether the latest contacts have one of this key, which acts.
const ContactNumbers* ContactRun::acting(const ContactNumbers& c) const {
  const auto found = std::ranges::lower_bound(order_, key_of(c), {},
                                              [&](std::int32_t i) { return key_of(contacts_[at(i)]); });
  if (found == order_.end() || !contacts_[at(*found)].same_key(c)) return nullptr;
  return &contacts_[at(*found)];
}

/// The nearest points inside both parts of a candidate, whatever the narrow phase's rules say of them.
bool ContactRun::find_plainly(const Candidate& candidate, double reach, Found& found) const {
  std::array<Vec3, 4> p{};
  for (int i = 0; i < vertices_of(candidate.kind); ++i) {
    p[at(i)] = block(ConstReals(now_), candidate.vertex[at(i)]);
  }
  const Closest closest = nearest_of(candidate.kind, p);
  if (!(closest.square < reach * reach) || !(closest.square > 0.0)) return false;
  // The ends of edges and the corners and edges of faces are parts of their own.
  const auto count = static_cast<std::size_t>(vertices_of(candidate.kind));
  if (std::any_of(closest.beta.begin(), closest.beta.begin() + count, [](double b) { return b == 0.0; })) {
    return false;
  }
  double weight = 1.0;
  if (candidate.kind == PairKind::edge_edge) {
    weight = weight_of_edges(contact_.surfaces(), now_, candidate.a, candidate.b);
  }
  found = {candidate.kind,
           candidate.a,
           candidate.b,
           candidate.vertex,
           closest.beta,
           closest.r,
           std::sqrt(closest.square),
           weight,
           0.0};
  return weight > 0.0;
}

void ContactRun::find() {
  looked_.clear();
  gaps_.clear();
  weights_.clear();
  predicted_.clear();
  order_.resize(contacts_.size());
  std::iota(order_.begin(), order_.end(), 0);
  std::ranges::sort(order_, {}, [&](std::int32_t i) { return key_of(contacts_[at(i)]); });
  find_pairs();
  find_planes();
}

/// Beside what the narrow phase finds, pairs that stopped a way, and pairs that act already: the linear
/// answer would lead through them.
void ContactRun::find_pairs() {
  const auto& vertices = contact_.surfaces().vertices();
  const auto& pairs = contact_.description().pairs;
  Found found{};
  auto stopped = held_->stopped().begin();
  for (std::size_t i = 0; i < candidates_->list().size(); ++i) {
    const Candidate& candidate = candidates_->list()[i];
    double reach = candidate.apart + pairs[at(candidate.pair)].gap;
    const bool stops = stopped != held_->stopped().end() && at(*stopped) == i;
    if (stops) {
      reach = std::numeric_limits<double>::infinity();
      ++stopped;
    }
    if (candidates_->is_far(i, reach)) continue;
    ContactNumbers c;
    if (!find_contact(contact_.surfaces(), now_, candidate, reach, found)) {
      c.kind = static_cast<double>(candidate.kind);
      c.a = candidate.a;
      c.b = candidate.b;
      if (!(stops || acting(c) != nullptr) || !find_plainly(candidate, reach, found)) continue;
    }
    c.kind = static_cast<double>(found.kind);
    c.a = found.a;
    c.b = found.b;
    c.pair = candidate.pair;
    Vec3 fixed = Vec3::Zero();
    for (std::size_t k = 0; k < 4; ++k) {
      c.vertex[k] = found.vertex[k];
      c.beta[k] = found.vertex[k] < 0 ? 0.0 : found.beta[k];
      if (found.vertex[k] < 0 || vertices[at(found.vertex[k])].row >= 0) continue;
      fixed += c.beta[k] * block(ConstReals(now_), found.vertex[k]);
    }
    c.fixed = numbers_of(fixed);
    c.normal = numbers_of(found.r / found.distance);
    c.place = numbers_of(found.r);
    c.apart = candidate.apart;
    c.area = found.area;
    looked_.push_back(c);
    predicted_.push_back(vector_of(c.normal).dot(this->reach(c, goal_)) < candidate.apart ? 1 : 0);
    gaps_.push_back(found.distance - candidate.apart);
    weights_.push_back(found.weight);
  }
}

void ContactRun::find_planes() {
  const auto& vertices = contact_.surfaces().vertices();
  const auto& pairs = contact_.description().pairs;
  for (const PlaneCandidate& candidate : candidates_->planes()) {
    const PlacedPlane& plane = planes_[at(candidate.obstacle)];
    const Vec3 place = block(ConstReals(now_), candidate.vertex);
    const double distance = plane.normal.dot(place - plane.point);
    const double goal = plane.normal.dot(block(ConstReals(goal_), candidate.vertex) - plane.point);
    if (!(std::min(distance, goal) < candidate.apart + pairs[at(candidate.pair)].gap)) continue;
    ContactNumbers c;
    c.kind = ContactNumbers::kPlane;
    c.a = candidate.vertex;
    c.b = candidate.obstacle;
    c.pair = candidate.pair;
    c.vertex[0] = candidate.vertex;
    c.beta[0] = 1.0;
    const Vec3 r = distance * plane.normal;
    c.fixed = numbers_of(r - place);
    c.normal = numbers_of(plane.normal);
    c.place = numbers_of(r);
    c.apart = candidate.apart;
    c.area = vertices[at(candidate.vertex)].area;
    looked_.push_back(c);
    predicted_.push_back(goal < candidate.apart ? 1 : 0);
    gaps_.push_back(distance - candidate.apart);
    weights_.push_back(1.0);
  }
}

void ContactRun::keep_multipliers() {
  for (ContactNumbers& c : looked_) {
    const ContactNumbers* found = acting(c);
    if (found == nullptr) continue;
    const ContactNumbers& before = *found;
    c.force = before.force;
    c.sliding = before.sliding;
    const Vec3 n = vector_of(c.normal);
    const Vec3 drag = vector_of(before.drag);
    c.drag = numbers_of(drag - n.dot(drag) * n);
  }
}

/// A vertex that slid to the next face hands its multiplier on.
void ContactRun::hand_over() {
  const auto& vertices = contact_.surfaces().vertices();
  const auto other_surface = [&](const ContactNumbers& c) {
    return vertices[static_cast<std::size_t>(c.vertex[1])].surface;
  };
  for (const ContactNumbers& before : contacts_) {
    if (!is_of_vertex(before) || !(before.force > 0.0)) continue;
    const auto is_heir = [&](const ContactNumbers& c) {
      return is_of_vertex(c) && c.a == before.a && other_surface(c) == other_surface(before);
    };
    const bool lives =
        std::ranges::any_of(looked_, [&](const ContactNumbers& c) { return c.same_key(before); });
    const auto heirs = std::ranges::count_if(looked_, is_heir);
    if (lives || heirs == 0) continue;
    const double share = 1.0 / static_cast<double>(heirs);
    for (ContactNumbers& c : looked_) {
      if (!is_heir(c)) continue;
      c.force += share * before.force;
      const Vec3 n = vector_of(c.normal);
      const Vec3 drag = vector_of(before.drag);
      c.drag = numbers_of(vector_of(c.drag) + share * (drag - n.dot(drag) * n));
    }
  }
}

/// sum_r N_r beta_r^2 A_rr^-1, without given degrees of freedom.
Mat3 ContactRun::compliance(const ContactNumbers& contact) const {
  Mat3 sum = Mat3::Zero();
  for (std::size_t k = 0; k < 4; ++k) {
    const std::int32_t i = row(contact.vertex[k]);
    if (i < 0 || contact.beta[k] == 0.0) continue;
    const Eigen::Map<const Mat3> A(blocks_.data() + 9 * static_cast<std::ptrdiff_t>(i));
    Mat3 inverse = A.inverse();
    for (int axis = 0; axis < 3; ++axis) {
      if (((fixed_.masks()[at(i)] >> axis) & 1) == 0) continue;
      inverse.row(axis).setZero();
      inverse.col(axis).setZero();
    }
    sum += counts_[at(i)] * contact.beta[k] * contact.beta[k] * inverse;
  }
  return sum;
}

void ContactRun::stiffen() {
  const auto for_rows = [&](auto&& f) {
    for (std::size_t i = 0; i < looked_.size(); ++i) {
      if (!may_press(i)) continue;
      for (std::size_t k = 0; k < 4; ++k) {
        const std::int32_t r = row(looked_[i].vertex[k]);
        if (r >= 0 && looked_[i].beta[k] != 0.0) f(counts_[at(r)]);
      }
    }
  };
  for_rows([](std::int32_t& count) { count = 0; });
  for_rows([](std::int32_t& count) { ++count; });
  stiffnesses_.assign(looked_.size(), 0.0);
  for (std::size_t i = 0; i < looked_.size(); ++i) {
    if (!may_press(i)) continue;
    const double largest = compliance(looked_[i]).cwiseAbs().rowwise().sum().maxCoeff();
    if (largest > 0.0) stiffnesses_[i] = kStiff * weights_[i] / (largest * scale_);
  }
}

/// Forces and stiffnesses at the places that were looked at; what does not press is dropped.
void ContactRun::press() {
  std::size_t kept = 0;
  depth_ = 0.0;
  for (std::size_t i = 0; i < looked_.size(); ++i) {
    const double k = stiffnesses_[i];
    const double t = looked_[i].force - k * gaps_[i];
    if (k == 0.0 || !(t > 0.0 || predicted_[i] != 0)) continue;
    ContactNumbers c = looked_[i];
    const Vec3 n = vector_of(c.normal);
    c.push = numbers_of(t * n);
    set_stiffness(c, k * n * n.transpose());
    const double friction = contact_.description().pairs[static_cast<std::size_t>(c.pair)].friction;
    if (friction == 0.0) c.sliding = 0.0;
    if (friction > 0.0) rub(c, n, friction * std::max(t, 0.0), vector_of(c.place), k);
    depth_ = std::max(depth_, -gaps_[i] / c.apart);
    looked_[kept++] = c;
  }
  looked_.resize(kept);
}

/// Coulomb's friction of bound F: it sticks as a spring, or slides with the force F.
void ContactRun::rub(ContactNumbers& c, const Vec3& n, double bound, const Vec3& place, double k) const {
  Vec3 before = reach(c, begin_);
  if (c.kind == ContactNumbers::kPlane) {
    const auto obstacle = static_cast<std::int32_t>(c.b);
    before -= contact_.carried(obstacle, -vector_of(c.fixed), *start_, end_, start_->time);
  }
  Vec3 slid = place - before;
  slid -= n.dot(slid) * n;
  const Vec3 drag = vector_of(c.drag);
  Vec3 force = drag - k * slid;
  Mat3 H = k * (Mat3::Identity() - n * n.transpose());
  // Where the bound alone turned the sliding round, it stops: it sticks from where the step began.
  const bool turned = c.sliding != 0.0 && force.dot(drag) < 0.0;
  c.sliding = 0.0;
  const double size = force.norm();
  if (turned) {
    force = -k * slid;
  } else if (size > bound) {
    const Vec3 along = force / size;
    force = bound * along;
    H = bound / size * (H - k * along * along.transpose());
    c.sliding = 1.0;
  }
  c.push = numbers_of(vector_of(c.push) + force);
  set_stiffness(c, stiffness_of(c) + H);
}

void ContactRun::update(const State& end) {
  for (ContactNumbers& c : contacts_) {
    Vec3 r = vector_of(c.fixed);
    for (std::size_t k = 0; k < 4; ++k) {
      const std::int32_t i = row(c.vertex[k]);
      if (i >= 0) r += c.beta[k] * block(ConstReals(end.positions), i);
    }
    const Vec3 f = vector_of(c.push) - stiffness_of(c) * (r - vector_of(c.place));
    const Vec3 n = vector_of(c.normal);
    const double normal = n.dot(f);
    c.force = std::max(0.0, normal);
    Vec3 drag = f - normal * n;
    const double friction = contact_.description().pairs[static_cast<std::size_t>(c.pair)].friction;
    const double bound = friction * c.force;
    if (drag.norm() > bound) drag *= bound > 0.0 ? bound / drag.norm() : 0.0;
    c.drag = numbers_of(drag);
  }
}

void ContactRun::write(State& state) const { ContactTable::write(contacts_, contact_.numbers(state)); }

void ContactRun::finish(State& end) {
  least_gap_ = std::numeric_limits<double>::infinity();
  gather(end, now_);
  for (ContactNumbers& c : contacts_) {
    const Vec3 n = vector_of(c.normal);
    Vec3 r = vector_of(c.fixed);
    for (std::size_t k = 0; k < 4; ++k) {
      const std::int32_t i = row(c.vertex[k]);
      if (i >= 0) r += c.beta[k] * block(ConstReals(end.positions), i);
    }
    c.push = numbers_of(c.force * n + vector_of(c.drag));
    c.place = numbers_of(r);
    c.stiffness = {};
    least_gap_ = std::min(least_gap_, n.dot(r) / c.apart);
  }
  write(end);
}

std::size_t ContactRun::bytes() const {
  return candidates_->bytes() + (begin_.size() + from_.size() + now_.size()) * sizeof(double) +
         (contacts_.capacity() + looked_.capacity()) * sizeof(ContactNumbers);
}

}  // namespace tissu
