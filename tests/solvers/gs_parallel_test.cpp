// Gauss-Seidel by colours: what a colour may hold, and that threads change nothing.

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <map>
#include <numeric>
#include <random>
#include <set>
#include <thread>

#include "problems/made_backwards.h"
#include "solvers/colouring.h"
#include "solvers/gs.h"
#include "solvers/registry.h"
#include "solvers/work_shares.h"

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
  for (const Colouring::Colour& colour : colouring.parallel()) {
    EXPECT_GT(static_cast<int>(colour.cones.size()), Colouring::kBarrier);
    EXPECT_TRUE(std::ranges::is_sorted(colour.cones));
    std::size_t in_stretches = 0;
    for (int s = 0; s < colour.count(); ++s) {
      EXPECT_LT(colour.stretch(s).size(), colour.cones.size());
      in_stretches += colour.stretch(s).size();
    }
    EXPECT_EQ(in_stretches, colour.cones.size());
    seen.insert(colour.cones.begin(), colour.cones.end());
    count += colour.cones.size();
  }
  EXPECT_EQ(count, static_cast<std::size_t>(cones));
  EXPECT_EQ(seen.size(), count);
}

// No two cones of two stretches of a colour are coupled by W.
void expect_apart(const Colouring& colouring, const Problem& problem) {
  const problems::SparseMatrix W = problem.delassus();
  std::vector<int> cone_of_row;
  for (int i = 0; i < problem.cone_count(); ++i) {
    cone_of_row.insert(cone_of_row.end(),
                       static_cast<std::size_t>(problem.cones()[static_cast<std::size_t>(i)].dim),
                       i);
  }
  for (const Colouring::Colour& colour : colouring.parallel()) {
    std::map<int, int> stretch_of;
    for (int s = 0; s < colour.count(); ++s) {
      for (const int i : colour.stretch(s)) stretch_of[i] = s;
    }
    for (const auto& [i, s] : stretch_of) {
      for (int k = 0; k < problem.cones()[static_cast<std::size_t>(i)].dim; ++k) {
        for (problems::SparseMatrix::InnerIterator it(W, problem.start(i) + k); it; ++it) {
          const auto other = stretch_of.find(cone_of_row[static_cast<std::size_t>(it.col())]);
          EXPECT_TRUE(other == stretch_of.end() || other->second == s)
              << i << " and " << other->first;
        }
      }
    }
  }
}

int longest_stretch(const Colouring& colouring) {
  int longest = 0;
  for (const Colouring::Colour& colour : colouring.parallel()) {
    for (int s = 0; s < colour.count(); ++s) {
      longest = std::max(longest, static_cast<int>(colour.stretch(s).size()));
    }
  }
  return longest;
}

enum class Order { kAlong, kShuffled };

// A chain of bodies of 3 dofs, each held to the next by one cone, the cones in their order or in
// none; with `hub`, every fifth cone holds its first body to the first of all instead.
Problem chain(int cones, bool hub, Order order = Order::kAlong) {
  std::vector<int> place(static_cast<std::size_t>(cones));
  std::iota(place.begin(), place.end(), 0);
  if (order == Order::kShuffled) std::shuffle(place.begin(), place.end(), std::mt19937(3));
  std::vector<Eigen::Triplet<double, int>> H;
  for (int i = 0; i < cones; ++i) {
    const int other = hub && i % 5 == 0 ? 0 : i + 1;
    const int row = 3 * place[static_cast<std::size_t>(i)];
    for (int k = 0; k < 3; ++k) {
      H.emplace_back(row + k, 3 * (i == 0 ? 1 : i) + k, 1.0);
      H.emplace_back(row + k, 3 * other + k, -1.0);
    }
  }
  const int dofs = 3 * (cones + 1);
  problems::SparseMatrix jacobian(3 * cones, dofs), mass(dofs, dofs);
  jacobian.setFromTriplets(H.begin(), H.end());
  mass.setIdentity();
  return Problem(
      problems::PrimalData{mass, jacobian, Eigen::VectorXd::LinSpaced(dofs, -1.0, 1.0),
                           Eigen::VectorXd::Zero(3 * cones)},
      std::vector<problems::Cone>(static_cast<std::size_t>(cones), problems::Cone::coulomb(3, 0.5)),
      {});
}

TEST(Colouring, OfBodiesSetsNeighboursApart) {
  const Problem problem = heap(6000);
  const int colours = with_coupling(problem, true, [&](const auto& coupling) {
    const Colouring colouring(problem, coupling);
    expect_partition(colouring, problem.cone_count());
    expect_apart(colouring, problem);
    EXPECT_LE(colouring.serial().size(), 1000u);
    return static_cast<int>(colouring.parallel().size());
  });
  EXPECT_GE(colours, 2);
}

TEST(Colouring, OfWSetsNeighboursApart) {
  const Problem problem = heap(6000);
  const DelassusCoupling coupling(problem);
  const Colouring colouring(problem, coupling);
  expect_partition(colouring, problem.cone_count());
  expect_apart(colouring, problem);
  EXPECT_GE(colouring.parallel().size(), 2u);
}

// Neighbours in a chain are neighbours in memory: a slab feels one cone of the one before it.
TEST(Colouring, CutsAChainIntoSlabs) {
  const Problem problem = chain(40000, false);
  const Colouring colouring(problem,
                            VelocityCoupling<RunProducts<3>>(problem, BlockedRows(problem)));
  expect_partition(colouring, problem.cone_count());
  ASSERT_EQ(colouring.parallel().size(), 1u);
  EXPECT_EQ(static_cast<int>(colouring.serial().size()), colouring.parallel()[0].count() - 1);
  EXPECT_GE(longest_stretch(colouring), 100);
}

// Waking threads would take longer than they save.
TEST(Colouring, LeavesFewConesToOneThread) {
  const Problem problem = chain(90, false);
  const Colouring colouring(problem,
                            VelocityCoupling<RunProducts<3>>(problem, BlockedRows(problem)));
  expect_partition(colouring, problem.cone_count());
  EXPECT_TRUE(colouring.parallel().empty());
}

// Without any order long stretches touch everything: they must give way to short ones.
TEST(Colouring, FindsThreadsWorkInAnyOrder) {
  const Problem problem = chain(40000, false, Order::kShuffled);
  const Colouring colouring(problem,
                            VelocityCoupling<RunProducts<3>>(problem, BlockedRows(problem)));
  expect_partition(colouring, problem.cone_count());
  EXPECT_LE(colouring.serial().size(), 2000u);
}

// W of which only the upper triangle is stored: a cone reads what another, earlier one writes.
TEST(Colouring, HeedsBlocksOnOneSideOfTheDiagonal) {
  const int cones = 4096;
  problems::SparseMatrix W(cones, cones);
  std::vector<Eigen::Triplet<double, int>> entries;
  for (int i = 0; i < cones; ++i) {
    entries.emplace_back(i, i, 1.0);
    if (i + 1 < cones) entries.emplace_back(i, i + 1, 0.03);
  }
  W.setFromTriplets(entries.begin(), entries.end());
  const Problem problem(
      problems::ReducedData{W, Eigen::VectorXd::Constant(cones, -1.0)},
      std::vector<problems::Cone>(static_cast<std::size_t>(cones), problems::Cone::coulomb(1, 0.0)),
      {});
  const Colouring colouring(problem, DelassusCoupling(problem));
  expect_partition(colouring, cones);
  expect_apart(colouring, problem);
}

// The cones of a hub come last and leave all others in their stretches.
TEST(Colouring, LeavesAHubToOneThread) {
  const Problem problem = chain(4000, true);
  for (const bool velocity : {true, false}) {
    with_coupling(problem, velocity, [&](const auto& coupling) {
      const Colouring colouring(problem, coupling);
      expect_partition(colouring, problem.cone_count());
      expect_apart(colouring, problem);
      EXPECT_EQ(colouring.serial().size(), 800u);
      EXPECT_GE(longest_stretch(colouring), 10);
      return 0;
    });
  }
}

// However unlike the threads' speeds, each item is taken once; one alone takes its own share from
// the front and then the others' from the back.
TEST(WorkShares, GiveEachItemOnce) {
  constexpr int kItems = 10000, kThreads = 4;
  WorkShares shares(kThreads);
  std::vector<std::atomic<int>> taken(kItems);
  {
    std::vector<std::jthread> threads;
    for (int t = 0; t < kThreads; ++t) {
      threads.emplace_back([&, t] {
        shares.deal(t, kThreads, kItems);
        for (int k = shares.take(t); k >= 0; k = shares.take(t)) {
          ++taken[static_cast<std::size_t>(k)];
        }
      });
    }
  }
  EXPECT_TRUE(std::ranges::all_of(taken, [](const auto& times) { return times == 1; }));
}

TEST(WorkShares, GoOnWithTheOthersFromTheBack) {
  WorkShares shares(2);
  shares.deal(0, 2, 5);
  shares.deal(1, 2, 5);
  std::vector<int> order;
  for (int k = shares.take(1); k >= 0; k = shares.take(1)) order.push_back(k);
  EXPECT_EQ(order, (std::vector{2, 3, 4, 1, 0}));
}

// OpenMP may grant fewer threads than were asked for.
TEST(WorkShares, GoToTheThreadsThatCame) {
  WorkShares shares(4);
  shares.deal(0, 1, 3);
  std::vector<int> order;
  for (int k = shares.take(0); k >= 0; k = shares.take(0)) order.push_back(k);
  EXPECT_EQ(order, (std::vector{0, 1, 2}));
}

// The iterate itself: a solver's answer is the best one seen.
Eigen::VectorXd after_sweeps(const Problem& problem, int threads) {
  const auto sweeps = make_gauss_seidel(problem, {.threads = threads});
  sweeps->start(Eigen::VectorXd::Zero(problem.rows()));
  for (int k = 0; k < 40; ++k) sweeps->advance();
  sweeps->start(Eigen::VectorXd(sweeps->r()));  // takes up what is there, by all threads
  for (int k = 0; k < 10; ++k) sweeps->advance();
  return sweeps->r();
}

TEST(GaussSeidelParallel, ThreadsChangeNoBit) {
  for (const Problem& problem : {heap(6000), chain(40000, false), chain(4000, true)}) {
    const Eigen::VectorXd one = after_sweeps(problem, 1);
    EXPECT_EQ(after_sweeps(problem, 2), one);
    EXPECT_EQ(after_sweeps(problem, 5), one);
    EXPECT_GT(one.norm(), 0.0);
  }
}

// To begin again where sweeps are is to go on.
TEST(GaussSeidelParallel, TakesUpReactions) {
  for (const Problem& problem : {heap(6000), chain(4000, true)}) {
    for (const std::optional<int> threads : {std::optional<int>(), std::optional<int>(3)}) {
      const auto sweeps = make_gauss_seidel(problem, {.threads = threads});
      sweeps->start(Eigen::VectorXd::Zero(problem.rows()));
      for (int k = 0; k < 20; ++k) sweeps->advance();
      const Eigen::VectorXd there = sweeps->r();
      sweeps->advance();
      const Eigen::VectorXd next = sweeps->r();
      EXPECT_GT((next - there).norm(), 1e-6 * next.norm());
      sweeps->start(there);
      sweeps->advance();
      EXPECT_LE((sweeps->r() - next).norm(), 1e-9 * next.norm());
    }
  }
}

// An associated cone that its normal rate alone would leave open: r = P_K(-q).
TEST(GaussSeidel, ClosesAConeThatSlidesFasterThanItOpens) {
  Eigen::MatrixXd W = Eigen::MatrixXd::Identity(3, 3);
  const Problem problem(problems::ReducedData{W.sparseView(), Eigen::Vector3d(0.1, 1.0, 0.0)},
                        std::vector<problems::Cone>{problems::Cone::associated(3, 0.5)}, {});
  for (const char* variant : {"gs", "gs-parallel", "gs[skip=10]"}) {
    const Eigen::VectorXd r = make_solver(variant).solve(problem, {}).r;
    EXPECT_LE((r - Eigen::Vector3d(0.32, -0.16, 0.0)).norm(), 1e-12) << variant;
  }
}

}  // namespace
}  // namespace conebench::solvers
