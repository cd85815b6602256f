#pragma once

/// What a block of like cells is made of, as plain data.

#include <cstdint>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "tissu/base/vec.h"
#include "tissu/law/law_info.h"
#include "tissu/law/loaded_law.h"
#include "tissu/model/line_section.h"
#include "tissu/model/options.h"

namespace tissu {

struct ChunkPlan;

/// Parameters of a law by name, in SI units: one number, or one for each cell.
using LawParameters = std::map<std::string, std::vector<double>>;

/// They are the same for all cells.
bool uniform(const LawParameters& parameters);

/// A law with its parameters.
struct LawUse {
  std::string law;
  LawParameters parameters;
  std::shared_ptr<const LoadedLaw> loaded = nullptr;  ///< null: the library's law of this name
};

/// What holds across a surface: no stress, as in a sheet that is free in space or in a flat body, or no
/// strain, as in a slice of a long body. A flat body stays in its plane, so that its cells have a right side.
/// Along a line nothing holds it sideways, but it cannot thin under `strain`.
enum class Plane : std::uint8_t { free, stress, strain };

/// What an elastic block is made of, whatever its model. `density` holds one number, or one for each cell.
struct ElasticBlock {
  std::string body;
  std::string element = "tetra";
  std::string law = "stvk";
  std::string quadrature = "full";
  std::vector<std::int32_t> cells;         ///< cell after cell, node numbers of the world, VTK order
  std::vector<std::int32_t> cell_numbers;  ///< of each cell in its body; empty: 0, 1, 2, …
  std::vector<std::int32_t> frames;  ///< of each entry of `cells`, where nodes have rotations; else empty
  std::int32_t first_rotation = 0;   ///< block of the rotation of frame 0; frame k's is first_rotation + k
  LawParameters parameters;          ///< of the law
  std::shared_ptr<const LoadedLaw> loaded = nullptr;  ///< the law itself; null: the library's of this name
  std::vector<LawUse> reinforcements;                 ///< laws whose energies are added: fibres
  std::vector<double> density;                        ///< [kg/m3]
  /// Of surfaces the thickness [m], of lines the area [m2]; one, or one for each cell. Volumes have none.
  std::vector<double> cross_section = {1.0};
  /// Share of the volume that is material: of each cell, or one for all. Every weight is multiplied by it, so
  /// that a cell cut in parts has one copy for each part (virtual nodes: Molino et al. 2004).
  std::vector<double> share = {1.0};
  /// The cell of the first day that each cell comes from, by its number; empty: its own.
  std::vector<std::int32_t> origins;
  /// The cell of the world before an edit whose memory each cell takes over, by its number; empty: its own.
  std::vector<std::int32_t> heirs_of;
  LineSection section;  ///< of lines that bend; others read their area only
  Plane plane = Plane::free;
  ModelOptions model;  ///< which model carries it, and what that one alone asks for
  double fill = 1.0;   ///< share of its chunks that is laid full; the rest is room for cells that edits add
  /// Of a block that was edited: where its cells stood on the first day, one plan for each of the models that
  /// it became; empty: this is the first day.
  std::vector<std::shared_ptr<const ChunkPlan>> plans = {};
};

/// The value of a cell, where there is one for all or one for each.
inline double of_cell(const std::vector<double>& values, std::int32_t cell) {
  return values.size() == 1 ? values.front() : values[static_cast<std::size_t>(cell)];
}

/// The law and what is added to it.
std::vector<LawUse> laws_of(const ElasticBlock& block);
/// Refuses laws that are not known.
const LawInfo& law_info(const ElasticBlock& block, const LawUse& use);
/// Refuses parameters that a law lacks or does not have, and lists that are neither one number nor one for
/// each cell.
void check_laws(const ElasticBlock& block, std::size_t cells);
/// The constants of a law that a cell has, as its kernels read them; refuses parameters out of range.
void cell_constants(const ElasticBlock& block, const LawUse& use, std::int32_t cell,
                    std::span<double> constants);
/// Refuses a list that is neither one number nor one for each cell.
void check_size(const ElasticBlock& block, const std::vector<double>& values, std::string_view what,
                std::size_t cells);
/// "3, 5, 9, 12, 14, …"
std::string first_five(const std::vector<std::int32_t>& numbers);

/// Some of a block's cells, `which` in ascending order, with what belongs to them.
ElasticBlock part_of(const ElasticBlock& block, const std::vector<std::size_t>& which);

/// A block's affine cells and its others apart, when it has both: one J serves an affine cell. `first_cell`
/// is the number in its body of a block whose cells have none. What is not known is left to the model to
/// refuse.
std::vector<ElasticBlock> split_affine(ElasticBlock block, std::int32_t first_cell,
                                       ConstReals rest_positions);

}  // namespace tissu
