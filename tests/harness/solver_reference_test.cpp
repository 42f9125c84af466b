// The reference of all solvers, and the file of it in docs/.

#include "harness/solver_reference.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <sstream>

#include "harness/refusals.h"
#include "problems/problem.h"

namespace conebench::harness {
namespace {

using solvers::Method;
using testing::HasSubstr;

bool has_siconos() {
  for (const Method& method : solvers::all_methods()) {
    if (method.name.starts_with("siconos:")) return true;
  }
  return false;
}

TEST(SolverReference, IsWhatTheDocumentationHolds) {
  if (!has_siconos()) GTEST_SKIP() << "this build has no Siconos, docs/solvers.md has";
  std::stringstream file;
  file << std::ifstream(CONEBENCH_SOURCE_DIR "/docs/solvers.md").rdbuf();
  EXPECT_TRUE(file.str() == solver_reference(solvers::all_methods()))
      << "docs/solvers.md is out of date: conebench solver reference > docs/solvers.md";
}

std::string in_one_line(std::string text) {
  std::ranges::replace(text, '\n', ' ');
  return text;
}

// "model: the associated law" without the kind.
std::string last_part(const std::string& summary) {
  const std::string kind = "model: ";
  return summary.starts_with(kind) ? summary.substr(kind.size()) : summary;
}

TEST(SolverReference, HasEveryParameterOfEveryMethod) {
  const std::string text = solver_reference(solvers::all_methods());
  for (const Method& method : solvers::all_methods()) {
    const std::size_t begin = text.find("\n## `" + method.name + "`");
    ASSERT_NE(begin, text.npos) << method.name;
    const std::string section = text.substr(begin, text.find("\n## ", begin + 1) - begin);
    EXPECT_FALSE(method.source.empty()) << method.name;
    EXPECT_THAT(in_one_line(section), HasSubstr("Source: " + method.source + ".")) << method.name;
    EXPECT_THAT(in_one_line(section), HasSubstr(last_part(method.summary))) << method.name;
    for (const solvers::Parameter& parameter : method.parameters) {
      EXPECT_THAT(section, HasSubstr("- `" + parameter.name + "`, ")) << method.name;
      EXPECT_FALSE(parameter.doc.empty()) << method.name << ", " << parameter.name;
    }
  }
}

const Method& method_named(const std::string& name) {
  for (const Method& method : solvers::all_methods()) {
    if (method.name == name) return method;
  }
  throw std::logic_error(name);
}

// Known answers: newton-ac divides by W; its full form needs M and H besides.
TEST(Refusals, AreThoseOfTheDefaultsAndWhatOtherChoicesAdd) {
  const std::vector<Refusal> found = refusals_of(method_named("newton-ac"), kinds_of_problems());
  ASSERT_EQ(found.size(), 2u);
  EXPECT_EQ(found[0].kind, "W = 0");
  EXPECT_EQ(found[0].parameter, "");
  EXPECT_EQ(found[0].reason, "W is zero");
  EXPECT_EQ(found[1].kind, "the reduced form (W, q)");
  EXPECT_EQ(found[1].parameter, "form=full");
  EXPECT_EQ(found[1].reason, "form=full needs M and H");
}

TEST(Refusals, OfASolverThatTakesAllAreNone) {
  Method method;
  method.name = "gs";
  std::vector<ProblemKind> few = kinds_of_problems();
  few.pop_back();  // the one that gs refuses: a dense W of 7002 rows
  EXPECT_TRUE(refusals_of(method, few).empty());
}

TEST(Refusals, KindsAreWhatTheirNamesSay) {
  const std::vector<ProblemKind> kinds = kinds_of_problems();
  for (const ProblemKind& kind : kinds) {
    EXPECT_EQ(kind.problem.is_primal(), kind.name != "the reduced form (W, q)");
    EXPECT_EQ(kind.problem.mobility().minCoeff() > 0.0, kind.name != "W = 0");
    if (kind.name.find("couples") != kind.name.npos) {
      EXPECT_FALSE(kind.problem.inertia().block_diagonal());
    }
    EXPECT_EQ(kind.problem.rows() == 7002, kind.name.find("7002") != kind.name.npos);
  }
}

}  // namespace
}  // namespace conebench::harness
