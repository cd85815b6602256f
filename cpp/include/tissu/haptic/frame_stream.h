#pragma once

/// Frames out of a stream of bytes, which may begin in the middle of one and lose some.

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "tissu/haptic/frame.h"

namespace tissu::haptic {

class FrameStream {
 public:
  /// The place for bytes that come next; never empty.
  [[nodiscard]] std::span<std::uint8_t> room() noexcept { return std::span(bytes_).subspan(count_); }
  /// Takes `count` bytes that were written into `room()`. Whether a whole frame came that is newer than the
  /// one before; the newest of them is then in `sample`.
  bool take(std::size_t count, Sample& sample) noexcept;
  /// Bytes that belonged to no frame, since the beginning.
  [[nodiscard]] std::int64_t skipped() const noexcept { return skipped_; }

 private:
  std::array<std::uint8_t, 16 * kFrameBytes> bytes_{};
  std::size_t count_ = 0;
  std::int64_t skipped_ = 0;
  std::uint32_t last_ = 0;
  bool first_ = true;
};

}  // namespace tissu::haptic
