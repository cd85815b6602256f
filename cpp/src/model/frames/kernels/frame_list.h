#pragma once

/// The loops of frames for each instruction set.

#include "base/kernel_sets.h"
#include "tissu/model/frames/frame_kernels.h"

TISSU_DECLARE_KERNELS(const FrameKernels* frame_kernels();)
