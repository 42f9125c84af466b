#pragma once

#include <Eigen/Core>

namespace conebench::solvers {

/// Calls function.template operator()<D>() with D = dim where cones of that dimension have code of
/// their own, else with D = Eigen::Dynamic.
template <class Function>
decltype(auto) with_dimension(Eigen::Index dim, const Function& function) {
  switch (dim) {
    case 1:
      return function.template operator()<1>();
    case 2:
      return function.template operator()<2>();
    case 3:
      return function.template operator()<3>();
    case 6:
      return function.template operator()<6>();
    default:
      return function.template operator()<Eigen::Dynamic>();
  }
}

}  // namespace conebench::solvers
