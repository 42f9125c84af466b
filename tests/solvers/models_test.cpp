// ccp and pyramid: their own problems, known answers, and the gap to Coulomb's law.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>
#include <random>

#include "problems/error.h"
#include "problems/made_backwards.h"
#include "problems/residual.h"
#include "solvers/ccp.h"
#include "solvers/model_residual.h"
#include "solvers/pyramid_law.h"
#include "solvers/registry.h"

namespace conebench::solvers {
namespace {

using problems::Cone;
using problems::Family;
using problems::PrimalData;
using problems::Problem;
using problems::ReducedData;
using problems::SparseMatrix;
using testing::HasSubstr;
constexpr double kPi = std::numbers::pi;

Result solve(const std::string& variant, const Problem& problem, double tol = 1e-10) {
  return make_solver(variant).solve(problem.shifted(),
                                    {{.tol = tol, .max_iterations = 500'000}, {}, nullptr});
}

double gap(const Problem& problem, const Result& result) {
  return problems::evaluate_eta(problem.shifted(), result.r);
}

double own(const std::string& variant, const Problem& problem, const Result& result) {
  return model_residual(variant, problem.shifted(), result.r).value();
}

// A block of 2 kg, driven against the plane and along it at `angle` to the first tangent; it
// slides.
constexpr double kMass = 2.0, kPress = 0.06, kDrive = 0.08, kMu = 0.5;
Problem sliding_block(double angle, double theta, bool reduced = false) {
  const Eigen::Vector3d q(-kPress, kDrive * std::cos(angle), kDrive * std::sin(angle));
  const SparseMatrix I = Eigen::MatrixXd(Eigen::Matrix3d::Identity()).sparseView();
  const std::vector<Cone> cones{{3, kMu, 0.0, theta}};
  if (reduced) return Problem(ReducedData{I / kMass, q}, cones, {});
  return Problem(PrimalData{kMass * I, I, kMass * q, Eigen::Vector3d::Zero()}, cones, {});
}

const std::vector<std::string> kPyramidMethods = {"lemke", "pgs"};

// Along an edge the pyramid's friction is the cone's; half way between two it is cos(pi / k) of it,
// r = (r_n, -c mu r_n t). Projecting r - u_hat / lambda on K_mu then gives, whatever the speed,
// eta U = lambda r_n mu (1 - c) / (1 + mu^2)^(1/2).
TEST(Pyramid, GapOfASlidingBlockHasItsClosedForm) {
  for (const std::string& method : kPyramidMethods) {
    for (const int faces : {4, 6, 8, 20}) {
      for (const bool reduced : {false, true}) {
        const std::string variant =
            "pyramid[faces=" + std::to_string(faces) + ",method=" + method + "]";
        const double sector = 2.0 * kPi / faces, c = std::cos(kPi / faces);
        const Problem along = sliding_block(2.0 * sector, kMu, reduced);
        const Result exact = solve(variant, along, 1e-12);
        EXPECT_EQ(exact.status, Status::kConverged) << variant;
        EXPECT_LE(gap(along, exact), 1e-11) << variant;

        const Problem between = sliding_block(1.5 * sector, kMu, reduced);
        const Result result = solve(variant, between, 1e-12);
        EXPECT_EQ(result.status, Status::kConverged) << variant;
        const double normal = kMass * kPress;
        EXPECT_NEAR(result.r(0), normal, 1e-11);
        EXPECT_NEAR(result.r.tail<2>().norm(), c * kMu * normal, 1e-11);
        EXPECT_NEAR(gap(between, result),
                    kPress * kMu * (1.0 - c) / (std::sqrt(1.0 + kMu * kMu) * between.rate_scale()),
                    1e-10);
        EXPECT_LE(own(variant, between, result), 1e-11);
      }
    }
  }
}

TEST(Pyramid, IsExactInTheLineAndWithoutFriction) {
  for (const std::string& method : kPyramidMethods) {
    for (const double theta_share : {0.0, 0.5, 1.0}) {
      const Problem line = problems::make_backwards({.cones = 12,
                                                     .dims = {2, 1},
                                                     .mu_high = 0.5,
                                                     .theta_share = theta_share,
                                                     .cohesive_share = 0.3,
                                                     .seed = 5})
                               .problem;
      const Problem smooth =
          problems::make_backwards(
              {.cones = 12, .dims = {3}, .mu_low = 0.0, .mu_high = 0.0, .seed = 6})
              .problem;
      for (const Problem& problem : {line, smooth}) {
        const Result result = solve("pyramid[method=" + method + "]", problem);
        EXPECT_EQ(result.status, Status::kConverged) << method;
        EXPECT_LE(gap(problem, result), 1e-9) << method;
      }
    }
  }
}

// W is regular, so that the associated problem has one solution, and friction of at most 0.3 leaves
// one here too. |r_a - r_b| is at most some 1e4 (condition, and U over lambda |r|) times the tol.
TEST(Pyramid, PivotsAndSweepsAgree) {
  for (const double theta_share : {0.0, 0.4, 1.0}) {
    for (const bool reduced : {false, true}) {
      for (std::uint64_t seed = 1; seed <= 5; ++seed) {
        const Problem problem = problems::make_backwards({.cones = 12,
                                                          .dims = {3, 3, 2, 1},
                                                          .mu_high = 0.3,
                                                          .theta_share = theta_share,
                                                          .cohesive_share = 0.3,
                                                          .mass_ratio = 2.0,
                                                          .reduced = reduced,
                                                          .seed = seed})
                                    .problem;
        const Result pivots = solve("pyramid", problem, 1e-10);
        const Result sweeps = solve("pyramid[method=pgs]", problem, 1e-10);
        EXPECT_EQ(pivots.status, Status::kConverged) << seed;
        EXPECT_EQ(sweeps.status, Status::kConverged) << seed;
        EXPECT_LE(own("pyramid", problem, pivots), 1e-10);
        EXPECT_LE((pivots.r - sweeps.r).norm(), 1e-6 * sweeps.r.norm()) << seed;
      }
    }
  }
}

// The bound of pyramid_law.h, and rates that tend to the round cone's as 1 / faces: sixteenfold
// from 8 to 128 faces, less what the edges happen to be nearer to the sliding directions by.
TEST(Pyramid, TendsToTheConeAsItsFacesGrow) {
  for (const double theta_share : {0.0, 1.0}) {
    const Problem problem = problems::make_backwards({.cones = 15,
                                                      .mu_high = 0.5,
                                                      .theta_share = theta_share,
                                                      .mass_ratio = 2.0,
                                                      .seed = 11})
                                .problem;
    const Eigen::VectorXd round = problem.rate(solve("gs", problem, 1e-12).r);
    std::vector<double> distances;
    for (const int faces : {8, 32, 128}) {
      const Result result = solve("pyramid[faces=" + std::to_string(faces) + "]", problem, 1e-9);
      ASSERT_EQ(result.status, Status::kConverged) << faces;
      distances.push_back((problem.rate(result.r) - round).norm());
      if (theta_share < 1.0) continue;
      double bound = 1e-9;
      for (int i = 0; i < problem.cone_count(); ++i) {
        const double friction =
            problem.cones()[static_cast<std::size_t>(i)].mu * result.r(problem.start(i));
        bound = std::max(bound,
                         problem.mobility()(i) * friction * kPi / (faces * problem.rate_scale()));
      }
      EXPECT_LE(gap(problem, result), bound) << faces;
      EXPECT_GT(gap(problem, result), 1e-6) << faces;
    }
    EXPECT_LT(distances[1], distances[0] / 2.0);
    EXPECT_LT(distances[2], distances[1] / 2.0);
    EXPECT_LT(distances[2], distances[0] / 8.0);
  }
}

TEST(Pyramid, SaysWhatItCannotTake) {
  const auto made = [](std::vector<int> dims, int cones) {
    return problems::make_backwards({.cones = cones, .dims = std::move(dims)}).problem;
  };
  const Solver solver = make_solver("pyramid");
  EXPECT_THAT(solver.refuses(made({3, 6}, 4)).value(), HasSubstr("d = 6"));
  EXPECT_THAT(solver.refuses(made({3}, 500)).value(), HasSubstr("5000 variables"));
  EXPECT_TRUE(make_solver("pyramid[method=pgs]").supports(made({3}, 500)));
  EXPECT_FALSE(make_solver("pyramid[method=pgs]").supports(made({6}, 4)));
  EXPECT_THROW(make_solver("pyramid[faces=5]"), problems::InputError);
  EXPECT_THROW(make_solver("pyramid[faces=2]"), problems::InputError);
}

TEST(Pyramid, NeverClaimsToSolveWhatHasNoSolution) {
  const Problem problem =
      problems::make_backwards({.family = Family::kInfeasible, .cones = 6, .seed = 3}).problem;
  const Result pivots = solve("pyramid", problem);
  EXPECT_EQ(pivots.status, Status::kStalled);
  ASSERT_EQ(pivots.notes.size(), 1u);
  EXPECT_THAT(pivots.notes[0], HasSubstr("ray"));
  const Result sweeps =
      make_solver("pyramid[method=pgs]").solve(problem, {{.max_iterations = 2000}, {}, nullptr});
  EXPECT_EQ(sweeps.status, Status::kIterationLimit);
}

TEST(Pyramid, RespectsTheIterationLimit) {
  const Problem problem = problems::make_backwards({.cones = 30, .seed = 24}).problem;
  for (const std::string& method : kPyramidMethods) {
    const Result result = make_solver("pyramid[method=" + method + "]")
                              .solve(problem, {{.tol = 1e-300, .max_iterations = 7}, {}, nullptr});
    EXPECT_EQ(result.status, Status::kIterationLimit);
    EXPECT_EQ(result.iterations, 7);
    EXPECT_EQ(result.r.size(), problem.rows());
  }
}

// A projection p of x on a convex cone: p in it, (x - p).p = 0, and (x - p).y <= 0 on its edges.
TEST(PyramidLaw, ProjectsOnThePyramid) {
  std::mt19937 random(3);
  std::normal_distribution<double> normal;
  for (const int faces : {4, 6, 10}) {
    const PyramidLaw law(faces);
    const Eigen::MatrixXd d = law.directions(3);
    for (const double mu : {0.0, 0.3, 2.0}) {
      for (int sample = 0; sample < 500; ++sample) {
        const Eigen::Vector3d x(normal(random), normal(random), normal(random));
        Eigen::VectorXd p = x;
        law.project(mu, p);
        EXPECT_NEAR((x - p).dot(p), 0.0, 1e-14 * x.squaredNorm());
        for (int j = 0; j < faces; ++j) {
          EXPECT_LE((x - p).dot(Eigen::Vector3d(1.0, mu * d(0, j), mu * d(1, j))),
                    1e-14 * x.norm() * (1.0 + mu));
          // Inside: below the plane of every face.
          const Eigen::Vector2d out = 0.5 * (d.col(j) + d.col((j + 1) % faces));
          EXPECT_LE(out.normalized().dot(p.tail<2>()) - mu * out.norm() * p(0), 1e-14 * x.norm());
        }
        Eigen::VectorXd u = x;
        law.shift_rate(1.0, u);
        EXPECT_NEAR(u(0) - x(0), (-(d.transpose() * x.tail<2>())).maxCoeff(), 1e-14 * x.norm());
      }
    }
  }
}

// The associated law with W = I / m is one projection: r = P_K(-m q), here on the cone's side.
TEST(ConeComplementarity, SlidingBlockOpensAtMuTimesItsSpeed) {
  for (const std::string method : {"aclm", "gs", "ipm", "spg"}) {
    const std::string variant = "ccp[method=" + method + "]";
    const Problem problem = sliding_block(0.7, kMu);
    const Result result = solve(variant, problem, 1e-11);
    EXPECT_EQ(result.status, Status::kConverged) << variant;
    const double normal = kMass * (kPress + kMu * kDrive) / (1.0 + kMu * kMu);
    EXPECT_NEAR(result.r(0), normal, 1e-9) << variant;
    EXPECT_NEAR(result.r(1), -kMu * normal * std::cos(0.7), 1e-9);
    const Eigen::VectorXd u = problem.rate(result.r);
    EXPECT_NEAR(u(0), kMu * u.tail<2>().norm(), 1e-9);
    EXPECT_GT(gap(problem, result), 0.1);
    EXPECT_LE(own(variant, problem, result), 1e-11);
  }
}

TEST(ConeComplementarity, IsExactUnderTheAssociatedLaw) {
  for (const std::vector<int>& dims : {std::vector<int>{3, 2}, {6, 1, 3}}) {
    const Problem problem =
        problems::make_backwards(
            {.cones = 12, .dims = dims, .theta_share = 0.0, .cohesive_share = 0.5, .seed = 22})
            .problem;
    for (const std::string method : {"ccp", "ccp[method=aclm]"}) {
      const double tol = method == "ccp" ? 1e-8 : 1e-10;
      const Result result = solve(method, problem, tol);
      EXPECT_EQ(result.status, Status::kConverged) << method;
      EXPECT_LE(gap(problem, result), tol) << method;
    }
  }
}

// Whatever the monitor sees on the way, the answer is that of the model.
TEST(ConeComplementarity, SolvesItsOwnProblemNotCoulombs) {
  for (const bool reduced : {false, true}) {
    for (const StopTest test : {StopTest::kCommon, StopTest::kOwn}) {
      const Problem problem =
          problems::make_backwards({.cones = 12, .dims = {3, 6}, .reduced = reduced, .seed = 4})
              .problem;
      const Result result =
          make_solver("ccp").solve(problem, {{.tol = 1e-8, .test = test}, {}, nullptr});
      EXPECT_EQ(result.status, Status::kConverged);
      EXPECT_LE(own("ccp", problem, result), 1.5e-8);
      EXPECT_GT(gap(problem, result), 1e-4);
      EXPECT_EQ(associated_problem(problem).rate_scale(), problem.rate_scale());
    }
  }
}

TEST(ModelResidual, IsKnownForModelsOnly) {
  const Problem problem = problems::make_backwards({.cones = 5}).problem;
  const Eigen::VectorXd r = Eigen::VectorXd::Zero(problem.rows());
  EXPECT_FALSE(model_residual("gs", problem, r));
  EXPECT_FALSE(model_residual("a-model-from-elsewhere", problem, r));
  // Of many faces the pyramid's law is the cone's.
  const Eigen::VectorXd some = solve("ccp", problem).r;
  EXPECT_NEAR(model_residual("pyramid[faces=256]", problem, some).value(),
              problems::evaluate_eta(problem, some), 1e-3);
  EXPECT_GT(model_residual("pyramid[faces=4]", problem, r).value(), 0.1);
}

}  // namespace
}  // namespace conebench::solvers
