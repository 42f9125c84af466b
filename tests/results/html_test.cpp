#include "results/html.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <openssl/evp.h>
#include <zlib.h>

#include <nlohmann/json.hpp>

#include "make_record.h"
#include "problems/error.h"
#include "problems/made_backwards.h"
#include "results/html_data.h"
#include "results/html_text.h"
#include "results/latex.h"
#include "results/svg_plot.h"

namespace conebench::results {
namespace {

using nlohmann::json;
using testing::HasSubstr;
using testing::Not;

constexpr PageFiles kFiles{"body{}", "let script=1", "let view=2"};

std::vector<Record> some_records() {
  Record slow = make_record("p1", "b", 1e-9, 2.0);
  slow.curve = {{0.5, 1, 0.1}, {2.0, 9, 1e-9}};
  Record dead = make_record("p2", "b", Record::kUnknown, 0.0);
  dead.status = Status::kKilledTime;
  return {make_record("p1", "a", 1e-9, 1.0), slow, make_record("p2", "a", 1e-9, 3.0), dead};
}

std::string between(const std::string& text, const std::string& from, const std::string& to) {
  const std::size_t start = text.find(from) + from.size();
  return text.substr(start, text.find(to, start) - start);
}

// What the page's script does with DecompressionStream.
std::string unpacked(const std::string& letters) {
  std::vector<unsigned char> bytes(letters.size());
  const int length =
      EVP_DecodeBlock(bytes.data(), reinterpret_cast<const unsigned char*>(letters.data()),
                      static_cast<int>(letters.size()));
  std::string text(20'000'000, '\0');
  uLongf size = text.size();
  EXPECT_EQ(::uncompress(reinterpret_cast<Bytef*>(text.data()), &size, bytes.data(),
                         static_cast<uLong>(length)),
            Z_OK);
  text.resize(size);
  return text;
}

json data_of(const std::string& page) {
  return json::parse(unpacked(between(page, "id=\"data\">", "</script>")));
}

TEST(HtmlText, MarksUpAndEscapes) {
  EXPECT_EQ(html_inline("*a* **b** `<*x*>` 2 < 3 * 4"),
            "<em>a</em> <strong>b</strong> <code>&lt;*x*&gt;</code> 2 &lt; 3 * 4");
  EXPECT_EQ(html_paragraphs("one\n\n- two\n- three"),
            "<p>one</p>\n<ul>\n<li>two</li>\n<li>three</li>\n</ul>\n");
}

TEST(Html, HoldsTheDataThatTheScriptReads) {
  const auto records = some_records();
  const json data = data_of(html_report({.records = records}, kFiles));
  const json& problems = data.at("groups").at(0).at("problems");
  EXPECT_EQ(problems.at("name"), json({"p1", "p2"}));
  EXPECT_EQ(problems.at("solvers"), json({"a", "b"}));
  EXPECT_EQ(problems.at("time_s"), json({{1.0, 3.0}, {2.0, nullptr}}));
  EXPECT_EQ(problems.at("statuses").at(problems.at("status").at(1).at(1).get<int>()),
            "killed_time");
  EXPECT_EQ(problems.at("eta").at(1).at(1), nullptr);
  EXPECT_EQ(problems.at("curves").at("0").at(0), json({1, {0.5, 2.0}, {0.1, 1e-9}}));
  std::vector<std::string> plots;
  for (const json& plot : data.at("groups").at(0).at("plots")) plots.push_back(plot.at("id"));
  EXPECT_THAT(plots, testing::ElementsAre("solved", "profile", "tolerance", "ecdf", "anytime",
                                          "missed", "scaling"));
}

TEST(Html, ShowsEveryPlotOfTheDataAsSvg) {
  const auto records = some_records();
  const std::string page = html_report({.records = records}, kFiles);
  const json data = data_of(page);
  for (const json& plot : data.at("groups").at(0).at("plots")) {
    const std::string figure =
        between(page, "data-plot=\"" + plot.at("id").get<std::string>() + "\"", "</figure>");
    std::size_t images = 0;
    for (std::size_t at = 0; (at = figure.find("<svg", at)) != std::string::npos; ++at) ++images;
    EXPECT_EQ(images, plot.at("variants").size()) << plot.at("id");
  }
}

TEST(Html, LetsNothingInButItsOwnScriptAndStyle) {
  const auto records = some_records();
  const std::string page = html_report({.records = records}, kFiles);
  const std::string policy = between(page, "Content-Security-Policy\" content=\"", "\">");
  // printf 'let script=1' | openssl dgst -sha256 -binary | base64
  EXPECT_EQ(
      policy,
      "default-src 'none'; script-src 'sha256-QlTaSrIfn20GfWqpD+D18y12TUJAPdO/nKmJPdfu6Is='; "
      "style-src "
      "'sha256-fJgEClQWV1hGkK4qHMO0KotTsVnMYMXTq7/suurGyUo='; img-src data:; base-uri 'none'; "
      "form-action 'none'");
  EXPECT_THAT(page, Not(HasSubstr("let view")));
  for (const char* load : {"src=", "href=\"http", "url(", "@import", " style=\""}) {
    EXPECT_THAT(page, Not(HasSubstr(load)));
  }
}

TEST(Html, SaysWhyThereIsNoViewAndNoCostOfSteps) {
  const auto records = some_records();
  const std::string page = html_report({.records = records, .no_views = "Gone & lost."}, kFiles);
  EXPECT_THAT(page, HasSubstr("Gone &amp; lost."));
  EXPECT_THAT(page, HasSubstr("conebench simulate SCENE --json"));
}

TEST(Html, NamesOfProblemsCannotBreakOut) {
  auto records = some_records();
  for (Record& record : records) record.problem.name = "</script><b>" + record.problem.name;
  EXPECT_THAT(html_report({.records = records}, kFiles), Not(HasSubstr("</script><b>")));
}

TEST(StepCost, IsReadFromEitherEnginesSummary) {
  const json dem = {{"engine", "dem"}, {"scene", "column"}, {"steps", 10},
                    {"solve_s", 1.0},  {"engine_s", 3.0},   {"solver", "gs"}};
  EXPECT_DOUBLE_EQ(scene_cost_from_json(dem, "x").other_per_step_s(), 0.3);
  const json mpm = {{"engine", "mpm"},   {"scene", "sand"},   {"steps", 10},   {"solve_s", 1.0},
                    {"assembly_s", 1.0}, {"transfer_s", 0.5}, {"solver", "gs"}};
  EXPECT_DOUBLE_EQ(scene_cost_from_json(mpm, "x").other_per_step_s(), 0.15);
  json none = dem;
  none["steps"] = 0;
  EXPECT_THROW(scene_cost_from_json(none, "x"), problems::InputError);
  EXPECT_THROW(scene_cost_from_json({{"engine", "dem"}}, "x"), problems::InputError);
}

TEST(StepPlots, GiveTheSolversShareOfTheStep) {
  Group group;
  group.methods = some_records();
  group.settings = group.methods.front().settings;
  const GroupNumbers numbers(group);
  const std::vector<SceneCost> costs = {
      {.family = "dem/test", .steps = 2, .solve_s = 0.0, .other_s = 2.0, .solver = "a"}};
  const auto plots = step_plots(numbers, costs);
  ASSERT_EQ(plots.size(), 4u);
  // "a" needs 1 and 3 s, its median (order statistic) is 1 s; the rest of a step is 1 s.
  EXPECT_DOUBLE_EQ(plots[0].series[0].points.at(0).x, 0.5);
  EXPECT_DOUBLE_EQ(plots[1].series[0].points.at(0).x, 2.0);
  EXPECT_TRUE(step_block(numbers, {}).empty());
}

// A ball of 2 kg pressed on the ground, sticking: r' is what stops it.
problems::ProblemFile ball_on_ground() {
  auto [problem, solutions] = problems::make_backwards({.cones = 12, .cohesive_share = 0.5});
  problems::Geometry geometry;
  geometry.points.setZero(12, 3);
  return {problem, geometry, {}, {}};
}

TEST(ProblemView, JudgesTwoAnswersContactByContact) {
  const auto made = problems::make_backwards({.cones = 12, .cohesive_share = 0.5});
  const problems::ProblemFile file = ball_on_ground();
  const Eigen::VectorXd exact = made.solutions.front();
  const ProblemView view =
      view_of(file, {{"a", exact}, {"b", Eigen::VectorXd::Zero(exact.size())}});
  ASSERT_EQ(view.answers.size(), 2u);
  EXPECT_LT(view.answers[0].eta, 1e-10);
  EXPECT_GT(view.answers[1].eta, 1e-3);
  EXPECT_DOUBLE_EQ(view.answers[1].eta_of_cone.maxCoeff(), view.answers[1].eta);
  for (const ContactState state : view.answers[1].state) EXPECT_EQ(state, ContactState::kOpen);
  EXPECT_NEAR(view.force_difference(3), view.answers[0].force(3), 1e-12);
  EXPECT_THAT(view.cohesive, testing::Contains(true));
  EXPECT_THAT(view.cohesive, testing::Contains(false));
}

TEST(Latex, EscapesAndMarksUp) {
  EXPECT_EQ(latex_text("`a_b` is 5 % of *x* & <y>"),
            "\\texttt{a\\_b} is 5 \\% of \\emph{x} \\& \\textless{}y\\textgreater{}");
  EXPECT_EQ(latex_text("- one\n- two"), "\\begin{itemize}\n\\item one\n\\item two\n\\end{itemize}");
}

TEST(Latex, HasAPictureForEveryPlotAndClosesWhatItOpens) {
  const auto records = some_records();
  const std::string text = latex_report({.records = records});
  const auto count = [&text](const std::string& wanted) {
    std::size_t found = 0;
    for (std::size_t at = 0; (at = text.find(wanted, at)) != std::string::npos; ++at) ++found;
    return found;
  };
  // profile: 3 tolerances; ecdf and anytime: 2 choices; solved, tolerance, missed, scaling: 1.
  EXPECT_EQ(count("\\begin{tikzpicture}"), 11u);
  for (const std::string name : {"tikzpicture", "axis", "longtable", "center", "itemize"}) {
    EXPECT_EQ(count("\\begin{" + name + "}"), count("\\end{" + name + "}")) << name;
  }
  for (const char* number : {"(inf", ",inf", "nan"}) EXPECT_EQ(count(number), 0u) << number;
}

}  // namespace
}  // namespace conebench::results
