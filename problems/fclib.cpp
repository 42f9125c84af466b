#include "problems/fclib.h"

#include <algorithm>

#include "problems/compressed.h"
#include "problems/error.h"
#include "problems/fclib_view.h"
#include "problems/file_parts.h"

namespace conebench::problems {
namespace {

// FCLIB's nz, when it is not a number of triplets.
constexpr int kCompressedColumns = -1;
constexpr int kCompressedRows = -2;

// The expected shape is compared before anything of that size is made. nzmax is not read: files
// exist where it is larger than the arrays.
SparseMatrix read_matrix(const hdf5::Reader& reader, const std::string& group, Eigen::Index rows,
                         Eigen::Index cols) {
  const std::string& subject = reader.subject();
  const int m = reader.integer(group + "/m"), n = reader.integer(group + "/n");
  require(m == rows && n == cols, subject, group, " is ", m, " x ", n, ", expected ", rows, " x ",
          cols);
  const int nz = reader.integer(group + "/nz");
  const std::vector<int> p = reader.integers(group + "/p");
  const std::vector<int> i = reader.integers(group + "/i");
  const Eigen::VectorXd x = reader.vector(group + "/x");
  const std::span<const double> value(x.data(), static_cast<std::size_t>(x.size()));
  const CompressedArrays arrays{rows, cols, p, i, value};
  if (nz == kCompressedColumns) return from_compressed_columns(arrays, subject, group);
  if (nz == kCompressedRows) return from_compressed_rows(arrays, subject, group);
  require(nz >= 0, subject, group, "/nz is ", nz, ", expected >= -2");
  const auto entries = static_cast<std::size_t>(nz);
  require(p.size() >= entries && i.size() >= entries && value.size() >= entries, subject, group,
          " has ", p.size(), " columns, ", i.size(), " rows and ", value.size(),
          " values, expected nz = ", nz);
  // i is the row and p the column: fclib.h says the opposite, its files do not.
  return from_triplets(rows, cols, std::span(i).first(entries), std::span(p).first(entries),
                       value.first(entries), subject, group);
}

std::vector<Cone> read_cones(const hdf5::Reader& reader, const std::string& root,
                             Eigen::Index rows) {
  const int dim = reader.integer(root + "/spacedim");
  const Eigen::VectorXd mu = reader.vector(root + "/vectors/mu");
  require(dim >= 1 && mu.size() * dim == rows, reader.subject(), root, "/vectors/mu has ",
          mu.size(), " entries for spacedim ", dim, " and ", rows,
          " rows, expected rows / spacedim");
  std::vector<Cone> cones;
  for (const double friction : mu) cones.push_back(Cone::coulomb(dim, friction));
  return cones;
}

Metadata describe(const hdf5::Reader& reader, const std::string& root,
                  const std::filesystem::path& path) {
  Metadata metadata;
  metadata.name = path.stem().string();
  metadata.engine = "fclib";
  metadata.scene = reader.text_dataset(root + "/info/title");
  metadata.origin = path.filename().string();
  return metadata;
}

Problem read_global(const hdf5::Reader& reader, Metadata metadata) {
  const std::string root = "/fclib_global";
  if (reader.has(root + "/G")) {
    reader.fail(root + "/G", "holds bilateral constraints, which are not supported");
  }
  Eigen::VectorXd f = reader.vector(root + "/vectors/f");
  Eigen::VectorXd w = reader.vector(root + "/vectors/w");
  std::vector<Cone> cones = read_cones(reader, root, w.size());
  SparseMatrix M = read_matrix(reader, root + "/M", f.size(), f.size());
  SparseMatrix H = read_matrix(reader, root + "/H", f.size(), w.size()).transpose();
  return {PrimalData{std::move(M), std::move(H), std::move(f), std::move(w)}, std::move(cones),
          std::move(metadata), read_rate_scale(reader)};
}

Problem read_local(const hdf5::Reader& reader, Metadata metadata) {
  const std::string root = "/fclib_local";
  for (const char* group : {"/V", "/R"}) {
    if (reader.has(root + group)) {
      reader.fail(root + group, "holds bilateral constraints, which are not supported");
    }
  }
  Eigen::VectorXd q = reader.vector(root + "/vectors/q");
  std::vector<Cone> cones = read_cones(reader, root, q.size());
  SparseMatrix W = read_matrix(reader, root + "/W", q.size(), q.size());
  return {ReducedData{std::move(W), std::move(q)}, std::move(cones), std::move(metadata),
          read_rate_scale(reader)};
}

}  // namespace

ProblemFile read_fclib(const std::filesystem::path& path) {
  const hdf5::Reader reader(path);
  const bool local = reader.has("/fclib_local");
  if (!local && !reader.has("/fclib_global")) {
    reader.fail("/", "has neither /fclib_local nor /fclib_global");
  }
  Metadata metadata = describe(reader, local ? "/fclib_local" : "/fclib_global", path);
  ProblemFile file{make_problem(reader.subject(),
                                [&] {
                                  return local ? read_local(reader, std::move(metadata))
                                               : read_global(reader, std::move(metadata));
                                }),
                   {},
                   {},
                   {}};
  file.solution = read_solution(reader, file.problem);
  if (reader.has("/guesses/1/r")) {
    Eigen::VectorXd guess = reader.vector("/guesses/1/r", file.problem.rows());
    if (!guess.isZero(0.0)) file.guess = std::move(guess);
  }
  return file;
}

void write_fclib_file(const std::filesystem::path& path, const ProblemFile& file) {
  const Problem& problem = file.problem;
  require(fits_fclib(problem), problem.name(),
          "FCLIB cannot hold this problem, expected Coulomb cones (theta = mu) that all have the "
          "same dimension 2, 3 or 6");
  hdf5::Writer writer(path);
  write_fclib_view(writer, problem, FclibArrays::kOwn);
  write_rate_scale(writer, problem.shifted());
  if (file.solution) write_solution(writer, problem, *file.solution);
  writer.save();
}

}  // namespace conebench::problems
