// The verbs that run scenes: scene, simulate, export, on both engines.

#include <map>
#include <nlohmann/json.hpp>

#include "problems/problem_file.h"
#include "tests/harness/program_test.h"

namespace conebench::harness {
namespace {

using testing::HasSubstr;

// sand-column on a grid that takes no time.
const std::string kSmall = " sand-column --set grid.cells=[16,4] --set grid.size_m=[4,1]";

class SceneVerbs : public ProgramTest {
 protected:
  bool exists(const std::string& file) const { return std::filesystem::exists(folder_ / file); }

  nlohmann::json summary_of(const std::string& arguments) const {
    const Ran ran = conebench("simulate" + arguments + " --json");
    EXPECT_EQ(ran.code, 0) << ran.err;
    return nlohmann::json::parse(ran.out);
  }
};

TEST_F(SceneVerbs, ScenesOfBothEnginesAreListed) {
  const auto list = nlohmann::json::parse(conebench("scene list --json").out);
  std::map<std::string, std::string> engines;
  for (const auto& entry : list) engines[entry["name"]] = entry["engine"];
  EXPECT_EQ(engines["column-dry"], "dem");
  EXPECT_EQ(engines["sand-column"], "mpm");
  EXPECT_THAT(conebench("scene list").out, HasSubstr("mpm"));
}

TEST_F(SceneVerbs, AShownSceneIsAFullSceneFile) {
  for (const std::string name : {"column-dry", "sand-column"}) {
    const std::string text = conebench("scene show " + name).out;
    EXPECT_THAT(text, HasSubstr("max_iterations = "));
    std::ofstream(folder_ / "copy.toml") << text;
    EXPECT_EQ(conebench("scene show copy.toml").out, text);
  }
  expect_usage_error("scene show sand-colum", "did you mean 'sand-column'?");
}

TEST_F(SceneVerbs, SimulatingSandWritesAllThatIsAskedFor) {
  const auto summary =
      summary_of(kSmall + " --steps 6 -o out --frames 2 --colour speed --checkpoint-every 4");
  for (const char* key : {"scene",
                          "engine",
                          "solver",
                          "tol",
                          "particles",
                          "steps",
                          "repeated_steps",
                          "time_s",
                          "steps_not_converged",
                          "solves",
                          "cycles",
                          "capped",
                          "iterations",
                          "cones_last",
                          "cones_most",
                          "left_particles",
                          "transfer_s",
                          "assembly_s",
                          "solve_s",
                          "state"}) {
    EXPECT_TRUE(summary.contains(key)) << key;
  }
  EXPECT_EQ(summary["engine"], "mpm");
  EXPECT_EQ(summary["steps"], 6);
  EXPECT_LE(summary["state"]["top_m"], 0.8);
  const std::string history = content(folder_ / "out" / "history.csv");
  EXPECT_EQ(std::count(history.begin(), history.end(), '\n'), 7);
  EXPECT_THAT(history, testing::StartsWith("time_s,h,front_m,top_m,"));
  for (const char* file : {"out/particles.pvd", "out/nodes.pvd", "out/nodes_000005.vtp",
                           "out/particles_000005.vtp", "out/checkpoint_000004.cbor",
                           "out/frame_000.svg", "out/frame_001.svg", "out/summary.json"}) {
    EXPECT_TRUE(exists(file)) << file;
  }
  const std::string picture = content(folder_ / "out" / "frame_001.svg");
  EXPECT_THAT(picture, HasSubstr("m/s"));
  EXPECT_EQ(picture.find("nan"), std::string::npos);
}

TEST_F(SceneVerbs, TheHistoryOfSpheresAddsUpToTheSummary) {
  const Ran ran = conebench("simulate stack --steps 20 -o out --json");
  ASSERT_EQ(ran.code, 0) << ran.err;
  const auto summary = nlohmann::json::parse(ran.out);
  std::istringstream history(content(folder_ / "out" / "history.csv"));
  std::string line;
  std::getline(history, line);
  EXPECT_THAT(line, testing::StartsWith("time_s,cones,bonds,iterations,converged,kinetic_J,"));
  std::int64_t lines = 0, iterations = 0;
  std::vector<double> last;
  while (std::getline(history, line)) {
    last.clear();
    std::istringstream fields(line);
    for (std::string field; std::getline(fields, field, ',');) last.push_back(std::stod(field));
    ASSERT_EQ(last.size(), 11u) << line;
    iterations += static_cast<std::int64_t>(last[3]);
    ++lines;
  }
  EXPECT_EQ(lines, 20);
  EXPECT_EQ(iterations, summary["iterations"]);
  EXPECT_EQ(last[0], summary["time_s"]);
  EXPECT_EQ(last[1], summary["cones_last"]);
  EXPECT_EQ(last[5], summary["energy"]["kinetic_J"]);
}

TEST_F(SceneVerbs, ARestartedRunGoesOnFromItsCheckpoint) {
  const auto whole = summary_of(kSmall + " --steps 6 -o out --checkpoint-every 4");
  const auto rest = summary_of(kSmall + " --steps 2 --restart out/checkpoint_000004.cbor");
  EXPECT_EQ(rest["steps"], 6);
  EXPECT_DOUBLE_EQ(rest["time_s"], whole["time_s"]);
  // The solver stops on a clock too, so that only its tolerance of 1e-5 is alike.
  EXPECT_NEAR(rest["state"]["front_m"], whole["state"]["front_m"], 1e-3);
  EXPECT_EQ(conebench("simulate sand-column --steps 1 --restart out/checkpoint_000004.cbor").code,
            2);
}

TEST_F(SceneVerbs, ARunWithoutStepsEndsWithTheScene) {
  const auto sand = summary_of(kSmall + " --set duration_s=0.01");
  EXPECT_NEAR(sand["time_s"].get<double>(), 0.012, 0.002 + 1e-12);
  const auto spheres = summary_of(" stack --set duration_s=0.01");
  EXPECT_EQ(spheres["steps"], 10);
  EXPECT_EQ(spheres["engine"], "dem");
}

TEST_F(SceneVerbs, ProblemsOfBothEnginesAreExported) {
  EXPECT_EQ(conebench("export" + kSmall + " --steps 4 --every 2 -o problems").code, 0);
  const Ran ran = conebench("export column-dry --steps 2 -o problems");
  EXPECT_THAT(ran.out, HasSubstr("2 problems of 2 steps")) << ran.err;
  for (const auto& [file, engine] :
       {std::pair("sand-column_000002.h5", "mpm"), std::pair("column-dry_000001.h5", "dem")}) {
    const auto path = folder_ / "problems" / file;
    ASSERT_TRUE(std::filesystem::exists(path)) << path;
    EXPECT_EQ(problems::read_problem_file(path).problem.metadata().engine, engine);
  }
  EXPECT_FALSE(exists("problems/sand-column_000001.h5"));
}

TEST_F(SceneVerbs, WrongWishesAreOneLineAndExitCodeTwo) {
  expect_usage_error("simulate sand-column --set material.frictoin=1", "did you mean 'friction'?");
  expect_usage_error("simulate sand-column --set materal.friction=1", "did you mean 'material'?");
  expect_usage_error("simulate sand-column --set material.friction=-1", "expected a number >= 0");
  expect_usage_error("export sand-column -o out --set material", "expected KEY=VALUE");
  expect_usage_error("simulate sand-column --frames 2", "expected -o DIR");
  expect_usage_error("simulate sand-column --checkpoint-every 2", "expected -o DIR");
  expect_usage_error("simulate sand-column --colour red", "expected fraction or speed");
  expect_usage_error("simulate stack --colour fraction", "expected speed");
  expect_usage_error("simulate stack --restart file.cbor", "expected a checkpoint");
}

}  // namespace
}  // namespace conebench::harness
