#include "harness/blas.h"

#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>

#include "program_test.h"

namespace conebench::harness {
namespace {

constexpr VectorUnits kOld{}, kAvx2{.avx2 = true}, kAvx512{.avx2 = true, .avx512 = true};

TEST(BlasKernels, OldOnesAreReplacedByWhatTheProcessorCanDo) {
  EXPECT_EQ(better_blas_kernels("Prescott", kAvx2), "Haswell");
  EXPECT_EQ(better_blas_kernels("Prescott", kAvx512), "SkylakeX");
  EXPECT_EQ(better_blas_kernels("Barcelona", kAvx2), "Haswell");
}

TEST(BlasKernels, OthersStay) {
  EXPECT_EQ(better_blas_kernels("Prescott", kOld), std::nullopt);
  EXPECT_EQ(better_blas_kernels("Haswell", kAvx512), std::nullopt);
  EXPECT_EQ(better_blas_kernels("", kAvx512), std::nullopt);
}

TEST(VectorUnits, AreThoseThatTheSystemNames) {
  std::ifstream file("/proc/cpuinfo");
  std::stringstream text;
  text << file.rdbuf();
  const auto has = [&](const char* flag) { return text.str().find(flag) != std::string::npos; };
  if (!has("flags")) GTEST_SKIP() << "no /proc/cpuinfo of this kind";
  const VectorUnits units = VectorUnits::of_this_processor();
  EXPECT_EQ(units.avx2, has(" avx2") && has(" fma"));
  EXPECT_EQ(units.avx512, has(" avx512f") && has(" avx512cd") && has(" avx512bw") &&
                              has(" avx512dq") && has(" avx512vl"));
}

class BlasOfTheProgram : public ProgramTest {
 protected:
  void SetUp() override {
    if (blas_kernels().empty()) GTEST_SKIP() << "not OpenBLAS";
    if (!VectorUnits::of_this_processor().avx2) GTEST_SKIP() << "nothing better than Prescott";
  }

  nlohmann::json doctor(const std::string& before) const {
    const auto findings = nlohmann::json::parse(conebench("doctor --json", before).out);
    return findings.at("BLAS");
  }
};

TEST_F(BlasOfTheProgram, IsNotTheOldestKind) {
  EXPECT_EQ(doctor("unset OPENBLAS_CORETYPE;")["good"], true);
}

TEST_F(BlasOfTheProgram, IsTheUsersWhereSet) {
  const auto blas = doctor("export OPENBLAS_CORETYPE=Prescott;");
  EXPECT_EQ(blas["good"], false);
  EXPECT_THAT(blas["value"].get<std::string>(), testing::HasSubstr("Prescott"));
}

}  // namespace
}  // namespace conebench::harness
