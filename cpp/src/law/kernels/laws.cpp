#include "law_kernel_list.h"
#include "point.h"
#include "tissu/law/generated/all.h"

namespace tissu::TISSU_KERNELS {
namespace {

template <class Volume, class Thin>
struct Tables;

template <template <class> class... L, template <class> class... Thin>
struct Tables<tissu::LawList<L...>, tissu::LawList<Thin...>> {
  static constexpr LawKernels all[] = {LawAtPoints<L>::table()..., LawAtPoints<Thin, 2>::table()...,
                                       LawAtPoints<Thin, 1>::table()...};
};

}  // namespace

KernelList<LawKernels> law_kernels() {
  return {Tables<AllLaws, ThinLaws>::all, AllLaws::kSize + 2 * ThinLaws::kSize};
}

}  // namespace tissu::TISSU_KERNELS
