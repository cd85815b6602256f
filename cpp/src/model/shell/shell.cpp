#include "tissu/model/shell/shell.h"

#include <algorithm>
#include <array>
#include <limits>
#include <map>
#include <numeric>
#include <utility>

#include "tissu/base/error.h"

namespace tissu {
namespace {

constexpr std::size_t kNodes = 3;
constexpr std::size_t kUnknowns = 2 * kNodes;

void check(const ElasticBlock& block) {
  const std::string asks = "body \"" + block.body + "\" asks for the model shell ";
  if (block.quadrature != "full") {
    throw ParameterError(asks + "with the quadrature \"" + block.quadrature + "\"; this model takes full.");
  }
  if (block.plane == Plane::strain) {
    throw ParameterError(asks + "under plane strain; a shell is free to thin: take plane stress.");
  }
  if (block.frames.size() != block.cells.size()) {
    throw ParameterError(asks + "with the rotations of " + std::to_string(block.frames.size()) +
                         " corners of its cells, which have " + std::to_string(block.cells.size()) +
                         "; give every corner the frame of its node.");
  }
  std::map<std::int32_t, std::int32_t> node_of;  // a frame that two nodes shared would be added to at a time
  std::map<std::int32_t, std::int32_t> frame_of;
  for (std::size_t i = 0; i < block.cells.size(); ++i) {
    const std::int32_t node = block.cells[i];
    const std::int32_t frame = block.frames[i];
    if (frame >= 0 && node_of.try_emplace(frame, node).first->second == node &&
        frame_of.try_emplace(node, frame).first->second == frame) {
      continue;
    }
    throw ParameterError(asks + "with frame " + std::to_string(frame) + " at node " + std::to_string(node) +
                         "; every node has one frame of its own.");
  }
}

}  // namespace

ModelInfo Shell::info() {
  using enum Ability::Can;
  return {.name = "shell",
          .form = "thin walls: membrane and bending, linear in axes that turn with each triangle",
          .laws = {"hooke"},
          .elements = {"triangle"},
          .poisson = {yes, "of the law"},
          .rotation = {yes, "any"},
          .strain = {partly, "linear in the triangle's axes"},
          .inversion = {yes, "a wall has no inside"},
          .topology = {yes, "cell by cell"}};
}

Shell::Shell(ElasticBlock block, ConstReals rest_positions, Isa /*isa*/, Threads threads)
    : CellModel(std::move(block), threads) {
  check(block_);
  check_laws(block_, static_cast<std::size_t>(cell_count()));
  const LawUse law = laws_of(block_).front();
  std::array<double, 2> constants;  // for the sake of what they refuse
  for (std::int32_t cell = 0; cell < (uniform(law.parameters) ? 1 : cell_count()); ++cell) {
    cell_constants(block_, law, cell, constants);
  }
  lay_cells(rest_positions, {.frames = false, .triangular = false});
  keep_volumes();
  lay_unknowns();
  lay_elements(rest_positions);
}

void Shell::lay_unknowns() {
  unknowns_.reserve(2 * block_.cells.size());
  for (std::size_t i = 0; i < block_.cells.size(); ++i) {
    unknowns_.push_back(block_.cells[i]);
    unknowns_.push_back(block_.first_rotation + block_.frames[i]);
  }
}

void Shell::lay_elements(ConstReals rest_positions) {
  const double drilling = options_or_defaults<ShellOptions>(block_.model).drilling;
  elements_.reserve(order_.element.size());
  for (const std::int32_t cell : order_.element) {
    const std::int32_t* nodes = block_.cells.data() + kNodes * static_cast<std::size_t>(cell);
    const auto corner = [&](int a) { return Vec3(tissu::block(rest_positions, nodes[a])); };
    elements_.emplace_back(
        std::array{corner(0), corner(1), corner(2)},
        ShellSection{of_cell(block_.cross_section, cell), of_cell(block_.parameters.at("young"), cell),
                     of_cell(block_.parameters.at("poisson"), cell), drilling, of_cell(block_.share, cell)});
  }
}

template <class Function>
void Shell::for_cells(Function&& f) const {
  for_chunks(order_, [&](const Chunk& chunk) {
    const auto end = static_cast<std::size_t>(chunk.end) * kLanes;
    for (auto i = static_cast<std::size_t>(chunk.begin) * kLanes; i < end; ++i) {
      if (order_.real[i] != 0) f(i, static_cast<std::size_t>(order_.element[i]), elements_[i]);
    }
  });
}

ShellPose Shell::pose(const State& state, std::size_t cell) const {
  ShellPose pose;
  for (std::size_t a = 0; a < kNodes; ++a) {
    const std::size_t i = cell * kNodes + a;
    pose.positions[a] = tissu::block(ConstReals(state.positions), block_.cells[i]);
    pose.rotations[a] = state.rotations[static_cast<std::size_t>(block_.frames[i])].toRotationMatrix();
  }
  return pose;
}

void Shell::scatter(const Vec18& values, std::size_t cell, Reals to) const {
  for (std::size_t k = 0; k < kUnknowns; ++k) {
    tissu::block(to, unknowns_[cell * kUnknowns + k]) += values.segment<3>(static_cast<Eigen::Index>(3 * k));
  }
}

void Shell::couple(SparsityBuilder& builder) const {
  builder.add_cells(unknowns_, static_cast<int>(kUnknowns));
}

void Shell::bind(const Sparsity& pattern) {
  lay_slots(order_, unknowns_, static_cast<int>(kUnknowns), pattern, slots_);
}

void Shell::add_force(const State& state, Scratch& /*scratch*/, Reals f) const {
  for_cells([&](std::size_t, std::size_t cell, const ShellElement& element) {
    scatter(element.force(pose(state, cell)), cell, f);
  });
}

void Shell::add_stiffness(const State& state, Scratch& /*scratch*/, StiffnessScale scale,
                          BlockMatrix& matrix) const {
  if (scale.position == 0.0) return;
  double* values = matrix.values();
  for_cells([&](std::size_t lane, std::size_t cell, const ShellElement& element) {
    const ShellPose now = pose(state, cell);
    const Mat18 K = scale.definite ? element.material_stiffness(now) : element.stiffness(now);
    const std::int32_t* slots =
        slots_.data() + lane / kLanes * kUnknowns * kUnknowns * kLanes + lane % kLanes;
    for (int row = 0; row < 18; row += 3) {
      for (int column = 0; column < 18; column += 3, slots += kLanes) {
        Eigen::Map<Mat3>(values + 9 * static_cast<std::ptrdiff_t>(*slots)) -=
            scale.position * K.block<3, 3>(row, column);
      }
    }
  });
}

void Shell::add_product(const State& state, Scratch& /*scratch*/, StiffnessScale scale, ConstReals p,
                        Reals out) const {
  if (scale.position == 0.0) return;
  for_cells([&](std::size_t, std::size_t cell, const ShellElement& element) {
    Vec18 of_cell;
    for (std::size_t k = 0; k < kUnknowns; ++k) {
      of_cell.segment<3>(static_cast<Eigen::Index>(3 * k)) = tissu::block(p, unknowns_[cell * kUnknowns + k]);
    }
    scatter(-scale.position * element.product(pose(state, cell), of_cell), cell, out);
  });
}

double Shell::energy(const State& state, Scratch& scratch) const {
  const Reals energies = scratch.reals(elements_.size());
  std::ranges::fill(energies, 0.0);  // of lanes that pad
  for_cells([&](std::size_t lane, std::size_t cell, const ShellElement& element) {
    energies[lane] = element.energy(pose(state, cell));
  });
  return std::accumulate(energies.begin(), energies.end(), 0.0);
}

void Shell::add_inertias(std::vector<Mat3>& of_frames) const {
  for_lanes([&](std::size_t lane, std::size_t cell) {
    const double density = of_cell(block_.density, static_cast<std::int32_t>(cell));
    for (std::size_t a = 0; a < kNodes; ++a) {
      const auto frame = static_cast<std::size_t>(block_.frames[cell * kNodes + a]);
      of_frames[frame].diagonal().array() += elements_[lane].nodal_inertia(density);
    }
  });
}

CellFields Shell::fields(const State& state) const {
  CellFields fields;
  const auto cells = static_cast<std::size_t>(cell_count());
  for (auto* values : {&fields.von_mises, &fields.energy_density, &fields.volume_ratio})
    values->resize(cells);
  for_cells([&](std::size_t, std::size_t cell, const ShellElement& element) {
    const ShellPose now = pose(state, cell);
    const ShellStress stress = element.stress(now);
    fields.von_mises[cell] = std::max(stress.top, stress.bottom);
    fields.energy_density[cell] = element.energy(now) / element.volume();
    fields.volume_ratio[cell] = element.volume_ratio(now);
  });
  return fields;
}

double Shell::least_volume_ratio(const State& state, Scratch& scratch) const {
  const Reals ratios = scratch.reals(elements_.size());
  std::ranges::fill(ratios, std::numeric_limits<double>::infinity());  // of lanes that pad
  for_cells([&](std::size_t lane, std::size_t cell, const ShellElement& element) {
    ratios[lane] = element.volume_ratio(pose(state, cell));
  });
  return least(ratios);
}

std::size_t Shell::bytes() const {
  return CellModel::bytes() + elements_.size() * sizeof(ShellElement) +
         unknowns_.size() * sizeof(std::int32_t);
}

std::size_t Shell::reals_per_cell() const { return sizeof(ShellElement) / sizeof(double); }

}  // namespace tissu
