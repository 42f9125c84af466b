#include "solvers/delassus_product.h"

#include "solvers/local/one_cone.h"

namespace conebench::solvers {
namespace {

using problems::Problem;

constexpr double kSecondsPerBlockEntry = 3.5e-10;  // both ways
constexpr double kSecondsPerNonzero = 1e-9;

// y = B^T r, then Wr = B y, with runs of L dofs.
template <int L>
struct Products {
  const Problem& problem;
  const BlockedRows& rows;

  void apply(const Eigen::VectorXd& r, Eigen::VectorXd& y, Eigen::VectorXd& Wr) const {
    y.setZero();
    for_each_cone([&]<int D>(int i, int at, int dim) {
      const Eigen::Matrix<double, D, 1> part = r.segment<D>(at, dim);
      const double* block = rows.blocks(i);
      for (const int run : rows.runs(i)) {
        add_transposed_product<D, L>(block, part, y.data() + run);
        block += dim * L;
      }
    });
    for_each_cone([&]<int D>(int i, int at, int dim) {
      Eigen::Matrix<double, D, 1> sum = Eigen::Matrix<double, D, 1>::Zero(dim);
      const double* block = rows.blocks(i);
      for (const int run : rows.runs(i)) {
        add_product<D, L>(block, y.data() + run, sum);
        block += dim * L;
      }
      Wr.segment<D>(at, dim) = sum;
    });
  }

 private:
  template <class Function>
  void for_each_cone(const Function& function) const {
    for (int i = 0; i < problem.cone_count(); ++i) {
      const int dim = problem.cones()[static_cast<std::size_t>(i)].dim;
      with_dimension(dim,
                     [&]<int D>() { function.template operator()<D>(i, problem.start(i), dim); });
    }
  }
};

}  // namespace

DelassusProduct::DelassusProduct(const Problem& problem) : problem_(problem) {
  if (!problem.is_primal() || !problem.inertia().block_diagonal()) return;
  rows_.emplace(problem);
  y_.resize(rows_->scaled_dofs());
}

void DelassusProduct::apply(const Eigen::VectorXd& r, Eigen::VectorXd& Wr) {
  if (!problem_.is_primal()) {
    Wr.noalias() = problem_.W() * r;
    return;
  }
  if (!rows_) {
    Wr = problem_.apply_delassus(r);
    return;
  }
  Wr.resize(r.size());
  switch (rows_->run_length()) {
    case 6:
      return Products<6>{problem_, *rows_}.apply(r, y_, Wr);
    case 3:
      return Products<3>{problem_, *rows_}.apply(r, y_, Wr);
    case 2:
      return Products<2>{problem_, *rows_}.apply(r, y_, Wr);
    default:
      return Products<1>{problem_, *rows_}.apply(r, y_, Wr);
  }
}

double DelassusProduct::work_s() const {
  if (rows_) return kSecondsPerBlockEntry * rows_->entries();
  const auto& matrix = problem_.is_primal() ? problem_.H() : problem_.W();
  return kSecondsPerNonzero * static_cast<double>(matrix.nonZeros());
}

void DelassusProduct::rate(const Eigen::VectorXd& r, Eigen::VectorXd& u) {
  apply(r, u);
  u += problem_.q();
}

}  // namespace conebench::solvers
