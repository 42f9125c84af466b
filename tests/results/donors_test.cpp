#include "results/donors.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "make_record.h"

namespace conebench::results {
namespace {

using testing::HasSubstr;
using testing::Not;

Record step(const std::string& solver, const std::string& donor, int index, double time_s) {
  Record record = make_record("p" + std::to_string(index), solver, 1e-9, time_s);
  record.settings.mode = "sequence";
  record.donor = donor;
  record.sequence = {.name = "s", .id = "s", .index = index, .length = 3};
  return record;
}

Group group_of(std::vector<Record> records) {
  Group group;
  group.settings = records.front().settings;
  group.methods = std::move(records);
  return group;
}

TEST(Donors, TheFirstStepIsNoWarmStart) {
  std::vector<Record> records;
  for (int k = 0; k < 3; ++k) {
    records.push_back(step("a", "", k, k == 0 ? 100.0 : 2.0));
    records.push_back(step("a", "b", k, k == 0 ? 100.0 : 1.0));
  }
  const std::string text = markdown(donor_block(group_of(records)), 3);
  EXPECT_THAT(text, HasSubstr("its own"));
  EXPECT_THAT(text, HasSubstr("2.00 s (2/2)"));
  EXPECT_THAT(text, HasSubstr("1.00 s (2/2)"));
  EXPECT_THAT(text, Not(HasSubstr("100")));
}

TEST(Donors, AFailureIsCountedAndNoTime) {
  std::vector<Record> records;
  for (int k = 0; k < 3; ++k) {
    records.push_back(step("a", "", k, 2.0));
    records.push_back(step("a", "b", k, 1.0));
  }
  records.back().eta = 1.0;
  const std::string text = markdown(donor_block(group_of(records)), 3);
  EXPECT_THAT(text, HasSubstr("1.00 s (1/2)"));
  EXPECT_THAT(text, HasSubstr("over the 1 steps"));
}

TEST(Donors, WithOneDonorThereIsNothingToCompare) {
  EXPECT_TRUE(donor_block(group_of({step("a", "", 1, 1.0), step("b", "", 1, 1.0)})).empty());
}

}  // namespace
}  // namespace conebench::results
