#include "tissu/haptic/shared_memory_device.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <thread>

#include "tissu/base/error.h"
#include "tissu/base/number_text.h"
#include "tissu/haptic/device_claim.h"
#include "tissu/haptic/frame.h"

namespace tissu::haptic {
namespace {

constexpr std::size_t kBytes = 256;
constexpr std::size_t kHalf = 128;   // of the frame, then of the answer
constexpr std::size_t kBehind = 64;  // from the version to what it is of

/// Memory of another process, mapped.
class Mapping {
 public:
  explicit Mapping(const std::string& name) {
    const int file = shm_open(name.c_str(), O_RDWR | O_CLOEXEC, 0);
    if (file < 0) {
      throw Error("no device has the shared memory " + name + " (" + std::strerror(errno) +
                  "); start the program that plays it first.");
    }
    struct stat found {};
    const bool large = fstat(file, &found) == 0 && found.st_size >= static_cast<off_t>(kBytes);
    void* const memory =
        large ? mmap(nullptr, kBytes, PROT_READ | PROT_WRITE, MAP_SHARED, file, 0) : MAP_FAILED;
    close(file);
    if (memory == MAP_FAILED) {
      throw Error("the shared memory " + name + " has " + std::to_string(found.st_size) +
                  " bytes; 256 are accepted: make it of that size.");
    }
    bytes_ = static_cast<std::uint8_t*>(memory);
  }
  Mapping(const Mapping&) = delete;
  Mapping& operator=(const Mapping&) = delete;
  Mapping(Mapping&&) = delete;
  Mapping& operator=(Mapping&&) = delete;
  ~Mapping() { munmap(bytes_, kBytes); }

  /// One number of the memory, read and written whole.
  template <class T>
  [[nodiscard]] std::atomic_ref<T> at(std::size_t byte) const noexcept {
    // The memory of another process has no type of its own.
    return std::atomic_ref<T>(*reinterpret_cast<T*>(bytes_ + byte));
  }

 private:
  std::uint8_t* bytes_ = nullptr;
};

class SharedMemoryDevice final : public Device {
 public:
  explicit SharedMemoryDevice(const SharedMemoryOptions& options)
      : claim_("shared memory " + options.name), info_(options.info), memory_(options.name) {
    if (!meet(options.wait)) {
      throw Error("the shared memory " + options.name + " gets no new frame within " +
                  number_text(options.wait) + " s; start the program that plays the device.");
    }
  }
  SharedMemoryDevice(const SharedMemoryDevice&) = delete;
  SharedMemoryDevice& operator=(const SharedMemoryDevice&) = delete;
  SharedMemoryDevice(SharedMemoryDevice&&) = delete;
  SharedMemoryDevice& operator=(SharedMemoryDevice&&) = delete;
  ~SharedMemoryDevice() override { write({}); }

  DeviceStatus read(Sample& sample) noexcept override {
    Sample found;
    const DeviceStatus status = look(found);
    if (status != DeviceStatus::ok) return status;
    if (!first_ && !comes_after(found.sequence, last_)) return DeviceStatus::none;
    first_ = false;
    last_ = found.sequence;
    sample = found;
    return DeviceStatus::ok;
  }

  DeviceStatus write(const Command& command) noexcept override {
    std::array<std::uint8_t, 40> bytes{};
    const Answer answer = answer_of(command);
    std::memcpy(bytes.data(), answer.data(), answer.size());
    const std::atomic_ref<std::uint32_t> version = memory_.at<std::uint32_t>(kHalf);
    const std::uint32_t next = (version.load(std::memory_order_relaxed) | 1U) + 1U;
    version.store(next - 1U, std::memory_order_relaxed);
    for (std::size_t k = 0; k < bytes.size(); k += sizeof(std::uint64_t)) {
      std::uint64_t word = 0;
      std::memcpy(&word, &bytes[k], sizeof word);
      memory_.at<std::uint64_t>(kHalf + kBehind + k).store(word, std::memory_order_release);
    }
    version.store(next, std::memory_order_release);
    return DeviceStatus::ok;
  }

  [[nodiscard]] DeviceInfo info() const noexcept override { return info_; }

 private:
  static constexpr int kMostLooks = 4;  // while the device writes: a bound on the time of `read`

  /// The frame that stands in the memory.
  DeviceStatus look(Sample& sample) const noexcept {
    const std::atomic_ref<std::uint32_t> version = memory_.at<std::uint32_t>(0);
    for (int k = 0; k < kMostLooks; ++k) {
      const std::uint32_t before = version.load(std::memory_order_acquire);
      Frame frame;
      for (std::size_t byte = 0; byte < frame.size(); byte += sizeof(std::uint64_t)) {
        const std::uint64_t word = memory_.at<std::uint64_t>(kBehind + byte).load(std::memory_order_acquire);
        std::memcpy(&frame[byte], &word, sizeof word);
      }
      if ((before & 1U) != 0U || version.load(std::memory_order_relaxed) != before) continue;
      if (before == 0U) return DeviceStatus::none;  // nothing was written yet
      return read_frame(frame, sample) ? DeviceStatus::ok : DeviceStatus::broken;
    }
    return DeviceStatus::none;
  }

  /// Waits until frames change: memory that a device has left behind still holds its last one.
  bool meet(double wait) {
    const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(wait);
    Sample first;
    bool seen = false;
    while (std::chrono::steady_clock::now() < end) {
      Sample found;
      if (look(found) == DeviceStatus::ok) {
        if (seen && found.sequence != first.sequence) return true;
        first = found;
        seen = true;
      }
      write({});
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    return false;
  }

  DeviceClaim claim_;
  DeviceInfo info_;
  Mapping memory_;
  std::uint32_t last_ = 0;
  bool first_ = true;
};

}  // namespace

std::unique_ptr<Device> open_shared_memory_device(const SharedMemoryOptions& options) {
  return std::make_unique<SharedMemoryDevice>(options);
}

}  // namespace tissu::haptic
