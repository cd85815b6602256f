#pragma once

/// Plain structs of the haptic library as classes whose attributes are numbers and arrays.

#include "haptic/arrays.h"
#include "tissu/haptic/kinematics.h"

namespace tissu::haptic::bind {

/// An attribute that is a vector: read as an array, a copy; written from what numpy makes an array of that
/// shape of. `at` gives a reference to the vector in its struct.
template <class Class, class At>
void vector_property(Class& bound, const char* name, At at) {
  using Owner = typename Class::type;
  using Vector = std::decay_t<decltype(at(std::declval<Owner&>()))>;
  bound.def_property(
      name, [at](Owner& owner) { return to_array(at(owner)); },
      [at, name](Owner& owner, const Doubles& value) { at(owner) = to_matrix<Vector>(value, name); });
}

/// An attribute that is a number, a flag or a std::array.
template <class Class, class At>
void number_property(Class& bound, const char* name, At at) {
  using Owner = typename Class::type;
  using Value = std::decay_t<decltype(at(std::declval<Owner&>()))>;
  bound.def_property(
      name, [at](Owner& owner) { return at(owner); },
      [at](Owner& owner, const Value& value) { at(owner) = value; });
}

}  // namespace tissu::haptic::bind

/// `expression` of the struct `s`: settings.limits.slew as the attribute slew, say.
#define TISSU_AT(expression) [](auto& s) -> auto& { return s.expression; }
