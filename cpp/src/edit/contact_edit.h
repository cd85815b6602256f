#pragma once

/// The surface in contact of a body that is edited in place.

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "edit/cut/kerf_table.h"
#include "tissu/edit/cut/cut_plan.h"
#include "tissu/edit/cut_state.h"
#include "tissu/world/world.h"

namespace tissu {

class ContactEdit {
 public:
  /// Null for a body that is in no contact. `cut` is that of the body.
  static std::unique_ptr<ContactEdit> make(const World& world, const std::string& body, const CutState& cut);
  ContactEdit(const World& world, const std::string& body, const CutState& cut);

  /// Whether the surface is made of the cells of the body, and not a mesh of its own.
  [[nodiscard]] bool follows_cells() const;
  /// A cut is refused if it leaves crossings.
  [[nodiscard]] bool refuses() const;

  /// Before the plan is applied to what a cut sees, …
  void begin(const CutState& cut, const CutPlan& plan) { table_.begin(cut.hosts, cut.material, plan); }
  /// … and afterwards.
  void end(const CutState& cut, const CutPlan& plan) { table_.end(cut.hosts, cut.material, plan); }
  /// The contact of the world after the plan, whose surface is that of the material. `rest`: all rows, new
  /// ones among them.
  [[nodiscard]] std::unique_ptr<Contact> of_material(const CutState& cut, const CutPlan& plan,
                                                     ConstReals rest) const;
  /// Of each primitive of such a contact, whether the plan may have changed it.
  [[nodiscard]] std::vector<std::uint8_t> changed(const Contact& contact) const;
  /// The contact after cells of a body that no blade met were removed, by its description.
  [[nodiscard]] std::unique_ptr<Contact> of_cells(const BodyDescription& body, ConstReals rest) const;

 private:
  [[nodiscard]] std::unique_ptr<Contact> with(SurfaceDescription surface, ContactDescription description,
                                              ConstReals rest) const;

  const World& world_;
  std::string body_;
  KerfTable table_;
};

}  // namespace tissu
