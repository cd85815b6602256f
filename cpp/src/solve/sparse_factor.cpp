#include "sparse_factor.h"

#include "factor_library.h"
#include "singular_matrix.h"
#include "work.h"

namespace tissu {
namespace {

constexpr double kFirstShift = 1e-4;
constexpr double kLastShift = 1e6;

}  // namespace

SparseFactor::SparseFactor() : library_(std::make_unique<Library>()) {}
SparseFactor::~SparseFactor() = default;
std::string_view SparseFactor::library() { return Library::kName; }
double SparseFactor::making_work(double operations, double numbers, double rows) {
  return operations / Library::kOperationsPerByte + kFactorNumber * numbers + kFactorRow * rows;
}

void SparseFactor::take_pattern(const BlockMatrix& matrix, const Couplings* couplings) {
  making_ = once_ = 0.0;
  if (!library_->lower.update_pattern(matrix, couplings)) return;
  library_->analyse();
  once_ = kOrdering * matrix.rows();
}

bool SparseFactor::factorise() {
  const bool made = library_->factorise();
  making_ += making_work(operations(), library_->numbers, library_->rows());
  return made;
}

void SparseFactor::make(const BlockMatrix& matrix, bool coupled) {
  const Couplings* couplings = coupled ? matrix.couplings() : nullptr;
  Library& l = *library_;
  l.ready = false;
  take_pattern(matrix, couplings);
  double shift = 0.0;
  l.lower.update_values(matrix, couplings, shift);
  while (!factorise()) {
    shift = shift == 0.0 ? kFirstShift : 10.0 * shift;
    if (shift > kLastShift) refuse_factor(matrix);
    l.lower.update_values(matrix, couplings, shift);
  }
  l.definite = shift == 0.0;
  l.ready = true;
  l.id = matrix.id();
  l.version = coupled ? matrix.version() : matrix.values_version();
}

bool SparseFactor::attempt(const BlockMatrix& matrix) {
  Library& l = *library_;
  l.ready = false;
  take_pattern(matrix, nullptr);
  l.lower.update_values(matrix, nullptr, 0.0);
  l.definite = factorise();
  if (!l.definite) return false;
  l.ready = true;
  l.id = matrix.id();
  l.version = matrix.values_version();
  return true;
}

bool SparseFactor::is_of(const BlockMatrix& matrix, bool coupled) const {
  const std::uint64_t version = coupled ? matrix.version() : matrix.values_version();
  return library_->ready && library_->id == matrix.id() && library_->version == version;
}
bool SparseFactor::is_definite() const { return library_->definite; }
void SparseFactor::solve(ConstReals b, Reals x) { library_->solve(1, b, x); }
void SparseFactor::solve_all(int columns, ConstReals b, Reals x) { library_->solve(columns, b, x); }
void SparseFactor::forget() { library_->ready = false; }
double SparseFactor::operations() const { return library_->operations; }
double SparseFactor::application() const { return kFactorSolve * 2.0 * number_bytes(); }
double SparseFactor::number_bytes() const { return sizeof(double) * library_->numbers; }

std::size_t SparseFactor::bytes() const {
  const LowerTriangle& lower = library_->lower;
  return library_->bytes() + lower.values.size() * (sizeof(double) + sizeof(int));
}

}  // namespace tissu
