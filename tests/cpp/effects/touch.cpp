/// What the bar touches.

#include <utility>

#include "bar.h"
#include "tissu/mesh/topology.h"

namespace tissu::effects {
namespace {

constexpr double kGap = 1e-4;      // m, at which surfaces rest
constexpr double kApart = 0.5e-4;  // m, at the start: they press from the first step on

SurfaceDescription surface_of(const Bar& bar, std::string name) {
  SurfaceDescription surface;
  surface.name = std::move(name);
  surface.closed = true;
  for (const auto& face : boundary_surface(bar.mesh).triangles) {
    surface.triangles.push_back({face[0], face[1], face[2]});
  }
  return surface;
}

void meet(Bar& bar, std::int32_t a, std::int32_t b, double friction = 0.0) {
  ContactPair pair;
  pair.a = a;
  pair.b = b;
  pair.friction = friction;
  pair.gap = kGap;
  bar.world.contact->pairs.push_back(std::move(pair));
}

/// A plane above the bar, whose end moves up.
void press_on_plane(Bar& bar, double friction, ContactMethod method = ContactMethod::augmented) {
  bar.world.contact.emplace();
  bar.world.contact->method = method;
  bar.world.contact->bodies.push_back(surface_of(bar, "bar"));
  ObstacleDescription plane;
  plane.surface.name = "plane";
  plane.plane = true;
  plane.normal = -Vec3::UnitZ();
  plane.origin = Vec3(0.0, 0.0, kSize.z() + kApart);
  bar.world.contact->obstacles.push_back(std::move(plane));
  meet(bar, 0, 1, friction);
}

}  // namespace

void touch_plane(Bar& bar) { press_on_plane(bar, 0.0); }
void rub_plane(Bar& bar) { press_on_plane(bar, 0.5); }

void spring_from_plane(Bar& bar) { press_on_plane(bar, 0.0, ContactMethod::penalty); }
void strike_plane(Bar& bar) {
  step_explicitly(bar);
  press_on_plane(bar, 0.0, ContactMethod::impulse);
}
void correct_at_plane(Bar& bar) {
  step_explicitly(bar);
  press_on_plane(bar, 0.0, ContactMethod::geometric);
}
/// Each step is solved, as the method asks for.
void keep_off_plane(Bar& bar) {
  bar.solver = {1e-8, 1000};
  press_on_plane(bar, 0.0, ContactMethod::barrier);
}

void lay_bar_above(Bar& bar) {
  bar.add_body("fem", "stvk");
  std::vector<double>& positions = bar.world.bodies.back().positions;
  for (std::size_t i = 2; i < positions.size(); i += 3) positions[i] += kSize.z() + kApart;
}

void touch_bar(Bar& bar) {
  lay_bar_above(bar);
  bar.world.contact.emplace();
  bar.world.contact->bodies = {surface_of(bar, "bar"), surface_of(bar, "other")};
  meet(bar, 0, 1);
}

void touch_itself(Bar& bar) {
  bar.world.contact.emplace();
  bar.world.contact->bodies.push_back(surface_of(bar, "bar"));
  meet(bar, 0, 0);
}

}  // namespace tissu::effects
