#pragma once

#include <vector>

#include "problems/problem.h"
#include "solvers/with_dimension.h"

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
  Block operator[](int i) { return block<Eigen::Dynamic>(i); }
  ConstBlock operator[](int i) const { return block<Eigen::Dynamic>(i); }

  /// The same with d_i = D known to the compiler.
  template <int D>
  Eigen::Map<Eigen::Matrix<double, D, D>> block(int i) {
    const auto k = static_cast<std::size_t>(i);
    return {values_.data() + begin_[k], dims_[k], dims_[k]};
  }
  template <int D>
  Eigen::Map<const Eigen::Matrix<double, D, D>> block(int i) const {
    const auto k = static_cast<std::size_t>(i);
    return {values_.data() + begin_[k], dims_[k], dims_[k]};
  }

  /// The products with a vector of one entry a row.
  Eigen::VectorXd operator*(const Eigen::VectorXd& x) const { return product<false>(x); }
  Eigen::VectorXd transpose_times(const Eigen::VectorXd& x) const { return product<true>(x); }

 private:
  template <bool kTransposed>
  Eigen::VectorXd product(const Eigen::VectorXd& x) const {
    Eigen::VectorXd y(x.size());
    Eigen::Index at = 0;
    for (int i = 0; i < count(); ++i) {
      const int dim = dims_[static_cast<std::size_t>(i)];
      with_dimension(dim, [&]<int D>() {
        const auto part = x.segment<D>(at, dim);
        if constexpr (kTransposed) {
          y.segment<D>(at, dim) = block<D>(i).transpose().lazyProduct(part);
        } else {
          y.segment<D>(at, dim) = block<D>(i).lazyProduct(part);
        }
      });
      at += dim;
    }
    return y;
  }

  std::vector<int> dims_;
  std::vector<std::size_t> begin_;
  std::vector<double> values_;
};

}  // namespace conebench::solvers
