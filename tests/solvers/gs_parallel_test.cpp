// Gauss-Seidel by colours: what a colour may hold, and that threads change nothing.

#include <gtest/gtest.h>

#include <set>

#include "problems/made_backwards.h"
#include "solvers/colouring.h"
#include "solvers/registry.h"

namespace conebench::solvers {
namespace {

using problems::Problem;

// Many cones on many bodies, each of which has several.
Problem heap(int cones) {
  return problems::make_backwards({.cones = cones, .dims = {3, 1, 2}, .seed = 11}).problem;
}

void expect_partition(const Colouring& colouring, int cones) {
  std::set<int> seen(colouring.serial().begin(), colouring.serial().end());
  std::size_t count = colouring.serial().size();
  for (const std::vector<int>& colour : colouring.parallel()) {
    EXPECT_GE(static_cast<int>(colour.size()), Colouring::kLeastParallel);
    EXPECT_TRUE(std::ranges::is_sorted(colour));
    seen.insert(colour.begin(), colour.end());
    count += colour.size();
  }
  EXPECT_EQ(count, static_cast<std::size_t>(cones));
  EXPECT_EQ(seen.size(), count);
}

// No two cones of a colour are coupled by W.
void expect_apart(const Colouring& colouring, const Problem& problem) {
  const problems::SparseMatrix W = problem.delassus();
  std::vector<int> cone_of_row;
  for (int i = 0; i < problem.cone_count(); ++i) {
    cone_of_row.insert(cone_of_row.end(),
                       static_cast<std::size_t>(problem.cones()[static_cast<std::size_t>(i)].dim),
                       i);
  }
  for (const std::vector<int>& colour : colouring.parallel()) {
    const std::set<int> same(colour.begin(), colour.end());
    for (const int i : colour) {
      for (problems::SparseMatrix::InnerIterator it(W, problem.start(i)); it; ++it) {
        const int other = cone_of_row[static_cast<std::size_t>(it.col())];
        EXPECT_TRUE(other == i || !same.contains(other)) << i << " and " << other;
      }
    }
  }
}

TEST(Colouring, OfBodiesSetsNeighboursApart) {
  const Problem problem = heap(1500);
  const int colours = with_coupling(problem, true, [&](const auto& coupling) {
    const Colouring colouring(problem, coupling);
    expect_partition(colouring, problem.cone_count());
    expect_apart(colouring, problem);
    return static_cast<int>(colouring.parallel().size());
  });
  EXPECT_GE(colours, 2);
}

TEST(Colouring, OfWSetsNeighboursApart) {
  const Problem problem = heap(1500);
  const DelassusCoupling coupling(problem);
  const Colouring colouring(problem, coupling);
  expect_partition(colouring, problem.cone_count());
  expect_apart(colouring, problem);
  EXPECT_GE(colouring.parallel().size(), 2u);
}

TEST(GaussSeidelParallel, ThreadsChangeNoBit) {
  const Problem problem = heap(1500);
  Request request;
  request.stop = {.tol = 1e-300, .max_iterations = 40};
  const Eigen::VectorXd one = make_solver("gs-parallel[threads=1]").solve(problem, request).r;
  for (const char* variant : {"gs-parallel[threads=2]", "gs-parallel[threads=5]"}) {
    EXPECT_EQ(make_solver(variant).solve(problem, request).r, one) << variant;
  }
  EXPECT_GT(one.norm(), 0.0);
}

}  // namespace
}  // namespace conebench::solvers
