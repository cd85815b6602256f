#pragma once

/// The loops of frames for each instruction set.

#include "tissu/model/frame_kernels.h"

namespace tissu {

namespace baseline {
const FrameKernels* frame_kernels();
}
namespace avx2 {
const FrameKernels* frame_kernels();
}
namespace avx512 {
const FrameKernels* frame_kernels();
}

}  // namespace tissu
