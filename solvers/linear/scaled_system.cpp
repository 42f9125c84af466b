#include "solvers/linear/scaled_system.h"

#include <Eigen/Cholesky>
#include <Eigen/QR>
#include <cmath>

#include "solvers/linear/general_system.h"
#include "solvers/linear/kkt_system.h"
#include "solvers/linear/normal_system.h"
#include "solvers/linear/sliding_system.h"

namespace conebench::solvers {
namespace {

using problems::Problem;

constexpr double kRegularisation = 1e-13;  // of W, as a share of the mobility
// Relative residuals: see ScaledSystem::fine(), refined(). With LU of normal equations an interior
// point loses nothing by the looser ones.
constexpr double kFine = 1e-10, kRefined = 1e-13;
constexpr double kLoose = 1e-3;

// L with L L^T = I + delta R R^T. Where the second term is large, from the QR factors of
// [I; sqrt(delta) R^T]: nothing is squared.
template <class Matrix>
Matrix root(double delta, const Matrix& R) {
  if constexpr (Matrix::RowsAtCompileTime == 1) {
    return Matrix(std::hypot(1.0, std::sqrt(delta) * R(0)));
  } else {
    const Eigen::Index dim = R.rows();
    const Matrix gram = delta * R.lazyProduct(R.transpose());
    if (gram.norm() < 1.0) return (Matrix::Identity(dim, dim) + gram).llt().matrixL();
    Eigen::MatrixXd stacked(2 * dim, dim);
    stacked.topRows(dim).setIdentity();
    stacked.bottomRows(dim) = std::sqrt(delta) * R.transpose();
    const Eigen::HouseholderQR<Eigen::MatrixXd> qr(stacked);
    const Eigen::MatrixXd upper =
        qr.matrixQR().topRows(dim).template triangularView<Eigen::Upper>();
    return upper.transpose();
  }
}

}  // namespace

ScaledSystem::ScaledSystem(const Problem& problem, Form form, bool symmetric)
    : problem_(problem),
      symmetric_(symmetric),
      may_switch_(form == Form::kAuto && problem.is_primal()),
      identity_(problem),
      L_(problem),
      S_(problem),
      SC_(problem) {
  for (int i = 0; i < identity_.count(); ++i) identity_[i].setIdentity();
  const bool kkt = form == Form::kKkt ||
                   (may_switch_ && KktSystem::nonzeros(problem) < NormalSystem::nonzeros(problem));
  if (kkt || (!symmetric && !problem.is_primal())) {
    be_finer();
  } else if (symmetric) {
    normal_ = std::make_unique<NormalSystem>(problem);
  } else {
    sliding_ = std::make_unique<SlidingSystem>(problem);
  }
}
ScaledSystem::~ScaledSystem() = default;

void ScaledSystem::be_finer() {
  may_switch_ = false;
  normal_.reset();
  sliding_.reset();
  if (symmetric_) {
    kkt_ = std::make_unique<KktSystem>(problem_);
  } else {
    general_ = std::make_unique<GeneralSystem>(problem_, GeneralSystem::Form::kAuto, true);
  }
}

double ScaledSystem::fine() const { return sliding_ ? kLoose : kFine; }
double ScaledSystem::refined() const { return sliding_ ? kLoose : kRefined; }

bool ScaledSystem::factorize(const BlockDiagonal& R, const BlockDiagonal& C) {
  for (int i = 0; i < R.count(); ++i) {
    const double delta = kRegularisation * problem_.mobility()(i);
    with_dimension(R[i].rows(), [&]<int D>() {
      using Matrix = Eigen::Matrix<double, D, D>;
      const Matrix Ri = R.block<D>(i);
      const Matrix L = root(delta, Ri);
      const Matrix S = L.template triangularView<Eigen::Lower>().solve(Ri);
      L_.block<D>(i) = L;
      S_.block<D>(i) = S;
      if (!symmetric_) SC_.block<D>(i) = S.lazyProduct(C.block<D>(i));
    });
  }
  if (kkt_) return kkt_->factorize(S_);
  if (normal_) return normal_->factorize_root(S_);
  if (sliding_) return sliding_->factorize(S_, SC_);
  return general_->factorize(identity_, SC_, &S_);
}

Eigen::VectorXd ScaledSystem::solve(Eigen::VectorXd z) const {
  const auto for_parts = [&](const auto& function) {
    for (int i = 0; i < L_.count(); ++i) {
      const Eigen::Index at = problem_.start(i), dim = L_[i].rows();
      with_dimension(dim, [&]<int D>() {
        auto part = z.segment<D>(at, dim);
        function(L_.block<D>(i), part);
      });
    }
  };
  for_parts([](const auto& L, auto& part) {
    L.template triangularView<Eigen::Lower>().solveInPlace(part);
  });
  z = kkt_       ? kkt_->solve(z)
      : normal_  ? normal_->solve_root(z)
      : sliding_ ? sliding_->solve(z)
                 : general_->solve(z);
  for_parts([](const auto& L, auto& part) {
    L.transpose().template triangularView<Eigen::Upper>().solveInPlace(part);
  });
  return z;
}

double ScaledSystem::work_s() const {
  return kkt_       ? kkt_->work_s()
         : normal_  ? normal_->work_s()
         : sliding_ ? sliding_->work_s()
                    : general_->work_s();
}

}  // namespace conebench::solvers
