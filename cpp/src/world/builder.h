#pragma once

/// Builds a world from its description, part after part: each reads what those before it made.

#include <Eigen/Geometry>
#include <memory>
#include <string>
#include <vector>

#include "tissu/contact/audit.h"
#include "tissu/world/world.h"

namespace tissu {

class WorldBuilder {
 public:
  /// `before`: null, or a world whose models hand over what stays as it is.
  WorldBuilder(World& world, const WorldDescription& description, const World* before, bool cells_are_new);
  void build();
  /// The supports of the description, of a world that is there.
  void renew_supports();

 private:
  // build_bodies.cpp
  void add_bodies();
  void place_bodies();
  std::vector<Frame> add_frames();
  void add_node_frames(std::vector<Frame>& frames);
  void add_models(const BodyDescription& description, Body& made, const std::vector<Frame>& frames);
  [[nodiscard]] std::vector<ElasticBlock> blocks_of(const BodyDescription& body, const Body& made) const;
  [[nodiscard]] std::vector<std::int32_t> shared_nodes(const BodyDescription& description) const;
  void add_inertias(std::vector<Frame>& frames) const;
  // build_viscosity.cpp
  void add_viscosity(const BodyDescription& body, const Body& made);
  // build_loads.cpp
  void add_loads();
  void add_load(const LoadDescription& load);
  void add_pressure(const PressureDescription& pressure);
  // build_contact.cpp
  void find_others(SurfaceDescription& surface) const;
  void add_contact();
  [[nodiscard]] std::vector<RowRange> loose_bodies() const;
  void separate_surfaces();
  // build_supports.cpp
  void add_supports();
  void hold(const FixedNodes& fixed);
  void hold_rotations(const FixedNodes& fixed, const Body& on, const std::vector<std::int32_t>& nodes,
                      const std::string& where);
  void hold_room();
  void hold_eliminated();
  /// The blocks of the rotations of some nodes; refuses those of a body whose nodes have none.
  [[nodiscard]] std::vector<std::int32_t> rotations_of(const Body& body, std::vector<std::int32_t> nodes,
                                                       const std::string& where) const;
  // world.cpp
  void lay_pattern();
  void list_run_time();
  void set_rest();

  World& world_;
  const WorldDescription& description_;
  const World* before_;
  bool cells_are_new_;
  std::vector<double> masses_;   ///< of each 3-vector of the unknown [kg]
  std::vector<double> weights_;  ///< sum_g w_g rho N_a of each node [kg]; the mass for linear elements
  std::vector<Mat3> inertias_;   ///< that models give to each frame
  std::vector<Vec3> moments_;    ///< of the weight of each frame, in its axes [kg m]; empty unless asked for
  std::vector<Vec3> spins_;      ///< of frames at time zero
  std::vector<Vec3> speeds_;
};

/// The box around the nodes and the origins of frames; the blocks of rotations are not positions.
Eigen::AlignedBox3d box_of(const std::vector<double>& positions, const std::vector<Frame>& frames);
/// Zero of an empty one.
double diagonal_of(const Eigen::AlignedBox3d& box);

/// What a pressure acts on, by rows of the world.
struct PressedFaces {
  std::vector<FaceCells> faces;
  std::vector<CarriedFace> carried;
  std::vector<FacePart> parts;
};
PressedFaces faces_of(const PressureDescription& pressure, const Body& on);

/// Node numbers of a body as those of the world; refuses others than 0 to count - 1.
std::vector<std::int32_t> shifted(std::vector<std::int32_t> nodes, std::int32_t first, std::int32_t count,
                                  const std::string& where);

}  // namespace tissu
