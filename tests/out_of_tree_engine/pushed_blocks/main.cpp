// pushed_blocks FOLDER: runs the engine with a solver of conebench and writes the problem of every
// step to FOLDER. Exit 1 when the blocks do not move as they must.

#include <problems/residual.h>
#include <solvers/registry.h>

#include <cmath>
#include <cstdio>
#include <exception>
#include <filesystem>

#include "row.h"

namespace problems = conebench::problems;
namespace solvers = conebench::solvers;

namespace {

constexpr int kSteps = 20;
constexpr double kTolerance = 1e-10;  // on eta: the share of the initial violation that is left

// One step: solve, judge, write, move. Returns the reactions, the next step's guess.
Eigen::VectorXd step(Row& row, int number, const Eigen::VectorXd& guess,
                     const std::filesystem::path& folder) {
  const problems::Problem problem = row.problem(number);
  const problems::Problem standard = problem.shifted();  // without cohesion: the same problem

  const solvers::Solver solver = solvers::make_solver("gs");
  const solvers::Result result =
      solver.solve(standard, {.stop = {.tol = kTolerance}, .guess = guess});
  const problems::Residual residual = problems::evaluate_residual(standard, result.r);
  std::printf("step %2d  %-9s eta %.1e  %lld iterations\n", number,
              std::string(solvers::to_string(result.status)).c_str(), residual.eta.max,
              static_cast<long long>(result.iterations));

  problems::write_problem_file(folder / (problem.name() + ".h5"),
                               {.problem = problem,
                                .geometry = row.geometry(),
                                .guess = guess,
                                .solution = problems::Solution{.r = result.r,
                                                               .u = standard.rate(result.r),
                                                               .v = standard.velocity(result.r),
                                                               .eta = residual.eta.max}});
  row.advance(standard.velocity(result.r));
  return result.r;
}

int run(const std::filesystem::path& folder) {
  std::filesystem::create_directories(folder);
  Row row;
  Eigen::VectorXd reactions;  // empty: the first step starts from 0
  for (int number = 0; number < kSteps; ++number) reactions = step(row, number, reactions, folder);

  double worst = 0.0;
  for (int i = 0; i < row.blocks; ++i) {
    worst = std::max(worst, std::abs(row.velocity(2 * i) - row.expected_velocity_m_s(kSteps)));
    worst = std::max(worst, std::abs(row.velocity(2 * i + 1)));
  }
  std::printf("every block at %.6f m/s, expected %.6f\n", row.velocity(0),
              row.expected_velocity_m_s(kSteps));
  return worst <= 1e-7 ? 0 : 1;
}

}  // namespace

int main(int count, char** arguments) {
  if (count != 2) {
    std::fprintf(stderr, "usage: pushed_blocks FOLDER\n");
    return 2;
  }
  try {
    return run(arguments[1]);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "pushed_blocks: %s\n", error.what());
    return 2;
  }
}
