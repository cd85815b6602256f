#pragma once

/// A device that speaks the frames of `frame.h` over a serial line.

#include <memory>
#include <string>

#include "tissu/haptic/device.h"

namespace tissu::haptic {

struct SerialOptions {
  std::string path;    ///< of the line, such as /dev/ttyACM0; a pseudo-terminal too
  int baud = 921'600;  ///< 921600, 1000000, 2000000 or 4000000; no less carries a frame a millisecond
  double wait = 1.0;   ///< longest wait for the first frame [s]
  DeviceInfo info;
};

/// Throws `Error` where the line is not there, is not a terminal, or gives no frame, or where another
/// controller has it, `ParameterError` for another speed.
std::unique_ptr<Device> open_serial_device(const SerialOptions& options);

}  // namespace tissu::haptic
