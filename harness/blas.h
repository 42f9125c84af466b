#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace conebench::harness {

/// The kernels that the loaded OpenBLAS computes with, "Haswell"; empty where another BLAS is
/// loaded.
std::string blas_kernels();

/// What this processor can do that kernels are chosen by.
struct VectorUnits {
  bool avx2 = false;    ///< with fused multiply-add
  bool avx512 = false;  ///< F, CD, BW, DQ, VL

  static VectorUnits of_this_processor();
};

/// The kernels to ask for (OPENBLAS_CORETYPE) in place of the chosen ones; none where those will
/// do. OpenBLAS takes those of 2004, "Prescott", for an Intel processor newer than itself (0.3.21
/// of Debian 12: Emerald Rapids; https://github.com/OpenMathLib/OpenBLAS/issues/4267), old ones of
/// it "Barcelona" for one of AMD (not seen): products of matrices at a fraction of their speed, in
/// every solver that factorises.
std::optional<std::string> better_blas_kernels(std::string_view chosen, VectorUnits units);

}  // namespace conebench::harness
