#include "tissu/model/dilatation/mean_dilatation.h"

#include <array>

#include "patch_matrix.h"

namespace tissu {
namespace {

constexpr std::size_t kMostNodes = 8;  ///< of a cell

static_assert(ElementOrder::chunk_size(kMostNodes) == kMostChunkCells);

/// PatchParts of one chunk. Not initialised: it is made on the stack of every call.
struct ChunkParts {
  std::array<double, kMostChunkCells * kMostNodes*(kMostNodes + 1) / 2 * 9> matrices;
  std::array<double, kMostChunkCells * kMostNodes * 3> stresses;
  std::array<double, kMostChunkCells * kMostNodes * 3> volumes;
  std::array<double, kMostChunkCells> slopes;
  std::array<double, kMostChunkCells> curvatures;

  PatchParts view() {
    return {matrices.data(), stresses.data(), volumes.data(), slopes.data(), curvatures.data()};
  }
};

}  // namespace

Loops<MeanDilatationKernels, MeanDilatationView> MeanDilatation::loops() const {
  MeanDilatationView view{.cells = cell_view(),
                          .first_patch = table_.first_patch.data(),
                          .first_lane = table_.first_lane.data(),
                          .lanes = table_.lanes.data(),
                          .inverse_volumes = table_.inverse_volumes.data()};
  view.cells.gradients = gradients_.data();
  view.cells.laws = laws_.data();
  view.cells.law_count = static_cast<int>(laws_.size());
  return {*kernels_, view, order_};
}

void MeanDilatation::couple(SparsityBuilder& builder) const {
  for (std::size_t p = 0; p + 1 < table_.first_node.size(); ++p) {
    const std::int32_t count = table_.first_node[p + 1] - table_.first_node[p];
    builder.add_cells({table_.nodes.data() + table_.first_node[p], static_cast<std::size_t>(count)}, count);
  }
}

void MeanDilatation::bind(const Sparsity& pattern) {
  table_.slots.resize(static_cast<std::size_t>(table_.first_slot.back()));
  threads_.for_pieces(table_.count(), [&](std::int32_t begin, std::int32_t end) {
    for (auto p = static_cast<std::size_t>(begin); p < static_cast<std::size_t>(end); ++p) {
      std::int32_t* slot = table_.slots.data() + table_.first_slot[p];
      for (std::int32_t a = table_.first_node[p]; a < table_.first_node[p + 1]; ++a) {
        for (std::int32_t b = table_.first_node[p]; b < table_.first_node[p + 1]; ++b) {
          *slot++ = pattern.slot(table_.nodes[static_cast<std::size_t>(a)],
                                 table_.nodes[static_cast<std::size_t>(b)]);
        }
      }
    }
  });
}

void MeanDilatation::add_force(const State& state, Scratch& /*scratch*/, Reals f) const {
  force_by(loops(), state.positions, f);
}

void MeanDilatation::add_product(const State& state, Scratch& /*scratch*/, StiffnessScale scale, ConstReals p,
                                 Reals out) const {
  product_by(loops(), state.positions, scale.position, p, out);
}

void MeanDilatation::add_stiffness(const State& state, Scratch& /*scratch*/, StiffnessScale scale,
                                   BlockMatrix& matrix) const {
  if (scale.position == 0.0) return;
  const auto cells = loops();
  double* values = matrix.values();
  for_chunks(order_, [&](const Chunk& chunk) {
    ChunkParts parts;
    kernels_->stiffness(cells.view, chunk, state.positions.data(), parts.view());
    add_patches(chunk, parts.view(), scale, values);
  });
}

void MeanDilatation::add_patches(const Chunk& chunk, const PatchParts& parts, StiffnessScale scale,
                                 double* blocks) const {
  const int nodes = reference_.nodes;
  const std::int32_t pairs = nodes * (nodes + 1) / 2;
  const auto first = table_.first_patch[static_cast<std::size_t>(chunk.begin)];
  const auto end = table_.first_patch[static_cast<std::size_t>(chunk.end)];
  PatchMatrix patch;
  for (auto p = static_cast<std::size_t>(first); p < static_cast<std::size_t>(end); ++p) {
    patch.begin(table_.first_node[p + 1] - table_.first_node[p]);
    std::ptrdiff_t lane = 0;
    for (std::int32_t i = table_.first_lane[p]; i < table_.first_lane[p + 1]; ++i) {
      lane = table_.lanes[static_cast<std::size_t>(i)] - chunk.begin * ElementOrder::kLanes;
      const std::uint8_t* places = table_.places.data() + static_cast<std::ptrdiff_t>(i) * nodes;
      patch.add_cell(places, nodes, parts.matrices + lane * pairs * 9);
      patch.add_vectors(places, nodes, parts.stresses + lane * nodes * 3, parts.volumes + lane * nodes * 3);
    }
    patch.close(parts.slopes[lane], parts.curvatures[lane]);
    if (scale.definite) patch.make_definite();
    patch.scatter(table_.slots.data() + table_.first_slot[p], -scale.position, blocks);
  }
}

double MeanDilatation::energy(const State& state, Scratch& scratch) const {
  return energy_by(loops(), state.positions, scratch);
}

void MeanDilatation::add_part_energies(const State& state, Scratch& scratch,
                                       std::span<const std::int32_t> part_of, Reals energies) const {
  add_by_part(order_, energies_by(loops(), state.positions, scratch), block_.cells,
              static_cast<std::size_t>(reference_.nodes), part_of, energies);
}

CellFields MeanDilatation::fields(const State& state) const { return fields_by(loops(), state.positions); }

std::size_t MeanDilatation::bytes() const {
  return CellModel::bytes() + table_.bytes() + of_cell_.size() * sizeof(std::int32_t) +
         (shape_.rest.size() + constants_.size() + X_.size()) * sizeof(double);
}

std::size_t MeanDilatation::reals_per_cell() const {
  std::size_t own = 0;  // of the law, where cells differ
  if (constants_stride_ != 0) own = static_cast<std::size_t>(constants_stride_) / kLanes;
  return static_cast<std::size_t>(shape_.rest_points) * shape_.reals + own + 1;  // 1 / V
}

}  // namespace tissu
