#pragma once

/// Registers of four numbers.

namespace tissu::TISSU_KERNELS {

using FourDoubles = double __attribute__((vector_size(32)));
using FourFloats = float __attribute__((vector_size(16)));

template <class T>
struct FourOf;
template <>
struct FourOf<double> {
  using Type = FourDoubles;
};
template <>
struct FourOf<float> {
  using Type = FourFloats;
};
template <class T>
using Four = typename FourOf<T>::Type;

}  // namespace tissu::TISSU_KERNELS
