#pragma once

namespace tissu::bench {

/// What the process holds in memory [bytes], after what it has given up went back to the system; 0 where the
/// system does not tell.
double resident_bytes();

}  // namespace tissu::bench
