#include "harness/policy.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "harness/step_solver.h"
#include "harness/variants.h"
#include "problems/engine/scene_file.h"
#include "problems/error.h"
#include "problems/residual.h"

namespace conebench::harness {
namespace {

using engine::Range;
using engine::StepAnswer;

constexpr std::int64_t kSchema = 1;

Policy::Rung read_rung(engine::TomlReader in, const std::string& subject) {
  Policy::Rung rung{in.text("solver"), in.number("time_limit_s", Range::kPositive)};
  in.finish();
  if (rung.solver.starts_with("policy:")) {
    throw problems::InputError(
        subject, "ladder: found " + rung.solver + ", expected a solver: policies do not nest");
  }
  make_solver(rung.solver);  // throws where there is none of that name
  return rung;
}

}  // namespace

std::string to_toml(const Policy& policy) {
  std::string out = fmt::format(
      "# Made by `conebench advise`. With a confidence of {:g}, a problem of the scene is solved "
      "to\n"
      "# eta <= {:g} within {:g} s by the first rung with a probability of at least {:.3f}.\n"
      "schema = {}\nscene = {}\ntol = {:g}\nbudget_s = {:g}\nconfidence = {:g}\n"
      "probability = {:.6g}\n",
      policy.confidence, policy.tol, policy.budget_s, policy.probability, kSchema,
      engine::quote(policy.scene), policy.tol, policy.budget_s, policy.confidence,
      policy.probability);
  for (const Policy::Rung& rung : policy.ladder) {
    out += fmt::format("\n[[ladder]]\nsolver = {}\ntime_limit_s = {:g}\n",
                       engine::quote(rung.solver), rung.time_limit_s);
  }
  return out;
}

Policy read_policy(const std::filesystem::path& path) {
  const engine::SceneText text = engine::load_scene_text(path.string(), {});
  const toml::table table = engine::parse_toml(text);
  engine::TomlReader in(table, "", text.subject);
  const std::int64_t schema = in.integer("schema", 1);
  problems::require(schema == kSchema, text.subject, "schema is ", schema, ", expected ", kSchema);
  Policy policy{.scene = in.text("scene"),
                .tol = in.number("tol", Range::kPositive),
                .budget_s = in.number("budget_s", Range::kPositive),
                .confidence = in.number("confidence", Range::kUnitInterval),
                .probability = in.number("probability", Range::kUnitInterval),
                .ladder = {}};
  for (engine::TomlReader& rung : in.tables("ladder")) {
    policy.ladder.push_back(read_rung(rung, text.subject));
  }
  in.finish();
  problems::require(!policy.ladder.empty(), text.subject,
                    "has no [[ladder]], expected at least one solver");
  return policy;
}

engine::StepSolver make_policy_solver(const Policy& policy, std::int64_t max_iterations) {
  struct Rung {
    solvers::Solver solver;
    engine::StepSolver step;
  };
  std::vector<Rung> rungs;
  for (const Policy::Rung& rung : policy.ladder) {
    rungs.push_back(
        {make_solver(rung.solver), make_step_solver({.name = rung.solver,
                                                     .tol = policy.tol,
                                                     .time_limit_s = rung.time_limit_s,
                                                     .max_iterations = max_iterations})});
  }
  return [rungs = std::move(rungs), tol = policy.tol](const problems::Problem& standard,
                                                      const Eigen::VectorXd& guess) {
    StepAnswer best;
    best.r = guess;
    double best_eta = std::numeric_limits<double>::infinity();
    std::int64_t iterations = 0;
    double solve_s = 0.0;
    for (const Rung& rung : rungs) {
      if (rung.solver.refuses(standard)) continue;
      StepAnswer answer = rung.step(standard, best.r);
      iterations += answer.iterations;
      solve_s += answer.solve_s;
      const double eta = problems::evaluate_eta(standard, answer.r);
      if (!(eta < best_eta)) continue;
      best_eta = eta;
      best = std::move(answer);
      best.converged = eta <= tol;
      if (best.converged) break;
    }
    problems::require(std::isfinite(best_eta), standard.name(),
                      "no solver of the policy has a finite answer, expected one that can take it");
    best.iterations = iterations;
    best.solve_s = solve_s;
    return best;
  };
}

}  // namespace conebench::harness
