#pragma once

#include <Eigen/Dense>

namespace conebench::solvers {

/// |W|_2 of a symmetric PSD matrix.
double largest_eigenvalue(const Eigen::MatrixXd& W);

/// lambda |r - P_K(r - u_hat / lambda)| / max(|q|, lambda |r|) with u = W r + q: the backward
/// residual of a one-cone answer.
double backward_residual(const Eigen::MatrixXd& W, const Eigen::VectorXd& q, double mu,
                         double theta, const Eigen::VectorXd& r);

/// A proof, made without the solver, that one Coulomb cone (theta = mu > 0) has no solution:
/// r = 0 violates the law; no r in K has W r = -q (a vector y with W y in K* and q.y > 0, or with
/// W y = 0 and q.y != 0); and the slide's polynomial, squared to degree 2 (d - 1) in a, has no
/// root a > 0 with r_n > 0. False means only that this proof failed.
bool proved_unsolvable(const Eigen::MatrixXd& W, const Eigen::VectorXd& q, double mu);

}  // namespace conebench::solvers
