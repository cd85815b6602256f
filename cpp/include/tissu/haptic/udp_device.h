#pragma once

/// A device that speaks the frames of `frame.h` over UDP.

#include <memory>
#include <string>

#include "tissu/haptic/device.h"

namespace tissu::haptic {

struct UdpOptions {
  std::string host = "127.0.0.1";  ///< address of the device, in numbers
  int port = 0;                    ///< of the device, 1 to 65535
  double wait = 1.0;               ///< longest wait for the first frame [s]
  DeviceInfo info;
};

/// Sends an answer that switches the motors off, takes the first frame, and has the device from then on.
/// Frames of other senders are not taken. Throws `Error` where nothing answers, or another controller has the
/// device, `ParameterError` for an address that is none.
std::unique_ptr<Device> open_udp_device(const UdpOptions& options);

}  // namespace tissu::haptic
