#include "harness/report_views.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <map>
#include <optional>

#include "harness/variants.h"
#include "harness/worker.h"
#include "problems/error.h"
#include "problems/load.h"
#include "results/group.h"
#include "results/hardness.h"
#include "results/output.h"
#include "results/profiles.h"

namespace conebench::harness {
namespace {

using results::Answer;
using results::Record;

constexpr std::size_t kMostViews = 6, kMostTried = 60;
constexpr int kMostOfScene = 2;
constexpr double kLongestSolve_s = 2.0;

// A folder of this process, gone with it.
class ScratchFolder {
 public:
  ScratchFolder()
      : path_(std::filesystem::temp_directory_path() /
              fmt::format("conebench-report-{}", ::getpid())) {
    results::make_folder(path_);
  }
  ~ScratchFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;

  std::filesystem::path file() const { return path_ / "answer.h5"; }

 private:
  std::filesystem::path path_;
};

// Why files were passed over.
struct Passed {
  int missing = 0, changed = 0, without_geometry = 0, too_large = 0, unsolved = 0;

  std::string text() const {
    std::string text;
    const auto add = [&text](int count, const char* what) {
      if (count > 0) text += fmt::format("{}{} {}", text.empty() ? "" : ", ", count, what);
    };
    add(missing, "no longer at their place");
    add(changed, "changed since");
    add(without_geometry, "without a geometry");
    add(too_large, "too large to show");
    add(unsolved, "without an answer that could be had again");
    return text;
  }
};

std::optional<problems::ProblemFile> usable_file(const results::ProblemId& id, Passed& passed) {
  if (!std::filesystem::is_regular_file(id.path)) {
    ++passed.missing;
    return {};
  }
  try {
    problems::ProblemFile file = problems::load_problem(id.path);
    if (problems::content_sha256(file.problem) != id.content_sha256) {
      ++passed.changed;
    } else if (!file.geometry || file.geometry->points.rows() == 0) {
      ++passed.without_geometry;
    } else if (file.problem.cone_count() > results::kMostConesShown) {
      ++passed.too_large;
    } else {
      return file;
    }
  } catch (const problems::InputError&) {
    ++passed.changed;
  }
  return {};
}

// The records of a problem's cold solves, best solver first; those that solved it before others.
std::vector<const Record*> best_records(const results::Group& group,
                                        std::span<const results::Rank> ranking,
                                        const std::string& content_sha256) {
  std::vector<const Record*> solved, others;
  for (const results::Rank& line : ranking) {
    const auto found =
        std::find_if(group.methods.begin(), group.methods.end(), [&](const Record& r) {
          return contender(r) == line.solver && r.problem.content_sha256 == content_sha256;
        });
    if (found == group.methods.end() || !std::isfinite(found->eta)) continue;
    (found->solved() ? solved : others).push_back(&*found);
  }
  solved.insert(solved.end(), others.begin(), others.end());
  return solved;
}

// Nothing where the solver is not of this program, or leaves no answer.
std::optional<Answer> solve_again(const Record& record, const problems::Problem& problem,
                                  const ScratchFolder& scratch) {
  try {
    std::filesystem::remove(scratch.file());
    const Task task{
        .problems = {source_from_file(record.problem.path)},
        .solver = make_solver(record.solver),
        .stop = {.tol = record.settings.tol,
                 .time_limit_s = std::min(record.settings.time_limit_s, kLongestSolve_s)},
        .memory_limit_bytes = record.settings.memory_limit_bytes,
        .solution_file = scratch.file()};
    const auto again = run_task(task);
    if (!again || !std::filesystem::exists(scratch.file())) return {};
    return Answer{record.solver, problems::read_foreign_answer(scratch.file(), problem.rows()).r};
  } catch (const problems::InputError&) {
    return {};
  }
}

std::optional<results::ProblemView> view_of_row(const results::Group& group,
                                                std::span<const results::Rank> ranking,
                                                const results::ProblemId& id,
                                                const ScratchFolder& scratch, Passed& passed) {
  const auto file = usable_file(id, passed);
  if (!file) return {};
  std::vector<Answer> answers;
  for (const Record* record : best_records(group, ranking, id.content_sha256)) {
    if (answers.size() == 2) break;
    if (auto answer = solve_again(*record, file->problem, scratch)) {
      answers.push_back(std::move(*answer));
    }
  }
  if (answers.empty()) {
    ++passed.unsolved;
    return {};
  }
  results::ProblemView view = results::view_of(*file, answers);
  view.name = id.name;
  view.family = id.family;
  return view;
}

}  // namespace

ReportViews make_views(std::span<const Record> records) {
  ReportViews result;
  const auto groups = results::group_by_settings(records);
  const auto group =
      std::find_if(groups.begin(), groups.end(), [](const auto& g) { return !g.methods.empty(); });
  if (group == groups.end()) return {{}, "Only models were run."};
  const auto table = results::make_time_table(group->methods, group->settings.tol);
  const auto ranking = results::rank(table);
  const ScratchFolder scratch;
  Passed passed;
  std::map<std::string, int> of_scene;
  std::size_t tried = 0;
  for (const std::size_t row : results::hardest_first(table)) {
    if (result.views.size() == kMostViews || tried == kMostTried) break;
    const results::ProblemId& id = table.rows[row].problem;
    if (of_scene[id.family] == kMostOfScene) continue;
    ++tried;
    if (auto view = view_of_row(*group, ranking, id, scratch, passed)) {
      ++of_scene[id.family];
      result.views.push_back(std::move(*view));
    }
  }
  if (const std::string why = passed.text(); !why.empty()) {
    result.note =
        fmt::format("{} of the {} hardest problem files looked at could not be shown: {}.",
                    tried - result.views.size(), tried, why);
  }
  return result;
}

}  // namespace conebench::harness
