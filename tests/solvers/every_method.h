#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <string>
#include <vector>

namespace conebench::solvers {

/// The variants that owe everything a method owes: the tests of that are run for each.
inline const std::vector<std::string> kEveryMethod = {
    "auto",
    "aclm",
    "aclm[anderson=0]",
    "ipm",
    "aclm-ipm",
    "aclm-ipm[form=normal]",
    "gs",
    "gs[form=delassus]",
    "gs[local=projection]",
    "gs[omega=0.8]",
    "gs[local=newton-ac]",
    "gs[local=newton-fb]",
    "gs[sweep=symmetric]",
    "gs[skip=5]",
    "gs[islands=true]",
    "gs-parallel",
    "gs-parallel[threads=2]",
    "prox-newton",
    "ppa",
    "ppa[inner=fb]",
    "ppa[inner=gs]",
    "spg",
    "spg[refresh=10]",
    "apgd",
    "apgd[refresh=10]",
    "apgd[skip=1]",
    "uzawa",
    "extragradient",
    "extragradient[step=unit]",
    "admm",
    "admm[anderson=0]",
    "newton-ac",
    "newton-ac[form=reduced]",
    "newton-ac[variant=jean-moreau]",
    "newton-ac[line_search=none]",
    "newton-ac[line_search=armijo]",
    "newton-ac[line_search=goldstein-price]",
    "newton-fb",
    "ipopt",
    "aclm-ipopt",
};

/// The tightest eta to ask of a variant on any well-conditioned problem. Interior points reach the
/// square root of rounding where r_i = u_i = 0 for some cone, since r_i.u_i is what they drive to
/// 0.
inline double attainable(const std::string& variant) {
  return variant.find("ip") != std::string::npos ? 1e-8 : 1e-12;
}

/// A variant as the name of a test: letters and digits, the rest '_'.
inline std::string test_name(const testing::TestParamInfo<std::string>& test) {
  std::string name = test.param;
  std::replace_if(
      name.begin(), name.end(), [](unsigned char c) { return !std::isalnum(c); }, '_');
  return name;
}

}  // namespace conebench::solvers
