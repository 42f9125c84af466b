// What `conebench plan --scripts` writes, run: the shards of every script make up one campaign.

#include "harness/job_scripts.h"

#include <set>
#include <tuple>

#include "results/journal.h"
#include "tests/harness/program_test.h"

namespace conebench::harness {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

constexpr const char* kStudy =
    "-p " CONEBENCH_SOURCE_DIR "/tests/data/ci-problems -s gs ipm --tol 1e-6 --time-limit 20s";

class JobScripts : public ProgramTest {
 protected:
  // In a folder whose name the scripts must quote.
  void plan() const {
    const Ran ran =
        conebench(std::string("plan ") + kStudy + " --shards 3 --scripts -o 'it'\\''s'");
    ASSERT_EQ(ran.code, 0) << ran.err;
    EXPECT_THAT(ran.out, HasSubstr("18 tasks in 9 groups"));
  }

  fs::path results() const { return folder_ / "it's"; }

  Ran shell(const std::string& command) const {
    const int status = std::system(
        ("cd '" + folder_.string() + "' && { " + command + "; } > out.txt 2> err.txt < /dev/null")
            .c_str());
    return {WEXITSTATUS(status), content(folder_ / "out.txt"), content(folder_ / "err.txt")};
  }

  using Row = std::tuple<std::string, std::string, std::string, double, std::int64_t>;

  static std::multiset<Row> rows(const fs::path& results_dir) {
    std::multiset<Row> found;
    for (const auto& r : results::read_results(results_dir).records) {
      found.emplace(r.problem.content_sha256, r.solver, results::to_string(r.status), r.eta,
                    r.iterations);
    }
    return found;
  }

  void expect_whole_campaign() const {
    for (const char* shard : {"1-of-3", "2-of-3", "3-of-3"}) {
      EXPECT_TRUE(fs::exists(results() / (std::string("journal-") + shard + ".jsonl"))) << shard;
    }
    EXPECT_TRUE(fs::exists(results() / "results.db"));
    EXPECT_EQ(conebench(std::string("run ") + kStudy + " -o alone").code, 0);
    EXPECT_EQ(rows(results()).size(), 18u);
    EXPECT_EQ(rows(results()), rows(folder_ / "alone"));
  }
};

TEST_F(JobScripts, TheLoopRunsAllShardsAndMergesThem) {
  plan();
  const Ran ran = shell("bash \"it's/loop.sh\"");
  EXPECT_EQ(ran.code, 0) << ran.err;
  expect_whole_campaign();
}

TEST_F(JobScripts, GnuParallelRunsAllShardsAndMergesThem) {
  if (shell("parallel --version | grep -q GNU").code != 0) GTEST_SKIP() << "no GNU parallel here";
  plan();
  const Ran ran = shell("bash \"it's/parallel.sh\"");
  EXPECT_EQ(ran.code, 0) << ran.err;
  expect_whole_campaign();
}

TEST_F(JobScripts, AreShellAndSayWhatSlurmMustKnow) {
  plan();
  for (const char* script : {"slurm-shards.sh", "slurm-merge.sh", "slurm-submit.sh"}) {
    EXPECT_EQ(shell(std::string("bash -n \"it's/") + script + "\"").code, 0) << script;
  }
  const std::string shards = content(results() / "slurm-shards.sh");
  for (const char* line : {"--array=1-3\n", "--exclusive\n", "--requeue\n", "--cpus-per-task=1\n",
                           "--cpu-bind=cores", "--shard \"$SLURM_ARRAY_TASK_ID\"/3"}) {
    EXPECT_THAT(shards, HasSubstr(line));
  }
  EXPECT_THAT(content(results() / "slurm-submit.sh"), HasSubstr("--dependency=afterany:"));
}

// 6 tasks a shard, each of up to 20 s of solver time: as long again for the residuals, which the
// solver's clock does not see, and ten minutes for the rest.
TEST_F(JobScripts, TheTimeOfAJobHoldsTheResidualsToo) {
  plan();
  EXPECT_THAT(content(results() / "slurm-shards.sh"), HasSubstr("#SBATCH --time=14\n"));
}

}  // namespace
}  // namespace conebench::harness
