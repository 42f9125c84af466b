// One-cone problems: how fast `exact` is beside one projected step and the other local solvers, and
// whether it is right.
//
//   build/local_benchmark
//
// proof/d/mu solves 250 000 random blocks of each of four kinds (condition 10, 1e8, 1e14,
// singular), reports the worst backward residual, and proves each refused block unsolvable by other
// means. The Newtons and the quartic start from r = 0; `failed` is the share of blocks that they
// say they did not solve.

#include <benchmark/benchmark.h>

#include <vector>

#include "harness/microbench/local_proof.h"
#include "harness/microbench/random_blocks.h"
#include "problems/cone.h"
#include "solvers/local/exact.h"
#include "solvers/local/newton_ac.h"
#include "solvers/local/newton_fb.h"
#include "solvers/local/quartic.h"

namespace conebench::solvers {
namespace {

constexpr int kBlocksPerKind = 250'000;

double mu_of(const benchmark::State& state) { return static_cast<double>(state.range(0)) / 10.0; }

template <int D>
void proof(benchmark::State& state) {
  const double mu = mu_of(state);
  double worst = 0.0;
  std::int64_t unsolvable = 0, unproved = 0;
  for (auto _ : state) {
    for (const Conditioning kind : {Conditioning::kGood, Conditioning::kHard,
                                    Conditioning::kExtreme, Conditioning::kSingular}) {
      std::mt19937_64 random(static_cast<std::uint64_t>(D * 10) + static_cast<std::uint64_t>(kind));
      for (int k = 0; k < kBlocksPerKind; ++k) {
        const Eigen::MatrixXd W = random_block(random, D, kind);
        const Eigen::VectorXd q = random_rate(random, W, kind);
        ExactLocal<D> local;
        local.set(W, largest_eigenvalue(W), mu, mu);
        typename ExactLocal<D>::Vector r = q;
        double a = 0.0;
        if (local.solve(q, r, a) == LocalCase::kNoSolution) {
          ++unsolvable;
          if (!proved_unsolvable(W, q, mu)) ++unproved;
        } else {
          worst = std::max(worst, backward_residual(W, q, mu, mu, r));
        }
      }
    }
  }
  state.counters["blocks"] = 4.0 * kBlocksPerKind;
  state.counters["worst_backward_residual"] = worst;
  state.counters["unsolvable"] = static_cast<double>(unsolvable);
  state.counters["unproved"] = static_cast<double>(unproved);
}

template <int D>
struct Sample {
  typename ExactLocal<D>::Vector q, r;
  ExactLocal<D> local;
  double lambda = 0.0, a = 0.0;
  typename ExactLocal<D>::Matrix W;
};

template <int D>
std::vector<Sample<D>> samples(double mu) {
  std::mt19937_64 random(1);
  std::vector<Sample<D>> all(4096);
  for (Sample<D>& s : all) {
    s.W = random_block(random, D, Conditioning::kGood);
    s.q = random_rate(random, s.W, Conditioning::kGood);
    s.lambda = largest_eigenvalue(s.W);
    s.local.set(s.W, s.lambda, mu, mu);
    s.r.setZero();
  }
  return all;
}

template <int D>
void exact(benchmark::State& state) {
  auto all = samples<D>(mu_of(state));
  for (auto _ : state) {
    for (Sample<D>& s : all) {
      s.local.solve(s.q, s.r, s.a);
      benchmark::DoNotOptimize(s.r.data());
    }
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(all.size()));
}

template <int D>
void projection(benchmark::State& state) {
  const double mu = mu_of(state);
  auto all = samples<D>(mu);
  for (auto _ : state) {
    for (Sample<D>& s : all) {
      typename ExactLocal<D>::Vector u = s.W * s.r + s.q;
      problems::add_de_saxce(mu, u);
      s.r -= u / s.lambda;
      problems::project(mu, s.r);
      benchmark::DoNotOptimize(s.r.data());
    }
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(all.size()));
}

template <class Local, int D>
void time_from_zero(benchmark::State& state, const std::vector<Sample<D>>& all,
                    const std::vector<Local>& locals) {
  double failed = 0.0;
  for (auto _ : state) {
    for (std::size_t k = 0; k < all.size(); ++k) {
      typename ExactLocal<D>::Vector r = ExactLocal<D>::Vector::Zero();
      if (!locals[k].solve(all[k].q, r)) failed += 1.0;
      benchmark::DoNotOptimize(r.data());
    }
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(all.size()));
  state.counters["failed"] =
      failed / static_cast<double>(state.iterations() * static_cast<std::int64_t>(all.size()));
}

template <class Newton, int D>
void newton(benchmark::State& state) {
  const double mu = mu_of(state);
  const auto all = samples<D>(mu);
  std::vector<Newton> locals(all.size());
  for (std::size_t k = 0; k < all.size(); ++k) locals[k].set(all[k].W, all[k].lambda, mu, mu);
  time_from_zero<Newton, D>(state, all, locals);
}

void quartic(benchmark::State& state) {
  const double mu = mu_of(state);
  const auto all = samples<3>(mu);
  std::vector<QuarticLocal> locals(all.size());
  for (std::size_t k = 0; k < all.size(); ++k) locals[k].set(all[k].W, all[k].lambda, mu);
  time_from_zero<QuarticLocal, 3>(state, all, locals);
}

// Arguments are 10 mu: 0.1, 0.5 and 3.
BENCHMARK(proof<2>)->Arg(1)->Arg(5)->Arg(30)->Iterations(1)->Unit(benchmark::kSecond);
BENCHMARK(proof<3>)->Arg(1)->Arg(5)->Arg(30)->Iterations(1)->Unit(benchmark::kSecond);
BENCHMARK(proof<6>)->Arg(1)->Arg(5)->Arg(30)->Iterations(1)->Unit(benchmark::kSecond);
BENCHMARK(exact<2>)->Arg(5);
BENCHMARK(projection<2>)->Arg(5);
BENCHMARK(exact<3>)->Arg(1)->Arg(5)->Arg(30);
BENCHMARK(projection<3>)->Arg(1)->Arg(5)->Arg(30);
BENCHMARK(exact<6>)->Arg(5);
BENCHMARK(projection<6>)->Arg(5);
BENCHMARK(newton<NewtonAcLocal<3>, 3>)->Arg(1)->Arg(5)->Arg(30);
BENCHMARK(newton<NewtonAcLocal<6>, 6>)->Arg(5);
BENCHMARK(newton<NewtonFbLocal<3>, 3>)->Arg(1)->Arg(5)->Arg(30);
BENCHMARK(newton<NewtonFbLocal<6>, 6>)->Arg(5);
BENCHMARK(quartic)->Arg(1)->Arg(5)->Arg(30);

}  // namespace
}  // namespace conebench::solvers

BENCHMARK_MAIN();
