#include "base/kernel_choice.h"
#include "solve/kernels/sweep_list.h"

namespace tissu {

template <class T>
SweepRows<T> sweep_rows_of(Isa isa) {
#ifdef TISSU_HAS_AVX512
  if (isa == Isa::avx512) return &avx512::sweep_rows;
#endif
#ifdef TISSU_HAS_AVX2
  if (isa == Isa::avx2) return &avx2::sweep_rows;
#endif
  (void)isa;
  return &baseline::sweep_rows;
}

template SweepRows<double> sweep_rows_of(Isa);
template SweepRows<float> sweep_rows_of(Isa);

}  // namespace tissu
