#include "solvers/linear/lu.h"

#include <dmumps_c.h>

#include <Eigen/SparseLU>
#include <algorithm>
#include <mutex>
#include <vector>

namespace conebench::solvers {

class Lu::Factor {
 public:
  virtual ~Factor() = default;
  virtual void analyse(const Matrix& matrix) = 0;
  virtual bool factorize(const Matrix& matrix) = 0;
  virtual Eigen::VectorXd solve(const Eigen::VectorXd& b) = 0;
  virtual double flops() const = 0;
  virtual double nonzeros() const = 0;
};

namespace {

constexpr double kSecondsPerFlop = 0.05e-9, kSecondsPerNonzero = 6e-9;

// A call of MUMPS takes 40 us whatever the size, which up to here is more than it gains.
constexpr Eigen::Index kSmall = 250;

// Room for pivots put off, in percent of what the analysis expects.
constexpr int kFirstRoom = 50, kMostRoom = 5000;
// A pivot on the diagonal is taken from this share of its column's largest entry on: the ordering
// survives.
constexpr double kDiagonalPivot = 1e-8;

// MUMPS' job numbers, its answer that the room is too small, and its number for "all processes".
enum Job { kInitialise = -1, kFinish = -2, kAnalyse = 1, kFactorize = 2, kSolve = 3 };
constexpr int kTooLittleRoom = -9;
constexpr MUMPS_INT kWorld = -987654;

std::mutex& one_caller() {
  static std::mutex mutex;
  return mutex;
}

}  // namespace

class Lu::Multifrontal final : public Factor {
 public:
  Multifrontal() {
    mumps_.par = 1;
    mumps_.sym = 0;
    mumps_.comm_fortran = kWorld;
    run(kInitialise);
    for (const int stream : {1, 2, 3}) control(stream) = -1;  // silent
    control(4) = 0;
    control(6) = 0;  // columns as they are
    control(7) = 6;  // quasi-dense approximate minimum degree
    control(8) = 0;  // no scaling
    control(14) = kFirstRoom;
    mumps_.cntl[0] = kDiagonalPivot;
  }
  ~Multifrontal() override { run(kFinish); }
  Multifrontal(const Multifrontal&) = delete;
  Multifrontal& operator=(const Multifrontal&) = delete;

  void analyse(const Matrix& matrix) override {
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

  bool factorize(const Matrix& matrix) override {
    mumps_.a = const_cast<double*>(matrix.valuePtr());  // is only read
    run(kFactorize);
    while (mumps_.infog[0] == kTooLittleRoom && control(14) < kMostRoom) {
      control(14) *= 2;
      run(kFactorize);
    }
    return mumps_.infog[0] >= 0;
  }

  Eigen::VectorXd solve(const Eigen::VectorXd& b) override {
    Eigen::VectorXd x = b;
    mumps_.rhs = x.data();
    run(kSolve);
    return x;
  }

  double flops() const override { return mumps_.rinfog[2]; }
  // In millions where the number is negative.
  double nonzeros() const override {
    const double entries = static_cast<double>(mumps_.infog[8]);
    return entries >= 0.0 ? entries : -1e6 * entries;
  }

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

class Lu::Small final : public Factor {
 public:
  void analyse(const Matrix& matrix) override { lu_.analyzePattern(matrix); }
  bool factorize(const Matrix& matrix) override {
    lu_.factorize(matrix);
    return lu_.info() == Eigen::Success;
  }
  Eigen::VectorXd solve(const Eigen::VectorXd& b) override { return lu_.solve(b); }
  double flops() const override {
    return nonzeros() * nonzeros() / static_cast<double>(std::max<Eigen::Index>(lu_.rows(), 1));
  }
  double nonzeros() const override { return static_cast<double>(lu_.nnzL() + lu_.nnzU()); }

 private:
  Eigen::SparseLU<Matrix> lu_;
};

Lu::Lu() = default;
Lu::~Lu() = default;
Lu::Lu(Lu&&) noexcept = default;

void Lu::analyse(const Matrix& matrix) {
  if (matrix.rows() > kSmall) {
    factor_ = std::make_unique<Multifrontal>();
  } else {
    factor_ = std::make_unique<Small>();
  }
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
