#include "solvers/delassus_product.h"

#include <numeric>

#include "solvers/local/one_cone.h"

namespace conebench::solvers {
namespace {

using problems::Problem;

constexpr double kSecondsPerBlockEntry = 3.5e-10;  // both ways
constexpr double kSecondsPerNonzero = 1e-9;

// y = B^T r of some cones, then u = B y, and q where it is given, of some, with runs of L dofs.
template <int L>
struct Products {
  const Problem& problem;
  const BlockedRows& rows;
  std::span<const int> from, to;

  void apply(const Eigen::VectorXd& r, Eigen::VectorXd& y, const Eigen::VectorXd* q,
             Eigen::VectorXd& u) const {
    y.setZero();
    for_each_cone(from, [&]<int D>(int i, int at, int dim) {
      const Eigen::Matrix<double, D, 1> part = r.segment<D>(at, dim);
      const double* block = rows.blocks(i);
      for (const int run : rows.runs(i)) {
        add_transposed_product<D, L>(block, part, y.data() + run);
        block += dim * L;
      }
    });
    for_each_cone(to, [&]<int D>(int i, int at, int dim) {
      Eigen::Matrix<double, D, 1> sum = Eigen::Matrix<double, D, 1>::Zero(dim);
      if (q != nullptr) sum = q->segment<D>(problem.start(i), dim);
      const double* block = rows.blocks(i);
      for (const int run : rows.runs(i)) {
        add_product<D, L>(block, y.data() + run, sum);
        block += dim * L;
      }
      u.segment<D>(at, dim) = sum;
    });
  }

 private:
  // function(cone, first row of its part, dim).
  template <class Function>
  void for_each_cone(std::span<const int> cones, const Function& function) const {
    int at = 0;
    for (const int i : cones) {
      const int dim = problem.cones()[static_cast<std::size_t>(i)].dim;
      with_dimension(dim, [&]<int D>() { function.template operator()<D>(i, at, dim); });
      at += dim;
    }
  }
};

void apply(const Problem& problem, const BlockedRows& rows, std::span<const int> from,
           const Eigen::VectorXd& r, Eigen::VectorXd& y, std::span<const int> to,
           const Eigen::VectorXd* q, Eigen::VectorXd& u) {
  switch (rows.run_length()) {
    case 6:
      return Products<6>{problem, rows, from, to}.apply(r, y, q, u);
    case 3:
      return Products<3>{problem, rows, from, to}.apply(r, y, q, u);
    case 2:
      return Products<2>{problem, rows, from, to}.apply(r, y, q, u);
    default:
      return Products<1>{problem, rows, from, to}.apply(r, y, q, u);
  }
}

}  // namespace

DelassusProduct::DelassusProduct(const Problem& problem) : problem_(problem) {
  if (!problem.is_primal() || !problem.inertia().block_diagonal()) return;
  rows_.emplace(problem);
  y_.resize(rows_->scaled_dofs());
  all_.resize(static_cast<std::size_t>(problem.cone_count()));
  std::iota(all_.begin(), all_.end(), 0);
}

void DelassusProduct::apply(const Eigen::VectorXd& r, Eigen::VectorXd& Wr) {
  if (rows_) {
    Wr.resize(r.size());
    solvers::apply(problem_, *rows_, all_, r, y_, all_, nullptr, Wr);
  } else if (problem_.is_primal()) {
    Wr = problem_.apply_delassus(r);
  } else {
    Wr.noalias() = problem_.W() * r;
  }
}

void DelassusProduct::rate(const Eigen::VectorXd& r, Eigen::VectorXd& u) {
  if (rows_) {
    u.resize(r.size());
    return rate(all_, r, all_, u);
  }
  apply(r, u);
  u += problem_.q();
}

void DelassusProduct::rate(std::span<const int> from, const Eigen::VectorXd& r,
                           std::span<const int> to, Eigen::VectorXd& u) {
  solvers::apply(problem_, *rows_, from, r, y_, to, &problem_.q(), u);
}

double DelassusProduct::work_s() const {
  if (rows_) return kSecondsPerBlockEntry * rows_->entries();
  const auto& matrix = problem_.is_primal() ? problem_.H() : problem_.W();
  return kSecondsPerNonzero * static_cast<double>(matrix.nonZeros());
}

}  // namespace conebench::solvers
