#pragma once

#include <vector>

#include "problems/problem.h"

namespace conebench::solvers {

/// One dense d_i x d_i block a cone, column-major, in one array: Jacobians and scalings of cones.
class BlockDiagonal {
 public:
  using Block = Eigen::Map<Eigen::MatrixXd>;
  using ConstBlock = Eigen::Map<const Eigen::MatrixXd>;

  /// Zero blocks.
  explicit BlockDiagonal(const problems::Problem& problem) {
    std::size_t size = 0;
    for (const problems::Cone& cone : problem.cones()) {
      dims_.push_back(cone.dim);
      begin_.push_back(size);
      size += static_cast<std::size_t>(cone.dim * cone.dim);
    }
    values_.assign(size, 0.0);
  }

  int count() const { return static_cast<int>(dims_.size()); }
  Block operator[](int i) {
    const auto k = static_cast<std::size_t>(i);
    return {values_.data() + begin_[k], dims_[k], dims_[k]};
  }
  ConstBlock operator[](int i) const {
    const auto k = static_cast<std::size_t>(i);
    return {values_.data() + begin_[k], dims_[k], dims_[k]};
  }

  /// The products with a vector of one entry a row.
  Eigen::VectorXd operator*(const Eigen::VectorXd& x) const {
    return product(x, [this](int i) { return (*this)[i]; });
  }
  Eigen::VectorXd transpose_times(const Eigen::VectorXd& x) const {
    return product(x, [this](int i) { return (*this)[i].transpose(); });
  }

 private:
  template <class BlockOf>
  Eigen::VectorXd product(const Eigen::VectorXd& x, const BlockOf& block) const {
    Eigen::VectorXd y(x.size());
    Eigen::Index at = 0;
    for (int i = 0; i < count(); ++i) {
      const int dim = dims_[static_cast<std::size_t>(i)];
      y.segment(at, dim).noalias() = block(i) * x.segment(at, dim);
      at += dim;
    }
    return y;
  }

  std::vector<int> dims_;
  std::vector<std::size_t> begin_;
  std::vector<double> values_;
};

}  // namespace conebench::solvers
