#include "tissu/haptic/frame_stream.h"

#include <algorithm>

namespace tissu::haptic {

bool FrameStream::take(std::size_t count, Sample& sample) noexcept {
  count_ += count;
  bool found = false;
  std::size_t at = 0;
  while (at + kFrameBytes <= count_) {
    Sample read;
    if (!read_frame(std::span(bytes_).subspan(at).first<kFrameBytes>(), read)) {
      ++at;
      ++skipped_;
      continue;
    }
    at += kFrameBytes;
    if (!first_ && !comes_after(read.sequence, last_)) continue;
    first_ = false;
    last_ = read.sequence;
    sample = read;
    found = true;
  }
  std::copy(bytes_.begin() + static_cast<std::ptrdiff_t>(at),
            bytes_.begin() + static_cast<std::ptrdiff_t>(count_), bytes_.begin());
  count_ -= at;
  return found;
}

}  // namespace tissu::haptic
