#include "tissu/base/number_text.h"

#include <gtest/gtest.h>

namespace tissu {
namespace {

// What a user gave is found again in the message, however small, large or near to a limit it is.
TEST(NumberText, IsWhatWasGiven) {
  EXPECT_EQ(number_text(-2e-9), "-2e-09");
  EXPECT_EQ(number_text(0.5), "0.5");
  EXPECT_EQ(number_text(1.00001), "1.00001");
  EXPECT_EQ(number_text(1000000.0), "1e+06");
  EXPECT_EQ(number_text(0.0), "0");
}

TEST(NumberText, HasFourDigitsOfWhatWasComputed) {
  EXPECT_EQ(number_text(1.0 / 3.0), "0.3333");
  EXPECT_EQ(number_text(-1234567.89), "-1.235e+06");
}

}  // namespace
}  // namespace tissu
