#include "tissu/haptic/frame.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string_view>
#include <vector>

#include "tissu/haptic/frame_stream.h"

namespace tissu::haptic {
namespace {

Sample sample(std::uint32_t sequence) {
  return {{1, -2, 3'000'000, -2'147'483'647, 5}, -1'234'567'890'123, sequence, 5, 0xFEDCBA9876543210U};
}

TEST(HapticFrame, ChecksumIsThatOfEthernet) {
  // The check value that catalogues of checksums give for CRC-32.
  const std::string_view text = "123456789";
  const std::vector<std::uint8_t> bytes(text.begin(), text.end());
  EXPECT_EQ(crc32(bytes), 0xCBF43926U);
}

TEST(HapticFrame, StandsInTheOrderThatTheDocumentationGives) {
  const Frame frame = frame_of(sample(0x04030201));
  const std::vector<std::uint8_t> head(frame.begin(), frame.begin() + 8);
  EXPECT_EQ(head, (std::vector<std::uint8_t>{'T', 'S', 'U', '1', 1, 2, 3, 4}));
  EXPECT_EQ(frame[16], 1);     // the first count, little-endian
  EXPECT_EQ(frame[20], 0xFE);  // -2
  EXPECT_EQ(frame[36], 5);     // flags
  EXPECT_EQ(frame[40], 0x10);  // tag
  EXPECT_EQ(frame[47], 0xFE);
}

TEST(HapticFrame, BringsBackEverySampleAndCommand) {
  Sample back;
  ASSERT_TRUE(read_frame(frame_of(sample(7)), back));
  EXPECT_EQ(back.counts, sample(7).counts);
  EXPECT_EQ(back.time_ns, sample(7).time_ns);
  EXPECT_EQ(back.sequence, 7U);
  EXPECT_EQ(back.flags, 5);
  EXPECT_EQ(back.tag, sample(7).tag);
  Command command{{0.5, -0.25, 0.125, 3.0, 0.0}, 99, 20, true};
  Command found;
  ASSERT_TRUE(read_answer(answer_of(command), found));
  EXPECT_EQ(found.torque, command.torque);  // numbers that floats hold
  EXPECT_EQ(found.sequence, 99U);
  EXPECT_EQ(found.watchdog_ms, 20);
  EXPECT_TRUE(found.enable);
}

TEST(HapticFrame, EveryFlippedBitIsRefused) {
  const Frame whole = frame_of(sample(7));
  for (std::size_t bit = 0; bit < 8 * kFrameBytes; ++bit) {
    Frame frame = whole;
    frame[bit / 8] = static_cast<std::uint8_t>(frame[bit / 8] ^ (1U << (bit % 8)));
    Sample back;
    EXPECT_FALSE(read_frame(frame, back)) << "bit " << bit;
    EXPECT_EQ(back.sequence, 0U);
  }
}

TEST(HapticFrame, ATorqueThatIsNotFiniteIsRefused) {
  Command command;
  command.torque[3] = std::numeric_limits<double>::quiet_NaN();
  Command found;
  EXPECT_FALSE(read_answer(answer_of(command), found));
}

TEST(HapticFrame, SequencesWrapAndBeginAgain) {
  EXPECT_TRUE(comes_after(1, 0));
  EXPECT_FALSE(comes_after(5, 5));
  EXPECT_FALSE(comes_after(4, 5));
  EXPECT_TRUE(comes_after(2, 0xFFFFFFFEU));
  EXPECT_FALSE(comes_after(0xFFFFFFFEU, 2));
  EXPECT_FALSE(comes_after(10, 74));
  EXPECT_TRUE(comes_after(10, 75));
  EXPECT_TRUE(comes_after(0, 5000));  // a device that was switched off and on
}

/// Puts bytes into a stream, at most `most` at a time; the sequences of the samples that it gave.
std::vector<std::uint32_t> read_all(FrameStream& stream, const std::vector<std::uint8_t>& bytes,
                                    std::size_t most) {
  std::vector<std::uint32_t> found;
  for (std::size_t at = 0; at < bytes.size();) {
    const auto room = stream.room();
    const std::size_t count = std::min({most, room.size(), bytes.size() - at});
    std::copy_n(bytes.begin() + static_cast<std::ptrdiff_t>(at), count, room.begin());
    at += count;
    Sample sample;
    if (stream.take(count, sample)) found.push_back(sample.sequence);
  }
  return found;
}

TEST(HapticFrameStream, FindsFramesThatBeginAnywhereAndLosesDamagedOnesOnly) {
  std::vector<std::uint8_t> bytes{'T', 'S', 'U', 'x', 0, 1, 2};  // the end of a frame that was not seen
  for (std::uint32_t k = 1; k <= 5; ++k) {
    Frame frame = frame_of(sample(k));
    if (k == 3) frame[17] ^= 1U;
    bytes.insert(bytes.end(), frame.begin(), frame.end());
  }
  FrameStream stream;
  EXPECT_EQ(read_all(stream, bytes, 1), (std::vector<std::uint32_t>{1, 2, 4, 5}));
  EXPECT_EQ(stream.skipped(), 7 + static_cast<std::int64_t>(kFrameBytes));
  FrameStream at_once;
  EXPECT_EQ(read_all(at_once, bytes, 1000), (std::vector<std::uint32_t>{5}));  // the newest alone
}

TEST(HapticFrameStream, KeepsRoomHoweverMuchOfItIsNoFrame) {
  FrameStream stream;
  const std::vector<std::uint8_t> noise(10'000, 'T');
  EXPECT_TRUE(read_all(stream, noise, 100).empty());
  EXPECT_GT(stream.room().size(), 0U);
}

}  // namespace
}  // namespace tissu::haptic
