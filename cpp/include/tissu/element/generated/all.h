// Made by `python -m tissu.codegen --update`, elements version 1, from
// python/tissu/codegen/elements.py. Change that, not this.

#pragma once

#include "tissu/element/generated/hexahedron.h"
#include "tissu/element/generated/hexahedron20.h"
#include "tissu/element/generated/hexahedron27.h"
#include "tissu/element/generated/line.h"
#include "tissu/element/generated/line3.h"
#include "tissu/element/generated/pyramid.h"
#include "tissu/element/generated/pyramid13.h"
#include "tissu/element/generated/quad.h"
#include "tissu/element/generated/quad8.h"
#include "tissu/element/generated/quad9.h"
#include "tissu/element/generated/tetra.h"
#include "tissu/element/generated/tetra10.h"
#include "tissu/element/generated/triangle.h"
#include "tissu/element/generated/triangle6.h"
#include "tissu/element/generated/wedge.h"
#include "tissu/element/generated/wedge15.h"

namespace tissu {

inline constexpr int kElementCount = 16;

/// Calls f with an object of each element's type, in the order of the table.
template <class Function>
constexpr void for_each_element(Function&& f) {
  f(Line2{});
  f(Line3{});
  f(Triangle3{});
  f(Triangle6{});
  f(Quad4{});
  f(Quad8{});
  f(Quad9{});
  f(Tetra4{});
  f(Tetra10{});
  f(Hexahedron8{});
  f(Hexahedron20{});
  f(Hexahedron27{});
  f(Wedge6{});
  f(Wedge15{});
  f(Pyramid5{});
  f(Pyramid13{});
}

}  // namespace tissu
