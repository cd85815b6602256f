#include "assembly/kernels/product_list.h"
#include "base/kernel_choice.h"

namespace tissu {

template <class T>
MultiplyRows<T> multiply_rows_of(Isa isa) {
#ifdef TISSU_HAS_AVX512
  if (isa == Isa::avx512) return &avx512::multiply_rows;
#endif
#ifdef TISSU_HAS_AVX2
  if (isa == Isa::avx2) return &avx2::multiply_rows;
#endif
  (void)isa;
  return &baseline::multiply_rows;
}

MultiplyThree multiply_three_of(Isa isa) {
#ifdef TISSU_HAS_AVX512
  if (isa == Isa::avx512) return &avx512::multiply_three;
#endif
#ifdef TISSU_HAS_AVX2
  if (isa == Isa::avx2) return &avx2::multiply_three;
#endif
  (void)isa;
  return &baseline::multiply_three;
}

template MultiplyRows<double> multiply_rows_of(Isa);
template MultiplyRows<float> multiply_rows_of(Isa);

}  // namespace tissu
