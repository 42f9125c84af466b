#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "problems/problem_file.h"

namespace conebench::results {

/// What a contact does in an answer.
enum class ContactState { kOpen, kStick, kSlide };

/// One solver's answer to a problem, contact by contact, as problems::evaluate_residual judges it.
struct AnswerView {
  std::string solver;
  double eta = 0.0;
  Eigen::VectorXd force;           ///< |r'_i| [force_unit]
  Eigen::VectorXd normal_force;    ///< r_i,n = r'_i,n - kappa_i: < 0 pulls [force_unit]
  Eigen::VectorXd eta_of_cone;     ///< [-]
  Eigen::VectorXd penetration;     ///< max(0, -u_n) [rate_unit]
  Eigen::VectorXd cone_violation;  ///< max(0, |r'_t| - mu r'_n) [force_unit]
  Eigen::VectorXd work;            ///< |r' . u_hat| [force_unit rate_unit]
  Eigen::VectorXd misalignment;    ///< of friction to sliding [rad]
  std::vector<ContactState> state;
};

/// A problem in space, with the answers of one or two solvers: what the page's 3D view shows.
struct ProblemView {
  std::string name, family, content_sha256;
  std::string force_unit, rate_unit;
  problems::Geometry geometry;  ///< with points
  std::vector<bool> cohesive;   ///< of each cone: kappa > 0
  std::vector<AnswerView> answers;
  /// Of two answers, cone by cone: |u_a - u_b|, and |r_a - r_b|, which may differ for two exact
  /// answers, since r is not unique. Empty for one.
  Eigen::VectorXd rate_difference, force_difference;
};

/// More cones than this are not shown: the page would grow too large.
inline constexpr int kMostConesShown = 3000;

/// A solver and its r'.
struct Answer {
  std::string solver;
  Eigen::VectorXd r;
};

/// `file` must have a geometry with points; at least one answer, of which the first two are shown.
/// A contact is open where its force lies below what eta can tell from zero, and slides where
/// |u_t| > 10 eta U (as Residual::misalignment).
/// Cost: evaluate_residual() an answer. Throws problems::InputError for an r of a wrong length.
ProblemView view_of(const problems::ProblemFile& file, const std::vector<Answer>& answers);

}  // namespace conebench::results
