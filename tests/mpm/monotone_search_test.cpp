// Chains of nodes in one dimension, without friction: M is lumped, B bidiagonal. There the cohesive
// law is maximal monotone, so the velocity is unique and can be found without any search.

#include "mpm/monotone_search.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <optional>
#include <random>

namespace conebench::test {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using mpm::FrozenSolution;
using mpm::MonotoneSearch;
using mpm::NodeState;

// rate = B v_free + W r, W = B M^-1 B^T; nodes without a gap are dense.
struct Chain {
  MatrixXd W;
  VectorXd free_rate, gap, kappa;

  Index size() const { return gap.size(); }
  VectorXd rate(const VectorXd& r) const { return W * r + free_rate; }
  double rate_scale() const { return std::max(free_rate.cwiseAbs().maxCoeff(), 1e-3); }
};

Chain random_chain(std::mt19937& random, Index nodes) {
  std::uniform_real_distribution<double> share(0.0, 1.0);
  Chain chain;
  MatrixXd B = MatrixXd::Zero(nodes, nodes + 1);
  VectorXd inverse_mass(nodes + 1), v(nodes + 1);
  for (Index k = 0; k <= nodes; ++k) {
    inverse_mass[k] = std::exp(4.0 * share(random) - 2.0);
    v[k] = 2.0 * share(random) - 1.0;
  }
  // One end is held in half of the chains.
  if (share(random) < 0.5) inverse_mass[0] = v[0] = 0.0;
  chain.gap.resize(nodes);
  chain.kappa.resize(nodes);
  for (Index k = 0; k < nodes; ++k) {
    const double area = 0.3 + share(random);
    B(k, k) = -area;
    B(k, k + 1) = area;
    chain.gap[k] = share(random) < 0.25 ? 0.0 : 0.8 * share(random);
    chain.kappa[k] = share(random) < 0.2 ? 0.0 : 0.5 * share(random);
  }
  chain.W = B * inverse_mass.asDiagonal() * B.transpose();
  chain.free_rate = B * v;
  return chain;
}

// Solves for r where `pinned` nodes have the rate `rate` and the others the reaction `r`.
VectorXd solve_pinned(const Chain& chain, const std::vector<bool>& pinned, const VectorXd& rate,
                      VectorXd r) {
  std::vector<Index> unknown;
  for (Index k = 0; k < chain.size(); ++k) {
    if (!pinned[static_cast<std::size_t>(k)]) continue;
    r[k] = 0.0;
    unknown.push_back(k);
  }
  if (unknown.empty()) return r;
  const VectorXd missing = rate - chain.rate(r);
  const MatrixXd W = chain.W(unknown, unknown);
  const VectorXd part = W.ldlt().solve(VectorXd(missing(unknown)));
  for (std::size_t k = 0; k < unknown.size(); ++k) r[unknown[k]] = part[static_cast<Index>(k)];
  return r;
}

constexpr double kRounding = 1e-11;  // of rates and reactions of order 1, masses within e^4

// The law itself: r_n >= 0 at rate -g; 0 on (-g, 0); in [-kappa, 0] at 0; -kappa above. Tries the
// four pieces of every node until all agree.
VectorXd known_answer(const Chain& chain) {
  enum Piece { kFull, kFalling, kHeld, kOpening };
  const auto n = static_cast<std::size_t>(chain.size());
  for (std::size_t code = 0; code < (std::size_t{1} << (2 * n)); ++code) {
    VectorXd rate = VectorXd::Zero(chain.size()), r = rate;
    std::vector<bool> pinned(n);
    for (std::size_t k = 0; k < n; ++k) {
      const auto i = static_cast<Index>(k);
      const auto piece = static_cast<Piece>(code >> (2 * k) & 3);
      pinned[k] = piece == kFull || piece == kHeld;
      if (piece == kFull) rate[i] = -chain.gap[i];
      if (piece == kOpening) r[i] = -chain.kappa[i];
    }
    r = solve_pinned(chain, pinned, rate, r);
    rate = chain.rate(r);
    bool agrees = true;
    for (std::size_t k = 0; k < n && agrees; ++k) {
      const auto i = static_cast<Index>(k);
      switch (static_cast<Piece>(code >> (2 * k) & 3)) {
        case kFull:
          agrees = r[i] >= -kRounding;
          break;
        case kFalling:
          agrees = rate[i] >= -chain.gap[i] - kRounding && rate[i] <= kRounding;
          break;
        case kHeld:
          agrees = r[i] >= -chain.kappa[i] - kRounding && r[i] <= kRounding;
          break;
        case kOpening:
          agrees = rate[i] >= -kRounding;
          break;
      }
    }
    if (agrees) return chain.rate(r);
  }
  ADD_FAILURE() << "no piece of the law agrees";
  return VectorXd::Zero(chain.size());
}

// The cone problem of frozen states: r >= -tip, rate >= -room, complementary; by trying every set.
FrozenSolution solve_frozen(const Chain& chain, const std::vector<NodeState>& states) {
  const auto n = static_cast<std::size_t>(chain.size());
  VectorXd tip = VectorXd::Zero(chain.size()), room = chain.gap;
  for (std::size_t k = 0; k < n; ++k) {
    if (states[k] == NodeState::kLoose) continue;
    tip[static_cast<Index>(k)] = chain.kappa[static_cast<Index>(k)];
    room[static_cast<Index>(k)] = 0.0;
  }
  for (std::size_t closed = 0; closed < (std::size_t{1} << n); ++closed) {
    std::vector<bool> pinned(n);
    for (std::size_t k = 0; k < n; ++k) pinned[k] = closed >> k & 1;
    const VectorXd r = solve_pinned(chain, pinned, -room, -tip);
    const VectorXd rate = chain.rate(r);
    if ((r + tip).minCoeff() < -kRounding || (rate + room).minCoeff() < -kRounding) continue;
    return {r, rate, chain.W.diagonal(), 10.0 * kRounding};
  }
  ADD_FAILURE() << "no solution of the frozen problem";
  return {};
}

struct Outcome {
  MonotoneSearch search;
  FrozenSolution kept;
};

Outcome run_search(const Chain& chain, bool start_bonded) {
  const auto n = static_cast<std::size_t>(chain.size());
  std::vector<NodeState> states(n);
  std::vector<bool> may_change(n);
  for (std::size_t k = 0; k < n; ++k) {
    const auto i = static_cast<Index>(k);
    const bool dense = chain.gap[i] == 0.0;
    states[k] = dense ? NodeState::kDense : start_bonded ? NodeState::kBonded : NodeState::kLoose;
    may_change[k] = !dense && chain.kappa[i] > 0.0;
    // A node without cohesion is dry whatever its name.
    if (!dense && chain.kappa[i] == 0.0) states[k] = NodeState::kLoose;
  }
  Outcome outcome{MonotoneSearch(states, may_change), {}};
  do {
    const FrozenSolution solution = solve_frozen(chain, outcome.search.states());
    if (outcome.search.take(solution)) outcome.kept = solution;
  } while (!outcome.search.done());
  return outcome;
}

class Chains : public testing::TestWithParam<bool> {};
INSTANTIATE_TEST_SUITE_P(Start, Chains, testing::Bool(),
                         [](const auto& start) { return start.param ? "Bonded" : "Loose"; });

TEST_P(Chains, StatesFoundGiveTheMaximalMonotoneLaw) {
  std::mt19937 random(3);
  int most_solves = 0, mixed = 0;
  for (int trial = 0; trial < 2000; ++trial) {
    const Chain chain = random_chain(random, 2 + trial % 5);
    const Outcome outcome = run_search(chain, GetParam());
    ASSERT_TRUE(outcome.search.agreed())
        << "chain " << trial << ": cycled " << outcome.search.cycled() << ", solves "
        << outcome.search.solves();
    const VectorXd expected = known_answer(chain);
    const double deviation =
        (outcome.kept.rate - expected).cwiseAbs().maxCoeff() / chain.rate_scale();
    ASSERT_LT(deviation, 1e-9) << "chain " << trial;
    most_solves = std::max(most_solves, outcome.search.solves());
    mixed += outcome.search.solves() > 1;
  }
  EXPECT_GT(mixed, 200) << "the chains are too easy";
  RecordProperty("most_solves", most_solves);
}

// One node: solutions that contradict whatever its state is.
FrozenSolution contradicting(const MonotoneSearch& search, double size) {
  const auto n = static_cast<Index>(search.states().size());
  FrozenSolution solution{VectorXd::Zero(n), VectorXd::Zero(n), VectorXd::Ones(n), 1e-9};
  for (Index i = 0; i < n; ++i) {
    if (search.states()[static_cast<std::size_t>(i)] == NodeState::kBonded) {
      solution.reaction[i] = size;
    } else {
      solution.rate[i] = size;
    }
  }
  return solution;
}

TEST(Search, EndsWhereEveryNextSetWasTried) {
  MonotoneSearch search({NodeState::kBonded}, {true});
  EXPECT_TRUE(search.take(contradicting(search, 2.0)));
  EXPECT_EQ(search.states()[0], NodeState::kLoose);
  EXPECT_FALSE(search.done());
  EXPECT_TRUE(search.take(contradicting(search, 1.0))) << "the lesser violation is the better one";
  EXPECT_TRUE(search.done());
  EXPECT_TRUE(search.cycled());
  EXPECT_FALSE(search.agreed());
  EXPECT_NEAR(search.violation(), 1.0, 1e-8);
}

TEST(Search, KeepsTheStatesOfTheLeastViolation) {
  MonotoneSearch search(std::vector(3, NodeState::kBonded), std::vector<bool>(3, true));
  EXPECT_TRUE(search.take(contradicting(search, 0.5)));
  EXPECT_FALSE(search.take(contradicting(search, 2.0)));
  EXPECT_TRUE(search.take(contradicting(search, 0.25)));
  EXPECT_FALSE(search.take(contradicting(search, 0.3)));
  EXPECT_NEAR(search.violation(), 0.25, 1e-8);
}

TEST(Search, ChangesOneNodeWhereAllTogetherWereTried) {
  MonotoneSearch search(std::vector(3, NodeState::kBonded), std::vector<bool>(3, true));
  search.take(contradicting(search, 1.0));
  EXPECT_EQ(search.states(), std::vector(3, NodeState::kLoose));
  search.take(contradicting(search, 1.0));  // all back would be the start
  const std::vector<NodeState> one = {NodeState::kBonded, NodeState::kLoose, NodeState::kLoose};
  EXPECT_EQ(search.states(), one);
}

TEST(Search, GivesUpAfterItsMostSolves) {
  MonotoneSearch search(std::vector(10, NodeState::kBonded), std::vector<bool>(10, true));
  // Alternately all nodes and the first of them disagree: 1024 sets to go through.
  std::mt19937 random(1);
  while (!search.done()) {
    FrozenSolution solution = contradicting(search, 1.0);
    for (Index i = 0; i < 10; ++i) {
      if (random() % 2 == 0) continue;
      solution.reaction[i] = 0.0;
      solution.rate[i] = -1.0;
    }
    search.take(solution);
    ASSERT_LE(search.solves(), MonotoneSearch::kMostSolves);
  }
  EXPECT_EQ(search.solves(), MonotoneSearch::kMostSolves);
  EXPECT_FALSE(search.cycled());
  EXPECT_FALSE(search.agreed());
}

TEST(Search, ToleranceLeavesNodesAlone) {
  for (const NodeState state : {NodeState::kBonded, NodeState::kLoose}) {
    MonotoneSearch search({state}, {true});
    FrozenSolution solution = contradicting(search, 0.0);
    solution.reaction[0] = 0.9e-9;  // of the tolerance 1e-9 / lambda
    solution.rate[0] = -1.1e-9;
    EXPECT_TRUE(search.take(solution));
    EXPECT_TRUE(search.agreed());
    EXPECT_EQ(search.states()[0], state);
  }
}

TEST(Search, OnlyTheGivenNodesChange) {
  MonotoneSearch search({NodeState::kDense, NodeState::kLoose}, {false, false});
  FrozenSolution solution{VectorXd::Ones(2), VectorXd::Ones(2), VectorXd::Ones(2), 0.0};
  EXPECT_TRUE(search.take(solution));
  EXPECT_TRUE(search.agreed());
  EXPECT_EQ(search.solves(), 1);
}

// What classify() makes of nodes, and the law it gives them.
mpm::LawInput some_nodes() {
  mpm::LawInput input;
  input.density = (VectorXd(4) << 1.0, 0.9995, 0.9, 0.9).finished();
  input.gap = (VectorXd(4) << 0.0, 1e-4, 0.2, 0.2).finished();
  input.tip = VectorXd::Constant(4, 3.0);
  input.free_rate = (VectorXd(4) << -1.0, -1.0, 0.5, -0.5).finished();
  return input;
}

void expect_laws(mpm::Law which, const std::vector<mpm::NodeLaw>& expected) {
  const mpm::LawInput input = some_nodes();
  const auto law = mpm::make_law(which);
  const auto states = law->classify(input);
  for (int i = 0; i < 4; ++i) {
    const auto slot = static_cast<std::size_t>(i);
    const mpm::NodeLaw found = law->law_of(input, i, states[slot]);
    EXPECT_NEAR(found.kappa, expected[slot].kappa, 1e-12) << to_string(which) << ", node " << i;
    EXPECT_EQ(found.gap, expected[slot].gap) << to_string(which) << ", node " << i;
  }
}

TEST(Laws, SayWhereCohesionActs) {
  expect_laws(mpm::Law::kUniform, {{3.0, 0.0}, {3.0, 1e-4}, {3.0, 0.2}, {3.0, 0.2}});
  expect_laws(mpm::Law::kDenseOnly, {{3.0, 0.0}, {1.5, 0.0}, {0.0, 0.2}, {0.0, 0.2}});
  expect_laws(mpm::Law::kDilationAware, {{3.0, 0.0}, {3.0, 0.0}, {3.0, 0.0}, {0.0, 0.2}});
  expect_laws(mpm::Law::kMonotone, {{3.0, 0.0}, {3.0, 0.0}, {3.0, 0.0}, {0.0, 0.2}});
}

TEST(Laws, NodesWithoutCohesionAreDryAndMayCompressInAllOfThem) {
  mpm::LawInput input = some_nodes();
  input.tip.setZero();
  for (const auto which :
       {mpm::Law::kUniform, mpm::Law::kDenseOnly, mpm::Law::kDilationAware, mpm::Law::kMonotone}) {
    const auto law = mpm::make_law(which);
    const auto states = law->classify(input);
    for (int i = 0; i < 4; ++i) {
      const mpm::NodeLaw found = law->law_of(input, i, states[static_cast<std::size_t>(i)]);
      EXPECT_EQ(found.kappa, 0.0);
      EXPECT_EQ(found.gap, input.gap[i]);
    }
  }
}

}  // namespace
}  // namespace conebench::test
