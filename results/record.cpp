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
  return {j.at("tol"),
          number_from(j.at("time_limit_s")),
          j.at("memory_limit_bytes"),
          j.at("stop"),
          j.value("mode", std::string("cold")),
          j.value("threads", 1),
          j.value("timing", std::string("once"))};
}

json to_json(const SequencePlace& place) {
  if (place.name.empty()) return nullptr;
  return {{"name", place.name}, {"id", place.id}, {"index", place.index}, {"length", place.length}};
}

SequencePlace sequence_from(const json& j) {
  if (j.is_null()) return {};
  return {j.at("name"), j.at("id"), j.at("index"), j.at("length")};
}

Record parse(const json& j) {
  Record r;
  r.problem = {j.at("problem"), j.at("content_sha256"), j.at("path"), j.at("family"),
               j.at("cones")};
  r.solver = j.at("solver");
  r.kind = j.at("kind");
  r.settings = settings_from(j);
  r.solver_build = j.value("solver_build", std::string());
  r.repetition = j.at("repetition");
  r.sequence = sequence_from(j.value("sequence", json()));
  r.donor = j.value("donor", std::string());
  r.status = status_or_throw(j.at("status"));
  r.claimed = j.at("claimed");
  r.eta = number_from(j.at("eta"));
  r.fclib_residual = number_from(j.at("fclib_residual"));
  r.siconos_residual = number_from(j.at("siconos_residual"));
  r.attainable_eta = number_from(j.at("attainable_eta"));
  r.guess_eta = number_from(j.value("guess_eta", json()));
  r.model_eta = number_from(j.value("model_eta", json()));
  r.iterations = j.at("iterations");
  r.setup_s = j.at("setup_s");
  r.solve_s = j.at("solve_s");
  r.timed_solves = j.value("timed_solves", std::int64_t{1});
  r.time_spread = number_from(j.value("time_spread", json()));
  r.solver_cpu_s = j.value("solver_cpu_s", 0.0);
  r.allocations = j.value("allocations", std::uint64_t{0});
  r.solver_memory_bytes = j.value("solver_memory_bytes", std::uint64_t{0});
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

std::string short_hash(std::string_view text) {
  std::array<unsigned char, EVP_MAX_MD_SIZE> digest{};
  EVP_Digest(text.data(), text.size(), digest.data(), nullptr, EVP_sha256(), nullptr);
  std::string hash;
  for (std::size_t i = 0; i < 16; ++i) hash += fmt::format("{:02x}", digest[i]);
  return hash;
}

std::string sequence_key(const Record& record) {
  const Settings& s = record.settings;
  const std::string& what =
      record.sequence.id.empty() ? record.problem.content_sha256 : record.sequence.id;
  return short_hash(fmt::format("{}\n{}\n{}\n{}\n{}\n{}\n{}\n{}\n{}\n{}\n{}\n{}\n{}", what,
                                record.solver, record.solver_build, s.tol, s.time_limit_s,
                                s.memory_limit_bytes, s.stop, s.mode, s.threads, record.repetition,
                                record.host.host_class(), record.donor, s.timing));
}

std::string task_key(const Record& record) {
  const std::string key = sequence_key(record);
  if (record.sequence.id.empty()) return key;
  return short_hash(fmt::format("{}\n{}", key, record.sequence.index));
}

std::string Host::host_class() const { return fmt::format("{}, {} cores", cpu, cores); }

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
          {"mode", r.settings.mode},
          {"threads", r.settings.threads},
          {"timing", r.settings.timing},
          {"solver_build", r.solver_build},
          {"repetition", r.repetition},
          {"sequence", to_json(r.sequence)},
          {"donor", r.donor},
          {"status", to_string(r.status)},
          {"claimed", r.claimed},
          {"eta", number(r.eta)},
          {"fclib_residual", number(r.fclib_residual)},
          {"siconos_residual", number(r.siconos_residual)},
          {"attainable_eta", number(r.attainable_eta)},
          {"guess_eta", number(r.guess_eta)},
          {"model_eta", number(r.model_eta)},
          {"iterations", r.iterations},
          {"setup_s", number(r.setup_s)},
          {"solve_s", number(r.solve_s)},
          {"timed_solves", r.timed_solves},
          {"time_spread", number(r.time_spread)},
          {"solver_cpu_s", r.solver_cpu_s},
          {"allocations", r.allocations},
          {"solver_memory_bytes", r.solver_memory_bytes},
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
