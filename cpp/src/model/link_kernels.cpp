#include <span>

#include "kernels/link_lists.h"

namespace tissu {
namespace {

struct Lists {
  MassLinkList links;
  MassTensorList tensors;
};

Lists lists(Isa isa) {
#ifdef TISSU_X86_KERNELS
  if (isa == Isa::avx512) return {avx512::mass_link_kernels(), avx512::mass_tensor_kernels()};
  if (isa == Isa::avx2) return {avx2::mass_link_kernels(), avx2::mass_tensor_kernels()};
#endif
  (void)isa;
  return {baseline::mass_link_kernels(), baseline::mass_tensor_kernels()};
}

}  // namespace

const MassLinkKernels* find_mass_link_kernels(Isa isa, std::string_view law) {
  const MassLinkList list = lists(isa).links;
  for (const MassLinkKernels& k : std::span(list.first, list.count)) {
    if (k.law == law) return &k;
  }
  return nullptr;
}

const MassTensorKernels* find_mass_tensor_kernels(Isa isa, bool linear, int size) {
  const MassTensorList list = lists(isa).tensors;
  for (const MassTensorKernels& k : std::span(list.first, list.count)) {
    if (k.linear == linear && k.size == size) return &k;
  }
  return nullptr;
}

}  // namespace tissu
