// Policies: read back as written, and the ladder that an engine climbs.

#include "harness/policy.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "harness/step_solver.h"
#include "problems/error.h"
#include "problems/made_backwards.h"
#include "problems/private_folder.h"
#include "problems/residual.h"

namespace conebench::harness {
namespace {

using problems::Problem;
using testing::HasSubstr;

Problem small_problem() { return problems::make_backwards({.cones = 30, .seed = 3}).problem; }

Policy some_policy() {
  Policy policy;
  policy.scene = "column \"dry\"";
  policy.tol = 1e-6;
  policy.budget_s = 4e-3;
  policy.confidence = 0.95;
  policy.probability = 0.875;
  policy.ladder = {{"gs[omega=0.8]", 4e-3}, {"auto", 10.0}};
  return policy;
}

class Policies : public testing::Test {
 protected:
  std::filesystem::path write(const std::string& text) const {
    const std::filesystem::path path = folder_.path() / "policy.toml";
    std::ofstream(path) << text;
    return path;
  }

  std::string error_of(const std::string& text) const {
    try {
      read_policy(write(text));
    } catch (const problems::InputError& error) {
      return error.what();
    }
    return "no error";
  }

  problems::PrivateFolder folder_;
};

TEST_F(Policies, AreReadAsTheyWereWritten) {
  const Policy policy = some_policy();
  const Policy read = read_policy(write(to_toml(policy)));
  EXPECT_EQ(read.scene, policy.scene);
  EXPECT_EQ(read.tol, policy.tol);
  EXPECT_EQ(read.budget_s, policy.budget_s);
  EXPECT_EQ(read.confidence, policy.confidence);
  EXPECT_EQ(read.probability, policy.probability);
  ASSERT_EQ(read.ladder.size(), 2u);
  EXPECT_EQ(read.ladder[0].solver, "gs[omega=0.8]");
  EXPECT_EQ(read.ladder[0].time_limit_s, 4e-3);
  EXPECT_EQ(read.ladder[1].solver, "auto");
}

TEST_F(Policies, SayWhatIsWrongWithThem) {
  const std::string head =
      "schema = 1\nscene = \"s\"\ntol = 1e-6\nbudget_s = 1\nconfidence = 0.9\nprobability = 0.5\n";
  const auto rung = [&](const std::string& solver) {
    return head + "[[ladder]]\nsolver = \"" + solver + "\"\ntime_limit_s = 1\n";
  };
  EXPECT_EQ(error_of(rung("gs")), "no error");
  EXPECT_THAT(error_of(head), HasSubstr("expected at least one solver"));
  EXPECT_THAT(error_of(rung("gauss")), HasSubstr("gauss"));
  EXPECT_THAT(error_of(rung("policy:other.toml")), HasSubstr("policies do not nest"));
  EXPECT_THAT(error_of(rung("gs") + "speed = 1\n"), HasSubstr("speed"));
  EXPECT_THAT(error_of("schema = 2\n"), HasSubstr("schema is 2"));
  EXPECT_THAT(error_of(rung("gs").replace(head.find("1e-6"), 4, "-1")), HasSubstr("tol"));
}

// The first rung cannot do it in one iteration's time; the second can.
TEST_F(Policies, TheLadderIsClimbedUntilEtaIsSmallEnough) {
  const Problem problem = small_problem();
  Policy policy = some_policy();
  policy.tol = 1e-9;
  policy.ladder = {{"gs", 1e-9}, {"newton-ac", 10.0}, {"auto", 10.0}};
  const Eigen::VectorXd zero = Eigen::VectorXd::Zero(problem.rows());
  const engine::StepAnswer answer = make_policy_solver(policy, 1000)(problem, zero);
  EXPECT_TRUE(answer.converged);
  EXPECT_LE(problems::evaluate_eta(problem, answer.r), 1e-9);
  const engine::StepAnswer first =
      make_step_solver({.name = "gs", .tol = 1e-9, .time_limit_s = 1e-9})(problem, zero);
  EXPECT_FALSE(first.converged);
  EXPECT_GT(answer.solve_s, first.solve_s);
}

TEST_F(Policies, AnEngineGetsTheBestAnswerWhereEveryRungMisses) {
  const Problem problem = small_problem();
  Policy policy = some_policy();
  policy.tol = 1e-300;
  policy.ladder = {{"newton-ac", 10.0}, {"gs", 1e-9}};
  const Eigen::VectorXd zero = Eigen::VectorXd::Zero(problem.rows());
  const engine::StepAnswer answer = make_policy_solver(policy, 50)(problem, zero);
  EXPECT_FALSE(answer.converged);
  EXPECT_LT(problems::evaluate_eta(problem, answer.r), 1e-9);
}

TEST_F(Policies, ARungThatCannotTakeTheStepIsPassedOver) {
  const Problem problem = problems::make_backwards({.cones = 6, .dims = {2}, .seed = 3}).problem;
  Policy policy = some_policy();
  const Eigen::VectorXd zero = Eigen::VectorXd::Zero(problem.rows());
  policy.ladder = {{"gs[local=quartic]", 1.0}, {"gs", 10.0}};
  EXPECT_TRUE(make_policy_solver(policy, 10000)(problem, zero).converged);
  policy.ladder.pop_back();
  EXPECT_THROW(make_policy_solver(policy, 10000)(problem, zero), problems::InputError);
}

TEST_F(Policies, AreSolversByTheNameOfTheirFile) {
  const Problem problem = small_problem();
  const auto file = write(to_toml(some_policy()));
  const engine::StepSolver solver = make_step_solver({.name = "policy:" + file.string()});
  const Eigen::VectorXd zero = Eigen::VectorXd::Zero(problem.rows());
  EXPECT_LE(problems::evaluate_eta(problem, solver(problem, zero).r), 1e-6);
  EXPECT_THROW(make_step_solver({.name = "policy:" + file.string() + "x"}), problems::InputError);
}

}  // namespace
}  // namespace conebench::harness
