#include "problems/problem.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "problems/error.h"
#include "problems/scaled_rows.h"

namespace conebench::problems {
namespace {

void require_finite_values(std::span<const double> values, std::string_view subject,
                           std::string_view what) {
  const auto size = static_cast<Eigen::Index>(values.size());
  if (Eigen::Map<const Eigen::VectorXd>(values.data(), size).allFinite()) return;
  for (std::size_t k = 0; k < values.size(); ++k) {
    require(std::isfinite(values[k]), subject, what, "[", k, "] is ", values[k],
            ", expected a finite number");
  }
}

void require_finite(const Eigen::VectorXd& v, std::string_view subject, std::string_view what) {
  require_finite_values({v.data(), static_cast<std::size_t>(v.size())}, subject, what);
}

void require_finite(const SparseMatrix& A, std::string_view subject, std::string_view what) {
  require_finite_values({A.valuePtr(), static_cast<std::size_t>(A.nonZeros())}, subject, what);
}

void require_shape(const SparseMatrix& A, Eigen::Index rows, Eigen::Index cols,
                   std::string_view subject, std::string_view what) {
  require(A.rows() == rows && A.cols() == cols, subject, what, " is ", A.rows(), " x ", A.cols(),
          ", expected ", rows, " x ", cols);
}

void require_size(const Eigen::VectorXd& v, Eigen::Index size, std::string_view subject,
                  std::string_view what) {
  require(v.size() == size, subject, what, " has ", v.size(), " entries, expected ", size);
}

void check_cone(const Cone& cone, std::size_t i, std::string_view subject) {
  require(cone.dim >= 1, subject, "cone ", i, " has dim ", cone.dim, ", expected >= 1");
  require(std::isfinite(cone.mu) && cone.mu >= 0.0, subject, "cone ", i, " has mu ", cone.mu,
          ", expected finite and >= 0");
  require(std::isfinite(cone.kappa) && cone.kappa >= 0.0, subject, "cone ", i, " has kappa ",
          cone.kappa, ", expected finite and >= 0");
  require(cone.theta >= 0.0 && cone.theta <= cone.mu, subject, "cone ", i, " has theta ",
          cone.theta, ", expected 0 <= theta <= mu = ", cone.mu);
}

std::vector<int> row_starts(std::span<const Cone> cones, std::string_view subject) {
  std::vector<int> start{0};
  start.reserve(cones.size() + 1);
  for (std::size_t i = 0; i < cones.size(); ++i) {
    check_cone(cones[i], i, subject);
    start.push_back(start.back() + cones[i].dim);
  }
  return start;
}

double spectral_norm(const Eigen::MatrixXd& A) {
  if (A.size() == 1) return std::abs(A(0, 0));
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(A.transpose() * A,
                                                             Eigen::EigenvaluesOnly);
  return std::sqrt(std::max(0.0, eigen.eigenvalues().maxCoeff()));
}

// The same for a symmetric A; no heap for the common size.
double symmetric_norm(const Eigen::MatrixXd& A) {
  if (A.size() == 1) return std::abs(A(0, 0));
  if (A.rows() != 3) {
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(A, Eigen::EigenvaluesOnly);
    return eigen.eigenvalues().cwiseAbs().maxCoeff();
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(A, Eigen::EigenvaluesOnly);
  return eigen.eigenvalues().cwiseAbs().maxCoeff();
}

void floor_mobility(Eigen::VectorXd& mobility) {
  if (mobility.size() == 0) return;
  mobility = mobility.cwiseMax(1e-12 * mobility.maxCoeff());
}

Eigen::VectorXd primal_mobility(const SparseMatrix& H, const SparseMatrix& inverse_root,
                                std::span<const int> start) {
  Eigen::VectorXd mobility(static_cast<Eigen::Index>(start.size()) - 1);
  ScaledRows rows(H, inverse_root);
  Eigen::MatrixXd block;
  for (Eigen::Index i = 0; i < mobility.size(); ++i) {
    const int first = start[static_cast<std::size_t>(i)];
    rows.load(first, start[static_cast<std::size_t>(i) + 1] - first);
    block = rows.S().lazyProduct(rows.S().transpose());
    mobility(i) = symmetric_norm(block);
  }
  floor_mobility(mobility);
  return mobility;
}

Eigen::VectorXd reduced_mobility(const SparseMatrix& W, std::span<const int> start) {
  Eigen::VectorXd mobility(static_cast<Eigen::Index>(start.size()) - 1);
  for (Eigen::Index i = 0; i < mobility.size(); ++i) {
    const int first = start[static_cast<std::size_t>(i)];
    const int dim = start[static_cast<std::size_t>(i) + 1] - first;
    mobility(i) = spectral_norm(Eigen::MatrixXd(W.block(first, first, dim, dim)));
  }
  floor_mobility(mobility);
  return mobility;
}

}  // namespace

Problem::Problem(PrimalData data, std::vector<Cone> cones, Metadata metadata,
                 std::optional<double> rate_scale)
    : f_(std::move(data.f)),
      w_(std::move(data.w)),
      cones_(std::move(cones)),
      metadata_(std::move(metadata)) {
  auto operators = std::make_shared<Operators>();
  operators->start = row_starts(cones_, name());
  const int rows = operators->start.back();
  const Eigen::Index dofs = data.M.rows();
  require_shape(data.M, dofs, dofs, name(), "M");
  require_shape(data.H, rows, dofs, name(), "H");
  require_size(f_, dofs, name(), "f");
  require_size(w_, rows, name(), "w");
  operators->M = canonical(std::move(data.M));
  operators->H = canonical(std::move(data.H));
  require_finite(operators->M, name(), "M.data");
  require_finite(operators->H, name(), "H.data");
  require_finite(f_, name(), "f");
  require_finite(w_, name(), "w");
  const double skew = asymmetry(operators->M);
  require(skew <= 1e-9, name(), "|M - M^T| / |M| is ", skew, ", expected M symmetric");
  operators->inertia = std::make_shared<const Inertia>(operators->M, name());
  operators->mobility =
      primal_mobility(operators->H, operators->inertia->inverse_root(), operators->start);
  operators_ = std::move(operators);
  q_ = H() * inertia().solve(f_) + w_;
  set_rate_scale(rate_scale);
}

Problem::Problem(ReducedData data, std::vector<Cone> cones, Metadata metadata,
                 std::optional<double> rate_scale)
    : q_(std::move(data.q)), cones_(std::move(cones)), metadata_(std::move(metadata)) {
  auto operators = std::make_shared<Operators>();
  operators->start = row_starts(cones_, name());
  const int rows = operators->start.back();
  require_shape(data.W, rows, rows, name(), "W");
  require_size(q_, rows, name(), "q");
  operators->W = canonical(std::move(data.W));
  require_finite(operators->W, name(), "W.data");
  require_finite(q_, name(), "q");
  const double skew = asymmetry(operators->W);
  require(skew <= kLargestAsymmetry, name(), "|W - W^T| / |W| is ", skew, ", expected at most ",
          kLargestAsymmetry, ": W symmetric up to rounding of the program that wrote it");
  const Eigen::VectorXd diagonal = operators->W.diagonal();
  const double lowest = rows > 0 ? -1e-12 * diagonal.maxCoeff() : 0.0;
  for (Eigen::Index row = 0; row < diagonal.size(); ++row) {
    require(diagonal(row) >= lowest, name(), "W(", row, ", ", row, ") is ", diagonal(row),
            ", expected >= 0: W positive semidefinite");
  }
  operators->mobility = reduced_mobility(operators->W, operators->start);
  operators_ = std::move(operators);
  set_rate_scale(rate_scale);
}

Problem::Problem(std::shared_ptr<const Operators> operators, std::vector<Cone> cones,
                 Metadata metadata, double rate_scale)
    : operators_(std::move(operators)),
      cones_(std::move(cones)),
      metadata_(std::move(metadata)),
      rate_scale_(rate_scale) {}

Problem Problem::with_metadata(Metadata metadata) const {
  Problem copy = *this;
  copy.metadata_ = std::move(metadata);
  return copy;
}

Problem Problem::with_laws(std::vector<Cone> cones, Eigen::VectorXd w) const {
  require_size(w, rows(), name(), "w");
  require_finite(w, name(), "w");
  require(row_starts(cones, name()) == operators_->start, name(),
          "the new cones have other dims, expected the same ones");
  Problem copy = *this;
  copy.q_ += w - this->w();
  copy.w_ = std::move(w);
  copy.cones_ = std::move(cones);
  copy.set_rate_scale({});
  return copy;
}

const SparseMatrix& Problem::M() const {
  if (!is_primal()) throw std::logic_error(name() + ": M asked of a reduced problem");
  return operators_->M;
}

const SparseMatrix& Problem::H() const {
  if (!is_primal()) throw std::logic_error(name() + ": H asked of a reduced problem");
  return operators_->H;
}

const Eigen::VectorXd& Problem::f() const {
  if (!is_primal()) throw std::logic_error(name() + ": f asked of a reduced problem");
  return f_;
}

const Eigen::VectorXd& Problem::w() const {
  if (!is_primal()) throw std::logic_error(name() + ": w asked of a reduced problem");
  return w_;
}

const Inertia& Problem::inertia() const {
  if (!is_primal()) throw std::logic_error(name() + ": inertia asked of a reduced problem");
  return *operators_->inertia;
}

const SparseMatrix& Problem::W() const {
  if (is_primal()) throw std::logic_error(name() + ": W asked of a primal problem");
  return operators_->W;
}

void Problem::check_rows(Eigen::Index rows) const {
  require(rows == this->rows(), name(), "r has ", rows, " entries, expected ", this->rows());
}

Eigen::VectorXd Problem::velocity(const Eigen::VectorXd& r) const {
  check_rows(r.size());
  return inertia().solve(f() + H().transpose() * r);
}

Eigen::VectorXd Problem::rate(const Eigen::VectorXd& r) const {
  if (is_primal()) return H() * velocity(r) + w_;
  check_rows(r.size());
  return W() * r + q_;
}

Eigen::VectorXd Problem::apply_delassus(const Eigen::VectorXd& r) const {
  check_rows(r.size());
  if (is_primal()) return H() * inertia().solve(H().transpose() * r);
  return W() * r;
}

SparseMatrix Problem::delassus() const {
  if (!is_primal()) return W();
  if (inertia().block_diagonal()) {
    const SparseMatrix scaled = H() * inertia().inverse_root();
    return SparseMatrix(scaled * SparseMatrix(scaled.transpose()));
  }
  // M couples many dofs: W is dense on what they touch, one column at a time.
  std::vector<Eigen::Triplet<double, int>> entries;
  for (int column = 0; column < rows(); ++column) {
    const Eigen::VectorXd h = H().row(column).transpose();
    const Eigen::VectorXd w = H() * inertia().solve(h);
    for (int row = 0; row < rows(); ++row) {
      if (w(row) != 0.0) entries.emplace_back(row, column, w(row));
    }
  }
  SparseMatrix W(rows(), rows());
  W.setFromTriplets(entries.begin(), entries.end());
  return W;
}

bool Problem::is_standard() const {
  return std::all_of(cones_.begin(), cones_.end(), [](const Cone& c) { return c.kappa == 0.0; });
}

Eigen::VectorXd Problem::tip_shift() const {
  Eigen::VectorXd shift = Eigen::VectorXd::Zero(rows());
  for (int i = 0; i < cone_count(); ++i)
    shift(start(i)) = cones_[static_cast<std::size_t>(i)].kappa;
  return shift;
}

Problem Problem::shifted() const {
  Problem standard = *this;
  if (is_standard()) return standard;
  const Eigen::VectorXd shift = tip_shift();
  if (is_primal()) {
    standard.f_ = f_ - H().transpose() * shift;
    standard.q_ = H() * inertia().solve(standard.f_) + w_;
  } else {
    standard.q_ = q_ - W() * shift;
  }
  for (Cone& cone : standard.cones_) cone.kappa = 0.0;
  return standard;
}

void Problem::set_rate_scale(std::optional<double> given) {
  rate_scale_ = given.value_or(0.0) > 0.0 ? *given : compute_rate_scale();
}

double Problem::compute_rate_scale() const {
  Eigen::VectorXd carried = Eigen::VectorXd::Zero(rows());
  if (is_primal()) carried = H().cwiseAbs() * inertia().solve(f_).cwiseAbs();
  double violation = 0.0, size = 0.0;
  Eigen::VectorXd wanted;
  for (int i = 0; i < cone_count(); ++i) {
    const Cone& cone = cones_[static_cast<std::size_t>(i)];
    const double pull = mobility()(i) * cone.kappa;
    const double rate = q_.segment(start(i), cone.dim).norm();
    wanted = q_.segment(start(i), cone.dim);
    add_de_saxce(cone.theta, wanted);
    wanted = -wanted;
    project(cone.mu, wanted);
    violation = std::max({violation, wanted.norm(), std::min(rate, pull)});
    size = std::max({size, rate, pull, carried.segment(start(i), cone.dim).norm()});
  }
  return std::max(violation, 1e-6 * size);
}

}  // namespace conebench::problems
