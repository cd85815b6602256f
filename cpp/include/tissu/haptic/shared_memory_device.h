#pragma once

/// A device that another process of this machine plays, through memory that both have.
///
///   0    version of the frame   u32, odd while it is written     64   frame, 64 bytes as in `frame.h`
///   128  version of the answer  u32, odd while it is written     192  answer, 36 bytes
///
/// The device makes the memory of 256 bytes (shm_open) and writes frames; the controller writes answers. A
/// reader copies what it reads between two looks at the version, and has it only where both were the same
/// even number.

#include <memory>
#include <string>

#include "tissu/haptic/device.h"

namespace tissu::haptic {

struct SharedMemoryOptions {
  std::string name;   ///< of the memory, such as /trocar
  double wait = 1.0;  ///< longest wait for the first frame [s]
  DeviceInfo info;
};

/// Throws `Error` where there is no such memory, it is too small or holds no frame, or another controller has
/// it.
std::unique_ptr<Device> open_shared_memory_device(const SharedMemoryOptions& options);

}  // namespace tissu::haptic
