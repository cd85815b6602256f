#include "tissu/haptic/serial_device.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/ioctl.h>
#include <termios.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cstring>

#include "tissu/base/error.h"
#include "tissu/base/number_text.h"
#include "tissu/haptic/device_claim.h"
#include "tissu/haptic/frame_stream.h"

namespace tissu::haptic {
namespace {

speed_t speed_of(int baud) {
  switch (baud) {
    case 921'600:
      return B921600;
    case 1'000'000:
      return B1000000;
    case 2'000'000:
      return B2000000;
    case 4'000'000:
      return B4000000;
    default:
      throw ParameterError("found " + std::to_string(baud) +
                           " baud; 921600, 1000000, 2000000 and 4000000 are accepted.");
  }
}

/// Bytes as they are: no echo, no characters of control, no waiting.
bool make_raw(int line, speed_t speed) {
  termios settings{};
  if (tcgetattr(line, &settings) != 0) return false;
  cfmakeraw(&settings);
  settings.c_cflag |= CLOCAL | CREAD;
  settings.c_cc[VMIN] = 0;
  settings.c_cc[VTIME] = 0;
  return cfsetspeed(&settings, speed) == 0 && tcsetattr(line, TCSANOW, &settings) == 0;
}

class SerialDevice final : public Device {
 public:
  explicit SerialDevice(const SerialOptions& options)
      : claim_("serial " + options.path),
        info_(options.info),
        line_(open(options.path.c_str(), O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC)) {
    try {
      begin(options);
    } catch (const Error&) {
      if (line_ >= 0) close(line_);
      throw;
    }
  }
  SerialDevice(const SerialDevice&) = delete;
  SerialDevice& operator=(const SerialDevice&) = delete;
  SerialDevice(SerialDevice&&) = delete;
  SerialDevice& operator=(SerialDevice&&) = delete;
  ~SerialDevice() override {
    write({});
    close(line_);
  }

  DeviceStatus read(Sample& sample) noexcept override {
    if (has_first_) {
      has_first_ = false;
      sample = first_;
      return DeviceStatus::ok;
    }
    bool found = false;
    const std::int64_t before = stream_.skipped();
    for (int k = 0; k < kMostReads; ++k) {
      const std::span<std::uint8_t> room = stream_.room();
      const ssize_t length = ::read(line_, room.data(), room.size());
      if (length < 0 && errno != EAGAIN && errno != EINTR)
        return found ? DeviceStatus::ok : DeviceStatus::gone;
      if (length <= 0) break;
      found = stream_.take(static_cast<std::size_t>(length), sample) || found;
    }
    if (found) return DeviceStatus::ok;
    if (stream_.skipped() > before) return DeviceStatus::broken;
    return is_gone() ? DeviceStatus::gone : DeviceStatus::none;
  }

  DeviceStatus write(const Command& command) noexcept override {
    const Answer answer = answer_of(command);
    const ssize_t length = ::write(line_, answer.data(), answer.size());
    if (length == static_cast<ssize_t>(answer.size())) return DeviceStatus::ok;
    return length < 0 && errno != EAGAIN && errno != EINTR ? DeviceStatus::gone : DeviceStatus::none;
  }

  [[nodiscard]] DeviceInfo info() const noexcept override { return info_; }

 private:
  static constexpr int kMostReads = 8;  // a bound on the time of `read`

  void begin(const SerialOptions& options) {
    if (line_ < 0) {
      throw Error("no device is at " + options.path + " (" + std::strerror(errno) +
                  "); plug it in, or check the path and who may open it.");
    }
    if (ioctl(line_, TIOCEXCL) != 0 || !make_raw(line_, speed_of(options.baud))) {
      throw Error(options.path + " is not a serial line (" + std::strerror(errno) +
                  "); name one, such as /dev/ttyACM0.");
    }
    if (!meet(options.wait)) {
      throw Error("the device at " + options.path + " gives no frame within " + number_text(options.wait) +
                  " s; switch it on, and check that both sides have " + std::to_string(options.baud) +
                  " baud.");
    }
  }

  /// A line without bytes and one that was unplugged read alike.
  [[nodiscard]] bool is_gone() const noexcept {
    pollfd question{.fd = line_, .events = POLLIN, .revents = 0};
    return poll(&question, 1, 0) > 0 && (question.revents & (POLLHUP | POLLERR | POLLNVAL)) != 0;
  }

  /// Waits for the first frame, which is kept for `read`.
  bool meet(double wait) {
    const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(wait);
    while (std::chrono::steady_clock::now() < end) {
      write({});
      pollfd question{.fd = line_, .events = POLLIN, .revents = 0};
      poll(&question, 1, 20);
      if (read(first_) == DeviceStatus::ok) return has_first_ = true;
    }
    return false;
  }

  DeviceClaim claim_;
  DeviceInfo info_;
  int line_;
  FrameStream stream_;
  Sample first_;
  bool has_first_ = false;
};

}  // namespace

std::unique_ptr<Device> open_serial_device(const SerialOptions& options) {
  speed_of(options.baud);
  return std::make_unique<SerialDevice>(options);
}

}  // namespace tissu::haptic
