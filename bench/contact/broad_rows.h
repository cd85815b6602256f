#pragma once

namespace tissu::bench {

/// The rows "broad phase/NAME/TRIANGLES": a coherent search of a folded sheet of a thousand to a million
/// triangles. `growth` is the power of the number of triangles by which the time grew since a thousand.
/// "broad phase anew/NAME/…": a search of 100,352 triangles with nothing kept from an earlier one.
void add_broad_rows();

}  // namespace tissu::bench
