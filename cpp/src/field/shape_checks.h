#pragma once

/// What the shape functions refuse of a request, whatever the function.

#include "shape_row.h"

namespace tissu {

/// The sentence's beginning: body "liver": , or nothing where no body is named.
std::string message_start(const FieldNames& names);

/// Names, numbers and sizes the user gives. The function's row of the list.
const ShapeFunctionInfo& check_use(const ShapeFunctionUse& use, const std::string& where);

/// Three finite coordinates each; at least one frame.
void check_positions(ConstReals positions, const std::string& what, const std::string& where);

/// Two frames closer than 1e-9 of the extent of all would share their weights in no defined way.
void check_distinct(ConstReals frames, const Nearest& nearest, const std::string& where);

/// (0.1, 0.2, 0.3) m
std::string at(const Vec3& x);

}  // namespace tissu
