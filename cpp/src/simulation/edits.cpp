/// A simulation whose world changes: edits, other worlds of the same unknowns, and the way back.

#include <optional>
#include <utility>

#include "kept_momenta.h"
#include "tissu/base/error.h"
#include "tissu/edit/cut/material_mesh.h"
#include "tissu/edit/remove_cells.h"
#include "tissu/edit/twist.h"
#include "tissu/simulation/simulation.h"

namespace tissu {
namespace {

/// Of a repair that is not made.
RepairCounts untouched(const RepairCounts& planned) {
  RepairCounts counts;
  counts.bad_before = counts.bad_after = planned.bad_before;
  counts.least_before = counts.least_after = planned.least_before;
  return counts;
}

}  // namespace

void Simulation::prepare_edits() {
  edits_in_place_ = true;
  replace_world(world_);
}

void Simulation::replace_world(std::shared_ptr<const World> world, std::span<const RowCopy> copies,
                               std::span<const RowBlend> blends) {
  if (world->blocks() != world_->blocks()) {
    throw ParameterError("the new world has other unknowns than the one that runs.");
  }
  std::unique_ptr<WorldEditor> editor;
  std::shared_ptr<const World> kept;
  if (edits_in_place_ && WorldEditor::serves(*world)) {
    if (world.use_count() > 1) kept = world;
    editor = std::make_unique<WorldEditor>(std::move(world));
    world = editor->world();
  }
  keep_velocities();
  const std::vector<double> memory = integrator_->memory();
  integrator_->prepare(*world, solver_.get(), profile_);
  integrator_->restore(memory);
  take_over(copies, blends);
  carry_memory(*world_, *world, state_);
  world_ = std::move(world);
  editor_ = std::move(editor);
  kept_ = std::move(kept);
  described_.reset();
  ++edits_;
  renew_watch();
  if (inverted_) inverted_.emplace(*world_);
}

/// Before an edit: free rows that it holds are to keep the velocity that they have, so that a method in time
/// that looks back knows its state again.
void Simulation::keep_velocities() {
  std::vector<double> kept = state_.velocities;
  world_->fixed().copy(held_, kept);
  held_ = std::move(kept);
  integrator_->before_edit();
}

/// Rows that an edit made take over everything of others.
void Simulation::take_over(std::span<const RowCopy> copies, std::span<const RowBlend> blends) {
  integrator_->blend_rows(blends);
  integrator_->copy_rows(copies);
  if (!last_good_.straining.empty()) {
    blend_rows(blends, last_good_.straining);
    copy_rows(copies, Reals(last_good_.straining));
  }
  for (State* state : {&state_, &last_good_}) {
    blend_rows(blends, state->positions);
    blend_rows(blends, state->velocities);
    copy_rows(copies, *state);
  }
  blend_rows(blends, held_);
  copy_rows(copies, Reals(held_));
}

void Simulation::follow(const WorldEditor::Made& made) {
  kept_.reset();
  described_.reset();
  ++edits_;
  if (made.contact != nullptr) world_->contact()->follow(*made.contact, state_);
  if (!integrator_->follow_edit(made.rows)) {
    const std::vector<double> memory = integrator_->memory();
    integrator_->prepare(*world_, solver_.get(), profile_);
    integrator_->restore(memory);
  }
  take_over(made.born.copies, made.born.blends);
  integrator_->after_edit();
  if (watch_) watch_.emplace();
  if (inverted_) inverted_.emplace(*world_);
}

Simulation::Edited Simulation::cut(std::string_view body, const Sweep& sweep, const CutOptions& options) {
  Edited edited = make(body, plan_body_cut(*world_, state_, body, sweep, options));
  if (options.divide) edited.least_quality = least_quality(*world_, body, edited.plan);
  return edited;
}

Simulation::Edited Simulation::ablate(std::string_view body, std::vector<std::int32_t> cells) {
  return make(body, plan_body_ablation(*world_, body, std::move(cells)));
}

Simulation::Edited Simulation::make(std::string_view body, CutPlan plan) {
  Edited edited;
  edited.plan = std::move(plan);
  if (!changes(edited.plan)) return edited;
  keep_velocities();
  keep_contact_forces();
  if (editor_ != nullptr) {
    if (const auto made = editor_->cut(body, edited.plan, state_)) {
      follow(*made);
      std::vector<std::int32_t> born;
      born.reserve(edited.plan.born.size());
      for (const BornCell& cell : edited.plan.born) born.push_back(cell.number);
      edited.before = made->before;
      edited.after = editor_->totals(body, born, made->rows, state_);
      return edited;
    }
  }
  go_on_with(cut_world(*world_, state_, body, edited.plan), body, edited);
  return edited;
}

/// Momenta that moved nodes and other cells change are given back around these, to each connected part its
/// own.
void Simulation::go_on_with(CutWorld made, std::string_view body, Edited& edited) {
  edited.before = totals(*world_, state_, body);
  edited.before.elastic = energy_of(*world_, state_, scratch_).elastic;  // branches of a Prony series too
  std::optional<KeptMomenta> kept;
  if (!made.around_moves.empty()) kept.emplace(*world_, state_, body);
  replace_world(std::move(made.world), made.born.copies, made.born.blends);
  integrator_->after_edit();
  if (kept) {
    for (const KeptMomenta::Lack& lack : kept->lacks(*world_, state_, made.born, made.around_moves)) {
      for (State* state : {&state_, &last_good_}) {
        add_twist(*world_, lack.rows, lack.momentum, lack.angular_momentum, state_.positions,
                  state->velocities);
      }
    }
  }
  edited.after = totals(*world_, state_, body);
  edited.after.elastic = energy_of(*world_, state_, scratch_).elastic;
  edited.relaid = true;
}

Simulation::Repaired Simulation::repair(std::string_view body, const RepairOptions& options) {
  RepairPlan found = plan_body_repair(*world_, state_, body, options);
  Repaired repaired;
  repaired.counts = found.counts;
  if (!changes(found.plan)) return repaired;
  std::optional<CutWorld> made = repaired_world(*world_, state_, body, found.plan);
  if (!made) {
    repaired.counts = untouched(found.counts);
    return repaired;
  }
  repaired.plan = std::move(found.plan);
  keep_contact_forces();
  go_on_with(*std::move(made), body, repaired);
  repaired.least_quality = least_quality(*world_, body, repaired.plan);
  return repaired;
}

std::vector<Piece> Simulation::pieces(std::string_view body) const {
  if (editor_ != nullptr) return editor_->pieces(body);
  const auto cut = cut_state(*world_, body);
  return tissu::pieces(cut->hosts, cut->material);
}

void Simulation::keep_contact_forces() {
  if (world_->contact() == nullptr || !contact_forces_.empty()) return;
  const auto count = static_cast<std::int32_t>(world_->contact()->surfaces().surfaces().size());
  for (std::int32_t surface = 0; surface < count; ++surface) {
    contact_forces_.push_back(world_->contact()->force_on(surface, state_));
  }
}

Contact::Wrench Simulation::contact_force_on(std::int32_t surface) const {
  if (!contact_forces_.empty()) return contact_forces_[static_cast<std::size_t>(surface)];
  return world_->contact()->force_on(surface, state_);
}

void Simulation::remove_cells(std::string_view body, std::span<const std::int32_t> cells) {
  keep_velocities();
  if (editor_ != nullptr) {
    if (const auto made = editor_->remove(body, cells, state_)) {
      follow(*made);
      return;
    }
  }
  replace_world(tissu::remove_cells(*world_, state_, body, cells));
  integrator_->after_edit();
}

/// A world that edits changed in place is kept as what it is made of, and laid again when it is needed.
Simulation::Mark Simulation::mark() {
  forget_solves();
  hold();
  Mark mark{.world = editor_ == nullptr ? world_ : kept_,
            .described = nullptr,
            .state = state_,
            .last_good = last_good_,
            .held = held_,
            .integrator = integrator_->memory(),
            .watch = watch_ ? watch_->reference(state_) : std::vector<double>(),
            .settled = settled_};
  if (mark.world == nullptr) {
    if (described_ == nullptr)
      described_ = std::make_shared<const WorldDescription>(described_apart(*world_));
    mark.described = described_;
  }
  return mark;
}

bool Simulation::is_at(const Mark& mark) const {
  if (mark.world == nullptr) return mark.described == described_;
  return mark.world == (editor_ == nullptr ? world_ : kept_);
}

void Simulation::return_to_world(const Mark& mark) {
  std::shared_ptr<const World> world = mark.world;
  if (world == nullptr) world = std::make_shared<World>(*mark.described);
  std::unique_ptr<WorldEditor> editor;
  if (edits_in_place_ && WorldEditor::serves(*world)) {
    editor = std::make_unique<WorldEditor>(std::move(world));
    world = editor->world();
  }
  world_ = std::move(world);
  editor_ = std::move(editor);
  kept_ = mark.world;
  described_ = mark.described;
}

void Simulation::rewind(const Mark& mark) {
  if (mark.state.positions.size() != state_.positions.size()) {
    throw ParameterError("the mark has other unknowns than the simulation; rewind the one that made it.");
  }
  if (!is_at(mark)) return_to_world(mark);
  contact_forces_.clear();
  ++edits_;
  integrator_->prepare(*world_, solver_.get(), profile_);
  integrator_->restore(mark.integrator);
  state_ = mark.state;
  last_good_ = mark.last_good;
  held_ = mark.held;
  settled_ = mark.settled;
  watch_.reset();
  if (!mark.watch.empty()) watch_.emplace().restore(mark.watch, state_);
  if (inverted_) inverted_.emplace(*world_);
  forget_solves();
}

}  // namespace tissu
