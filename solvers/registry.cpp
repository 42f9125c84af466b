#include "solvers/registry.h"

#include "solvers/aclm.h"
#include "solvers/admm.h"
#include "solvers/apgd.h"
#include "solvers/auto.h"
#include "solvers/ccp.h"
#include "solvers/extragradient.h"
#include "solvers/gs.h"
#include "solvers/gs_parallel.h"
#include "solvers/ipm.h"
#include "solvers/ipopt.h"
#include "solvers/ipopt_convex.h"
#include "solvers/newton/newton.h"
#include "solvers/nlopt_convex.h"
#include "solvers/ppa.h"
#include "solvers/prox_newton.h"
#include "solvers/pyramid.h"
#include "solvers/siconos.h"
#include "solvers/spg.h"
#include "solvers/uzawa.h"

namespace conebench::solvers {
namespace {

std::vector<Method> table() {
  std::vector<Method> methods{automatic(),
                              gauss_seidel(),
                              gauss_seidel_parallel(),
                              spectral_projected_gradient(),
                              apgd(),
                              uzawa(),
                              extragradient(),
                              admm(),
                              alart_curnier_newton(),
                              fischer_burmeister_newton(),
                              proximal_newton(),
                              proximal_point(),
                              aclm(),
                              interior_point(),
                              aclm_interior_point(),
                              ipopt(),
                              aclm_ipopt(),
                              nlopt(),
                              cone_complementarity_model(),
                              pyramid_model()};
  for (Method& peer : siconos_methods()) methods.push_back(std::move(peer));
  return methods;
}

}  // namespace

std::span<const Method> all_methods() {
  static const std::vector<Method> kMethods = table();
  return kMethods;
}

}  // namespace conebench::solvers
