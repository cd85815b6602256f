#pragma once

/// Loops over elements made for one element, law and quadrature together.

#include "tissu/cell/elastic_kernels.h"

namespace tissu {

/// The kernels compiled for an element, a law and a quadrature together, null when there are none.
const ElasticKernels* find_fused_kernels(Isa isa, std::string_view element, std::string_view law,
                                         std::string_view quadrature);

}  // namespace tissu
