#pragma once

/// The wire format between a device and its controller, little-endian, the same on every kind of wire.
///
///   frame, 64 bytes, from the device         answer, 36 bytes, to the device
///    0  magic "TSU1"                          0  magic "TSA1"
///    4  sequence               u32            4  sequence that is answered    u32
///    8  time of the device     u64 [ns]       8  torque of five channels      f32[5]
///   16  counts of the channels i32[5]        28  enable, 0 or 1               u16
///   36  flags (`Flag`)         u16           30  watchdog                     u16 [ms]
///   38  zero                   u16           32  crc32 of bytes 0 to 31       u32
///   40  tag of the tool        u64
///   48  zero                   12 bytes
///   60  crc32 of bytes 0 to 59 u32
///
/// The checksum is that of Ethernet and zlib: polynomial 0xEDB88320, reflected, begun and ended with ones.

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "tissu/haptic/device.h"

namespace tissu::haptic {

inline constexpr std::size_t kFrameBytes = 64;
inline constexpr std::size_t kAnswerBytes = 36;
using Frame = std::array<std::uint8_t, kFrameBytes>;
using Answer = std::array<std::uint8_t, kAnswerBytes>;

std::uint32_t crc32(std::span<const std::uint8_t> bytes) noexcept;

Frame frame_of(const Sample& sample) noexcept;
Answer answer_of(const Command& command) noexcept;

/// False where magic or checksum is wrong; the sample is then unchanged.
bool read_frame(std::span<const std::uint8_t, kFrameBytes> frame, Sample& sample) noexcept;
/// The same of an answer, as a device written in C++ reads it. A torque that is not finite is refused too.
bool read_answer(std::span<const std::uint8_t, kAnswerBytes> answer, Command& command) noexcept;

/// Whether a frame comes after another. Sequences wrap; a device that is older by more than 64 frames
/// has begun again, and is taken.
bool comes_after(std::uint32_t sequence, std::uint32_t before) noexcept;

}  // namespace tissu::haptic
