#include "harness/doctor.h"

#include <fmt/format.h>
#include <hdf5.h>
#include <openssl/crypto.h>
#include <sys/resource.h>
#include <unistd.h>

#include <CLI/Version.hpp>
#include <Eigen/Core>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "harness/blas.h"
#include "harness/cgroup.h"
#include "harness/child.h"
#include "harness/host.h"
#include "harness/units.h"
#include "results/text.h"
#include "solvers/registry.h"

namespace conebench::harness {
namespace {

using Clock = std::chrono::steady_clock;

double seconds(Clock::duration duration) { return std::chrono::duration<double>(duration).count(); }

Finding timer() {
  double smallest_s = 1.0;
  for (int i = 0; i < 1000; ++i) {
    const auto start = Clock::now();
    auto now = Clock::now();
    while (now == start) now = Clock::now();
    smallest_s = std::min(smallest_s, seconds(now - start));
  }
  return {"timer resolution", results::format_time(smallest_s), smallest_s < 1e-5};
}

// a = b + s c over arrays far larger than any cache: 24 bytes an entry.
Finding bandwidth() {
  constexpr Eigen::Index kEntries = 8'000'000;
  constexpr int kTrials = 5;
  const Eigen::VectorXd b = Eigen::VectorXd::Ones(kEntries), c = Eigen::VectorXd::Ones(kEntries);
  Eigen::VectorXd a = Eigen::VectorXd::Zero(kEntries);
  double best_s = 1e9;
  for (int trial = 0; trial < kTrials; ++trial) {
    const auto start = Clock::now();
    a.noalias() = b + (1.0 + trial) * c;
    best_s = std::min(best_s, seconds(Clock::now() - start));
  }
  const double rate = 24.0 * static_cast<double>(kEntries) / best_s / 1e9;
  const bool used = a.sum() > 0.0;
  return {"memory bandwidth, one core", fmt::format("{:.1f} GB/s (triad, rough)", rate), used};
}

Finding limit(const char* name, __rlimit_resource resource, bool bytes) {
  rlimit value{};
  ::getrlimit(resource, &value);
  if (value.rlim_cur == RLIM_INFINITY) return {name, "unlimited"};
  return {name, bytes ? format_bytes(value.rlim_cur) : fmt::format("{}", value.rlim_cur)};
}

Finding writable(const char* name, const std::filesystem::path& folder) {
  const bool good = ::access(folder.c_str(), W_OK) == 0;
  return {name, folder.string() + (good ? " (writable)" : " (not writable)"), good};
}

Finding hdf5() {
  unsigned major = 0, minor = 0, release = 0;
  H5get_libversion(&major, &minor, &release);
  return {"HDF5", fmt::format("{}.{}.{}", major, minor, release)};
}

Finding load() {
  double average = 0.0;
  const int cores = current_host().cores;
  if (::getloadavg(&average, 1) != 1) return {"load", "unknown"};
  const bool good = average < 0.5 * cores;
  return {"load",
          fmt::format("{:.2f} on {} cores{}", average, cores,
                      good ? "" : " (busy: timings will be noisy)"),
          good};
}

Finding blas() {
  const std::string kernels = blas_kernels();
  if (kernels.empty()) return {"BLAS", "not OpenBLAS"};
  const auto better = better_blas_kernels(kernels, VectorUnits::of_this_processor());
  return {"BLAS",
          fmt::format("OpenBLAS, kernels {}", kernels) +
              (better ? fmt::format(" (slow; faster with OPENBLAS_CORETYPE={})", *better) : ""),
          !better};
}

Finding siconos() {
  for (const solvers::Method& method : solvers::all_methods()) {
    if (method.name.starts_with("siconos:")) return {"Siconos Numerics", "built in"};
  }
  return {"Siconos Numerics", "not built in: no siconos:* solvers (libsiconos-numerics-dev)"};
}

Finding memory_groups() {
  const auto& folder = memory_cgroups();
  return {"memory control groups", folder ? fmt::format("one a worker, below {}", folder->string())
                                          : "none writable (--mem limits address space only)"};
}

}  // namespace

std::vector<Finding> examine() {
  const results::Host host = current_host();
  const bool optimised = host.build.find("Debug") == std::string::npos && !memory_limits_are_off();
  std::error_code error;
  return {
      {"conebench", host.version},
      {"compiler", host.compiler},
      {"build", host.build + (optimised ? "" : " (not for timing)"), optimised},
      {"sanitizers", memory_limits_are_off() ? "on (memory limits are not enforced)" : "off"},
      {"processor", host.cpu},
      {"cores", fmt::format("{}", host.cores)},
      load(),
      {"Eigen",
       fmt::format("{}.{}.{}", EIGEN_WORLD_VERSION, EIGEN_MAJOR_VERSION, EIGEN_MINOR_VERSION)},
      hdf5(),
      {"OpenSSL", OpenSSL_version(OPENSSL_VERSION_STRING)},
      {"nlohmann-json", fmt::format("{}.{}.{}", NLOHMANN_JSON_VERSION_MAJOR,
                                    NLOHMANN_JSON_VERSION_MINOR, NLOHMANN_JSON_VERSION_PATCH)},
      {"fmt", fmt::format("{}", FMT_VERSION)},
      {"CLI11", CLI11_VERSION},
      blas(),
      siconos(),
      limit("limit: address space", RLIMIT_AS, true),
      memory_groups(),
      limit("limit: file size", RLIMIT_FSIZE, true),
      limit("limit: processes", RLIMIT_NPROC, false),
      writable("program's folder",
               std::filesystem::read_symlink("/proc/self/exe", error).parent_path()),
      writable("working folder", std::filesystem::current_path()),
      timer(),
      bandwidth(),
  };
}

}  // namespace conebench::harness
