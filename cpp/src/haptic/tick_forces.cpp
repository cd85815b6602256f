#include <algorithm>
#include <cmath>

#include "haptic/tick_parts.h"

namespace tissu::haptic {
namespace {

constexpr double kLeastScale = 1e-6;  // of K_c: below, no force and no solve

/// Forces for a model, a stiffness and a shift at the joints of this tick.
struct Solved {
  Patch patch{};
  Rows lambda = Rows::Zero();
  PatchReport report{};
  double stored = 0.0;
};

/// Whether friction bears all that it can. What sticks must not creep by what the solver leaves over.
bool is_slipping(const Block& block, const Rows& lambda) noexcept {
  constexpr double kFull = 1.0 - 1e-9;
  if (block.kind == BlockKind::bounded) return std::abs(lambda[block.row]) >= kFull * block.bound;
  return lambda.segment<2>(block.row + 1).norm() >= kFull * block.bound * lambda[block.row];
}

/// Contacts that slip, and open ones, take their tangential rest with them; so does a blade that goes on.
void follow_slip(const Solved& s, Rows& shift) noexcept {
  const Rows g = gaps(s.patch, s.lambda);
  for (int k = 0; k < s.patch.blocks; ++k) {
    const Block& block = s.patch.block[static_cast<std::size_t>(k)];
    if (block.kind == BlockKind::push || !is_slipping(block, s.lambda)) continue;
    if (block.kind == BlockKind::cone) shift.segment<2>(block.row + 1) -= g.segment<2>(block.row + 1);
    if (block.kind == BlockKind::bounded) shift[block.row] -= g[block.row];
  }
}

void solve(const Settings& settings, const Memory& m, double scale, Rows& shift, Solved& s) noexcept {
  make_patch(m.model, m.rows, settings.joints, scale * settings.stiffness, m.q, shift, s.patch);
  s.report = solve_patch(s.patch, settings.sweeps, s.lambda);
  s.stored = stored_energy(s.patch, s.lambda);
  const Rows before = shift;
  follow_slip(s, shift);
  s.patch.b.head(s.patch.rows) += (shift - before).head(s.patch.rows);
}

bool is_loaded(const Block& block, const Rows& lambda) noexcept {
  return block.kind == BlockKind::bounded || lambda[block.row] > 0.0;
}

/// Shows the share gamma of the full forces: b of what bears is scaled by gamma, which scales lambda by it,
/// cones included; what does not bear is kept from bearing.
void show_share(const Solved& full, double gamma, Memory& m) noexcept {
  m.share = gamma;
  m.lambda = gamma * full.lambda;
  m.shift = m.slip;
  if (gamma == 1.0) return;
  const Rows g = gaps(full.patch, m.lambda);
  for (int k = 0; k < full.patch.blocks; ++k) {
    const Block& block = full.patch.block[static_cast<std::size_t>(k)];
    const int size = block.kind == BlockKind::cone ? 3 : 1;
    if (is_loaded(block, full.lambda)) {
      m.shift.segment(block.row, size) -= (1.0 - gamma) * full.patch.b.segment(block.row, size);
    } else {
      m.shift[block.row] += std::max(0.0, -g[block.row]);
    }
  }
}

Vec3 total_force(const LocalModel& model, const Rows& lambda) noexcept {
  Vec3 sum = Vec3::Zero();
  for (std::int32_t i = 0; i < model.contacts; ++i) {
    const LocalContact& c = model.contact[static_cast<std::size_t>(i)];
    sum += c.normal * lambda[3 * i] + c.tangent * lambda[3 * i + 1] +
           c.normal.cross(c.tangent) * lambda[3 * i + 2];
  }
  return sum;
}

/// Takes the newest model where it is new, meant for this tool and finite. True where it was taken.
bool take_model(const Kinematics& kinematics, const TickInput& input, Memory& m) noexcept {
  const LocalModel* model = input.model;
  if (model == nullptr || model->stamp == 0 || model->stamp == m.model.stamp || model->stamp == m.refused) {
    return false;
  }
  if (model->tag != m.tag) return false;
  if (!is_finite(*model)) {
    m.refused = model->stamp;
    ++m.bad_models;
    return false;
  }
  m.bad_models = 0;
  m.model = *model;
  m.rows = model_rows(kinematics, m.model);
  m.slip.setZero();
  m.lambda.setZero();
  for (std::int32_t i = 0; i < m.model.contacts; ++i) {
    m.lambda.segment<3>(3 * i) = m.model.contact[static_cast<std::size_t>(i)].force;
  }
  const Vec3 slow = total_force(m.model, m.lambda);
  if (m.force_ticks > 0) {
    m.disagreement = (m.force_sum / static_cast<double>(m.force_ticks) - slow).norm();
  }
  m.force_sum.setZero();
  m.force_ticks = 0;
  return true;
}

/// The share of K_c that this tick wants.
double wanted_scale(const Settings& settings, const TickInput& input, Memory& m) noexcept {
  m.ramp = settings.ramp > 0.0 ? std::min(1.0, m.ramp + settings.period / settings.ramp) : 1.0;
  const double late = model_age(input, m) - settings.stall;
  const double fading = late <= 0.0 ? 1.0 : std::max(0.0, 1.0 - late / settings.fade);
  return m.ramp * m.tank.stiffness * fading;
}

void drop_force(Memory& m) noexcept {
  m.lambda.setZero();
  m.slip.setZero();
  m.shift.setZero();
  m.scale = 0.0;
  m.share = 1.0;
  m.stored = 0.0;
  m.force_sum.setZero();
  m.force_ticks = 0;
}

void settle(const Settings& settings, const Motion& motion, double stored, Memory& m) noexcept {
  const Joints v = motion.speed;
  const Joints power = settings.friction.viscous.cwiseProduct(v.cwiseAbs2()) +
                       settings.friction.coulomb.cwiseProduct(v.cwiseAbs());
  const double work = motion.fast ? 0.0 : m.paid.dot(motion.dq);  // a jump of counts is not a way
  m.tank.settle(settings.tank, work, stored - m.stored, motion.fresh ? power.sum() * settings.period : 0.0);
  m.stored = stored;
}

/// The forces of the model in use at this tick's joints, and the tank after them.
void solve_current(const Settings& settings, const Motion& motion, Memory& m, Solved& s) noexcept {
  s.lambda = m.lambda;
  if (m.scale > kLeastScale) {
    solve(settings, m, m.scale, m.shift, s);
    if (m.share == 1.0) m.slip = m.shift;
  } else {
    s.lambda.setZero();
  }
  m.lambda = s.lambda;
  settle(settings, motion, s.stored, m);
}

/// The newest model and stiffness, as much of them as the tank pays.
void adopt(const Settings& settings, double scale, Memory& m, Solved& full) noexcept {
  full.stored = 0.0;
  m.scale = scale;
  if (scale <= kLeastScale) {
    m.tank.pay(settings.tank, -m.stored);
    drop_force(m);
    return;
  }
  full.lambda = m.lambda;
  solve(settings, m, scale, m.slip, full);
  const double more = full.stored - m.stored;
  const double share = m.tank.pay(settings.tank, more);
  const double shown = m.stored + share * more;
  show_share(full, share == 1.0 ? 1.0 : std::sqrt(shown / full.stored), m);
  m.stored = shown;
}

}  // namespace

Joints model_torques(const Kinematics& kinematics, const Settings& settings, const TickInput& input,
                     const Motion& motion, Memory& m, TickReport& report) noexcept {
  const Joints slow = 2.0 * settings.count_size / settings.period;
  if (!gives_force(m.state)) {
    // What drives the axes to their ends is not the tissue's: the tank does not pay it.
    if (m.state != State::homing) settle(settings, motion, 0.0, m);
    drop_force(m);
    return Joints::Zero();
  }
  Solved s;
  solve_current(settings, motion, m, s);
  m.tank.observe(settings.tank, settings.period);
  const double scale = wanted_scale(settings, input, m);
  const bool taken = take_model(kinematics, input, m);
  if (taken || scale != m.scale || m.share != 1.0) adopt(settings, scale, m, s);
  report.sweeps = s.report.sweeps;
  report.change = s.report.change;
  for (std::int32_t i = 0; i < m.model.contacts; ++i) report.contacts += m.lambda[3 * i] > 0.0 ? 1 : 0;
  report.force = total_force(m.model, m.lambda);
  m.force_sum += report.force;
  if (m.model.blade.present) report.force += m.model.blade.way * m.lambda[3 * m.model.contacts];
  ++m.force_ticks;
  m.state = (m.lambda.head(m.rows.rows + kStops).array() != 0.0).any() ? State::contact : State::free;
  Joints damping = -settings.damping.cwiseProduct(motion.speed);
  if (settings.tank.gate) {
    damping += m.tank.damping(settings.friction.viscous, motion.speed, slow, settings.period);
  }
  return patch_torques(m.rows, m.q, settings.joints, m.lambda) + damping;
}

}  // namespace tissu::haptic
