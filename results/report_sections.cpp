#include "results/report_sections.h"

#include "results/anytime.h"
#include "results/donors.h"
#include "results/model_gap.h"
#include "results/report_blocks.h"
#include "results/scaling.h"
#include "results/speed_plots.h"
#include "results/statistics_text.h"
#include "results/warm_gain.h"

namespace conebench::results {
namespace {

// Adds what is not empty.
void add(Section& section, Block block, bool folded = false) {
  if (!block.empty()) section.parts.push_back({std::move(block), folded});
}

void add(Section& section, Plot plot) {
  if (!plot.series.empty()) section.parts.push_back({std::move(plot), false});
}

void add(Section& section, std::vector<Plot> plots) {
  for (Plot& plot : plots) add(section, std::move(plot));
}

Section ranking_section(const GroupNumbers& n) {
  Section section{.id = "ranking", .title = "Ranking"};
  add(section, solved_plot(n));
  auto blocks = ranking_blocks(n.group());
  for (std::size_t i = blocks.size(); i-- > 0;) {
    const bool own = i + 1 == blocks.size();
    if (own) blocks[i].text += ranking_note();
    add(section, std::move(blocks[i]), !own);
  }
  add(section, apart_block(n));
  add(section, stability_block(n), true);
  return section;
}

Section step_section(const GroupNumbers& n, std::span<const SceneCost> costs) {
  Section section{.id = "step", .title = "Does the solver matter?"};
  Block block = step_block(n, costs);
  if (block.empty()) {
    section.missing =
        "What the rest of a step costs is not known here: no run of an engine lies beside these "
        "results. `conebench simulate SCENE --json > RESULTS_DIR/simulations/SCENE.json` adds one "
        "for each scene.";
    return section;
  }
  add(section, step_plots(n, costs));
  add(section, std::move(block));
  return section;
}

Section profile_section(const GroupNumbers& n) {
  Section section{.id = "profiles", .title = "Speed and success"};
  add(section, profile_plots(n));
  add(section, tolerance_plot(n));
  add(section, shares_block(n), true);
  add(section, time_plots(n));
  add(section, time_block(n), true);
  add(section, anytime_plots(n));
  return section;
}

Section tails_section(const GroupNumbers& n) {
  Section section{.id = "tails", .title = "Tails and deadlines"};
  add(section, missed_plot(n));
  add(section, tails_block(n));
  add(section, deadline_block(n));
  return section;
}

Section scaling_section(const GroupNumbers& n) {
  Section section{.id = "scaling", .title = "Scaling with size"};
  Scaling of_size = scaling(n);
  add(section, std::move(of_size.plot));
  add(section, std::move(of_size.block));
  return section;
}

Section warm_section(const GroupNumbers& n, std::span<const Group> groups) {
  Section section{.id = "warm", .title = "Gain of a warm start"};
  if (const Group* cold = cold_twin(n.group(), groups)) {
    const auto gains = warm_gains(*cold, n.group());
    add(section, warm_plot(gains, n.ranking()));
    add(section, warm_block(gains, n.group().settings));
  }
  add(section, donor_block(n.group()));
  if (section.parts.empty()) {
    section.missing =
        n.group().settings.mode == "cold"
            ? "These solves all start from r = 0. `conebench run --mode cold,sequence` "
              "also solves the steps of a scene one after the other, each from the "
              "answer before; their report says what that gains."
            : "Nothing ran from r = 0 under the same rules, so there is nothing to "
              "compare with.";
  }
  return section;
}

Section model_section(const Group& group) {
  Section section{.id = "models", .title = "Models and their gap"};
  if (group.models.empty()) {
    section.missing = "No model (a solver of an approximation: associated cone, pyramid) was run.";
    return section;
  }
  add(section, model_plot(group));
  add(section, model_block(group));
  return section;
}

Section ends_section(const Group& group) {
  Section section{.id = "ends", .title = "How the tasks ended"};
  Block block = status_block(group);
  block.text =
      "*converged*: the solver's own test, or the common one, was met; only the verified eta "
      "counts as solved. *refuted*: it claimed success and eta says no.";
  add(section, std::move(block));
  return section;
}

}  // namespace

GroupReport report_group(const Group& group, std::span<const Group> groups,
                         const ReportInput& input) {
  GroupReport report{.title = describe(group.settings)};
  if (group.methods.empty()) {
    report.verdict.sentence = "**Only models were run under these rules:** there is no ranking.";
  } else {
    const GroupNumbers n(group);
    report.verdict = verdict(n);
    report.sections = {ranking_section(n), step_section(n, input.scene_costs),
                       profile_section(n), tails_section(n),
                       scaling_section(n), warm_section(n, groups)};
  }
  report.sections.push_back(model_section(group));
  report.sections.push_back(ends_section(group));
  return report;
}

}  // namespace conebench::results
