#include "harness/calibration.h"

#include <fmt/format.h>
#include <sched.h>
#include <unistd.h>

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <chrono>
#include <cmath>
#include <fstream>
#include <functional>

#include "harness/median.h"

namespace conebench::harness {
namespace {

constexpr int kRepeats = 9;

MedianInterval time_of(const std::function<void()>& work) {
  std::vector<double> times_s;
  for (int repeat = 0; repeat < kRepeats; ++repeat) {
    const auto start = std::chrono::steady_clock::now();
    work();
    times_s.push_back(
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
  }
  return median_interval(std::move(times_s));
}

// The Laplacian of a line, which a step of explicit diffusion applies: |I - A / 4| <= 1, so that
// the numbers stay as they are, far from overflow and from denormal.
Eigen::SparseMatrix<double, Eigen::RowMajor> diffusion(Eigen::Index n) {
  Eigen::SparseMatrix<double, Eigen::RowMajor> A(n, n);
  A.reserve(Eigen::VectorXi::Constant(n, 3));
  for (Eigen::Index i = 0; i < n; ++i) {
    if (i > 0) A.insert(i, i - 1) = 0.25;
    A.insert(i, i) = 0.5;
    if (i + 1 < n) A.insert(i, i + 1) = 0.25;
  }
  return A;
}

MedianInterval arithmetic() {
  constexpr Eigen::Index kDense = 96, kSparse = 4096;
  constexpr int kDenseProducts = 8, kSparseProducts = 100;
  const Eigen::MatrixXd rotation = Eigen::MatrixXd::Identity(kDense, kDense).rowwise().reverse();
  const auto sparse = diffusion(kSparse);
  Eigen::MatrixXd dense = Eigen::MatrixXd::Constant(kDense, kDense, 0.5), next_dense = dense;
  Eigen::VectorXd vector = Eigen::VectorXd::Ones(kSparse), next_vector = vector;
  return time_of([&] {
    for (int i = 0; i < kDenseProducts; ++i) {
      next_dense.noalias() = rotation * dense;
      dense.swap(next_dense);
    }
    for (int i = 0; i < kSparseProducts; ++i) {
      next_vector.noalias() = sparse * vector;
      vector.swap(next_vector);
    }
  });
}

MedianInterval memory() {
  constexpr Eigen::Index kEntries = 64'000'000 / (3 * sizeof(double));
  const Eigen::VectorXd b = Eigen::VectorXd::Ones(kEntries), c = Eigen::VectorXd::Ones(kEntries);
  Eigen::VectorXd a = Eigen::VectorXd::Zero(kEntries);
  return time_of([&] { a.noalias() = b + 0.5 * c; });
}

// The first line of /proc/stat: "cpu user nice system idle iowait irq softirq steal ...", in ticks.
void read_processor_time(Calibration& calibration) {
  constexpr int kFields = 8, kSteal = 7;
  const auto tick_s = 1.0 / static_cast<double>(::sysconf(_SC_CLK_TCK));
  std::ifstream file("/proc/stat");
  std::string name;
  file >> name;
  double ticks = 0.0;
  for (int field = 0; field < kFields && file >> ticks; ++field) {
    calibration.processor_s += ticks * tick_s;
    if (field == kSteal) calibration.stolen_s = ticks * tick_s;
  }
}

std::optional<double> frequency_hz() {
  std::ifstream file(
      fmt::format("/sys/devices/system/cpu/cpu{}/cpufreq/scaling_cur_freq", ::sched_getcpu()));
  double kilohertz = 0.0;
  if (!(file >> kilohertz)) return std::nullopt;
  return 1e3 * kilohertz;
}

void compare(const char* what, double before, double after, double allowance,
             std::vector<std::string>& signs) {
  const double change = after / before - 1.0;
  if (std::abs(change) <= allowance) return;
  signs.push_back(
      fmt::format("{}: {:+.1f} % ({:.1f} % is noise)", what, 100.0 * change, 100.0 * allowance));
}

}  // namespace

Calibration calibrate() {
  const MedianInterval work = arithmetic();
  Calibration calibration;
  calibration.frequency_hz = frequency_hz();
  const MedianInterval traffic = memory();
  calibration.arithmetic_s = work.median;
  calibration.arithmetic_spread = work.spread();
  calibration.memory_s = traffic.median;
  calibration.memory_spread = traffic.spread();
  read_processor_time(calibration);
  return calibration;
}

std::vector<std::string> signs_of_drift(const Calibration& before, const Calibration& after) {
  std::vector<std::string> signs;
  compare("time of arithmetic", before.arithmetic_s, after.arithmetic_s,
          kLeastDrift + before.arithmetic_spread + after.arithmetic_spread, signs);
  compare("time of memory traffic", before.memory_s, after.memory_s,
          kLeastDrift + before.memory_spread + after.memory_spread, signs);
  if (before.frequency_hz && after.frequency_hz) {
    compare("frequency of the core", *before.frequency_hz, *after.frequency_hz, kLeastDrift, signs);
  }
  const double stolen_s = after.stolen_s - before.stolen_s;
  const double passed_s = after.processor_s - before.processor_s;
  if (stolen_s > kMostStolen * passed_s) {
    signs.push_back(fmt::format("{:.1f} % of the processor time was stolen by other guests",
                                100.0 * stolen_s / passed_s));
  }
  return signs;
}

bool drifted(const Calibration& before, const Calibration& after) {
  return !signs_of_drift(before, after).empty();
}

}  // namespace conebench::harness
