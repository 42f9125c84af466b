#pragma once

#include <string>
#include <vector>

#include "problems/made_backwards.h"

namespace conebench::harness {

/// A recipe and what it is called in tables.
struct NamedRecipe {
  std::string name;
  problems::Recipe recipe;
};

/// Small problems with known solutions: every dimension, mixed dimensions, frictionless, cohesive,
/// associated, rank-deficient, reduced. What `solver check` and `demo` use.
std::vector<NamedRecipe> small_recipes();

/// The problem of a recipe, under that name.
problems::Problem make_named(const NamedRecipe& named);

}  // namespace conebench::harness
