#pragma once

/// Loads from outside: forces on nodes, and pressure on faces.

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "tissu/element/reference_cell.h"
#include "tissu/element/reference_part.h"
#include "tissu/force/force_model.h"
#include "tissu/force/load_change.h"

namespace tissu {

/// A node of a load that has lost a part of what it acted on there.
struct LoadLeft {
  std::size_t place;  ///< of the node among those of the load
  Vec3 per_unit;      ///< force for each unit of the load along each axis: an area left [m2], or nothing
};

/// Forces that keep their direction (dead loads): point forces, and tractions summed into nodes. What a run
/// changes of it: three numbers of which the forces are made, and the forces. Where something of what it
/// acted on is gone, the forces follow from the three numbers and from what is left.
class NodalLoad final : public ForceModel {
 public:
  NodalLoad(std::string name, std::vector<std::int32_t> nodes, std::vector<double> forces, History history);
  /// What is left at some of its nodes, ascending. `along_normals`: the first of the three numbers is a
  /// pressure, which acts against normals.
  void set_left(std::vector<LoadLeft> left, bool along_normals);
  /// After an edit in place of the body: on other nodes. Only of a load that the run has not changed.
  void act_on(std::vector<std::int32_t> nodes, std::vector<double> forces);
  [[nodiscard]] std::string_view effect() const override { return name_; }
  [[nodiscard]] ForceKind kind() const override { return ForceKind::external; }
  [[nodiscard]] bool has_constant_stiffness() const override { return true; }
  [[nodiscard]] bool has_stiffness() const override { return false; }
  /// It changes with time.
  [[nodiscard]] bool may_add_energy() const override { return !history_.times.empty(); }
  void add_force(const State& state, Scratch& scratch, Reals f) const override;
  /// -sum f . x [J]
  [[nodiscard]] double energy(const State& state, Scratch& scratch) const override;
  void claim_memory(MemoryPlaces& places) override;
  void carry_memory(const ForceModel& before, const Memory& then, Memory& now) const override;
  void check_memory(const State& state) const override { change_.check(name_, state); }

 private:
  static constexpr std::size_t kMadeOf = 3;
  /// Calls f(node, force).
  template <class Function>
  void for_forces(const State& state, Function&& f) const;

  std::string name_;
  std::vector<std::int32_t> nodes_;
  std::vector<double> forces_;  ///< [N], three for each node
  std::vector<LoadLeft> left_;
  bool along_normals_ = false;
  History history_;
  LoadChange change_;
};

/// Faces of one kind: node numbers face after face, in VTK order, anticlockwise seen from outside. Those of a
/// flat body are its edges, along which it lies on the left seen from +z.
struct FaceCells {
  std::string element = "triangle";  ///< or triangle6, quad, quad8, quad9; line and line3 for edges
  std::vector<std::int32_t> nodes;
  double thickness = 0.0;  ///< of the flat body along z, at rest [m]; faces have none
};

/// A face of a cell, of which the cell has material.
struct FacePart {
  std::string_view element;
  std::vector<std::int32_t> nodes;                  ///< of the cell, in the order of the element
  std::vector<std::vector<ReferencePoint>> pieces;  ///< where it has material; empty: everywhere
};

/// A point that rides on nodes: numbers and weights, which sum to one.
struct CarriedNode {
  std::int32_t node;
  double weight;
};
/// A flat triangle between such points, anticlockwise seen from outside.
using CarriedFace = std::array<std::vector<CarriedNode>, 3>;

/// Adds each node's share of the area of the faces [m2], sum_g w_g |x,1 x x,2| N_a: what a traction that is
/// the same everywhere gives to the nodes. `part`: a rule on a part of each face; null: of the whole face.
void add_areas(const FaceCells& faces, ConstReals positions, std::vector<double>& nodal,
               const ReferenceCell* part = nullptr);
/// The same with the outward normal, sum_g w_g N_a x,1 x x,2 [m2], three for each node: what a pressure of -1
/// Pa gives to the nodes.
void add_normals(const FaceCells& faces, ConstReals positions, std::vector<double>& nodal,
                 const ReferenceCell* part = nullptr);

/// Pressure that stays normal to the faces it acts on: f_a = -p sum_g w_g N_a (x,1 x x,2), with the rule that
/// is exact for it. Of the edge of a flat body x,2 is its thickness at rest along z. Its stiffness is skew on
/// an open surface; the symmetric part is used, which is exact for a pressure on a closed surface or one
/// whose rim is held. A definite matrix goes without it: the eigenvalues of a face sum to zero, so half of
/// what it says would be gone, and on a closed surface the faces' parts cancel each other, their halves would
/// not. A triangle whose points ride on nodes gives each point a third of its force; of a part of a face the
/// sum goes over the points of its pieces. What a run changes of it: the pressure.
class Pressure final : public ForceModel {
 public:
  Pressure(std::string name, std::vector<FaceCells> faces, double pressure, History history,
           std::vector<CarriedFace> carried = {}, std::vector<FacePart> parts = {});
  /// After an edit in place of the body: on other faces, by the same memory.
  void act_on(std::vector<FaceCells> faces, std::vector<CarriedFace> carried, std::vector<FacePart> parts);
  [[nodiscard]] std::string_view effect() const override { return name_; }
  [[nodiscard]] ForceKind kind() const override { return ForceKind::external; }
  [[nodiscard]] bool may_add_energy() const override { return true; }
  void couple(SparsityBuilder& builder) const override;
  void add_force(const State& state, Scratch& scratch, Reals f) const override;
  void add_stiffness(const State& state, Scratch& scratch, StiffnessScale scale,
                     BlockMatrix& matrix) const override;
  void add_product(const State& state, Scratch& scratch, StiffnessScale scale, ConstReals p,
                   Reals out) const override;
  /// p times the volume between the faces and the origin [J]; of an open surface it depends on the origin,
  /// and only its change where the rim is held means something.
  [[nodiscard]] double energy(const State& state, Scratch& scratch) const override;
  void claim_memory(MemoryPlaces& places) override { change_.claim(name_, 1, places); }
  void carry_memory(const ForceModel& before, const Memory& then, Memory& now) const override;
  void check_memory(const State& state) const override { change_.check(name_, state); }

 private:
  /// At its time, whatever share of the loads acts.
  [[nodiscard]] double pressure_at(const State& state) const;
  template <class Function>
  void for_blocks(const State& state, double scale, Function&& f) const;

  struct Ruled {
    FaceCells faces;
    ReferenceCell rule;
  };

  std::string name_;
  std::vector<Ruled> faces_;
  std::vector<CarriedFace> carried_;
  double pressure_;  ///< [Pa]
  History history_;
  LoadChange change_;
};

}  // namespace tissu
