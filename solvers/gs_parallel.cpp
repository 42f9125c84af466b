#include "solvers/gs_parallel.h"

#include "solvers/gs.h"

namespace conebench::solvers {
namespace {

using problems::Problem;

constexpr std::int64_t kMostThreads = 1024;

Solver make(const Method& method, const Values& values) {
  GaussSeidelSettings settings;
  settings.omega = std::get<double>(values.at("omega"));
  settings.threads = static_cast<int>(std::get<std::int64_t>(values.at("threads")));
  if (std::get<std::string>(values.at("local")) == "projection") {
    settings.local = LocalKind::kProjection;
  }
  return make_iterative_solver(
      method, values,
      [settings](const Problem& problem) { return gauss_seidel_refuses(problem, settings); },
      [settings](const Problem& problem) { return make_gauss_seidel(problem, settings); });
}

}  // namespace

Method gauss_seidel_parallel() {
  Method method{
      .name = "gs-parallel",
      .kind = Kind::kMethod,
      .summary = "Gauss-Seidel by colours, each solved by several threads at once",
      .source =
          "as gs; colouring for parallel projected Gauss-Seidel is folklore, ours is first fit",
      .parameters = {{.name = "local",
                      .fallback = std::string("exact"),
                      .choices = {"exact", "projection"},
                      .doc = "how one cone is solved: to rounding, or by one projected "
                             "step"},
                     {.name = "omega",
                      .fallback = 1.0,
                      .low = 0.05,
                      .high = 1.95,
                      .doc = "relaxation of each cone's update [-]"},
                     {.name = "threads",
                      .fallback = std::int64_t{0},
                      .low = 0,
                      .high = kMostThreads,
                      .doc = "that solve a colour; 0: as many as the run has [-]"}},
      .make = {}};
  method.make = [method](const Values& values) { return make(method, values); };
  return method;
}

}  // namespace conebench::solvers
