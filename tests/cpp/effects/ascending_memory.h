#pragma once

namespace tissu::effects {

/// From now on each new block of memory lies above those before it, larger ones at pages, and none is used
/// again. What a copy takes depends on where its blocks begin, and a loop over two arrays asks which is the
/// lower one, so that otherwise counts depended on what ran before.
void let_memory_ascend();

}  // namespace tissu::effects
