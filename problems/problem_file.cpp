#include "problems/problem_file.h"

#include <numeric>

#include "problems/atomic_file.h"
#include "problems/compressed.h"
#include "problems/error.h"
#include "problems/fclib_view.h"
#include "problems/file_parts.h"
#include "problems/geometry_file.h"

namespace conebench::problems {
namespace {

constexpr std::string_view kFormat = "conebench-problem";
constexpr std::string_view kGenerator = "conebench " CONEBENCH_VERSION;
constexpr std::int64_t kVersion = 1;

void write_root(hdf5::Writer& writer, const Problem& problem) {
  const Metadata& metadata = problem.metadata();
  writer.attribute("/", "format", kFormat);
  writer.attribute("/", "format_version", kVersion);
  writer.attribute("/", "name", metadata.name);
  writer.attribute("/", "engine", metadata.engine);
  writer.attribute("/", "scene", metadata.scene);
  writer.attribute("/", "step", metadata.step);
  writer.attribute("/", "step_size_s", metadata.step_size_s);
  writer.attribute("/", "force_unit", metadata.force_unit);
  writer.attribute("/", "rate_unit", metadata.rate_unit);
  writer.attribute("/", "origin", metadata.origin);
  writer.attribute("/", "sampling_weight", metadata.sampling_weight);
  writer.attribute("/", "generator", kGenerator);
  writer.attribute("/", "content_sha256", content_sha256(problem));
  write_rate_scale(writer, problem);
}

Metadata read_root(const hdf5::Reader& reader) {
  if (reader.text("/", "format") != kFormat) {
    reader.fail("/", "has the format '" + reader.text("/", "format") + "', expected '" +
                         std::string(kFormat) + "'");
  }
  const std::int64_t version = reader.whole_number("/", "format_version");
  if (version != kVersion) {
    reader.fail("/", "has format_version " + std::to_string(version) + ", expected " +
                         std::to_string(kVersion));
  }
  Metadata metadata;
  const auto text = [&](const char* name, std::string& value) {
    if (reader.has_attribute("/", name)) value = reader.text("/", name);
  };
  const auto number = [&](const char* name, double& value) {
    if (reader.has_attribute("/", name)) value = reader.number("/", name);
  };
  text("name", metadata.name);
  text("engine", metadata.engine);
  text("scene", metadata.scene);
  text("force_unit", metadata.force_unit);
  text("rate_unit", metadata.rate_unit);
  text("origin", metadata.origin);
  number("step_size_s", metadata.step_size_s);
  number("sampling_weight", metadata.sampling_weight);
  if (reader.has_attribute("/", "step")) metadata.step = reader.whole_number("/", "step");
  return metadata;
}

void write_matrix(hdf5::Writer& writer, const std::string& group, const SparseMatrix& matrix) {
  writer.group(group);
  writer.array(group + "/data", values(matrix));
  writer.array(group + "/indices", inner_indices(matrix));
  writer.array(group + "/indptr", begins(matrix));
  const std::int64_t shape[] = {matrix.rows(), matrix.cols()};
  writer.attribute(group, "shape", shape);
  writer.attribute(group, "format", std::string_view("csr"));
}

// The expected shape is compared before anything of that size is made.
SparseMatrix read_matrix(const hdf5::Reader& reader, const std::string& group, Eigen::Index rows,
                         Eigen::Index cols) {
  if (!reader.has(group)) reader.fail(group, "is missing");
  if (!reader.has(group + "/data")) {
    reader.fail(group,
                "has no member data, expected a group of compressed rows (data, indices, "
                "indptr; attributes shape, format)");
  }
  const std::vector<std::int64_t> shape = reader.whole_numbers(group, "shape", 2);
  require(shape[0] == rows && shape[1] == cols, reader.subject(), group, " has the shape ",
          shape[0], " x ", shape[1], ", expected ", rows, " x ", cols);
  const Eigen::VectorXd data = reader.vector(group + "/data");
  const std::vector<int> indices = reader.integers(group + "/indices");
  const std::vector<int> indptr = reader.integers(group + "/indptr");
  const std::string format = reader.text(group, "format");
  const bool by_columns = format == "csc";
  const Eigen::Index begins = (by_columns ? cols : rows) + 1;
  require(static_cast<Eigen::Index>(indptr.size()) == begins, reader.subject(), group,
          "/indptr has ", indptr.size(), " entries, expected ", begins,
          by_columns ? " (columns + 1)" : " (rows + 1)");
  require(indices.size() == static_cast<std::size_t>(data.size()) && indptr.back() == data.size(),
          reader.subject(), group, " has ", data.size(), " values and ", indices.size(),
          " indices, expected both to be indptr's last entry");
  const CompressedArrays arrays{
      rows, cols, indptr, indices, {data.data(), static_cast<std::size_t>(data.size())}};
  if (format == "csr") return from_compressed_rows(arrays, reader.subject(), group);
  if (by_columns) return from_compressed_columns(arrays, reader.subject(), group);
  reader.fail(group, "has the format '" + format + "', expected 'csr' or 'csc'");
}

std::vector<double> column_of(std::span<const Cone> cones, double Cone::*member) {
  std::vector<double> column;
  for (const Cone& cone : cones) column.push_back(cone.*member);
  return column;
}

void write_problem(hdf5::Writer& writer, const Problem& problem) {
  std::vector<int> dims;
  for (const Cone& cone : problem.cones()) dims.push_back(cone.dim);
  writer.group("/problem");
  writer.array("/problem/dim", dims);
  writer.array("/problem/mu", column_of(problem.cones(), &Cone::mu));
  writer.array("/problem/kappa", column_of(problem.cones(), &Cone::kappa));
  writer.array("/problem/theta", column_of(problem.cones(), &Cone::theta));
  if (problem.is_primal()) {
    writer.array("/problem/f", problem.f());
    writer.array("/problem/w", problem.w());
    write_matrix(writer, "/problem/M", problem.M());
    write_matrix(writer, "/problem/H", problem.H());
  } else {
    writer.array("/problem/q", problem.q());
    write_matrix(writer, "/problem/W", problem.W());
  }
}

std::vector<Cone> read_cones(const hdf5::Reader& reader, Eigen::Index rows) {
  const std::vector<int> dim = reader.integers("/problem/dim");
  const auto count = static_cast<Eigen::Index>(dim.size());
  const Eigen::VectorXd mu = reader.vector("/problem/mu", count);
  const Eigen::VectorXd kappa = reader.vector("/problem/kappa", count);
  const Eigen::VectorXd theta = reader.vector("/problem/theta", count);
  const std::int64_t sum = std::accumulate(dim.begin(), dim.end(), std::int64_t{0});
  require(sum == rows, reader.subject(), "/problem/dim sums to ", sum, ", expected ", rows,
          ", one for each row");
  std::vector<Cone> cones;
  for (Eigen::Index i = 0; i < count; ++i) {
    const int cone_dim = dim[static_cast<std::size_t>(i)];
    require(cone_dim >= 1, reader.subject(), "/problem/dim[", i, "] is ", cone_dim,
            ", expected >= 1");
    cones.push_back({cone_dim, mu(i), kappa(i), theta(i)});
  }
  return cones;
}

Problem read_problem(const hdf5::Reader& reader, Metadata metadata) {
  const std::optional<double> scale = read_rate_scale(reader);
  if (reader.has("/problem/W")) {
    Eigen::VectorXd q = reader.vector("/problem/q");
    std::vector<Cone> cones = read_cones(reader, q.size());
    SparseMatrix W = read_matrix(reader, "/problem/W", q.size(), q.size());
    return {ReducedData{std::move(W), std::move(q)}, std::move(cones), std::move(metadata), scale};
  }
  Eigen::VectorXd f = reader.vector("/problem/f");
  Eigen::VectorXd w = reader.vector("/problem/w");
  std::vector<Cone> cones = read_cones(reader, w.size());
  SparseMatrix M = read_matrix(reader, "/problem/M", f.size(), f.size());
  SparseMatrix H = read_matrix(reader, "/problem/H", w.size(), f.size());
  return {PrimalData{std::move(M), std::move(H), std::move(f), std::move(w)}, std::move(cones),
          std::move(metadata), scale};
}

void check_hash(const hdf5::Reader& reader, const Problem& problem) {
  if (!reader.has_attribute("/", "content_sha256")) return;
  const std::string stored = reader.text("/", "content_sha256");
  const std::string found = content_sha256(problem);
  if (stored != found) {
    reader.fail("/problem", "has the hash " + found + ", but content_sha256 is " + stored +
                                ": the file is damaged");
  }
}

void write_all(hdf5::Writer& writer, const ProblemFile& file) {
  const Problem& problem = file.problem;
  require(file.guess.size() == 0 || file.guess.size() == problem.rows(), problem.name(),
          "the guess has ", file.guess.size(), " entries, expected ", problem.rows());
  write_root(writer, problem);
  write_problem(writer, problem);
  if (file.geometry) write_geometry(writer, *file.geometry, problem);
  if (file.guess.size() > 0) {
    writer.group("/guess");
    writer.array("/guess/r", file.guess);
    writer.attribute("/guess", "shifted", std::int64_t{1});
  }
  if (file.solution) write_solution(writer, problem, *file.solution);
  if (fits_fclib(problem)) write_fclib_view(writer, problem, FclibArrays::kLinked);
}

}  // namespace

void write_problem_file(const std::filesystem::path& path, const ProblemFile& file) {
  hdf5::Writer writer(path);
  write_all(writer, file);
  writer.save();
}

void set_sampling_weight(const std::filesystem::path& path, double weight) {
  hdf5::overwrite_attribute(path, "/", "sampling_weight", weight);
  sync_file(path);
}

void write_external_problem(const std::filesystem::path& path, const Problem& standard,
                            const Eigen::VectorXd& guess) {
  hdf5::Writer writer(path);
  write_all(writer, {standard, {}, guess, {}});
  if (standard.rate_scale_is_of_data()) {
    writer.attribute("/", "rate_scale", standard.rate_scale());
  }
  writer.save();
}

ProblemFile read_problem_file(const std::filesystem::path& path) {
  const hdf5::Reader reader(path);
  if (!reader.has("/problem")) reader.fail("/problem", "is missing");
  Metadata metadata = read_root(reader);
  ProblemFile file{
      make_problem(reader.subject(), [&] { return read_problem(reader, std::move(metadata)); }),
      {},
      {},
      {}};
  check_hash(reader, file.problem);
  file.geometry = read_geometry(reader, file.problem.cone_count());
  if (reader.has("/guess/r")) file.guess = reader.vector("/guess/r", file.problem.rows());
  file.solution = read_solution(reader, file.problem);
  return file;
}

void write_solution_file(const std::filesystem::path& path, const Problem& problem,
                         const Solution& solution) {
  hdf5::Writer writer(path);
  writer.attribute("/", "format", std::string_view("conebench-solution"));
  writer.attribute("/", "name", problem.name());
  writer.attribute("/", "generator", kGenerator);
  writer.attribute("/", "content_sha256", content_sha256(problem));
  write_solution(writer, problem, solution);
  writer.save();
}

ForeignAnswer read_foreign_answer(const std::filesystem::path& path, Eigen::Index rows) {
  const hdf5::Reader reader(path);
  ForeignAnswer answer{.r = reader.vector("/solution/r", rows)};
  if (reader.has_attribute("/solution", "iterations")) {
    answer.iterations = reader.whole_number("/solution", "iterations");
    if (answer.iterations < 0) {
      reader.fail("/solution",
                  "iterations = " + std::to_string(answer.iterations) + ", expected >= 0");
    }
  }
  return answer;
}

}  // namespace conebench::problems
