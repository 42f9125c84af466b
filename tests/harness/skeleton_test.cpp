// `conebench solver new`, the examples that it copies, and the page that explains it.

#include "harness/skeleton.h"

#include <set>

#include "harness/small_problems.h"
#include "problems/problem_file.h"
#include "program_test.h"
#include "results/journal.h"

namespace conebench::harness {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

// Debian's interpreter first: h5py is its package. CONEBENCH is where the page wants it.
const std::string kEnvironment = std::string("export CONEBENCH='") + CONEBENCH_SOURCE_DIR +
                                 "' PATH='" + fs::path(CONEBENCH_PROGRAM).parent_path().string() +
                                 "':/usr/bin:/bin:$PATH;";

bool python_has_h5py() {
  return std::system("/usr/bin/python3 -c 'import h5py, numpy' 2>/dev/null") == 0;
}

class SkeletonTest : public ProgramTest {
 protected:
  // Runs a command in the test's folder.
  Ran shell(const std::string& command) const {
    const std::string line = kEnvironment + " cd '" + folder_.string() + "' && { " + command +
                             "\n} > out.txt 2> err.txt";
    const int status = std::system(line.c_str());
    return {WEXITSTATUS(status), content(folder_ / "out.txt"), content(folder_ / "err.txt")};
  }

  void write_problems() const {
    for (const std::size_t i : {1u, 8u}) {  // one in the primal form, one in the reduced
      const NamedRecipe named = small_recipes()[i];
      problems::write_problem_file(folder_ / "problems" / (named.name + ".h5"),
                                   {make_named(named), {}, {}, {}});
    }
  }

  // A campaign on both problems: every answer there, converged and verified, in some iterations.
  void expect_it_solves(const std::string& variant) const {
    fs::create_directories(folder_ / "problems");
    write_problems();
    const Ran ran = shell("conebench run -p problems -s " + variant +
                          " --tol 1e-6 --time-limit 20s -o results");
    EXPECT_EQ(ran.code, 0) << ran.err;
    const auto records = results::read_journal(results::journal_path(folder_ / "results")).records;
    EXPECT_EQ(records.size(), 2u);
    for (const results::Record& record : records) {
      EXPECT_EQ(record.status, results::Status::kConverged) << record.error;
      EXPECT_LE(record.eta, 1e-6);
      EXPECT_GT(record.iterations, 0);
      EXPECT_EQ(record.kind, "peer");
    }
  }
};

TEST_F(SkeletonTest, TheExampleInCSolves) {
  const Ran built = shell("cp -r \"$CONEBENCH/examples/c\" c && make -C c");
  ASSERT_EQ(built.code, 0) << built.err;
  EXPECT_EQ(built.err, "");
  expect_it_solves("plugin:c/my_solver.so");
}

TEST_F(SkeletonTest, TheExampleInCppSolves) {
  const Ran built = shell("cp -r \"$CONEBENCH/examples/c++\" c++ && make -C c++");
  ASSERT_EQ(built.code, 0) << built.err;
  EXPECT_EQ(built.err, "");
  expect_it_solves("plugin:c++/my_solver.so");
}

TEST_F(SkeletonTest, TheExampleInPythonSolves) {
  if (!python_has_h5py()) GTEST_SKIP() << "/usr/bin/python3 has no numpy and h5py";
  expect_it_solves("exec:\"$CONEBENCH/examples/python/my_solver.py\"");
}

TEST_F(SkeletonTest, EveryFileOfTheExamplesIsInTheProgram) {
  std::set<fs::path> carried;
  for (const SkeletonFile& file : skeleton_files()) {
    const fs::path path = fs::path(file.language) / file.name;
    carried.insert(path);
    EXPECT_EQ(content(fs::path(CONEBENCH_SOURCE_DIR) / "examples" / path), file.text) << path;
  }
  for (const char* file : {"c/my_solver.c", "c++/my_solver.cpp", "python/my_solver.py"}) {
    EXPECT_TRUE(carried.contains(file)) << file;
  }
}

TEST_F(SkeletonTest, ANewSolverHasItsOwnNameEverywhere) {
  for (const char* language : {"c", "c++", "python"}) {
    const std::string folder = std::string("in-") + language;
    const Ran ran =
        shell("conebench solver new fast-2 --language " + std::string(language) + " -o " + folder);
    ASSERT_EQ(ran.code, 0) << ran.err;
    std::size_t files = 0;
    for (const auto& entry : fs::directory_iterator(folder_ / folder)) {
      EXPECT_THAT(content(entry.path()), testing::Not(HasSubstr("my_solver"))) << entry.path();
      EXPECT_THAT(ran.out, HasSubstr(folder + "/" + entry.path().filename().string() + "\n"));
      ++files;
    }
    EXPECT_GE(files, 2u);
    EXPECT_THAT(content(folder_ / folder / "README.md"), HasSubstr("# fast-2\n"));
  }
  const Ran built = shell("make -C in-c && conebench solver show plugin:in-c/fast-2.so");
  EXPECT_EQ(built.code, 0) << built.err;
  EXPECT_THAT(built.out, HasSubstr("omega = 1"));
}

TEST_F(SkeletonTest, WhatIsThereIsNotOverwritten) {
  ASSERT_EQ(shell("conebench solver new mine").code, 0);
  std::ofstream(folder_ / "mine" / "mine.cpp") << "precious\n";
  fs::remove(folder_ / "mine" / "Makefile");
  expect_usage_error("solver new mine", "mine/README.md: is there already");
  EXPECT_EQ(content(folder_ / "mine" / "mine.cpp"), "precious\n");
  EXPECT_FALSE(fs::exists(folder_ / "mine" / "Makefile"));
}

TEST_F(SkeletonTest, BadNamesLanguagesAndPlacesAreRefused) {
  expect_usage_error("solver new ../mine", "expected letters, digits");
  expect_usage_error("solver new 2fast", "a letter first");
  expect_usage_error("solver new ''", "a letter first");
  expect_usage_error("solver new mine --language pyhton", "did you mean 'python'?");
  EXPECT_EQ(conebench("solver new mine -o /proc/no-such-place").code, 3);
}

TEST_F(SkeletonTest, AMissingLibraryIsBadInputInEveryVerb) {
  fs::create_directories(folder_ / "problems");
  write_problems();
  const std::string missing = "plugin:none.so";
  for (const std::string& verb :
       {"solve problems/made-3d.h5 -s " + missing, "run -p problems -s " + missing,
        "solver check " + missing, "solver show " + missing, "simulate column-dry -s " + missing}) {
    expect_usage_error(verb, "none.so: is no file, expected a shared library");
  }
}

TEST_F(SkeletonTest, AProgramThatBreaksDownIsNotPassedAndSaysWhy) {
  fs::create_directories(folder_ / "problems");
  write_problems();
  const problems::Problem open = make_named(small_recipes()[1]);  // r = 0 solves it
  problems::write_problem_file(folder_ / "problems" / "open.h5",
                               {{problems::PrimalData{open.M(), open.H(), 0.0 * open.f(),
                                                      Eigen::VectorXd::Zero(open.rows())},
                                 {open.cones().begin(), open.cones().end()},
                                 {}},
                                {},
                                {},
                                {}});
  const Ran ran = shell(
      "printf '#!/bin/sh\\necho no such module >&2\\nexit 1\\n' > broken && chmod +x broken && "
      "conebench solver check exec:./broken problems");
  EXPECT_EQ(ran.code, 1) << ran.err;
  EXPECT_THAT(ran.out, testing::Not(HasSubstr("pass")));
  std::size_t told = 0;
  for (std::size_t at = 0; (at = ran.out.find("stderr: no such module", at)) != ran.out.npos;
       ++at) {
    ++told;
  }
  EXPECT_EQ(told, 3u) << ran.out;
  EXPECT_THAT(ran.out, HasSubstr("exit code 1 without a solution file"));
}

TEST_F(SkeletonTest, TheInstalledHeaderIsEnough) {
  const std::string build = fs::path(CONEBENCH_PROGRAM).parent_path().string();
  const Ran ran =
      shell("cmake --install '" + build + "' --component program --prefix installed && set -e\n" +
            "installed/bin/conebench solver new mine --language c\n" +
            "make -C mine CONEBENCH=../installed/include/conebench\n" +
            "installed/bin/conebench solver check plugin:mine/mine.so");
  EXPECT_EQ(ran.code, 0) << ran.out << ran.err;
}

TEST_F(SkeletonTest, WithoutTheHeadersPlaceMakeSaysWhatItWants) {
  const Ran built = shell("cp -r \"$CONEBENCH/examples/c\" c && env -u CONEBENCH make -C c");
  EXPECT_NE(built.code, 0);
  EXPECT_THAT(built.err, HasSubstr("make CONEBENCH=DIR is expected"));
}

// The code blocks of a page that are marked as sh, in order.
std::string commands_in(const fs::path& page) {
  std::istringstream text(content(page));
  std::string commands;
  bool inside = false;
  for (std::string line; std::getline(text, line);) {
    if (line.starts_with("```")) {
      inside = line == "```sh";
    } else if (inside) {
      commands += line + "\n";
    }
  }
  return commands;
}

TEST_F(SkeletonTest, EveryCommandOfThePageRuns) {
  if (!python_has_h5py()) GTEST_SKIP() << "/usr/bin/python3 has no numpy and h5py";
  const std::string commands = commands_in(fs::path(CONEBENCH_SOURCE_DIR) / "docs/add-a-solver.md");
  EXPECT_EQ(std::count(commands.begin(), commands.end(), '\n'), 15) << commands;
  const Ran ran = shell("set -e\n" + commands);
  EXPECT_EQ(ran.code, 0) << ran.out << ran.err;
  EXPECT_THAT(ran.out, testing::Not(HasSubstr("FAIL")));
  EXPECT_THAT(ran.out, HasSubstr("`plugin:mine/mine.so[omega=1.3]`"));
  EXPECT_TRUE(fs::exists(folder_ / "results" / "report" / "report.md") ||
              fs::exists(folder_ / "results" / "report.md"));
}

}  // namespace
}  // namespace conebench::harness
