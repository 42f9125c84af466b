// The proximal point method's parts: its inner methods solve the step that they are posed.

#include "solvers/ppa.h"

#include <gtest/gtest.h>

#include <random>

#include "problems/made_backwards.h"
#include "problems/residual.h"
#include "solvers/ppa_inner.h"

namespace conebench::solvers {
namespace {

using problems::Family;
using problems::Problem;
using Function = NewtonSettings::Function;

std::vector<std::unique_ptr<ProximalInner>> inners(const Problem& problem) {
  std::vector<std::unique_ptr<ProximalInner>> all;
  all.push_back(make_proximal_newton_inner(problem, Function::kAlartCurnier));
  all.push_back(make_proximal_newton_inner(problem, Function::kFischerBurmeister));
  all.push_back(make_proximal_gauss_seidel(problem));
  return all;
}

// W + alpha lambda and q - alpha lambda c, written out.
Problem proximal_problem(const Problem& problem, const Eigen::VectorXd& centre, double alpha) {
  Eigen::VectorXd weight(problem.rows());
  for (int i = 0; i < problem.cone_count(); ++i) {
    weight.segment(problem.start(i), problem.cones()[static_cast<std::size_t>(i)].dim)
        .setConstant(alpha * problem.mobility()(i));
  }
  const Eigen::MatrixXd W =
      Eigen::MatrixXd(problem.delassus()) + Eigen::MatrixXd(weight.asDiagonal());
  return Problem(problems::ReducedData{W.sparseView(), problem.q() - weight.cwiseProduct(centre)},
                 {problem.cones().begin(), problem.cones().end()}, {});
}

TEST(ProximalPoint, EveryInnerMethodSolvesTheStepThatItIsPosed) {
  std::mt19937 random(4);
  std::normal_distribution<double> normal;
  for (const bool reduced : {false, true}) {
    const auto made = problems::make_backwards({.cones = 12,
                                                .dims = {3, 6, 2, 1},
                                                .mu_high = 0.5,
                                                .theta_share = 0.7,
                                                .reduced = reduced,
                                                .seed = 12});
    const Problem& problem = made.problem;
    const Eigen::VectorXd centre =
        made.solutions[0] +
        made.solutions[0].cwiseAbs().maxCoeff() *
            Eigen::VectorXd::NullaryExpr(problem.rows(), [&] { return 0.1 * normal(random); });
    for (const auto& inner : inners(problem)) {
      for (const double alpha : {1.0, 0.1, 10.0}) {
        const Problem step = proximal_problem(problem, centre, alpha);
        inner->pose(centre, alpha);
        for (int k = 0; k < 60 && inner->advance(); ++k) {
        }
        EXPECT_LE(problems::evaluate_eta(step, inner->r()), 1e-11) << alpha;
        EXPECT_LE((inner->u() - problem.rate(inner->r())).norm(), 1e-12 * inner->u().norm());
      }
    }
  }
}

TEST(ProximalPoint, SolvesWhereTheReactionsAreNotUnique) {
  for (const char* inner : {"ac", "fb", "gs"}) {
    for (const Family family : {Family::kRankDeficient, Family::kSingularBlock}) {
      const Problem problem =
          problems::make_backwards({.family = family, .cones = 12, .mu_high = 0.4, .seed = 9})
              .problem;
      const Result result =
          make_solver(std::string("ppa[inner=") + inner + "]")
              .solve(problem, {{.tol = 1e-9, .max_iterations = 20000}, {}, nullptr});
      EXPECT_EQ(result.status, Status::kConverged) << inner;
    }
  }
}

}  // namespace
}  // namespace conebench::solvers
