#include "batch_math_lanes.h"

#include "tissu/base/batch_math.h"

namespace tissu::TISSU_KERNELS {
namespace {

template <Batch (*kFunction)(Batch)>
void over(const double* x, double* y, std::size_t count) {
  for (std::size_t i = 0; i < count; i += kWidth) kFunction(Batch::load(x + i)).store(y + i);
}

Batch logs(Batch x) { return log(x); }
Batch exps(Batch x) { return exp(x); }
Batch cbrts(Batch x) { return cbrt(x); }
Batch inverse_cbrts(Batch x) { return inverse_cbrt(x); }

}  // namespace

test::BatchMath batch_math() { return {&over<logs>, &over<exps>, &over<cbrts>, &over<inverse_cbrts>}; }

}  // namespace tissu::TISSU_KERNELS
