#include "tissu/haptic/plugin_device.h"

#include <dlfcn.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "tissu/base/error.h"
#include "tissu/base/number_text.h"
#include "tissu/haptic/device_claim.h"
#include "tissu/haptic/device_plugin.h"

namespace tissu::haptic {
namespace {

struct Close {
  void operator()(void* handle) const { dlclose(handle); }
};
using Library = std::unique_ptr<void, Close>;

Library load(const std::string& file) {
  Library library(dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL));
  if (library == nullptr) {
    throw Error("the plug-in " + file + " cannot be loaded (" + dlerror() +
                "); check its path, and build it here.");
  }
  return library;
}

template <class F>
F* entry(const Library& library, const std::string& file, const char* name) {
  // The only way from what dlsym finds to a function.
  auto* const found = reinterpret_cast<F*>(dlsym(library.get(), name));
  if (found == nullptr) {
    throw Error("the plug-in " + file + " has no function " + name +
                "; build it with tissu/haptic/device_plugin.h.");
  }
  return found;
}

/// The functions of a plug-in, which live as long as its library.
struct Entries {
  explicit Entries(const std::string& file)
      : library(load(file)),
        abi(entry<decltype(tissu_device_abi)>(library, file, "tissu_device_abi")),
        open(entry<decltype(tissu_device_open)>(library, file, "tissu_device_open")),
        read(entry<decltype(tissu_device_read)>(library, file, "tissu_device_read")),
        write(entry<decltype(tissu_device_write)>(library, file, "tissu_device_write")),
        close(entry<decltype(tissu_device_close)>(library, file, "tissu_device_close")) {
    if (abi() != TISSU_DEVICE_ABI) {
      throw Error("the plug-in " + file + " has version " + std::to_string(abi()) +
                  " of the interface; version " + std::to_string(TISSU_DEVICE_ABI) +
                  " is accepted: build it again.");
    }
  }

  Library library;
  decltype(&tissu_device_abi) abi;
  decltype(&tissu_device_open) open;
  decltype(&tissu_device_read) read;
  decltype(&tissu_device_write) write;
  decltype(&tissu_device_close) close;
};

/// What is wrong with what a plug-in says of its device; empty: nothing.
std::string wrong_with(const DeviceInfo& info) {
  if (info.axes < 1 || info.axes > static_cast<int>(kChannels)) {
    return std::to_string(info.axes) + " axes; 1 to 5 are accepted";
  }
  for (std::size_t k = 0; k < static_cast<std::size_t>(info.axes); ++k) {
    if (!(std::isfinite(info.count_size[k]) && info.count_size[k] > 0.0)) {
      return "a count of " + number_text(info.count_size[k]) + " on axis " + std::to_string(k) +
             "; one above 0 is accepted";
    }
    if (!(std::isfinite(info.torque_limit[k]) && info.torque_limit[k] >= 0.0)) {
      return "a torque limit of " + number_text(info.torque_limit[k]) + " on axis " + std::to_string(k) +
             "; 0 or more is accepted";
    }
  }
  if (!(info.rate >= 300.0)) return number_text(info.rate) + " Hz; 300 Hz or more are accepted";
  if (!(info.delay >= 0.0)) return "a delay of " + number_text(info.delay) + " s; 0 or more is accepted";
  return {};
}

class PluginDevice final : public Device {
 public:
  PluginDevice(const std::string& file, const std::string& address)
      : claim_("plugin " + file + " " + address), entries_(file) {
    tissu_device_info found{};
    std::array<char, 512> why{};
    device_ = entries_.open(address.c_str(), &found, why.data(), why.size());
    why.back() = '\0';
    if (device_ == nullptr) {
      const std::string reason = why.front() == '\0' ? "it gives no reason" : why.data();
      throw Error("the plug-in " + file + " opens no device at '" + address + "' (" + reason +
                  "); plug it in, or check the address.");
    }
    info_.axes = found.axes;
    std::ranges::copy(found.count_size, info_.count_size.begin());
    std::ranges::copy(found.torque_limit, info_.torque_limit.begin());
    info_.rate = found.rate;
    info_.delay = found.delay;
    info_.torque_confirmed = found.torque_confirmed != 0;
    const std::string wrong = wrong_with(info_);
    if (wrong.empty()) return;
    entries_.close(device_);
    throw Error("the plug-in " + file + " says of its device: " + wrong + "; correct the plug-in.");
  }
  PluginDevice(const PluginDevice&) = delete;
  PluginDevice& operator=(const PluginDevice&) = delete;
  PluginDevice(PluginDevice&&) = delete;
  PluginDevice& operator=(PluginDevice&&) = delete;
  ~PluginDevice() override {
    write({});
    entries_.close(device_);
  }

  DeviceStatus read(Sample& sample) noexcept override {
    tissu_device_sample found{};
    const int status = entries_.read(device_, &found);
    if (status != TISSU_DEVICE_OK) return status_of(status);
    std::ranges::copy(found.counts, sample.counts.begin());
    sample.time_ns = found.time_ns;
    sample.sequence = found.sequence;
    sample.flags = static_cast<std::uint16_t>(found.flags);
    sample.tag = found.tag;
    return DeviceStatus::ok;
  }

  DeviceStatus write(const Command& command) noexcept override {
    tissu_device_command given{};
    std::ranges::copy(command.torque, std::begin(given.torque));
    given.sequence = command.sequence;
    given.watchdog_ms = command.watchdog_ms;
    given.enable = command.enable ? 1 : 0;
    return status_of(entries_.write(device_, &given));
  }

  [[nodiscard]] DeviceInfo info() const noexcept override { return info_; }

 private:
  static DeviceStatus status_of(int status) noexcept {
    switch (status) {
      case TISSU_DEVICE_OK:
        return DeviceStatus::ok;
      case TISSU_DEVICE_NONE:
        return DeviceStatus::none;
      case TISSU_DEVICE_GONE:
        return DeviceStatus::gone;
      default:
        return DeviceStatus::broken;
    }
  }

  DeviceClaim claim_;
  Entries entries_;
  void* device_ = nullptr;
  DeviceInfo info_;
};

}  // namespace

std::unique_ptr<Device> open_plugin_device(const std::string& library, const std::string& address) {
  return std::make_unique<PluginDevice>(library, address);
}

}  // namespace tissu::haptic
