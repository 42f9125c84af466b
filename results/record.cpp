#include "results/record.h"

#include <fmt/format.h>
#include <openssl/evp.h>

#include <array>
#include <cmath>
#include <nlohmann/json.hpp>

#include "problems/error.h"

namespace conebench::results {
namespace {

using nlohmann::json;

json number(double value) { return std::isfinite(value) ? json(value) : json(nullptr); }

double number_from(const json& value) {
  return value.is_null() ? Record::kUnknown : value.get<double>();
}

json curve_to_json(const std::vector<CurvePoint>& curve) {
  json points = json::array();
  for (const CurvePoint& p : curve) points.push_back({p.time_s, p.iteration, number(p.eta)});
  return points;
}

std::vector<CurvePoint> curve_from(const json& points) {
  std::vector<CurvePoint> curve;
  curve.reserve(points.size());
  for (const json& p : points) {
    curve.push_back({p.at(0).get<double>(), p.at(1).get<std::int64_t>(), number_from(p.at(2))});
  }
  return curve;
}

Host host_from(const json& j) {
  return {j.at("cpu"), j.at("cores"), j.at("compiler"), j.at("build"), j.at("version")};
}

Status status_or_throw(const std::string& name) {
  const auto status = status_from(name);
  problems::require(status.has_value(), "status", "\"", name, "\" is none that we know");
  return *status;
}

Settings settings_from(const json& j) {
  return {j.at("tol"), number_from(j.at("time_limit_s")), j.at("memory_limit_bytes"), j.at("stop")};
}

Record parse(const json& j) {
  Record r;
  r.problem = {j.at("problem"), j.at("content_sha256"), j.at("path"), j.at("family"),
               j.at("cones")};
  r.solver = j.at("solver");
  r.kind = j.at("kind");
  r.settings = settings_from(j);
  r.repetition = j.at("repetition");
  r.status = status_or_throw(j.at("status"));
  r.claimed = j.at("claimed");
  r.eta = number_from(j.at("eta"));
  r.fclib_residual = number_from(j.at("fclib_residual"));
  r.siconos_residual = number_from(j.at("siconos_residual"));
  r.attainable_eta = number_from(j.at("attainable_eta"));
  r.iterations = j.at("iterations");
  r.setup_s = j.at("setup_s");
  r.solve_s = j.at("solve_s");
  r.wall_s = j.at("wall_s");
  r.cpu_s = j.at("cpu_s");
  r.peak_memory_bytes = j.at("peak_memory_bytes");
  r.curve = curve_from(j.at("curve"));
  r.notes = j.at("notes").get<std::vector<std::string>>();
  r.error = j.at("error");
  r.started_at = j.at("started_at");
  r.host = host_from(j.at("host"));
  return r;
}

}  // namespace

std::string task_key(const Record& record) {
  const Settings& s = record.settings;
  const std::string text =
      fmt::format("{}\n{}\n{}\n{}\n{}\n{}\n{}", record.problem.content_sha256, record.solver, s.tol,
                  s.time_limit_s, s.memory_limit_bytes, s.stop, record.repetition);
  std::array<unsigned char, EVP_MAX_MD_SIZE> digest{};
  EVP_Digest(text.data(), text.size(), digest.data(), nullptr, EVP_sha256(), nullptr);
  std::string key;
  for (std::size_t i = 0; i < 16; ++i) key += fmt::format("{:02x}", digest[i]);
  return key;
}

json to_json(const Host& host) {
  return {{"cpu", host.cpu},
          {"cores", host.cores},
          {"compiler", host.compiler},
          {"build", host.build},
          {"version", host.version}};
}

json to_json(const Record& r) {
  return {{"problem", r.problem.name},
          {"content_sha256", r.problem.content_sha256},
          {"path", r.problem.path},
          {"family", r.problem.family},
          {"cones", r.problem.cones},
          {"solver", r.solver},
          {"kind", r.kind},
          {"tol", r.settings.tol},
          {"time_limit_s", number(r.settings.time_limit_s)},
          {"memory_limit_bytes", r.settings.memory_limit_bytes},
          {"stop", r.settings.stop},
          {"repetition", r.repetition},
          {"status", to_string(r.status)},
          {"claimed", r.claimed},
          {"eta", number(r.eta)},
          {"fclib_residual", number(r.fclib_residual)},
          {"siconos_residual", number(r.siconos_residual)},
          {"attainable_eta", number(r.attainable_eta)},
          {"iterations", r.iterations},
          {"setup_s", number(r.setup_s)},
          {"solve_s", number(r.solve_s)},
          {"wall_s", r.wall_s},
          {"cpu_s", r.cpu_s},
          {"peak_memory_bytes", r.peak_memory_bytes},
          {"curve", curve_to_json(r.curve)},
          {"notes", r.notes},
          {"error", r.error},
          {"started_at", r.started_at},
          {"host", to_json(r.host)}};
}

Record record_from_json(const json& j, const std::string& where) {
  try {
    return parse(j);
  } catch (const json::exception& error) {
    throw problems::InputError(where, error.what());
  } catch (const problems::InputError& error) {
    throw problems::InputError(where, error.what());
  }
}

}  // namespace conebench::results
