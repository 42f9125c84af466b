#include "solvers/linear/scaled_system.h"

#include <Eigen/QR>
#include <cmath>

#include "solvers/linear/general_system.h"
#include "solvers/linear/kkt_system.h"
#include "solvers/linear/normal_system.h"

namespace conebench::solvers {
namespace {

using problems::Problem;

constexpr double kRegularisation = 1e-13;  // of W, as a share of the mobility

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
    : problem_(problem), identity_(problem), L_(problem), S_(problem), SC_(problem) {
  if (!symmetric) {
    general_ = std::make_unique<GeneralSystem>(problem, GeneralSystem::Form::kAuto, true);
    for (int i = 0; i < identity_.count(); ++i) identity_[i].setIdentity();
    return;
  }
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

bool ScaledSystem::can_be_finer() const { return may_switch_ && normal_ != nullptr; }

void ScaledSystem::be_finer() {
  normal_.reset();
  kkt_ = std::make_unique<KktSystem>(problem_);
}

bool ScaledSystem::factorize(const BlockDiagonal& R, const BlockDiagonal& C) {
  for (int i = 0; i < R.count(); ++i) {
    L_[i] = root(kRegularisation * problem_.mobility()(i), R[i]);
    S_[i] = L_[i].triangularView<Eigen::Lower>().solve(R[i]);
  }
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
  z = kkt_ ? kkt_->solve(z) : normal_ ? normal_->solve_root(z) : general_->solve(z);
  for (int i = 0; i < L_.count(); ++i) {
    auto part = z.segment(problem_.start(i), L_[i].rows());
    L_[i].transpose().triangularView<Eigen::Upper>().solveInPlace(part);
  }
  return z;
}

double ScaledSystem::work_s() const {
  return kkt_ ? kkt_->work_s() : normal_ ? normal_->work_s() : general_->work_s();
}

}  // namespace conebench::solvers
