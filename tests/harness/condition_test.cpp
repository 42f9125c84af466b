#include "harness/condition.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <nlohmann/json.hpp>

#include "harness/where.h"
#include "problems/error.h"

namespace conebench::harness {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::ThrowsMessage;
using Json = nlohmann::ordered_json;

Condition gate(const std::string& expression) {
  return {expression, {.option = "--gate", .noun = "quantity", .names = {"sgm(time)", "failures"}}};
}

bool passes(const std::string& expression, double time, double failures) {
  return gate(expression).matches({{"sgm(time)", time}, {"failures", failures}});
}

TEST(Gate, ReadsNamesWithParentheses) {
  EXPECT_TRUE(passes("sgm(time) < 1.05 && failures <= 0", 1.04, 0));
  EXPECT_FALSE(passes("sgm(time) < 1.05 && failures <= 0", 1.06, 0));
  EXPECT_FALSE(passes("sgm(time)<1.05&&failures<=0", 1.04, 1));
  EXPECT_TRUE(passes("sgm( time ) < 1.05", 1.0, 0));
  EXPECT_TRUE(passes("!(sgm(time) >= 1.05) || (failures == 3)", 2.0, 3));
}

TEST(Gate, AnInfiniteQuantityComparesAndAMissingOneFails) {
  EXPECT_FALSE(passes("sgm(time) < 1.05", std::numeric_limits<double>::infinity(), 0));
  EXPECT_FALSE(gate("sgm(time) < 1.05").matches({{"sgm(time)", nullptr}, {"failures", 0}}));
  EXPECT_FALSE(gate("sgm(time) >= 1.05").matches({{"sgm(time)", nullptr}, {"failures", 0}}));
}

void expect_refused(const std::string& expression, const std::string& place,
                    const std::string& expected) {
  EXPECT_THAT([&] { gate(expression); },
              ThrowsMessage<problems::InputError>(
                  AllOf(HasSubstr("--gate: "), HasSubstr(place), HasSubstr(expected))))
      << expression;
}

TEST(Gate, PointsAtThePlaceItDoesNotUnderstand) {
  expect_refused("failures <", "at its end", "expected a quantity, a number");
  expect_refused("failures < 0 & failures", "at '& failures'", "expected an operator or the end");
  expect_refused("failures < 0 || sgm(tme) < 1", "at 'sgm(tme) < 1'", "did you mean 'sgm(time)'?");
  expect_refused("sgm(time < 1", "at '< 1'", "expected ')'");
  expect_refused("(failures < 1", "at its end", "expected ')'");
  expect_refused("speed > 1", "at 'speed > 1'", "known: sgm(time), failures");
  expect_refused("", "at its end", "expected a quantity");
}

TEST(Gate, AnUnknownNameIsRefusedEvenWhereItWouldNotBeLookedAt) {
  EXPECT_THROW(gate("true || speed > 1"), problems::InputError);
}

TEST(Where, ComparesTheFactsOfAProblem) {
  const Json facts = {{"cones", 2000}, {"engine", "mpm"}, {"coulomb", true}, {"scene", nullptr}};
  EXPECT_TRUE(Where("cones > 1e3 && engine == \"mpm\"").matches(facts));
  EXPECT_FALSE(Where("cones > 1e3 && !coulomb").matches(facts));
  EXPECT_TRUE(Where("scene != 'column'").matches(facts));
  EXPECT_FALSE(Where("scene == 'column'").matches(facts));
  EXPECT_THAT([&] { return Where("cone > 1").matches(facts); },
              ThrowsMessage<problems::InputError>(
                  HasSubstr("--where: 'cone' is no fact of a problem (did you mean 'cones'?)")));
  EXPECT_THROW(Where("engine > 3").matches(facts), problems::InputError);
}

}  // namespace
}  // namespace conebench::harness
