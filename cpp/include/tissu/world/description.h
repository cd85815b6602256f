#pragma once

/// What a world is built from, as plain data with node numbers local to each body.

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "tissu/assembly/fixed_dofs.h"
#include "tissu/base/isa.h"
#include "tissu/contact/description.h"
#include "tissu/force/load.h"
#include "tissu/model/elastic_block.h"
#include "tissu/viscosity/viscosity.h"

namespace tissu {

struct CutState;

struct RayleighDamping {
  double mass = 0.0;       ///< alpha [1/s]
  double stiffness = 0.0;  ///< beta [s]
};

struct SharedNode {
  std::string body;
  std::int32_t node = 0;
};

/// A place in a body of the first day: the mean of up to four nodes, by weights that sum to 1.
struct FirstDayPoint {
  std::array<std::int32_t, 4> node{-1, -1, -1, -1};  ///< -1 beyond the last
  std::array<double, 4> weight{};
};

struct BodyDescription {
  std::string name;
  std::vector<double> positions;  ///< at rest [m], three for each node
  std::vector<ElasticBlock> elastic;
  std::optional<RayleighDamping> rayleigh = std::nullopt;
  Viscosity viscosity = {};
  bool frames = false;  ///< its nodes are frames: they have a rotation too, none at rest
  /// Frames of other bodies that this body's cells use as well: numbers from its own node count on.
  std::vector<SharedNode> shared = {};
  /// Rows of the unknown that follow its nodes, held and without mass: nodes that edits make take them.
  std::int32_t room = 0;
  /// Of the nodes that edits made, which are its last: the node of the first day that each is a copy of; of
  /// those that blades put on edges, -1 - i for the place `points[i]`.
  std::vector<std::int32_t> copies_of = {};
  std::vector<FirstDayPoint> points = {};
  /// Cuts have moved nodes at rest, so that `positions` do not follow from those of the first day.
  bool moved = false;
  /// Nodes with cells but without material at them; ascending. Loads on faces reach them by the material of
  /// their cells, loads of nodes do not, and a support holds those that the material on it needs
  /// (part_supports of the room edit).
  std::vector<std::int32_t> bare = {};
  /// Its cells and their material as cuts left them; null before the first cut.
  std::shared_ptr<const CutState> cut = nullptr;
  /// The same of a body that was never cut, where it is at hand.
  std::shared_ptr<const CutState> uncut = nullptr;
  /// The number that the next cell gets which an edit makes; 0: one more than the last.
  std::int32_t next_cell = 0;
};

struct FixedNodes {
  std::string body;
  std::vector<std::int32_t> nodes;
  std::uint8_t axes = FixedDofs::kAllAxes;  ///< of space; 0: the places are free
  Motion motion;
  std::vector<double> positions;  ///< where the motion starts, three for each node; empty: at rest
  std::uint8_t rotations = 0;     ///< of frames: axes about which their rotation is given too
  /// By which a run leads them live (FixedDofs::lead_to), together with all others of the name; empty: never.
  std::string name = {};
  /// Its nodes before the first edit of the body, ascending; empty until then.
  std::vector<std::int32_t> first_day = {};
};

struct LoadDescription {
  std::string name;
  std::string body;
  std::vector<std::int32_t> nodes;
  std::vector<double> forces;  ///< [N], three for each node
  History history;
  bool moments = false;  ///< they are moments [N m] on frames, about axes of space
  /// Of a body that was edited: what it was before the first edit; else empty.
  std::vector<std::int32_t> first_day = {};
  std::vector<double> first_forces = {};
  /// Of a load on faces: these, and what multiplies the area of each, or its normal with an area's length.
  std::vector<FaceCells> faces = {};
  Vec3 unit = Vec3::Zero();  ///< [Pa]
  bool along_normals = false;
  std::vector<LoadLeft> left = {};  ///< where something of what it acted on is gone
};

struct PressureDescription {
  std::string name;
  std::string body;
  std::vector<FaceCells> faces;
  double pressure = 0.0;  ///< [Pa]
  History history;
  std::vector<CarriedFace> carried = {};  ///< what cuts have left of other triangles
  std::vector<FacePart> parts = {};       ///< and of other quads
  std::vector<FaceCells> first_day = {};  ///< of a body that was cut: the faces before
};

/// A rigid body that stands alone.
struct FrameDescription {
  Vec3 position = Vec3::Zero();
  Quaternion rotation = Quaternion::Identity();
  Vec3 velocity = Vec3::Zero();
  Vec3 angular_velocity = Vec3::Zero();  ///< in space [rad/s]
  double mass = 1.0;                     ///< [kg]
  Mat3 inertia = Mat3::Identity();       ///< about its origin, in its own axes [kg m2]
};

struct WorldDescription {
  std::vector<BodyDescription> bodies;
  std::vector<FrameDescription> frames;
  std::vector<FixedNodes> fixed;
  std::optional<Vec3> gravity;  ///< [m/s2]
  /// Gravity pulls at the nodes by sum_g w_g rho N_a, which statics needs. With inertia beside it, it pulls
  /// at the masses that inertia has, so that a body falls without being deformed. The two differ for
  /// quadratic elements only.
  bool consistent_weight = false;
  std::vector<LoadDescription> loads;
  std::vector<PressureDescription> pressures;
  std::optional<ContactDescription> contact;
  bool links = false;        ///< springs between points may be made and unmade while it runs
  bool grabbing = false;     ///< points may be pulled to targets while it runs
  bool instruments = false;  ///< instruments remember where they were
  bool pressing = false;     ///< edges of blades press on the material until it gives way
  bool editable = false;     ///< cells may be removed while it runs
  /// Of a world that is built once more: all rows at rest after its surfaces were moved apart. Empty: they
  /// are moved apart when the world is built.
  std::vector<double> separated = {};
  int threads = 1;
  std::optional<Isa> isa;  ///< absent: the best there is

  BodyDescription& body(std::string_view name);
};

}  // namespace tissu
