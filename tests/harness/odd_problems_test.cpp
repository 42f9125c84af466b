// What no method may do, whatever the problem; and that a problem said in other words is solved as
// it was.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <limits>
#include <optional>
#include <stdexcept>
#include <thread>

#include "harness/survey/attempt.h"
#include "harness/survey/transform.h"
#include "problems/error.h"
#include "problems/residual.h"
#include "solvers/registry.h"
#include "tests/harness/test_solvers.h"
#include "tests/solvers/every_method.h"

namespace conebench::harness {
namespace {

using problems::Problem;
using solvers::Solver;
using solvers::Status;
using solvers::Stop;
using testing::HasSubstr;

// What is solved at all takes milliseconds, with Ipopt a second; on a busy machine far longer.
constexpr double kLimit_s = 60.0;
// Where nothing promises an answer, all of this may be used up.
constexpr double kShortLimit_s = 0.1;

problems::MadeProblem ordinary() {
  return problems::make_backwards({.cones = 12, .mu_high = 0.4, .cohesive_share = 0.3, .seed = 11});
}

Problem dry() {
  return problems::make_backwards({.cones = 12, .mu_high = 0.4, .seed = 11}).problem;
}

Problem with_friction(double mu) {
  return problems::make_backwards({.cones = 12, .mu_low = mu, .mu_high = mu, .seed = 13}).problem;
}

Problem empty() {
  problems::SparseMatrix M(3, 3);
  M.setIdentity();
  return Problem(problems::PrimalData{M, problems::SparseMatrix(0, 3), Eigen::Vector3d::Ones(),
                                      Eigen::VectorXd(0)},
                 {}, {});
}

// The first cone has W_ii = 0: it moves like this whatever r is.
Problem with_one_moving(double normal) {
  return with_prescribed_rate(dry(), 0, Eigen::Vector3d(normal, 0.3, -0.2));
}

std::vector<std::string> all_variants() {
  std::vector<std::string> variants = solvers::kEveryMethod;
  variants.push_back("nlopt");
  return variants;
}

class OddProblems : public testing::TestWithParam<std::string> {
 protected:
  // Whatever the problem: no fault, and no refusal.
  Attempt try_on(const Problem& problem, double limit_s) {
    const Stop stop{.tol = tol_, .time_limit_s = limit_s};
    const Attempt tried = attempt(solver_, problem, stop);
    EXPECT_EQ(fault(tried, problem, stop), "");
    EXPECT_EQ(tried.end, Attempt::End::kReturned) << tried.text;
    return tried;
  }

  // Nothing if the method owes no answer.
  std::optional<Attempt> expect_solved(const Problem& problem) {
    const Attempt tried = try_on(problem, owes_answers_ ? kLimit_s : kShortLimit_s);
    if (!owes_answers_) return std::nullopt;
    EXPECT_EQ(tried.status, Status::kConverged)
        << to_string(tried.status) << ", eta = " << tried.eta;
    return tried;
  }

  // An answer to a twin of what is solved, taken back, is as good an answer: up to a factor, and
  // what rounding does to eta.
  void expect_solved_alike(const Problem& original, const Twin& twin, double factor) {
    const std::optional<Attempt> tried = expect_solved(twin.problem);
    if (!tried || tried->status != Status::kConverged) return;
    const problems::Residual back =
        problems::evaluate_residual(original.shifted(), twin.r_back * tried->r);
    const double rounding = 10.0 * back.attainable_eta;
    EXPECT_LE(back.eta.max, factor * tried->eta + rounding);
    EXPECT_GE(back.eta.max, tried->eta / factor - rounding);
  }

  // In units where W_ii is 1, as Ipopt gets the problem, the reaction of a cone with W_ii = 0 is a
  // million times the others': inside aclm it stalls on some processors (eta 5e-2 seen).
  void ask_less_of_ipopt() {
    if (GetParam().find("ipopt") != std::string::npos) tol_ = 1e-6;
    if (GetParam() == "aclm-ipopt") owes_answers_ = false;
  }

  Solver solver_ = solvers::make_solver(GetParam());
  double tol_ = std::max(1e-8, 5.0 * solvers::attainable(GetParam()));
  // NLopt's algorithms stall short of 1e-8 on most problems of this size.
  bool owes_answers_ = GetParam() != "nlopt";
};

TEST_P(OddProblems, RefuseAGuessThatHoldsANaN) {
  const Problem problem = ordinary().problem;
  Eigen::VectorXd guess = Eigen::VectorXd::Zero(problem.rows());
  guess(4) = std::numeric_limits<double>::quiet_NaN();
  const Attempt tried = attempt(solver_, problem, {.time_limit_s = kShortLimit_s}, guess);
  EXPECT_EQ(tried.end, Attempt::End::kInputError) << tried.text;
  EXPECT_THAT(tried.text, HasSubstr("NaN"));
}

TEST_P(OddProblems, OrdinaryProblemIsSolved) { expect_solved(ordinary().problem); }

TEST_P(OddProblems, EmptyProblemIsSolved) {
  EXPECT_EQ(try_on(empty(), kLimit_s).status, Status::kConverged);
}

TEST_P(OddProblems, OneConeIsSolved) {
  for (const int cone : {1, 2, 3}) expect_solved(alone(ordinary(), cone));
}

// No method has to solve it: only honesty is asked for.
TEST_P(OddProblems, LargeFrictionIsJudgedHonestly) { try_on(with_friction(5.0), kShortLimit_s); }

TEST_P(OddProblems, TinyFrictionIsSolved) { expect_solved(with_friction(1e-10)); }

TEST_P(OddProblems, StrengthFarAboveTheOtherForcesIsSolved) {
  expect_solved(with_strength(dry(), 1e6));
}

TEST_P(OddProblems, ConeThatOpensWhateverItsReactionIsSolved) {
  ask_less_of_ipopt();
  expect_solved(with_one_moving(1.0));
}

TEST_P(OddProblems, ConeThatSlidesOffWhateverItsReactionIsSolved) {
  ask_less_of_ipopt();
  expect_solved(with_one_moving(0.0));
}

TEST_P(OddProblems, ConeThatClosesWhateverItsReactionIsNotSolved) {
  EXPECT_NE(try_on(with_one_moving(-1.0), kShortLimit_s).status, Status::kConverged);
}

TEST_P(OddProblems, UnitsDoNotMatter) {
  const Problem original = ordinary().problem;
  expect_solved_alike(original, in_units(original, 1e6, 1.0), 1.1);
  expect_solved_alike(original, in_units(original, 1.0, 1e6), 1.1);
  expect_solved_alike(original, in_units(original, 1e6, 1e6), 1.1);
}

TEST_P(OddProblems, DirectionsOfTangentsDoNotMatter) {
  const Problem original = ordinary().problem;
  expect_solved_alike(original, with_turned_tangents(original, 14), 1.1);
}

TEST_P(OddProblems, OrderDoesNotMatter) {
  const Problem original = ordinary().problem;
  expect_solved_alike(original, in_random_order(original, 15), 1.1);
}

TEST_P(OddProblems, DuplicatedConesDoNotMatter) {
  const Problem original = ordinary().problem;
  expect_solved_alike(original, with_cones_twice(original), 2.0);
}

INSTANTIATE_TEST_SUITE_P(Registered, OddProblems, testing::ValuesIn(all_variants()),
                         solvers::test_name);

// A twin's eta at any r' is that of the original at the same r', so that the tests above judge
// methods and not words.
TEST(Twins, HaveTheEtaAndTheRateOfTheOriginal) {
  const Problem original =
      problems::make_backwards({.dims = {3, 1, 6, 2}, .cohesive_share = 0.5, .seed = 11}).problem;
  for (const Twin& twin : {in_units(original, 1e6, 1.0), in_units(original, 1e-6, 1e6),
                           with_turned_tangents(original, 14), in_random_order(original, 15)}) {
    const Eigen::VectorXd r_twin = twin.problem.mobility().maxCoeff() /
                                   original.mobility().maxCoeff() *
                                   Eigen::VectorXd::LinSpaced(twin.problem.rows(), -1.0, 2.0);
    const Problem standard = original.shifted(), standard_twin = twin.problem.shifted();
    const Eigen::VectorXd r = twin.r_back * r_twin;
    const double eta = problems::evaluate_eta(standard, r);
    EXPECT_NEAR(problems::evaluate_eta(standard_twin, r_twin), eta, 1e-11 * eta);
    const Eigen::VectorXd u = standard.rate(r);
    EXPECT_LE((twin.u_back * standard_twin.rate(r_twin) - u).norm(), 1e-11 * u.norm());
  }
}

// Every fault, committed on purpose.
class Faults : public testing::Test {
 protected:
  std::string fault_of(const std::function<void(Eigen::VectorXd&)>& act) {
    const Attempt tried = attempt(solver_that("at fault", act), problem_, stop_);
    return fault(tried, problem_, stop_);
  }

  Problem problem_ = one_contact();
  Stop stop_{.time_limit_s = 0.1};
};

TEST_F(Faults, NoneInAnHonestAnswer) {
  const Attempt tried = attempt(honest_solver(), problem_, stop_);
  EXPECT_EQ(fault(tried, problem_, stop_), "");
  EXPECT_TRUE(tried.solved(stop_.tol));
  EXPECT_EQ(tried.r, Eigen::Vector3d(1.0, -0.25, 0.0));
}

TEST_F(Faults, AClaimAboveTheTolerance) {
  EXPECT_EQ(fault_of([](Eigen::VectorXd&) {}), "says converged at eta = 1");
}

// Reactions so large that u is lost in r - u / lambda, on walls that close in.
TEST_F(Faults, AClaimByReactionsThatRoundingHides) {
  problem_ = problems::make_backwards(
                 {.family = problems::Family::kInfeasible, .cones = 2, .dims = {1}, .seed = 2})
                 .problem;
  EXPECT_THAT(fault_of([](Eigen::VectorXd& r) { r.setConstant(1e17); }),
              HasSubstr("says converged at eta = "));
}

TEST_F(Faults, ADenialBelowTheTolerance) {
  Solver solver = honest_solver();
  solver.solve = [honest = solver.solve](const Problem& problem, const solvers::Request& request) {
    solvers::Result result = honest(problem, request);
    result.status = Status::kStalled;
    return result;
  };
  EXPECT_THAT(fault(attempt(solver, problem_, stop_), problem_, stop_), HasSubstr("says stalled"));
}

TEST_F(Faults, InfeasibilityWithoutAProof) {
  Solver solver = honest_solver();
  solver.solve = [](const Problem& problem, const solvers::Request&) {
    solvers::Result result;
    result.status = Status::kInfeasible;
    result.r = Eigen::VectorXd::Zero(problem.rows());
    result.certificate = Eigen::Vector3d::UnitX();
    return result;
  };
  EXPECT_EQ(fault(attempt(solver, problem_, stop_), problem_, stop_),
            "says infeasible without a proof");
}

TEST_F(Faults, NaN) {
  EXPECT_EQ(fault_of([](Eigen::VectorXd& r) { r(1) = std::nan(""); }), "r is not finite");
}

TEST_F(Faults, ThrowingWhateverItIs) {
  EXPECT_EQ(fault_of([](Eigen::VectorXd&) { throw std::runtime_error("no"); }), "threw: no");
  EXPECT_EQ(fault_of([](Eigen::VectorXd&) { throw problems::InputError("it", "no"); }),
            "threw: it: no");
  EXPECT_EQ(fault_of([](Eigen::VectorXd&) { throw 1; }), "threw: not a std::exception");
}

TEST_F(Faults, ACrashAndALeaving) {
  EXPECT_THAT(fault_of([](Eigen::VectorXd&) { std::abort(); }), HasSubstr("died: SIGABRT"));
  EXPECT_THAT(fault_of([](Eigen::VectorXd&) { std::exit(0); }), HasSubstr("died: exit code"));
}

TEST_F(Faults, AnAnswerOfTheWrongLength) {
  EXPECT_EQ(fault_of([](Eigen::VectorXd& r) { r.conservativeResize(2); }),
            "r has the wrong length");
}

TEST_F(Faults, ATimeLimitThatIsOverrun) {
  EXPECT_THAT(fault_of([](Eigen::VectorXd& r) {
                r << 1.0, -0.25, 0.0;
                std::this_thread::sleep_for(std::chrono::milliseconds(2200));
              }),
              HasSubstr("took 2.2 s of 0.1 s"));
}

TEST_F(Faults, NoneInARefusalWhichIsNoAnswer) {
  Solver solver = honest_solver();
  solver.refuses = [](const Problem&) { return std::optional<std::string>("not today"); };
  const Attempt tried = attempt(solver, problem_, stop_);
  EXPECT_EQ(tried.end, Attempt::End::kRefused);
  EXPECT_FALSE(tried.solved(stop_.tol));
  EXPECT_EQ(fault(tried, problem_, stop_), "");
}

}  // namespace
}  // namespace conebench::harness
