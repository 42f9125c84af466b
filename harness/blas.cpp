#include "harness/blas.h"

#include <dlfcn.h>

namespace conebench::harness {

std::string blas_kernels() {
  void* symbol = dlsym(RTLD_DEFAULT, "openblas_get_corename");
  return symbol != nullptr ? reinterpret_cast<const char* (*)()>(symbol)() : "";
}

VectorUnits VectorUnits::of_this_processor() {
#if defined(__x86_64__)
  return {.avx2 = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma"),
          .avx512 = __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512cd") &&
                    __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512dq") &&
                    __builtin_cpu_supports("avx512vl")};
#else
  return {};
#endif
}

std::optional<std::string> better_blas_kernels(std::string_view chosen, VectorUnits units) {
  if (chosen != "Prescott" && chosen != "Barcelona") return std::nullopt;
  if (units.avx512) return "SkylakeX";
  if (units.avx2) return "Haswell";
  return std::nullopt;
}

}  // namespace conebench::harness
