#pragma once

#include <Eigen/Core>
#include <memory>
#include <span>
#include <vector>

#include "mpm/scene.h"
#include "problems/problem_file.h"

namespace conebench::mpm {

using problems::NodeState;

/// What the stress nodes of a step are like before it is solved, one entry a node.
struct LawInput {
  Eigen::VectorXd density;    ///< phi / phi_max [-]
  Eigen::VectorXd gap;        ///< g = sqrt(2/d) (phi_max V - Phi)_+ / h [rate_unit]
  Eigen::VectorXd tip;        ///< h (c/mu) sqrt(d/2), the full strength [force_unit]
  Eigen::VectorXd free_rate;  ///< (B v*)_0, as if no stress acted [rate_unit]
};

/// The law of one node: its cone's tip at -kappa, and how far it may compress, w_0.
struct NodeLaw {
  double kappa = 0.0;
  double gap = 0.0;
};

/// Where cohesion acts. A law sorts the nodes before the step is solved; `monotone` sorts them
/// anew from the solution (monotone_search.h).
///
/// A node without cohesion is dry in every law: kappa = 0, w_0 = g.
class CohesionLaw {
 public:
  /// A node from this share of phi_max on is dense.
  static constexpr double kDense = 0.999;

  virtual ~CohesionLaw() = default;
  virtual std::vector<NodeState> classify(const LawInput& input) const;
  virtual NodeLaw law_of(const LawInput& input, int node, NodeState state) const;
};

/// p = -c below phi_max: grains attract at a distance (the report's equation 5). For the record.
class UniformLaw : public CohesionLaw {
 public:
  NodeLaw law_of(const LawInput& input, int node, NodeState state) const override;
};

/// p = 0 below phi_max (equation 6). The strength rises from 0 to c over the last 0.1 % of
/// density, as in Sand6.
class DenseOnlyLaw : public CohesionLaw {
 public:
  NodeLaw law_of(const LawInput& input, int node, NodeState state) const override;
};

/// p = 0 below phi_max where the medium compresses (equation 7), read off the free velocity:
/// bonded where (B v*)_0 >= -kTolerance max |(B v*)_0|.
class DilationAwareLaw : public CohesionLaw {
 public:
  static constexpr double kTolerance = 1e-8;
  std::vector<NodeState> classify(const LawInput& input) const override;
};

/// The same start; the solution then decides.
class MonotoneLaw : public DilationAwareLaw {};

std::unique_ptr<CohesionLaw> make_law(Law law);

}  // namespace conebench::mpm
