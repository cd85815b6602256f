#include "tissu/haptic/udp_device.h"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cmath>
#include <cstdint>
#include <cstring>

#include "tissu/base/error.h"
#include "tissu/base/number_text.h"
#include "tissu/haptic/device_claim.h"
#include "tissu/haptic/frame.h"

namespace tissu::haptic {
namespace {

std::string place_of(const UdpOptions& options) { return options.host + ":" + std::to_string(options.port); }

sockaddr_in address_of(const UdpOptions& options) {
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(static_cast<std::uint16_t>(options.port));
  if (options.port < 1 || options.port > 65535 ||
      inet_pton(AF_INET, options.host.c_str(), &address.sin_addr) != 1) {
    throw ParameterError(
        "found the device " + place_of(options) +
        "; an address in numbers and a port of 1 to 65535 are accepted, such as 192.168.1.20:7001.");
  }
  return address;
}

class UdpDevice final : public Device {
 public:
  explicit UdpDevice(const UdpOptions& options)
      : claim_("udp " + place_of(options)), info_(options.info), socket_(socket(AF_INET, kKind, 0)) {
    const sockaddr_in address = address_of(options);
    // The interface of sockets takes every kind of address by one type.
    if (socket_ < 0 || connect(socket_, reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0) {
      const std::string reason = std::strerror(errno);
      if (socket_ >= 0) close(socket_);
      throw Error("the device " + place_of(options) + " cannot be reached (" + reason +
                  "); check its network.");
    }
    if (!meet(options.wait)) {
      close(socket_);
      throw Error("no device answers at " + place_of(options) + " within " + number_text(options.wait) +
                  " s; switch it on, or check its address.");
    }
  }
  UdpDevice(const UdpDevice&) = delete;
  UdpDevice& operator=(const UdpDevice&) = delete;
  UdpDevice(UdpDevice&&) = delete;
  UdpDevice& operator=(UdpDevice&&) = delete;
  ~UdpDevice() override {
    write({});
    close(socket_);
  }

  DeviceStatus read(Sample& sample) noexcept override {
    DeviceStatus status = DeviceStatus::none;
    for (int k = 0; k < kMostFrames; ++k) {
      const ssize_t length = recv(socket_, bytes_.data(), bytes_.size(), 0);
      if (length < 0) {
        if (errno == ECONNREFUSED) return status == DeviceStatus::ok ? status : DeviceStatus::gone;
        return status;
      }
      Sample found;
      if (length != kFrameBytes || !read_frame(std::span(bytes_).first<kFrameBytes>(), found)) {
        if (status == DeviceStatus::none) status = DeviceStatus::broken;
        continue;
      }
      if (!first_ && !comes_after(found.sequence, last_)) continue;
      first_ = false;
      last_ = found.sequence;
      sample = found;
      status = DeviceStatus::ok;
    }
    return status;
  }

  DeviceStatus write(const Command& command) noexcept override {
    const Answer answer = answer_of(command);
    if (send(socket_, answer.data(), answer.size(), MSG_NOSIGNAL) == static_cast<ssize_t>(answer.size())) {
      return DeviceStatus::ok;
    }
    return errno == ECONNREFUSED ? DeviceStatus::gone : DeviceStatus::none;
  }

  [[nodiscard]] DeviceInfo info() const noexcept override { return info_; }

 private:
  static constexpr int kKind = SOCK_DGRAM | SOCK_NONBLOCK | SOCK_CLOEXEC;
  static constexpr int kMostFrames = 64;  // that are read at a time: a bound on the time of `read`

  /// Asks for the first frame until it comes, or the time is over. It is left for `read`.
  bool meet(double wait) noexcept {
    constexpr int kBetween = 20;  // [ms] between two questions
    for (int left = static_cast<int>(std::lround(1e3 * wait)); left > 0; left -= kBetween) {
      write({});
      pollfd question{.fd = socket_, .events = POLLIN, .revents = 0};
      if (poll(&question, 1, kBetween) > 0 && (question.revents & POLLIN) != 0) return true;
      if ((question.revents & POLLERR) != 0) {  // nothing listens there yet: the error is taken out
        int error = 0;
        socklen_t size = sizeof error;
        getsockopt(socket_, SOL_SOCKET, SO_ERROR, &error, &size);
        poll(nullptr, 0, kBetween);
      }
    }
    return false;
  }

  DeviceClaim claim_;
  DeviceInfo info_;
  int socket_;
  std::array<std::uint8_t, kFrameBytes + 1> bytes_{};  // one more, so that a frame that is too long is seen
  std::uint32_t last_ = 0;
  bool first_ = true;
};

}  // namespace

std::unique_ptr<Device> open_udp_device(const UdpOptions& options) {
  address_of(options);
  return std::make_unique<UdpDevice>(options);
}

}  // namespace tissu::haptic
