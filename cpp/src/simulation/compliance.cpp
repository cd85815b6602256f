#include "tissu/simulation/compliance.h"

#include <algorithm>
#include <cmath>

#include "kept_factor.h"
#include "node_turns.h"
#include "tissu/base/error.h"

namespace tissu {
namespace {

bool has_constant_matrix(const std::unique_ptr<ForceModel>& model) {
  return model->has_constant_stiffness() || model->run_time().couples;
}

/// Every unknown has a mass or an inertia.
bool has_inertia(const World& world) {
  std::vector<std::uint8_t> with(static_cast<std::size_t>(world.blocks()), 0);
  for (std::size_t row = 0; row < with.size(); ++row) with[row] = world.mass().nodal()[row] > 0.0 ? 1 : 0;
  for (const Frame& frame : world.frames()) with[static_cast<std::size_t>(frame.rotation)] = 1;
  const auto& masks = world.fixed().masks();
  for (std::size_t row = 0; row < with.size(); ++row) {
    if (with[row] == 0 && masks[row] != FixedDofs::kAllAxes) return false;
  }
  return true;
}

}  // namespace

/// What is kept of a world.
struct Compliance::Kept {
  std::shared_ptr<const World> world;
  std::uint64_t edits = 0;  ///< of the simulation: the world may have been edited in its place
  double h = 0.0;
  bool is_static = false;
  bool is_constant = false;  ///< the matrix, whatever is coupled beside it
  bool has_inertia = false;
  bool definite = false;  ///< cells' shares are made semi-definite
  bool assembled = false;
  BlockMatrix A;
  Couplings couplings;
  Scratch scratch;
  KeptFactor factor;
  Eigen::MatrixXd table;                   ///< A^-1 among the rows of the settings
  std::vector<std::int32_t> place;         ///< of each row in the table; -1: it is not there
  double time = -1.0, time_before = -1.0;  ///< of the latest state, and of that before it [s]
  std::vector<double> velocities, velocities_before;
  std::vector<double> way, push;  ///< what find_drift works with

  explicit Kept(std::shared_ptr<const World> of)
      : world(std::move(of)), A(world->sparsity(), world->isa(), world->threads()) {}
  /// h^2, or 1 at rest.
  [[nodiscard]] double size() const { return is_static ? 1.0 : h * h; }
};

Compliance::Compliance(Settings settings) : settings_(std::move(settings)) {
  if (settings_.rows.size() > kMostRows) {
    throw ParameterError("found " + std::to_string(settings_.rows.size()) + " nodes; at most " +
                         std::to_string(kMostRows) +
                         " are accepted, since each meets each other in a table: take the way factor.");
  }
}
Compliance::~Compliance() = default;

std::string_view Compliance::library() { return SparseFactor::library(); }

void Compliance::follow(const Simulation& simulation, double h) {
  const std::shared_ptr<const World>& world = simulation.shared_world();
  const bool is_static = simulation.integrator().is_static();
  const bool same = kept_ != nullptr && kept_->world == world && kept_->edits == simulation.edits();
  if (same && kept_->h == h && kept_->is_static == is_static) return;
  if (!same) kept_ = std::make_unique<Kept>(world);
  kept_->edits = simulation.edits();
  Kept& k = *kept_;
  k.h = h;
  k.is_static = is_static;
  k.assembled = false;
  k.table.resize(0, 0);
  k.is_constant = world->frames().empty() && std::ranges::all_of(world->forces(), has_constant_matrix);
  k.has_inertia = !is_static && has_inertia(*world);
  for (const auto& model : world->forces()) k.scratch.reserve(model->scratch_size());
}

void Compliance::assemble(const State& state) {
  Kept& k = *kept_;
  if (k.assembled && k.is_constant) return couple(state);
  const World& world = *k.world;
  k.A.clear();
  if (!k.is_static) world.mass().add_to(k.A, state, 1.0);
  const StiffnessScale scale{-k.size(), k.is_static ? 0.0 : -k.h, k.definite};
  for (const auto& model : world.forces()) {
    if (model->has_stiffness() && !model->run_time().couples) {
      model->add_stiffness(state, k.scratch, scale, k.A);
    }
  }
  k.A.constrain(world.fixed().rows(), world.fixed().masks());
  k.assembled = true;
  couple(state);
}

void Compliance::couple(const State& state) {
  Kept& k = *kept_;
  k.couplings.clear();
  for (const ForceModel* model : k.world->run_time().coupling) {
    model->add_couplings(state, {-k.size(), k.is_static ? 0.0 : -k.h, k.definite}, k.couplings);
  }
  k.couplings.close(k.world->blocks(), &k.world->fixed().masks());
  const Couplings* coupled = k.couplings.empty() ? nullptr : &k.couplings;
  if (coupled != k.A.couplings() || coupled != nullptr) k.A.set_couplings(coupled);
}

const Eigen::MatrixXd& Compliance::find(Simulation& simulation, double h,
                                        std::span<const CarriedPoint> points) {
  simulation.settle();
  report_ = {};
  follow(simulation, h);
  const bool tabled = settings_.way == ComplianceWay::condensed || settings_.way == ComplianceWay::warped;
  if (tabled) {
    find_by_table(simulation.state(), points);
  } else {
    find_by_solves(simulation.state(), points);
  }
  W_ *= kept_->size();
  if (tabled || kept_->is_static) {
    drift_.setZero(W_.rows());
  } else {
    remember(simulation.state());
    find_drift(simulation.state());
  }
  return W_;
}

void Compliance::remember(const State& state) {
  Kept& k = *kept_;
  if (state.time == k.time) return;
  k.time_before = k.time;
  k.velocities_before.swap(k.velocities);
  k.time = state.time;
  k.velocities.assign(state.velocities.begin(), state.velocities.end());
}

void Compliance::find_drift(const State& state) {
  Kept& k = *kept_;
  const World& world = *k.world;
  // A state that does not follow the one before is taken to move evenly.
  const bool follows = std::abs(k.time - k.time_before - k.h) <= 1e-6 * k.h &&
                       k.velocities_before.size() == k.velocities.size();
  k.way = k.velocities;
  if (follows) {
    for (std::size_t i = 0; i < k.way.size(); ++i) k.way[i] += k.velocities[i] - k.velocities_before[i];
  }
  k.push.assign(k.way.size(), 0.0);
  world.mass().add_product(state, 1.0, k.way, k.push);
  for (const auto& model : world.forces()) {
    if (model->has_stiffness() && !model->run_time().couples) {
      model->add_product(state, k.scratch, {0.0, -k.h, false}, k.velocities, k.push);
    }
  }
  const Eigen::Map<const Eigen::VectorXd> push(k.push.data(), static_cast<Eigen::Index>(k.push.size()));
  drift_ = k.h * (k.factor.motions().transpose() * push);
}

void Compliance::find_by_solves(const State& state, std::span<const CarriedPoint> points) {
  Kept& k = *kept_;
  const PointLoads loads(points, k.world->fixed().masks());
  const Inertia inertia{k.has_inertia ? &k.world->mass() : nullptr, &state};
  const auto attempt = [&] {
    assemble(state);
    if (settings_.way == ComplianceWay::gradient) {
      return k.factor.iterate(k.A, loads, inertia, settings_.tolerance);
    }
    return k.factor.find(k.A, loads, inertia, settings_.tolerance);
  };
  const bool before = k.definite;
  bool found = attempt();
  if (before && k.factor.made()) {  // anew anyway: perhaps it is definite again
    k.definite = false;
    found = attempt();
  }
  if (!found) {
    k.definite = true;
    k.assembled = false;
    attempt();
  }
  W_ = k.factor.found();
  report_ = {k.factor.error(), k.factor.corrections(), k.factor.made(), !k.definite};
}

void Compliance::find_by_table(const State& state, std::span<const CarriedPoint> points) {
  Kept& k = *kept_;
  const World& world = *k.world;
  const bool warped = settings_.way == ComplianceWay::warped;
  if (k.table.size() == 0 && !settings_.rows.empty()) {
    if (!warped && !k.is_constant) {
      throw ParameterError(
          "found a stiffness that changes with the shape; the way condensed accepts a scene of hooke and "
          "condensed bodies: take the way factor, or warped.");
    }
    if (!world.frames().empty()) {
      throw ParameterError(
          "found bodies of frames; the ways condensed and warped accept nodes alone: take factor.");
    }
    assemble(warped ? world.shape_state() : state);
    k.A.set_couplings(nullptr);
    k.table = k.factor.among(k.A, settings_.rows);
    k.place.assign(static_cast<std::size_t>(world.blocks()), -1);
    for (std::size_t i = 0; i < settings_.rows.size(); ++i) {
      k.place[static_cast<std::size_t>(settings_.rows[i])] = static_cast<std::int32_t>(i);
    }
    report_.made = true;
  }
  const PointLoads loads(points, world.fixed().masks());
  Eigen::MatrixXd B = Eigen::MatrixXd::Zero(k.table.rows(), loads.columns());
  for (const PointLoads::Entry& e : loads.entries()) {
    const std::int32_t place = k.place[static_cast<std::size_t>(e.row)];
    if (place < 0) throw ParameterError("found a node that is not among those of the table.");
    const Vec3 load = warped ? Vec3(turn_of(world, state, e.row).transpose() * e.load) : e.load;
    B.col(e.column).segment<3>(3 * static_cast<Eigen::Index>(place)) += load;
  }
  W_ = B.transpose() * (k.table * B);
  W_ = (0.5 * (W_ + W_.transpose())).eval();
}

}  // namespace tissu
