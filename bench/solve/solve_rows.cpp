#include "solve_rows.h"

#include <initializer_list>

namespace tissu::bench {

void add_solve_rows() {
  for (const int size : {1'000, 20'000, 1'000'000}) {
    for (const int threads : {1, 2}) {
      add_product_rows(size, threads);
      add_preconditioner_rows(size, threads);
    }
  }
}

}  // namespace tissu::bench
