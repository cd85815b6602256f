#pragma once

/// One controller for each device: a name that one process of the machine can hold, and once.

#include <string>

namespace tissu::haptic {

/// Holds a name until it is destroyed or its process ends. It is a Unix socket in the abstract name space,
/// which leaves no file behind.
class DeviceClaim {
 public:
  /// `name`: of the device, such as "udp 192.168.1.20:7001". Throws `Error` where another controller holds
  /// it.
  explicit DeviceClaim(const std::string& name);
  DeviceClaim(const DeviceClaim&) = delete;
  DeviceClaim& operator=(const DeviceClaim&) = delete;
  DeviceClaim(DeviceClaim&&) = delete;
  DeviceClaim& operator=(DeviceClaim&&) = delete;
  ~DeviceClaim();

 private:
  int socket_ = -1;
};

}  // namespace tissu::haptic
