#pragma once

/// What is compiled for each instruction set in this folder.

#include "ablation.h"
#include "machine.h"
#include "rotation_rows.h"

#define TISSU_BENCH_LOOPS(isa)             \
  namespace tissu::isa {                   \
  bench::MachineKernels machine_loops();   \
  bench::AblationKernels ablation_loops(); \
  bench::RotationKernels rotation_loops(); \
  }
TISSU_BENCH_LOOPS(baseline)
TISSU_BENCH_LOOPS(avx2)
TISSU_BENCH_LOOPS(avx512)
#undef TISSU_BENCH_LOOPS
