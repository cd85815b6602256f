#pragma once

namespace tissu::bench {

/// The rows "pair/…": what one pair costs in the narrow phase (its nearest points) and on its way (the plane
/// test alone, and the share that is free). `ns/pair` is the mean, `worst us` the slowest pair.
void add_pair_rows();

}  // namespace tissu::bench
