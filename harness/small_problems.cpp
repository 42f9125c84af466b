#include "harness/small_problems.h"

namespace conebench::harness {

std::vector<NamedRecipe> small_recipes() {
  using problems::Family;
  return {
      {"made-2d", {.cones = 30, .dims = {2}}},
      {"made-3d", {.cones = 40, .dims = {3}}},
      {"made-6d", {.cones = 20, .dims = {6}}},
      {"made-mixed-dims", {.cones = 30, .dims = {1, 2, 3, 6}}},
      {"made-frictionless", {.cones = 30, .dims = {1}, .mu_low = 0.0, .mu_high = 0.0}},
      {"made-cohesive", {.cones = 40, .dims = {3}, .cohesive_share = 0.5}},
      {"made-associated", {.cones = 30, .dims = {3}, .theta_share = 0.0}},
      {"made-rank-deficient", {.family = Family::kRankDeficient, .cones = 40, .dims = {3}}},
      {"made-reduced", {.cones = 30, .dims = {3}, .reduced = true}},
  };
}

problems::Problem make_named(const NamedRecipe& named) {
  const problems::Problem problem = problems::make_backwards(named.recipe).problem;
  problems::Metadata metadata = problem.metadata();
  metadata.name = named.name;
  return problem.with_metadata(metadata);
}

}  // namespace conebench::harness
