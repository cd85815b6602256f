#pragma once

/// The sum of two laws: a base and what is added to it, such as fibres.

#include <array>
#include <cstddef>
#include <string_view>

#include "tissu/law/tensor.h"

namespace tissu {

/// `LawSum<NeoHooke, Fibre>::Of` is a law; its constants are those of the first, then of the second, and its
/// name is "neo_hooke+fibre".
template <template <class> class First, template <class> class Second>
struct LawSum {
  static constexpr std::size_t kSplit = First<double>::kName.size();
  static constexpr auto kText = [] {
    std::array<char, kSplit + 1 + Second<double>::kName.size()> text{};
    for (std::size_t i = 0; i < kSplit; ++i) text[i] = First<double>::kName[i];
    text[kSplit] = '+';
    for (std::size_t i = kSplit + 1; i < text.size(); ++i) text[i] = Second<double>::kName[i - kSplit - 1];
    return text;
  }();

  template <class T>
  struct Of {
    static constexpr std::string_view kName{kText.data(), kText.size()};
    static constexpr bool kLinear = First<T>::kLinear && Second<T>::kLinear;
    static constexpr bool kFrameInvariant = First<T>::kFrameInvariant && Second<T>::kFrameInvariant;
    static constexpr bool kAddition = First<T>::kAddition && Second<T>::kAddition;
    First<T> first;
    Second<T> second;

    [[nodiscard]] T energy(const Tensor2<T>& F) const { return first.energy(F) + second.energy(F); }
    [[nodiscard]] Tensor2<T> stress(const Tensor2<T>& F) const {
      return sum(first.stress(F), second.stress(F));
    }
    [[nodiscard]] Tensor2<T> stress_change(const Tensor2<T>& F, const Tensor2<T>& dF) const {
      return sum(first.stress_change(F, dF), second.stress_change(F, dF));
    }
    [[nodiscard]] Tangent<T> tangent(const Tensor2<T>& F) const {
      Tangent<T> A = first.tangent(F);
      const Tangent<T> B = second.tangent(F);
      TISSU_UNROLL
      for (int i = 0; i < 45; ++i) A.a[i] = A.a[i] + B.a[i];
      return A;
    }

   private:
    static Tensor2<T> sum(Tensor2<T> A, const Tensor2<T>& B) {
      TISSU_UNROLL
      for (int i = 0; i < 9; ++i) A.m[i / 3][i % 3] = A.m[i / 3][i % 3] + B.m[i / 3][i % 3];
      return A;
    }
  };
};

}  // namespace tissu
