// `conebench export --policy`: which files are there in the end, and what they stand for.

#include <map>
#include <string>

#include "problems/load.h"
#include "tests/harness/program_test.h"

namespace conebench::harness {
namespace {

using testing::HasSubstr;

// A scene of each engine that takes no time.
const std::string kSand = " sand-column --set grid.cells=[16,4] --set grid.size_m=[4,1]";
const std::string kSpheres = " stack";

class ExportPolicies : public ProgramTest {
 protected:
  using Weights = std::map<std::string, double>;  // by file name

  Weights weights(const std::string& folder) const {
    Weights weights;
    for (const auto& path : problems::find_problems({folder_ / folder}).files) {
      weights[path.filename().string()] =
          problems::load_problem(path).problem.metadata().sampling_weight;
    }
    return weights;
  }

  Weights exported(const std::string& scene, const std::string& policy) const {
    std::filesystem::remove_all(folder_ / "out");
    const Ran ran = conebench("export" + scene + " --steps 40 -o out --policy " + policy);
    EXPECT_EQ(ran.code, 0) << ran.err;
    EXPECT_THAT(ran.out, HasSubstr("problems of 40 steps in out"));
    EXPECT_THAT(ran.out, HasSubstr("times for the writer"));
    return weights("out");
  }

  // Runs until the provisional folder has a file, and then sends the signal; by itself it would run
  // for minutes.
  Ran ended_by(const std::string& signal, const std::string& policy) const {
    const std::string script = (folder_ / "script.sh").string();
    std::ofstream(script)
        << CONEBENCH_PROGRAM " export" + kSand + " --steps 1000000 --policy " + policy +
               " -o out &\n"
        << "until ls out/.*.provisional/*.h5 || ! kill -0 $!; do sleep 0.01; done >/dev/null 2>&1\n"
        << "kill -" << signal << " $!\n"
        << "wait $!\n";
    const std::string command =
        "cd '" + folder_.string() + "' && sh script.sh > out.txt 2> err.txt";
    const int status = std::system(command.c_str());
    return {WEXITSTATUS(status), content(folder_ / "out.txt"), content(folder_ / "err.txt")};
  }

  static double total(const Weights& weights) {
    double sum = 0.0;
    for (const auto& [name, weight] : weights) sum += weight;
    return sum;
  }
};

TEST_F(ExportPolicies, OfRangesWeighTheStride) {
  for (const std::string& scene : {kSand, kSpheres}) {
    EXPECT_EQ(exported(scene, "all").size(), 40u);
    const Weights every = exported(scene, "every:8");
    EXPECT_EQ(every.size(), 5u);
    EXPECT_EQ(total(every), 40.0);
    const Weights range = exported(scene, "3..5");
    EXPECT_EQ(range.size(), 3u);
    EXPECT_EQ(total(range), 3.0);
  }
}

TEST_F(ExportPolicies, OfSamplesStandForEveryStep) {
  for (const std::string& scene : {kSand, kSpheres}) {
    for (const std::string policy : {"reservoir:6", "stratified:6"}) {
      const Weights sample = exported(scene, policy);
      EXPECT_EQ(sample.size(), 6u) << policy;
      EXPECT_NEAR(total(sample), 40.0, 1e-9) << policy;
      EXPECT_EQ(exported(scene, policy), sample) << policy << " differs from run to run";
    }
    const Weights hardest = exported(scene, "hardest:6");
    EXPECT_EQ(hardest.size(), 6u);
    EXPECT_EQ(total(hardest), 6.0);
  }
}

TEST_F(ExportPolicies, DrawSamplesWithTheSeedOfTheScene) {
  const Weights one = exported(kSand, "reservoir:6"),
                two = exported(kSand + " --set seed=2", "reservoir:6");
  EXPECT_NE(one, two);
}

TEST_F(ExportPolicies, EndWithWhatThereIsWhenInterrupted) {
  const Ran ran = ended_by("TERM", "reservoir:3");
  EXPECT_EQ(ran.code, 130) << ran.err;
  const std::string before_steps = "problems of ";
  const std::size_t at = ran.out.find(before_steps);
  ASSERT_NE(at, std::string::npos) << ran.out;
  const double steps = std::stod(ran.out.substr(at + before_steps.size()));
  const Weights sample = weights("out");
  EXPECT_GE(sample.size(), 1u);
  EXPECT_NEAR(total(sample), steps, 1e-9);
}

TEST_F(ExportPolicies, LeaveNothingToBeSeenWhenKilled) {
  EXPECT_EQ(ended_by("KILL", "hardest:3").code, 128 + 9);
  EXPECT_TRUE(weights("out").empty());
  const Ran ran = conebench("export" + kSand + " --steps 10 --policy reservoir:3 -o out");
  EXPECT_EQ(ran.code, 0) << ran.err;
  EXPECT_EQ(weights("out").size(), 3u);
  EXPECT_FALSE(std::filesystem::exists(folder_ / "out" / ".sand-column.provisional"));
}

TEST_F(ExportPolicies, SayThatTheDiskIsFull) {
  for (const std::string policy : {"all", "stratified:4"}) {
    const Ran ran =
        conebench("export" + kSand + " --steps 20 -o out --policy " + policy, "ulimit -f 4;");
    EXPECT_EQ(ran.code, 3) << ran.err;
    EXPECT_EQ(ran.error_lines(), 1) << ran.err;
    EXPECT_THAT(ran.err, HasSubstr("cannot write: File too large"));
    EXPECT_TRUE(weights("out").empty());
  }
}

TEST_F(ExportPolicies, OfOtherNamesAreRefused) {
  expect_usage_error("export stack -o out --policy hardset:3", "did you mean 'hardest'?");
  expect_usage_error("export stack -o out --policy reservoir:0", "expected all, every:N");
  expect_usage_error("export stack -o out --policy hardest:3 --every 2", "--every");
}

}  // namespace
}  // namespace conebench::harness
