#pragma once

/// The preconditioner that a word names.

#include <memory>

#include "diagonal_preconditioner.h"
#include "incomplete_cholesky.h"
#include "multigrid.h"
#include "stale_cholesky.h"

namespace tissu {

template <class T>
std::unique_ptr<Preconditioner<T>> make_preconditioner(Preconditioning kind) {
  switch (kind) {
    case Preconditioning::jacobi:
      return std::make_unique<Jacobi<T>>();
    case Preconditioning::incomplete_cholesky:
      return std::make_unique<IncompleteCholesky<T>>();
    case Preconditioning::stale_cholesky:
      return std::make_unique<StaleCholesky<T>>();
    case Preconditioning::multigrid:
      return std::make_unique<Multigrid<T>>();
    case Preconditioning::block_jacobi:
      break;
  }
  return std::make_unique<BlockJacobi<T>>();
}

}  // namespace tissu
