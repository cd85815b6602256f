#pragma once

/// A world that belongs to one simulation, which edits it in place between two steps.

#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "tissu/edit/body_totals.h"
#include "tissu/edit/cut/cut_plan.h"
#include "tissu/edit/cut/piece_table.h"
#include "tissu/edit/cut_state.h"
#include "tissu/edit/edit_body.h"
#include "tissu/world/world_edit.h"

namespace tissu {

/// What a world is made of, of which no edit of the world reaches anything.
WorldDescription described_apart(const World& world);
/// The same world once more, of which no edit of the other reaches anything.
std::shared_ptr<World> laid_anew(const World& world);

class ContactEdit;

class WorldEditor {
 public:
  /// Whether any body of a world can be edited in place.
  static bool serves(const World& world);
  /// Takes a world that nothing else holds; of one that is held elsewhere it lays its own, with the same
  /// bits.
  explicit WorldEditor(std::shared_ptr<const World> world);
  ~WorldEditor();
  WorldEditor(const WorldEditor&) = delete;
  WorldEditor& operator=(const WorldEditor&) = delete;

  [[nodiscard]] const std::shared_ptr<const World>& world() const { return shown_; }

  /// What an edit in place changed.
  struct Made {
    RowsBorn born;                     ///< rows of the state that take over others
    std::vector<std::int32_t> rows;    ///< of the matrix, whose columns changed, ascending
    BodyTotals before;                 ///< of the cells that went and of these rows
    std::unique_ptr<Contact> contact;  ///< with the surfaces before the edit; null: they have not changed
  };
  /// Makes a plan for a body; nothing where that cannot be done in place. Refuses, with nothing changed, what
  /// leaves crossings.
  std::optional<Made> cut(std::string_view body, const CutPlan& plan, const State& state);
  /// Takes cells out, whose nodes do not part; nothing where that cannot be done in place. Refuses cells that
  /// are not there.
  std::optional<Made> remove(std::string_view body, std::span<const std::int32_t> cells, const State& state);

  /// Of some cells, and of the masses of some rows.
  [[nodiscard]] BodyTotals totals(std::string_view body, std::span<const std::int32_t> cells,
                                  std::span<const std::int32_t> rows, const State& state) const;
  /// The connected parts of the material of a body, by the numbers of their first cells.
  [[nodiscard]] std::vector<Piece> pieces(std::string_view body) const;

 private:
  struct EditedBody {
    std::shared_ptr<CutState> state;        ///< null: of a body that has no material to be cut
    std::unique_ptr<PieceTable> pieces;     ///< beside the state
    std::unique_ptr<ContactEdit> touching;  ///< null: of a body that is in no contact
  };
  [[nodiscard]] std::size_t number_of(std::string_view body) const;
  enum class Verb { cut, remove };
  std::optional<Made> make(std::string_view body, const CutPlan& plan, const State& state, Verb verb);
  void part_bound(std::string_view body, const BodyChange& change, Verb verb);
  void track(std::size_t body);
  void apply(std::size_t body, const CutPlan& plan);
  [[nodiscard]] std::unique_ptr<Contact> parted_contact(std::size_t body, const CutPlan& plan) const;
  [[nodiscard]] BodyChange change_of(std::size_t body, const CutPlan& plan, const State& state) const;

  std::shared_ptr<World> world_;
  std::shared_ptr<const World> shown_;
  WorldEdit edit_;
  std::vector<EditedBody> bodies_;
};

}  // namespace tissu
