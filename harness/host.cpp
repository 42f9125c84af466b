#include "harness/host.h"

#include <fmt/format.h>

#include <ctime>
#include <fstream>

#include "harness/blas.h"
#include "harness/child.h"
#include "harness/pool.h"

namespace conebench::harness {
namespace {

std::string cpu_model() {
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);) {
    const auto colon = line.find(':');
    if (line.starts_with("model name") && colon != std::string::npos) return line.substr(colon + 2);
  }
  return "unknown processor";
}

std::string compiler() {
#if defined(__clang__)
  return fmt::format("clang {}.{}.{}", __clang_major__, __clang_minor__, __clang_patchlevel__);
#else
  return fmt::format("gcc {}.{}.{}", __GNUC__, __GNUC_MINOR__, __GNUC_PATCHLEVEL__);
#endif
}

std::string build() {
  std::string text = CONEBENCH_BUILD_TYPE;
#if defined(CONEBENCH_IS_NATIVE)
  text += ", for this processor";
#endif
  if (memory_limits_are_off()) text += ", sanitizers";
  if (const std::string kernels = blas_kernels(); !kernels.empty()) {
    text += ", OpenBLAS for " + kernels;
  }
  return text;
}

}  // namespace

std::string version() { return CONEBENCH_VERSION; }

results::Host current_host() {
  return {.cpu = cpu_model(),
          .cores = static_cast<int>(allowed_cores().size()),
          .compiler = compiler(),
          .build = build(),
          .version = version()};
}

std::string utc_now(double seconds_ago) {
  const std::time_t now = std::time(nullptr) - static_cast<std::time_t>(seconds_ago);
  std::tm utc{};
  ::gmtime_r(&now, &utc);
  char text[32];
  std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%SZ", &utc);
  return text;
}

}  // namespace conebench::harness
