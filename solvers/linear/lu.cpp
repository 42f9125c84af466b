#include "solvers/linear/lu.h"

#include <dmumps_c.h>

#include <mutex>
#include <vector>

namespace conebench::solvers {
namespace {

constexpr double kSecondsPerFlop = 0.4e-9, kSecondsPerNonzero = 15e-9;
// A pivot on the diagonal is taken from this share of its column's largest entry on: the ordering
// survives.
constexpr double kDiagonalPivot = 1e-8;
// Room for pivots put off, in percent of what the analysis expects.
constexpr int kFirstRoom = 50, kMostRoom = 5000;

// MUMPS' job numbers, and the constant that stands for "all processes".
enum Job { kInitialise = -1, kFinish = -2, kAnalyse = 1, kFactorize = 2, kSolve = 3 };
constexpr MUMPS_INT kWorld = -987654;
constexpr int kTooLittleRoom = -9;

std::mutex& one_caller() {
  static std::mutex mutex;
  return mutex;
}

}  // namespace

class Lu::Factor {
 public:
  Factor() {
    mumps_.par = 1;
    mumps_.sym = 0;
    mumps_.comm_fortran = kWorld;
    run(kInitialise);
    for (const int stream : {1, 2, 3, 4}) control(stream) = stream < 4 ? -1 : 0;  // silent
    control(6) = 0;  // columns as they are
    control(7) = 6;  // quasi-dense approximate minimum degree
    control(8) = 0;  // no scaling: cones' units are alike
    control(14) = kFirstRoom;
    mumps_.cntl[0] = kDiagonalPivot;
  }
  ~Factor() { run(kFinish); }
  Factor(const Factor&) = delete;
  Factor& operator=(const Factor&) = delete;

  void analyse(const Matrix& matrix) {
    rows_.clear();
    columns_.clear();
    for (int j = 0; j < matrix.outerSize(); ++j) {
      for (int k = matrix.outerIndexPtr()[j]; k < matrix.outerIndexPtr()[j + 1]; ++k) {
        rows_.push_back(matrix.innerIndexPtr()[k] + 1);
        columns_.push_back(j + 1);
      }
    }
    mumps_.n = static_cast<MUMPS_INT>(matrix.rows());
    mumps_.nnz = static_cast<MUMPS_INT8>(rows_.size());
    mumps_.irn = rows_.data();
    mumps_.jcn = columns_.data();
    run(kAnalyse);
  }

  bool factorize(const Matrix& matrix) {
    mumps_.a = const_cast<double*>(matrix.valuePtr());
    run(kFactorize);
    while (mumps_.infog[0] == kTooLittleRoom && control(14) < kMostRoom) {
      control(14) *= 2;
      run(kFactorize);
    }
    return mumps_.infog[0] >= 0;
  }

  Eigen::VectorXd solve(const Eigen::VectorXd& b) {
    Eigen::VectorXd x = b;
    mumps_.rhs = x.data();
    run(kSolve);
    return x;
  }

  double flops() const { return mumps_.rinfog[2]; }
  double nonzeros() const { return static_cast<double>(mumps_.infog[8]); }

 private:
  MUMPS_INT& control(int number) { return mumps_.icntl[number - 1]; }

  void run(Job job) {
    const std::scoped_lock alone(one_caller());
    mumps_.job = job;
    dmumps_c(&mumps_);
  }

  DMUMPS_STRUC_C mumps_{};
  std::vector<MUMPS_INT> rows_, columns_;
};

Lu::Lu() : factor_(std::make_unique<Factor>()) {}
Lu::~Lu() = default;
Lu::Lu(Lu&&) noexcept = default;

// MUMPS takes no empty matrix.
void Lu::analyse(const Matrix& matrix) {
  if (matrix.rows() > 0) factor_->analyse(matrix);
}

bool Lu::factorize(const Matrix& matrix) {
  if (matrix.rows() == 0) return true;
  const bool done = factor_->factorize(matrix);
  work_s_ = kSecondsPerFlop * factor_->flops() + kSecondsPerNonzero * factor_->nonzeros();
  return done;
}

Eigen::VectorXd Lu::solve(const Eigen::VectorXd& b) const {
  return b.size() > 0 ? factor_->solve(b) : b;
}

}  // namespace conebench::solvers
