#include "tissu/haptic/frame.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <type_traits>

namespace tissu::haptic {
namespace {

constexpr std::array<std::uint8_t, 4> kFrameMagic{'T', 'S', 'U', '1'};
constexpr std::array<std::uint8_t, 4> kAnswerMagic{'T', 'S', 'A', '1'};

constexpr std::array<std::uint32_t, 256> crc_table() {
  std::array<std::uint32_t, 256> table{};
  for (std::uint32_t byte = 0; byte < table.size(); ++byte) {
    std::uint32_t rest = byte;
    for (int bit = 0; bit < 8; ++bit) rest = (rest >> 1U) ^ ((rest & 1U) != 0U ? 0xEDB88320U : 0U);
    table[byte] = rest;
  }
  return table;
}

template <class T>
void put(std::span<std::uint8_t> bytes, std::size_t at, T value) noexcept {
  const auto number = static_cast<std::uint64_t>(static_cast<std::make_unsigned_t<T>>(value));
  for (std::size_t k = 0; k < sizeof(T); ++k) bytes[at + k] = static_cast<std::uint8_t>(number >> (8 * k));
}

template <class T>
T got(std::span<const std::uint8_t> bytes, std::size_t at) noexcept {
  std::uint64_t number = 0;
  for (std::size_t k = 0; k < sizeof(T); ++k) number |= static_cast<std::uint64_t>(bytes[at + k]) << (8 * k);
  return static_cast<T>(static_cast<std::make_unsigned_t<T>>(number));
}

/// Whether the bytes begin with the magic and end with their checksum.
bool is_whole(std::span<const std::uint8_t> bytes, const std::array<std::uint8_t, 4>& magic) noexcept {
  if (!std::equal(magic.begin(), magic.end(), bytes.begin())) return false;
  const std::size_t end = bytes.size() - 4;
  return got<std::uint32_t>(bytes, end) == crc32(bytes.first(end));
}

}  // namespace

std::uint32_t crc32(std::span<const std::uint8_t> bytes) noexcept {
  static constexpr std::array<std::uint32_t, 256> kTable = crc_table();
  std::uint32_t rest = ~0U;
  for (const std::uint8_t byte : bytes) rest = (rest >> 8U) ^ kTable[(rest ^ byte) & 0xFFU];
  return ~rest;
}

Frame frame_of(const Sample& sample) noexcept {
  Frame frame{};
  std::ranges::copy(kFrameMagic, frame.begin());
  put(frame, 4, sample.sequence);
  put(frame, 8, sample.time_ns);
  for (std::size_t k = 0; k < kChannels; ++k) put(frame, 16 + 4 * k, sample.counts[k]);
  put(frame, 36, sample.flags);
  put(frame, 40, sample.tag);
  put(frame, kFrameBytes - 4, crc32(std::span(frame).first(kFrameBytes - 4)));
  return frame;
}

Answer answer_of(const Command& command) noexcept {
  Answer answer{};
  std::ranges::copy(kAnswerMagic, answer.begin());
  put(answer, 4, command.sequence);
  for (std::size_t k = 0; k < kChannels; ++k) {
    put(answer, 8 + 4 * k, std::bit_cast<std::uint32_t>(static_cast<float>(command.torque[k])));
  }
  put(answer, 28, static_cast<std::uint16_t>(command.enable ? 1 : 0));
  put(answer, 30, command.watchdog_ms);
  put(answer, kAnswerBytes - 4, crc32(std::span(answer).first(kAnswerBytes - 4)));
  return answer;
}

bool read_frame(std::span<const std::uint8_t, kFrameBytes> frame, Sample& sample) noexcept {
  if (!is_whole(frame, kFrameMagic)) return false;
  sample.sequence = got<std::uint32_t>(frame, 4);
  sample.time_ns = got<std::int64_t>(frame, 8);
  for (std::size_t k = 0; k < kChannels; ++k) sample.counts[k] = got<std::int32_t>(frame, 16 + 4 * k);
  sample.flags = got<std::uint16_t>(frame, 36);
  sample.tag = got<std::uint64_t>(frame, 40);
  return true;
}

bool read_answer(std::span<const std::uint8_t, kAnswerBytes> answer, Command& command) noexcept {
  if (!is_whole(answer, kAnswerMagic)) return false;
  Channels torque{};
  for (std::size_t k = 0; k < kChannels; ++k) {
    torque[k] = static_cast<double>(std::bit_cast<float>(got<std::uint32_t>(answer, 8 + 4 * k)));
    if (!std::isfinite(torque[k])) return false;
  }
  command.torque = torque;
  command.sequence = got<std::uint32_t>(answer, 4);
  command.enable = got<std::uint16_t>(answer, 28) == 1;
  command.watchdog_ms = got<std::uint16_t>(answer, 30);
  return true;
}

bool comes_after(std::uint32_t sequence, std::uint32_t before) noexcept {
  constexpr std::int32_t kBegunAgain = 64;  // frames: none is overtaken by so many
  const auto ahead = static_cast<std::int32_t>(sequence - before);
  return ahead > 0 || ahead < -kBegunAgain;
}

}  // namespace tissu::haptic
