#include "harness/microbench/local_proof.h"

#include <unsupported/Eigen/Polynomials>
#include <vector>

#include "problems/cone.h"

namespace conebench::solvers {
namespace {

using Polynomial = Eigen::VectorXd;  // coefficients, constant first

Polynomial product(const Polynomial& a, const Polynomial& b) {
  Polynomial c = Polynomial::Zero(a.size() + b.size() - 1);
  for (Eigen::Index i = 0; i < a.size(); ++i) c.segment(i, b.size()) += a(i) * b;
  return c;
}

Polynomial padded(const Polynomial& a, Eigen::Index size) {
  Polynomial b = Polynomial::Zero(size);
  b.head(a.size()) = a;
  return b;
}

struct Spectrum {
  Eigen::MatrixXd range, null;
  Eigen::VectorXd values;  // of the range
};

Spectrum spectrum(const Eigen::MatrixXd& W) {
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(W);
  const Eigen::Index d = W.rows();
  Eigen::Index zeros = 0;
  while (zeros < d && eigen.eigenvalues()(zeros) <= 1e-14 * W.norm()) ++zeros;
  return {eigen.eigenvectors().rightCols(d - zeros), eigen.eigenvectors().leftCols(zeros),
          eigen.eigenvalues().tail(d - zeros)};
}

// min of |r_t| - mu r_n over W r = -q by descent over the null space; the gradient g there proves
// infeasibility when it lies in range(W) and the minimum is positive.
bool no_stick(const Eigen::MatrixXd& W, const Eigen::VectorXd& q, double mu) {
  const Spectrum s = spectrum(W);
  const Eigen::Index d = q.size();
  if (s.null.cols() > 0 && (s.null.transpose() * q).norm() > 1e-13 * q.norm()) return true;
  Eigen::VectorXd r = -s.range * (s.values.cwiseInverse().asDiagonal() * (s.range.transpose() * q));
  auto height = [&](const Eigen::VectorXd& x) { return x.tail(d - 1).norm() - mu * x(0); };
  auto gradient = [&](const Eigen::VectorXd& x) {
    Eigen::VectorXd g(d);
    g(0) = -mu;
    g.tail(d - 1) = x.tail(d - 1) / x.tail(d - 1).norm();
    return g;
  };
  for (int step = 0; step < 200 && s.null.cols() > 0; ++step) {  // Newton in the null space
    const Eigen::VectorXd t = r.tail(d - 1) / r.tail(d - 1).norm();
    const Eigen::MatrixXd Zt = s.null.bottomRows(d - 1);
    Eigen::MatrixXd hessian =
        Zt.transpose() * (Zt - t * (t.transpose() * Zt)) / r.tail(d - 1).norm();
    hessian.diagonal().array() += 1e-14 * (1.0 + hessian.norm());
    const Eigen::VectorXd slope = s.null.transpose() * gradient(r);
    const Eigen::VectorXd move = s.null * hessian.ldlt().solve(-slope);
    double length = 1.0;
    while (length > 1e-12 && height(r + length * move) > height(r)) length *= 0.5;
    r += length * move;
  }
  if (height(r) <= 0.0) return false;
  const Eigen::VectorXd g = -gradient(r);  // on the boundary of K*
  if (s.null.cols() > 0 && (s.null.transpose() * g).norm() > 1e-6) return false;
  const Eigen::VectorXd y =
      s.range * (s.values.cwiseInverse().asDiagonal() * (s.range.transpose() * g));
  return q.dot(y) > 0.0;
}

bool no_slide(const Eigen::MatrixXd& W, const Eigen::VectorXd& q, double mu) {
  const Eigen::Index t = q.size() - 1;
  const double Wnn = W(0, 0);
  const Eigen::VectorXd coupling = W.col(0).tail(t) / Wnn;
  const Eigen::MatrixXd S = W.bottomRightCorner(t, t) - coupling * W.col(0).tail(t).transpose();
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(S);
  const double unit = W.norm();  // a in units of W
  const Eigen::VectorXd b = eigen.eigenvectors().transpose() * (q.tail(t) - coupling * q(0));
  const Eigen::VectorXd w = eigen.eigenvectors().transpose() * coupling;
  // Per distinct pole -s of r_t(a): the squares of b there, and w . b there. Null directions share
  // the pole 0, so that the polynomial has no common factor.
  std::vector<double> pole, square_b, w_b;
  for (Eigen::Index k = 0; k < t; ++k) {
    const double s = eigen.eigenvalues()(k) > 4e-15 * unit ? eigen.eigenvalues()(k) / unit : 0.0;
    if (pole.empty() || s > 0.0 || pole.back() > 0.0) {
      pole.push_back(s);
      square_b.push_back(0.0);
      w_b.push_back(0.0);
    }
    square_b.back() += b(k) * b(k);
    w_b.back() += w(k) * b(k);
  }
  const std::size_t poles = pole.size();
  auto product_without = [&](std::size_t skip) {
    Polynomial p = Polynomial::Ones(1);
    for (std::size_t k = 0; k < poles; ++k) {
      if (k != skip) p = product(p, Eigen::Vector2d(pole[k], 1.0));
    }
    return p;
  };
  const auto degree = static_cast<Eigen::Index>(poles);
  Polynomial normal = -q(0) / Wnn * unit * product_without(poles);  // r_n times prod (s + a)
  Polynomial square = Polynomial::Zero(2 * degree + 1);
  for (std::size_t k = 0; k < poles; ++k) {
    const Polynomial rest = product_without(k);
    normal += padded(w_b[k] * rest, degree + 1);
    square -= padded(square_b[k] * product(rest, rest), 2 * degree + 1);
  }
  square += mu * mu * product(normal, normal);
  const Eigen::PolynomialSolver<double, Eigen::Dynamic> solver(Polynomial(square / square.norm()));
  for (const auto& root : solver.roots()) {
    const bool real = std::abs(root.imag()) <= 1e-7 * std::abs(root.real());
    if (!real || root.real() <= 1e-12) continue;
    if (Eigen::poly_eval(normal, root.real()) > 0.0) return false;
  }
  return true;
}

}  // namespace

double largest_eigenvalue(const Eigen::MatrixXd& W) {
  return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(W, Eigen::EigenvaluesOnly)
      .eigenvalues()
      .maxCoeff();
}

double backward_residual(const Eigen::MatrixXd& W, const Eigen::VectorXd& q, double mu,
                         double theta, const Eigen::VectorXd& r) {
  const double lambda = largest_eigenvalue(W);
  Eigen::VectorXd u = W * r + q;
  problems::add_de_saxce(theta, u);
  Eigen::VectorXd projected = r - u / lambda;
  problems::project(mu, projected);
  return lambda * (r - projected).norm() / std::max(q.norm(), lambda * r.norm());
}

bool proved_unsolvable(const Eigen::MatrixXd& W, const Eigen::VectorXd& q, double mu) {
  if (q(0) >= 0.0) return false;
  if (W(0, 0) <= 0.0) return true;  // then row n of W is zero and u_n = q_n < 0 whatever r
  return no_stick(W, q, mu) && no_slide(W, q, mu);
}

}  // namespace conebench::solvers
