#include "solvers/registry.h"

#include "solvers/aclm.h"
#include "solvers/auto.h"
#include "solvers/gs.h"
#include "solvers/ipm.h"
#include "solvers/ipopt.h"
#include "solvers/ipopt_convex.h"
#include "solvers/newton/newton.h"
#include "solvers/nlopt_convex.h"
#include "solvers/siconos.h"
#include "solvers/spg.h"

namespace conebench::solvers {
namespace {

std::vector<Method> table() {
  std::vector<Method> methods{automatic(),
                              gauss_seidel(),
                              spectral_projected_gradient(),
                              alart_curnier_newton(),
                              fischer_burmeister_newton(),
                              aclm(),
                              interior_point(),
                              aclm_interior_point(),
                              ipopt(),
                              aclm_ipopt(),
                              nlopt()};
  for (Method& peer : siconos_methods()) methods.push_back(std::move(peer));
  return methods;
}

}  // namespace

std::span<const Method> all_methods() {
  static const std::vector<Method> kMethods = table();
  return kMethods;
}

}  // namespace conebench::solvers
