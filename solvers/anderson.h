#pragma once

#include <Eigen/QR>
#include <algorithm>
#include <deque>

namespace conebench::solvers {

/// Anderson acceleration of a fixed point x = g(x): from the last `depth` pairs it takes the
/// combination of g's that would have the least residual if g were affine.
/// Cost    2 n depth^2 flops a step.
/// Source  Walker & Ni, SIAM J. Numer. Anal. 49(4) (2011) (not checked).
class Anderson {
 public:
  explicit Anderson(int depth) : depth_(static_cast<std::size_t>(depth)) {}

  void restart() {
    x_changes_.clear();
    f_changes_.clear();
    x_.resize(0);
  }

  /// The next x after g(x) was evaluated.
  Eigen::VectorXd next(const Eigen::VectorXd& x, const Eigen::VectorXd& gx) {
    const Eigen::VectorXd f = gx - x;
    if (x_.size() > 0 && depth_ > 0) {
      x_changes_.push_back(x - x_);
      f_changes_.push_back(f - f_);
      if (x_changes_.size() > depth_) {
        x_changes_.pop_front();
        f_changes_.pop_front();
      }
    }
    x_ = x;
    f_ = f;
    if (x_changes_.empty()) return gx;
    const auto columns = static_cast<Eigen::Index>(f_changes_.size());
    Eigen::MatrixXd F(f.size(), columns);
    for (Eigen::Index k = 0; k < columns; ++k) F.col(k) = f_changes_[static_cast<std::size_t>(k)];
    Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(F);
    qr.setThreshold(1e-8);
    const Eigen::VectorXd weights = qr.solve(f);
    Eigen::VectorXd result = gx;
    for (Eigen::Index k = 0; k < columns; ++k) {
      const auto at = static_cast<std::size_t>(k);
      result -= weights(k) * (x_changes_[at] + f_changes_[at]);
    }
    return result;
  }

 private:
  std::size_t depth_;
  std::deque<Eigen::VectorXd> x_changes_, f_changes_;
  Eigen::VectorXd x_, f_;
};

}  // namespace conebench::solvers
