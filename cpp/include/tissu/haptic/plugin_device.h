#pragma once

/// A device of a shared library with the five functions of `device_plugin.h`.

#include <memory>
#include <string>

#include "tissu/haptic/device.h"

namespace tissu::haptic {

/// `library`: its file. `address`: which device, in the plug-in's own words.
/// Throws `Error` where the library cannot be loaded, lacks a function, has another version or opens no
/// device, where what it says of the device cannot be, or where another controller has it.
std::unique_ptr<Device> open_plugin_device(const std::string& library, const std::string& address);

}  // namespace tissu::haptic
