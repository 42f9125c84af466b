#include "harness/plugin_probe.h"

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "harness/error_text.h"
#include "harness/plugin_library.h"
#include "harness/pool.h"

namespace conebench::harness {
namespace {

using nlohmann::json;

constexpr double kLimit_s = 5.0;

json bound(double value) { return std::isfinite(value) ? json(value) : json(nullptr); }

json to_json(const solvers::Parameter& p) {
  json value = {{"name", p.name},
                {"low", bound(p.low)},
                {"high", bound(p.high)},
                {"doc", p.doc},
                {"choices", p.choices}};
  std::visit([&](const auto& fallback) { value["fallback"] = fallback; }, p.fallback);
  return value;
}

// JSON keeps the four types apart: 1.0 stays a floating point number.
solvers::Value value_from(const json& value) {
  if (value.is_boolean()) return value.get<bool>();
  if (value.is_number_integer()) return value.get<std::int64_t>();
  if (value.is_number()) return value.get<double>();
  return value.get<std::string>();
}

solvers::Parameter parameter_from(const json& j) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  return {.name = j.at("name"),
          .fallback = value_from(j.at("fallback")),
          .low = j.at("low").is_null() ? -kInfinity : j.at("low").get<double>(),
          .high = j.at("high").is_null() ? kInfinity : j.at("high").get<double>(),
          .choices = j.at("choices").get<std::vector<std::string>>(),
          .doc = j.at("doc")};
}

json described(const std::filesystem::path& path) {
  const PluginLibrary library(path);
  const auto text = [](const char* given) { return std::string(given == nullptr ? "" : given); };
  json parameters = json::array();
  for (const solvers::Parameter& p : library.parameters()) parameters.push_back(to_json(p));
  return {{"name", text(library.plugin().name)},
          {"summary", text(library.plugin().summary)},
          {"parameters", parameters}};
}

// In the child.
std::string look(const std::filesystem::path& path) {
  json message;
  try {
    message = described(path);
  } catch (const BadAbi& error) {
    message = {{"trouble", error.what()}};
  } catch (const problems::InputError& error) {
    message = {{"input_error", error.what()}, {"subject", error.subject()}};
  }
  return message.dump(-1, ' ', false, json::error_handler_t::replace);
}

PluginProbe understood(const ChildOutcome& outcome) {
  const json message = json::parse(outcome.output, nullptr, false);
  if (message.is_discarded()) return {{}, describe_end(outcome)};
  if (message.contains("input_error")) {
    throw input_error(message["input_error"], message["subject"]);
  }
  if (message.contains("trouble")) return {{}, message["trouble"]};
  PluginDescription description{message.at("name"), message.at("summary"), {}};
  for (const json& p : message.at("parameters")) {
    description.parameters.push_back(parameter_from(p));
  }
  return {std::move(description), {}};
}

}  // namespace

PluginProbe probe_plugin(const std::filesystem::path& path) {
  problems::require(std::filesystem::is_regular_file(path), path.string(),
                    "is no file, expected a shared library");
  PluginProbe probe{{}, "interrupted"};
  run_pool(1, 1,
           {.make =
                [&](std::size_t) {
                  return Job{.work = [&] { return look(path); }, .limits = {.wall_s = kLimit_s}};
                },
            .done = [&](std::size_t, const ChildOutcome& end) { probe = understood(end); },
            .tick = {}});
  return probe;
}

}  // namespace conebench::harness
