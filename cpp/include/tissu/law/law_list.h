#pragma once

#include <type_traits>

namespace tissu {

/// Names a class template as a type, to hand it to a function: `for_each([](auto tag) { ... })`.
template <template <class> class L>
struct LawTag {
  template <class T>
  using Of = L<T>;
};

/// A list of laws, class templates over the scalar.
template <template <class> class... L>
struct LawList {
  static constexpr int kSize = static_cast<int>(sizeof...(L));

  /// The same list as arguments of another template, over a scalar: `As<testing::Types, double>`.
  template <template <class...> class To, class T>
  using As = To<L<T>...>;

  /// Calls f(LawTag<L>{}) for each.
  template <class Function>
  static constexpr void for_each(Function&& f) {
    (f(LawTag<L>{}), ...);
  }
};

}  // namespace tissu
