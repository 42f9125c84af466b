#include "solvers/registry.h"

#include <array>

#include "solvers/gs.h"
#include "solvers/spg.h"

namespace conebench::solvers {

std::span<const Method> all_methods() {
  static const std::array<Method, 2> kMethods{gauss_seidel(), spectral_projected_gradient()};
  return kMethods;
}

}  // namespace conebench::solvers
