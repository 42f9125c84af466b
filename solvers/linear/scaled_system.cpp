#include "solvers/linear/scaled_system.h"

#include <Eigen/QR>
#include <cmath>

#include "solvers/linear/general_system.h"
#include "solvers/linear/gmres.h"
#include "solvers/linear/kkt_system.h"
#include "solvers/linear/normal_system.h"

namespace conebench::solvers {
namespace {

using problems::Problem;

constexpr double kRegularisation = 1e-13;  // of W, as a share of the mobility
// Relative residuals: see ScaledSystem::fine(), refined().
constexpr double kFine = 1e-10, kRefined = 1e-13;
// With GMRES: an interior point loses a few iterations by it at most.
constexpr double kLoose = 1e-3, kKrylovResidual = 1e-4;
constexpr int kMostKrylov = 40;
constexpr double kSlidingWork = 3.0;  // of a factorisation with GMRES, over one without

// L with L L^T = I + delta R R^T, from the QR factors of [I; sqrt(delta) R^T]: whatever the size of
// R, nothing is squared.
Eigen::MatrixXd root(double delta, const Eigen::Ref<const Eigen::MatrixXd>& R) {
  const Eigen::Index dim = R.rows();
  Eigen::MatrixXd stacked(2 * dim, dim);
  stacked.topRows(dim).setIdentity();
  stacked.bottomRows(dim) = std::sqrt(delta) * R.transpose();
  const Eigen::HouseholderQR<Eigen::MatrixXd> qr(stacked);
  const Eigen::MatrixXd upper = qr.matrixQR().topRows(dim).triangularView<Eigen::Upper>();
  return upper.transpose();
}

}  // namespace

ScaledSystem::ScaledSystem(const Problem& problem, Form form, bool symmetric)
    : problem_(problem),
      symmetric_(symmetric),
      identity_(problem),
      C_(problem),
      L_(problem),
      S_(problem),
      SC_(problem) {
  for (int i = 0; i < identity_.count(); ++i) identity_[i].setIdentity();
  may_switch_ = form == Form::kAuto && problem.is_primal();
  const bool kkt = form == Form::kKkt ||
                   (may_switch_ && KktSystem::nonzeros(problem) < NormalSystem::nonzeros(problem));
  if (kkt) {
    kkt_ = std::make_unique<KktSystem>(problem);
  } else {
    normal_ = std::make_unique<NormalSystem>(problem);
  }
}
ScaledSystem::~ScaledSystem() = default;

bool ScaledSystem::can_be_finer() const {
  return symmetric_ ? may_switch_ && normal_ != nullptr : general_ == nullptr;
}

void ScaledSystem::be_finer() {
  normal_.reset();
  kkt_.reset();
  if (symmetric_) {
    kkt_ = std::make_unique<KktSystem>(problem_);
  } else {
    general_ = std::make_unique<GeneralSystem>(problem_, GeneralSystem::Form::kAuto, true);
  }
}

double ScaledSystem::fine() const { return symmetric_ || general_ ? kFine : kLoose; }
double ScaledSystem::refined() const { return symmetric_ || general_ ? kRefined : kLoose; }

bool ScaledSystem::factorize(const BlockDiagonal& R, const BlockDiagonal& C) {
  for (int i = 0; i < R.count(); ++i) {
    L_[i] = root(kRegularisation * problem_.mobility()(i), R[i]);
    S_[i] = L_[i].triangularView<Eigen::Lower>().solve(R[i]);
  }
  C_ = C;
  if (kkt_) return kkt_->factorize(S_);
  if (normal_) return normal_->factorize_root(S_);
  for (int i = 0; i < R.count(); ++i) SC_[i].noalias() = S_[i] * C[i];
  return general_->factorize(identity_, SC_, &S_);
}

Eigen::VectorXd ScaledSystem::solve(Eigen::VectorXd z) const {
  for (int i = 0; i < L_.count(); ++i) {
    auto part = z.segment(problem_.start(i), L_[i].rows());
    L_[i].triangularView<Eigen::Lower>().solveInPlace(part);
  }
  z = general_ ? general_->solve(z) : symmetric_ ? solve_symmetric(z) : solve_sliding(z);
  for (int i = 0; i < L_.count(); ++i) {
    auto part = z.segment(problem_.start(i), L_[i].rows());
    L_[i].transpose().triangularView<Eigen::Upper>().solveInPlace(part);
  }
  return z;
}

Eigen::VectorXd ScaledSystem::solve_symmetric(const Eigen::VectorXd& z) const {
  return kkt_ ? kkt_->solve(z) : normal_->solve_root(z);
}

// t_i = c_i.(W S^T y)_i of each cone for y = solve_symmetric(z).
Eigen::VectorXd ScaledSystem::slide(const Eigen::VectorXd& z) const {
  const Eigen::VectorXd u = kkt_ ? kkt_->solve_rate(z) : normal_->solve_root_rate(z);
  Eigen::VectorXd t(problem_.cone_count());
  for (int i = 0; i < problem_.cone_count(); ++i) {
    const Eigen::Index tangents = S_[i].rows() - 1;
    t(i) = C_[i].row(0).tail(tangents).dot(u.segment(problem_.start(i) + 1, tangents));
  }
  return t;
}

// S e_n t.
Eigen::VectorXd ScaledSystem::kick(const Eigen::VectorXd& t) const {
  Eigen::VectorXd z(problem_.rows());
  for (int i = 0; i < problem_.cone_count(); ++i) {
    z.segment(problem_.start(i), S_[i].rows()) = t(i) * S_[i].col(0);
  }
  return z;
}

// (I + S W S^T) y = z - kick(t), in which t + slide(kick(t)) = slide(z).
Eigen::VectorXd ScaledSystem::solve_sliding(const Eigen::VectorXd& z) const {
  const auto apply = [this](const Eigen::VectorXd& t) {
    return Eigen::VectorXd(t + slide(kick(t)));
  };
  return solve_symmetric(z - kick(gmres(apply, slide(z), kKrylovResidual, kMostKrylov).x));
}

double ScaledSystem::work_s() const {
  if (general_) return general_->work_s();
  const double factor_s = kkt_ ? kkt_->work_s() : normal_->work_s();
  return symmetric_ ? factor_s : kSlidingWork * factor_s;
}

}  // namespace conebench::solvers
