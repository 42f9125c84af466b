// One sweep of Gauss-Seidel in velocity form on packed spheres, or on problems from files whose
// cones have d = 3, beside its floor: max(bytes that a sweep must move / bandwidth at that working
// set, time of its arithmetic). The arithmetic, local solves and products with H, is timed at the
// last iterate, where no cone waits for another. Beside it the gain of gs-parallel with two
// threads, and what an empty parallel region of two costs, which no sweep can gain.
//
//   build/sweep_benchmark [FILE...]
//
// All are measured in the same run, since machines are noisy: compare them as ratios.

#include <benchmark/benchmark.h>

#include <chrono>
#include <numeric>
#include <span>

#include "problems/load.h"
#include "problems/made_backwards.h"
#include "solvers/blocked_rows.h"
#include "solvers/gs.h"
#include "solvers/gs_coupling.h"
#include "solvers/local/one_cone.h"

namespace conebench::solvers {
namespace {

using problems::Cone;
using problems::PrimalData;
using problems::Problem;
using problems::SparseMatrix;

// Unit spheres on a cubic lattice, each touching its lower neighbours or the floor, one step under
// tilted gravity: about three contacts a sphere.
Problem sphere_lattice(int contacts) {
  const int side = std::max(2, static_cast<int>(std::lround(std::cbrt(contacts / 3.0))));
  auto body = [&](int x, int y, int z) { return (x * side + y) * side + z; };
  std::vector<Eigen::Triplet<double, int>> H;
  int row = 0;
  auto add_contact = [&](int axis, int above, int below) {
    const int t1 = (axis + 1) % 3, t2 = (axis + 2) % 3;
    const int directions[3] = {axis, t1, t2};
    for (int k = 0; k < 3; ++k, ++row) {
      H.emplace_back(row, 6 * above + directions[k], 1.0);
      if (below >= 0) H.emplace_back(row, 6 * below + directions[k], -1.0);
      if (k == 0) continue;
      // The contact point moves by omega x (arm along the axis): both spheres turn it alike.
      const int about = k == 1 ? t2 : t1;
      const double arm = k == 1 ? -1.0 : 1.0;
      H.emplace_back(row, 6 * above + 3 + about, arm);
      if (below >= 0) H.emplace_back(row, 6 * below + 3 + about, arm);
    }
  };
  for (int x = 0; x < side; ++x) {
    for (int y = 0; y < side; ++y) {
      for (int z = 0; z < side; ++z) {
        add_contact(2, body(x, y, z), z > 0 ? body(x, y, z - 1) : -1);
        if (x > 0) add_contact(0, body(x, y, z), body(x - 1, y, z));
        if (y > 0) add_contact(1, body(x, y, z), body(x, y - 1, z));
      }
    }
  }
  const int dofs = 6 * side * side * side;
  SparseMatrix jacobian(row, dofs), mass(dofs, dofs);
  jacobian.setFromTriplets(H.begin(), H.end());
  mass.setIdentity();
  Eigen::VectorXd f = Eigen::VectorXd::Zero(dofs);
  for (int dof = 0; dof < dofs; ++dof) {
    if (dof % 6 >= 3) mass.coeffRef(dof, dof) = 0.4;
    if (dof % 6 == 2) f(dof) = -1e-2;
    if (dof % 6 == 0) f(dof) = 4e-3;
  }
  return Problem(PrimalData{mass, jacobian, f, Eigen::VectorXd::Zero(row)},
                 std::vector<Cone>(static_cast<std::size_t>(row / 3), Cone::coulomb(3, 0.5)), {});
}

double seconds_of(const std::function<void()>& action) {
  const auto start = std::chrono::steady_clock::now();
  action();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

// Best of several reads of an array as large as what a sweep touches. [bytes/s]
double read_bandwidth(std::size_t bytes) {
  const std::vector<double> data(std::max<std::size_t>(bytes / sizeof(double), 1024), 1.0);
  const std::size_t passes = std::max<std::size_t>(1, (std::size_t{1} << 26) / bytes);
  double best = 0.0;
  for (int repetition = 0; repetition < 7; ++repetition) {
    const Eigen::Map<const Eigen::VectorXd> view(data.data(),
                                                 static_cast<Eigen::Index>(data.size()));
    const double time = seconds_of([&] {
      for (std::size_t pass = 0; pass < passes; ++pass) benchmark::DoNotOptimize(view.sum());
    });
    best = std::max(best, static_cast<double>(passes * data.size() * sizeof(double)) / time);
  }
  return best;
}

template <class Local>
struct LocalSolve {
  Local local;
  Eigen::Vector3d u, r;
};

// Time of all, so many at a time that they are in the cache: what they read counts as bytes. [s]
template <class Local>
double solve_all(std::vector<LocalSolve<Local>>& solves) {
  constexpr std::size_t kAtATime = 64;
  const auto solve_some = [](std::span<LocalSolve<Local>> some) {
    for (LocalSolve<Local>& solve : some) {
      Eigen::Vector3d r = solve.r;
      solve.local.solve(solve.u, r);
      benchmark::DoNotOptimize(r.data());
    }
  };
  constexpr int kRounds = 20;
  double time = 0.0;
  for (std::size_t first = 0; first < solves.size(); first += kAtATime) {
    const auto some = std::span(solves).subspan(first, std::min(kAtATime, solves.size() - first));
    solve_some(some);
    time += seconds_of([&] {
      for (int round = 0; round < kRounds; ++round) solve_some(some);
    });
  }
  return time / kRounds;
}

// The sweep's own local problems at r, solved again and again: best time per cone. [s]
double local_solve_time(const Problem& problem, const Eigen::VectorXd& r) {
  constexpr GaussSeidelSettings kSettings;
  const BlockedRows rows(problem);
  const Eigen::VectorXd u = problem.rate(r);
  std::vector<LocalSolve<OneCone<3>>> general;
  std::vector<LocalSolve<IsotropicCone>> isotropic;
  for (int i = 0; i < problem.cone_count(); ++i) {
    const OneCone<3> local(kSettings.local, rows.diagonal_block(i, 3), problem.mobility()(i),
                           problem.cones()[static_cast<std::size_t>(i)], kSettings.regularization);
    const Eigen::Vector3d ui = u.segment<3>(problem.start(i)), ri = r.segment<3>(problem.start(i));
    if (local.stays_open(ui(0)) && ri.isZero(0.0)) continue;
    if (const auto closed = local.isotropic()) {
      isotropic.push_back({*closed, ui, ri});
    } else {
      general.push_back({local, ui, ri});
    }
  }
  double best = 1e9;
  for (int repetition = 0; repetition < 7; ++repetition) {
    best = std::min(best, solve_all(general) + solve_all(isotropic));
  }
  return best / problem.cone_count();
}

// As a sweep does them at r, each cone for itself; flattened like the sweep's.
template <class Products>
[[gnu::flatten]] void multiply_all(const Problem& problem, const BlockedRows& rows,
                                   const Eigen::VectorXd& r, const Eigen::VectorXd& y,
                                   Eigen::VectorXd& moved) {
  for (int i = 0; i < problem.cone_count(); ++i) {
    const int at = problem.start(i);
    if (r.segment<3>(at).isZero(0.0)) {
      benchmark::DoNotOptimize(Products::normal_rate(rows, i, 3, y.data()));
      continue;
    }
    Eigen::Vector3d u = problem.w().segment<3>(at);
    Products::add_rate(rows, i, y.data(), u);
    benchmark::DoNotOptimize(u.data());
    const Eigen::Vector3d change = r.segment<3>(at);
    Products::add_reaction(rows, i, change, moved.data());
  }
}

// The sweep's products with H at r, waiting for no other cone: best time per cone. [s]
double product_time(const Problem& problem, const Eigen::VectorXd& r) {
  const BlockedRows rows(problem);
  const Eigen::VectorXd y = rows.free_velocity(problem);
  Eigen::VectorXd moved = Eigen::VectorXd::Zero(y.size());
  double best = 1e9;
  with_products(rows, [&]<class Products>() {
    for (int repetition = 0; repetition < 7; ++repetition) {
      best =
          std::min(best, seconds_of([&] { multiply_all<Products>(problem, rows, r, y, moved); }));
    }
  });
  benchmark::DoNotOptimize(moved.data());
  return best / problem.cone_count();
}

// Best time of a sweep among rounds of 50 sweeps or more from the guess, and the last iterate. [s]
double sweep_time(const GaussSeidelSettings& settings, const Problem& problem,
                  const Eigen::VectorXd& guess, Eigen::VectorXd& r) {
  const int sweeps = std::max(50, 5'000'000 / std::max(1, problem.cone_count()));
  const auto iteration = make_gauss_seidel(problem, settings);
  double best = 1e9;
  for (int repetition = 0; repetition < 5; ++repetition) {
    iteration->start(guess);
    best = std::min(best, seconds_of([&] {
                      for (int k = 0; k < sweeps; ++k) iteration->advance();
                    }));
  }
  r = iteration->r();
  return best / sweeps;
}

// Two threads start and meet, with nothing to do in between. [s]
double empty_region_time() {
  constexpr int kRegions = 10'000;
  double best = 1e9;
  for (int repetition = 0; repetition < 7; ++repetition) {
    best = std::min(best, seconds_of([] {
                      for (int k = 0; k < kRegions; ++k) {
#pragma omp parallel num_threads(2)
                        benchmark::ClobberMemory();
                      }
                    }));
  }
  return best / kRegions;
}

// No guess: from r = 0.
void sweep(benchmark::State& state, const Problem& problem, Eigen::VectorXd guess) {
  if (guess.size() == 0) guess = Eigen::VectorXd::Zero(problem.rows());
  Eigen::VectorXd r;
  double best = 0.0, parallel = 0.0, region = 0.0;
  for (auto _ : state) {
    parallel = sweep_time({.threads = 2}, problem, guess, r);
    region = empty_region_time();
    best = sweep_time({}, problem, guess, r);
  }
  const double cones = problem.cone_count();
  const auto bytes = static_cast<double>(gauss_seidel_sweep_bytes(problem));
  const double moved = bytes / read_bandwidth(static_cast<std::size_t>(bytes)) / cones;
  const double local = local_solve_time(problem, r);
  const double products = product_time(problem, r);
  state.counters["cones"] = cones;
  state.counters["ns_per_cone"] = 1e9 * best / cones;
  state.counters["bytes_per_cone"] = bytes / cones;
  state.counters["ns_bytes"] = 1e9 * moved;
  state.counters["ns_local"] = 1e9 * local;
  state.counters["ns_products"] = 1e9 * products;
  state.counters["times_floor"] = best / cones / std::max(moved, local + products);
  state.counters["gain_by_two_threads"] = best / parallel;
  state.counters["ns_region"] = 1e9 * region;
}

void sweep_file(benchmark::State& state, const std::string& path) {
  const problems::ProblemFile file = problems::load_problem(path);
  const Problem problem = file.problem.shifted();
  if (!has_velocity_form(problem)) {
    return state.SkipWithError("has no M and H with M block diagonal");
  }
  for (const Cone& cone : problem.cones()) {
    if (cone.dim != 3) return state.SkipWithError("has cones of another dimension than 3");
  }
  sweep(state, problem, file.guess);
}

void sweep_lattice(benchmark::State& state) {
  sweep(state, sphere_lattice(static_cast<int>(state.range(0))), {});
}

}  // namespace
}  // namespace conebench::solvers

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  const auto set_up = [](benchmark::internal::Benchmark* benchmark) {
    return benchmark->Unit(benchmark::kMillisecond)->Iterations(1);
  };
  for (int k = 1; k < argc; ++k) {
    set_up(benchmark::RegisterBenchmark(argv[k], conebench::solvers::sweep_file,
                                        std::string(argv[k])));
  }
  if (argc == 1) {
    set_up(benchmark::RegisterBenchmark("sweep", conebench::solvers::sweep_lattice))
        ->RangeMultiplier(10)
        ->Range(1000, 100000);
  }
  benchmark::RunSpecifiedBenchmarks();
}
