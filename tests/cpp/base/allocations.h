#pragma once

/// Counts what is asked of malloc and its kin, below operator new and below Eigen.

#include <atomic>

#if defined(__GLIBC__) && !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define TISSU_COUNTS_ALLOCATIONS
#endif

namespace tissu::test {

extern constinit std::atomic<bool> counting;     ///< set it around what is to be counted
extern constinit std::atomic<long> allocations;  ///< how many, while `counting`

}  // namespace tissu::test
