#pragma once

#include <Eigen/Core>

#include "problems/cone.h"

namespace conebench::solvers {

using ConstPart = Eigen::Ref<const Eigen::VectorXd>;
using Part = Eigen::Ref<Eigen::VectorXd>;
using PartMatrix = Eigen::Ref<Eigen::MatrixXd>;

/// A semismooth function of one cone whose zeros are the solutions of its law,
///
///   phi(p, u) = 0   if and only if   K_mu* contains u_hat, orthogonal to p in K_mu,
///
/// where p = lambda r is the reaction as a rate, so that both arguments and phi share one unit.
/// Positively homogeneous: a change of unit scales phi alike.
class ConeFunction {
 public:
  virtual ~ConeFunction() = default;

  virtual void value(const problems::Cone& cone, const ConstPart& p, const ConstPart& u,
                     Part phi) const = 0;
  /// dphi/dp and dphi/du; at a kink the element of the generalised Jacobian that the class states.
  virtual void jacobian(const problems::Cone& cone, const ConstPart& p, const ConstPart& u,
                        PartMatrix dp, PartMatrix du) const = 0;
};

}  // namespace conebench::solvers
