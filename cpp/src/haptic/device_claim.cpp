#include "tissu/haptic/device_claim.h"

#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstddef>
#include <cstring>

#include "tissu/base/error.h"

namespace tissu::haptic {

DeviceClaim::DeviceClaim(const std::string& name) : socket_(socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC, 0)) {
  if (socket_ < 0) {
    throw Error("the device " + name + " cannot be claimed (" + std::strerror(errno) +
                "); close other files.");
  }
  // The first byte of an abstract name is zero. A name that is too long keeps its end, in which
  // devices differ.
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  const std::string held = "tissu-trocar/" + name;
  const std::size_t room = sizeof(address.sun_path) - 1;
  const std::size_t length = std::min(room, held.size());
  std::copy(held.end() - static_cast<std::ptrdiff_t>(length), held.end(), &address.sun_path[1]);
  const auto bytes = static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + 1 + length);
  // The interface of sockets takes every kind of address by one type.
  if (bind(socket_, reinterpret_cast<const sockaddr*>(&address), bytes) == 0) return;
  const int error = errno;
  close(socket_);
  if (error == EADDRINUSE) {
    throw Error("the device " + name + " has a controller already; one is accepted: stop the other one.");
  }
  throw Error("the device " + name + " cannot be claimed (" + std::strerror(error) + "); try again.");
}

DeviceClaim::~DeviceClaim() { close(socket_); }

}  // namespace tissu::haptic
