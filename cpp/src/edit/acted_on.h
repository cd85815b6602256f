#pragma once

/// Nodes on which something acts.

#include <string_view>
#include <vector>

#include "tissu/world/description.h"

namespace tissu {

/// Sets `may_move` to 0 for nodes of a body that a support holds or leads, that a load acts on, and to which
/// tissue is tied.
void keep_acted_on(const WorldDescription& description, std::string_view body, std::vector<char>& may_move);

/// Sets `is_held` to 1 for nodes of a body that a support holds or leads.
void mark_held(const WorldDescription& description, std::string_view body, std::vector<char>& is_held);

}  // namespace tissu
