#include "frames.h"

#include "frame_list.h"
#include "frames_stiffness.h"

namespace tissu::TISSU_KERNELS {
namespace {
constexpr FrameKernels kTable = {&FrameLoops::gradient, &FrameLoops::gradient_change, &FrameLoops::force,
                                 &FrameLoops::force_change, &FrameStiffness::add};
}  // namespace

const FrameKernels* frame_kernels() { return &kTable; }

}  // namespace tissu::TISSU_KERNELS
