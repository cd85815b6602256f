#include "kernel_list.h"
#include "point.h"
#include "tissu/law/generated/all.h"

namespace tissu::TISSU_KERNELS {
namespace {

template <class List>
struct Tables;

template <template <class> class... L>
struct Tables<tissu::LawList<L...>> {
  static constexpr LawKernels all[] = {LawAtPoints<L>::table()...};
};

}  // namespace

LawTables law_kernels() { return {Tables<AllLaws>::all, AllLaws::kSize}; }

}  // namespace tissu::TISSU_KERNELS
