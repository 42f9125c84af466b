#include "harness/units.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "problems/error.h"

namespace conebench::harness {
namespace {

TEST(Units, ReadDurations) {
  EXPECT_DOUBLE_EQ(parse_duration_s("60s", "--x"), 60.0);
  EXPECT_DOUBLE_EQ(parse_duration_s("4ms", "--x"), 4e-3);
  EXPECT_DOUBLE_EQ(parse_duration_s("500us", "--x"), 5e-4);
  EXPECT_DOUBLE_EQ(parse_duration_s("20ns", "--x"), 2e-8);
  EXPECT_DOUBLE_EQ(parse_duration_s("2min", "--x"), 120.0);
  EXPECT_DOUBLE_EQ(parse_duration_s("1.5 h", "--x"), 5400.0);
  EXPECT_DOUBLE_EQ(parse_duration_s("0.5", "--x"), 0.5);
}

TEST(Units, ReadSizes) {
  EXPECT_EQ(parse_bytes("2G", "--x"), 2ULL << 30);
  EXPECT_EQ(parse_bytes("512MiB", "--x"), 512ULL << 20);
  EXPECT_EQ(parse_bytes("1.5kB", "--x"), 1500u);
  EXPECT_EQ(parse_bytes("64", "--x"), 64u);
}

TEST(Units, RefuseWhatTheyDoNotKnowAndListWhatTheyDo) {
  for (const char* text : {"60 parsecs", "s", "", "-1s", "0s", "inf", "nan", "1e999s", "1s2"}) {
    EXPECT_THROW(parse_duration_s(text, "--time-limit"), problems::InputError) << text;
  }
  try {
    parse_bytes("2Gb", "--mem");
    FAIL();
  } catch (const problems::InputError& error) {
    EXPECT_THAT(error.what(), testing::StartsWith("--mem: \"2Gb\""));
    EXPECT_THAT(error.what(), testing::HasSubstr("GiB"));
  }
}

TEST(Units, PrintSizes) {
  EXPECT_EQ(format_bytes(512ULL << 20), "512 MiB");
  EXPECT_EQ(format_bytes(3ULL << 29), "1.5 GiB");
}

}  // namespace
}  // namespace conebench::harness
