#pragma once

/// What of a scene touches what, as plain data.

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "tissu/assembly/fixed_dofs.h"
#include "tissu/contact/broad_phase.h"

namespace tissu {

/// A node of a body.
struct BodyNode {
  std::string body;
  std::int32_t node = 0;
};

/// Vertices of a body's surface that nodes carry: p = sum w x, or p = sum w (x + R arm) where they are
/// frames.
struct SurfaceRiders {
  std::vector<std::int32_t> vertex = {};  ///< numbers as the primitives have them, ascending
  std::vector<std::int32_t> begin = {0};  ///< of each in `node` and `weight`, and the end
  std::vector<std::int32_t> node = {};    ///< of the body; from its number of nodes on: of `others`
  std::vector<double> weight = {};        ///< those of a vertex sum to 1
  /// From each node that is a frame to the vertex at rest [m], three numbers each; empty: no frame turns it.
  std::vector<double> arm = {};
  std::vector<BodyNode> others = {};  ///< nodes of other bodies that carry vertices too
};

/// The surface of a body or of an obstacle. It is made of triangles, of edges that belong to no triangle
/// (lines, a capsule) and of vertices that belong to no edge (a sphere).
struct SurfaceDescription {
  std::string name;  ///< of the body or obstacle
  /// Of an obstacle: its vertices where it stands at rest [m], three numbers each. A body's are its nodes, or
  /// what `riders` lists; a negative number is not a node.
  std::vector<double> vertices = {};
  std::vector<std::array<std::int32_t, 3>> triangles = {};  ///< anticlockwise seen from outside
  std::vector<std::array<std::int32_t, 2>> edges = {};
  std::vector<std::int32_t> points = {};
  /// Half the thickness of what the primitives stand for [m], one number for each vertex; empty: none.
  std::vector<double> radius = {};
  bool closed = false;  ///< its triangles enclose a volume: they are met from outside only
  SurfaceRiders riders = {};
  /// Of each node of a body whose nodes cuts parted: the node of the first day that it is a copy of.
  std::vector<std::int32_t> roots = {};
};

/// A thing that is not deformed: a plane, or a surface.
struct ObstacleDescription {
  SurfaceDescription surface;   ///< empty for a plane
  bool plane = false;           ///< all points x with normal . (x - origin) <= 0 are inside
  Vec3 normal = Vec3::UnitZ();  ///< of length 1
  Vec3 origin = Vec3::Zero();   ///< what `motion` moves, and what moments are taken about [m]
  Motion motion = {};           ///< the path on which it is led; at rest when empty
  /// Number among the world's rigid bodies of the one that carries it, whose origin is `origin`: it moves
  /// freely. -1: it is led, or at rest.
  std::int32_t frame = -1;
};

enum class ContactMethod { augmented, barrier, penalty, impulse, geometric };

/// How the force of the penalty method grows as surfaces close.
enum class PenaltyLaw { linear, reciprocal };

/// A pair of surfaces that meet. Bodies are numbered first, in the order of `bodies`, then obstacles.
struct ContactPair {
  std::int32_t a = 0;
  std::int32_t b = 0;     ///< the same: it meets itself
  double friction = 0.0;  ///< Coulomb's mu
  double gap = 0.0;       ///< at which surfaces rest [m], beside the radii; positive
  /// Speed of parting over speed of meeting; absent: 0 of impulses, what the damper of penalty gives.
  std::optional<double> restitution = std::nullopt;
  std::optional<double> stiffness = std::nullopt;  ///< of the penalty method [Pa/m]; absent: from the masses
  std::vector<std::int32_t> nodes = {};            ///< of a that alone meet b, ascending; empty: all
};

struct ContactDescription {
  std::vector<SurfaceDescription> bodies;
  std::vector<ObstacleDescription> obstacles;
  std::vector<ContactPair> pairs;
  ContactMethod method = ContactMethod::augmented;
  PenaltyLaw penalty = PenaltyLaw::linear;
  BroadPhaseKind broad_phase = BroadPhaseKind::hierarchy;
  int iterations = 20;  ///< systems at most in a step that is linearised once
  bool travel = true;   ///< nothing passes through anything
};

}  // namespace tissu
