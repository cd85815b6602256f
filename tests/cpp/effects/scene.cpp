#include "scene.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "bar.h"
#include "tissu/base/error.h"
#include "tissu/step/explicit_euler.h"
#include "tissu/step/implicit_euler.h"
#include "tissu/step/static_equilibrium.h"

namespace tissu::effects {

void step_explicitly(Bar& bar) {
  bar.integrator = std::make_unique<SymplecticEuler>();
  bar.h = 1e-4;
}

namespace {

void leave(Bar& /*bar*/) {}
void fall(Bar& bar) { bar.world.gravity = Vec3(0.0, 0.0, -9.81); }
void fall_explicitly(Bar& bar) {
  step_explicitly(bar);
  fall(bar);
}
void hold_explicitly(Bar& bar) {
  step_explicitly(bar);
  hold(bar);
}
void hang(Bar& bar) {
  hold(bar);
  fall(bar);
}
/// Equilibrium, from rest again in each step.
void rest(Bar& bar) {
  hang(bar);
  bar.solver = {1e-8, 1000};
  bar.integrator = std::make_unique<StaticEquilibrium>(StaticEquilibrium::Settings{});
  bar.before = [](Simulation& simulation) {
    simulation.state().positions = simulation.world().rest_positions();
  };
}
void iterate_newton(Bar& bar) { bar.integrator = std::make_unique<ImplicitEuler>(NewtonSettings{10, 1e-4}); }
void damp_like_rayleigh(Bar& bar) { bar.body().rayleigh = RayleighDamping{0.1, 1e-3}; }
void damp_like_kelvin_voigt(Bar& bar) {
  bar.body().viscosity.shear = 1.0;
  bar.body().viscosity.bulk = 1.0;
}
void damp_against_centroids(Bar& bar) { bar.body().viscosity.centroid = 1e3; }
void relax(Bar& bar) { bar.body().viscosity.prony = {{0.5, 0.1}, {0.2, 1.0}}; }
void hold_instruments(Bar& bar) { bar.world.instruments = true; }
void allow_edits(Bar& bar) { bar.world.editable = true; }
void take_snapshots(Bar& bar) {
  bar.before = [](Simulation& simulation) { (void)simulation.snapshot(); };
}
void ask_reactions(Bar& bar) {
  bar.before = [](Simulation& simulation) { (void)simulation.reactions(); };
}
void ask_energies(Bar& bar) {
  bar.before = [](Simulation& simulation) { (void)simulation.energy(); };
}
void add_corotational(Bar& bar) { bar.add_body("corotational", "hooke"); }
void add_mass_spring(Bar& bar) {
  bar.add_body("mass-spring", "hooke");
  bar.world.bodies.back().viscosity.shear = 1.0;
}
void add_mass_link(Bar& bar) { bar.add_body("mass-link", "stvk"); }
void add_mass_tensor(Bar& bar) { bar.add_body("mass-tensor", "stvk"); }
void add_mean_dilatation(Bar& bar) { bar.add_body("mean-dilatation", "stvk"); }
void add_condensed(Bar& bar) {
  bar.add_body("condensed", "hooke");
  std::vector<std::int32_t> kept = bar.end(0.0);
  const std::vector<std::int32_t> other_end = bar.end(kSize.x());
  kept.insert(kept.end(), other_end.begin(), other_end.end());
  std::ranges::sort(kept);
  bar.world.bodies.back().elastic.front().model = CondensedOptions{.kept = std::move(kept)};
}

struct Recipe {
  std::string_view name;
  void (*put)(Bar&);
};
constexpr std::array kRecipes = {
    Recipe{"bare", &leave},
    Recipe{"gravity", &fall},
    Recipe{"nodal-load", &pull_nodes},
    Recipe{"traction", &pull_faces},
    Recipe{"pressure", &press},
    Recipe{"fixed", &hold},
    Recipe{"prescribed", &lead},
    Recipe{"live-lead", &lead_live},
    Recipe{"rayleigh", &damp_like_rayleigh},
    Recipe{"kelvin-voigt", &damp_like_kelvin_voigt},
    Recipe{"centroid", &damp_against_centroids},
    Recipe{"prony", &relax},
    Recipe{"sheets", &add_sheets},
    Recipe{"lines", &add_lines},
    Recipe{"fibres", &add_fibres},
    Recipe{"hexahedra", &add_hexahedra},
    Recipe{"corotational", &add_corotational},
    Recipe{"mass-spring", &add_mass_spring},
    Recipe{"mass-link", &add_mass_link},
    Recipe{"mass-tensor", &add_mass_tensor},
    Recipe{"mean-dilatation", &add_mean_dilatation},
    Recipe{"condensed", &add_condensed},
    Recipe{"frame", &add_frame},
    Recipe{"link", &add_link},
    Recipe{"grab", &add_grab},
    Recipe{"touch-plane", &touch_plane},
    Recipe{"rub-plane", &rub_plane},
    Recipe{"spring-plane", &spring_from_plane},
    Recipe{"strike-plane", &strike_plane},
    Recipe{"correct-plane", &correct_at_plane},
    Recipe{"barrier-plane", &keep_off_plane},
    Recipe{"two-bars", &lay_bar_above},
    Recipe{"touch-bar", &touch_bar},
    Recipe{"touch-itself", &touch_itself},
    Recipe{"instruments", &hold_instruments},
    Recipe{"editable", &allow_edits},
    Recipe{"editing", &remove_a_cell_each_step},
    Recipe{"newton", &iterate_newton},
    Recipe{"indefinite", &squeeze_each_step},
    Recipe{"snapshots", &take_snapshots},
    Recipe{"reactions", &ask_reactions},
    Recipe{"energies", &ask_energies},
    Recipe{"explicit", &step_explicitly},
    Recipe{"explicit-gravity", &fall_explicitly},
    Recipe{"explicit-fixed", &hold_explicitly},
    Recipe{"hanging", &hang},
    Recipe{"static", &rest},
};

/// Stretched and bent more and more, so that no force is trivially zero.
void set_off(State& state) {
  for (std::int32_t i = 0; i < state.blocks(); ++i) {
    const Vec3 x = block(ConstReals(state.positions), i);
    block(Reals(state.velocities), i) += Vec3(0.5 * x.x(), -0.2 * x.y(), 2.0 * x.x() * x.x());
  }
}

}  // namespace

std::vector<std::string_view> scene_names() {
  std::vector<std::string_view> names;
  for (const Recipe& recipe : kRecipes) names.push_back(recipe.name);
  return names;
}

Scene make_scene(std::string_view name, int n) {
  const auto* recipe = std::ranges::find(kRecipes, name, &Recipe::name);
  if (recipe == kRecipes.end()) throw ParameterError("there is no scene \"" + std::string(name) + "\".");
  Bar bar(n);
  recipe->put(bar);
  if (!bar.integrator) bar.integrator = std::make_unique<ImplicitEuler>();
  Scene scene{std::make_unique<Simulation>(std::make_shared<const World>(std::move(bar.world)),
                                           std::move(bar.integrator),
                                           std::make_unique<ConjugateGradient>(bar.solver)),
              bar.h, std::move(bar.before)};
  set_off(scene.simulation->state());
  if (bar.once) bar.once(*scene.simulation);
  scene.start = scene.simulation->state();
  return scene;
}

}  // namespace tissu::effects
