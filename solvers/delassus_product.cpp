#include "solvers/delassus_product.h"

#include <numeric>

#include "solvers/with_dimension.h"

namespace conebench::solvers {
namespace {

using problems::Problem;

constexpr double kSecondsPerBlockEntry = 3.5e-10;  // of B both ways, of W once
constexpr double kSecondsPerNonzero = 1e-9;

// function(cone, first row of its part, dim).
template <class Function>
void for_each_cone(const Problem& problem, std::span<const int> cones, const Function& function) {
  int at = 0;
  for (const int i : cones) {
    const int dim = problem.cones()[static_cast<std::size_t>(i)].dim;
    with_dimension(dim, [&]<int D>() { function.template operator()<D>(i, at, dim); });
    at += dim;
  }
}

// y = B^T r of some cones, then u = B y, and q where it is given, of some.
template <class Products>
void apply_rows(const Problem& problem, const BlockedRows& rows, std::span<const int> from,
                const Eigen::VectorXd& r, Eigen::VectorXd& y, std::span<const int> to,
                const Eigen::VectorXd* q, Eigen::VectorXd& u) {
  y.setZero();
  for_each_cone(problem, from, [&]<int D>(int i, int at, int dim) {
    const Eigen::Matrix<double, D, 1> part = r.segment<D>(at, dim);
    Products::add_reaction(rows, i, part, y.data());
  });
  for_each_cone(problem, to, [&]<int D>(int i, int at, int dim) {
    Eigen::Matrix<double, D, 1> sum = Eigen::Matrix<double, D, 1>::Zero(dim);
    if (q != nullptr) sum = q->segment<D>(problem.start(i), dim);
    Products::add_rate(rows, i, y.data(), sum);
    u.segment<D>(at, dim) = sum;
  });
}

// u = W r, and q where it is given, of some cones, where r is 0 but for some; y is all of r.
void apply_blocks(const Problem& problem, const BlockedDelassus& W, std::span<const int> from,
                  const Eigen::VectorXd& r, Eigen::VectorXd& y, std::span<const int> to,
                  const Eigen::VectorXd* q, Eigen::VectorXd& u) {
  y.setZero();
  for_each_cone(problem, from, [&]<int D>(int i, int at, int dim) {
    y.segment<D>(problem.start(i), dim) = r.segment<D>(at, dim);
  });
  for_each_cone(problem, to, [&]<int D>(int i, int at, int dim) {
    Eigen::Matrix<double, D, 1> sum = Eigen::Matrix<double, D, 1>::Zero(dim);
    if (q != nullptr) sum = q->segment<D>(problem.start(i), dim);
    W.add_rate(i, y, sum);
    u.segment<D>(at, dim) = sum;
  });
}

}  // namespace

DelassusProduct::DelassusProduct(const Problem& problem) : problem_(problem) {
  if (!problem.is_primal()) {
    W_.emplace(problem);
    y_.resize(problem.rows());
  } else if (problem.inertia().block_diagonal()) {
    rows_.emplace(problem);
    y_.resize(rows_->scaled_dofs());
  }
  all_.resize(static_cast<std::size_t>(problem.cone_count()));
  std::iota(all_.begin(), all_.end(), 0);
}

void DelassusProduct::apply(const Eigen::VectorXd& r, Eigen::VectorXd& Wr) {
  if (!has_parts()) {
    Wr = problem_.apply_delassus(r);
    return;
  }
  Wr.resize(r.size());
  apply(all_, r, all_, nullptr, Wr);
}

void DelassusProduct::rate(const Eigen::VectorXd& r, Eigen::VectorXd& u) {
  if (has_parts()) {
    u.resize(r.size());
    return rate(all_, r, all_, u);
  }
  apply(r, u);
  u += problem_.q();
}

void DelassusProduct::rate(std::span<const int> from, const Eigen::VectorXd& r,
                           std::span<const int> to, Eigen::VectorXd& u) {
  apply(from, r, to, &problem_.q(), u);
}

void DelassusProduct::apply(std::span<const int> from, const Eigen::VectorXd& r,
                            std::span<const int> to, const Eigen::VectorXd* q, Eigen::VectorXd& u) {
  if (W_) return apply_blocks(problem_, *W_, from, r, y_, to, q, u);
  with_products(*rows_, [&]<class Products>() {
    apply_rows<Products>(problem_, *rows_, from, r, y_, to, q, u);
  });
}

double DelassusProduct::work_s() const {
  if (rows_) return kSecondsPerBlockEntry * rows_->numbers();
  if (W_) return kSecondsPerBlockEntry * W_->numbers();
  return kSecondsPerNonzero * static_cast<double>(problem_.H().nonZeros());
}

}  // namespace conebench::solvers
