#include "problems/fclib_view.h"

#include <algorithm>

#include "problems/file_parts.h"

namespace conebench::problems {
namespace {

constexpr int kCompressedColumns = -1;  // FCLIB's nz

class View {
 public:
  View(hdf5::Writer& writer, const Problem& problem, FclibArrays arrays)
      : writer_(writer),
        problem_(problem),
        standard_(problem.shifted()),
        linked_(arrays == FclibArrays::kLinked),
        root_(problem.is_primal() ? "/fclib_global" : "/fclib_local") {}

  void write() {
    writer_.group(root_);
    writer_.scalar(root_ + "/spacedim", problem_.cones().front().dim);
    write_info();
    writer_.group(root_ + "/vectors");
    write_mu();
    const bool same = problem_.is_standard();
    if (problem_.is_primal()) {
      write_vector("f", standard_.f(), same);
      write_vector("w", standard_.w(), true);
      write_matrix("H", problem_.H());  // our rows are the columns of FCLIB's H
      write_by_columns("M", problem_.M());
    } else {
      write_vector("q", standard_.q(), same);
      write_by_columns("W", problem_.W());
    }
  }

 private:
  void write_info() {
    const Metadata& metadata = problem_.metadata();
    const std::string cohesion = "cohesion is shifted into f (or q): r here is r + kappa e_n";
    writer_.group(root_ + "/info");
    writer_.scalar(root_ + "/info/title", std::string_view(metadata.name));
    writer_.scalar(root_ + "/info/description",
                   std::string_view(metadata.engine + " " + metadata.scene + " step " +
                                    std::to_string(metadata.step) + "; force in " +
                                    metadata.force_unit + ", rate in " + metadata.rate_unit));
    writer_.scalar(root_ + "/info/math_info",
                   std::string_view(problem_.is_standard() ? "no cohesion" : cohesion));
  }

  void write_mu() {
    if (linked_) return writer_.link("/problem/mu", root_ + "/vectors/mu");
    Eigen::VectorXd mu(problem_.cone_count());
    for (int i = 0; i < problem_.cone_count(); ++i) {
      mu(i) = problem_.cones()[static_cast<std::size_t>(i)].mu;
    }
    writer_.array(root_ + "/vectors/mu", mu);
  }

  void write_vector(const std::string& name, const Eigen::VectorXd& numbers, bool same) {
    const std::string target = root_ + "/vectors/" + name;
    if (linked_ && same) return writer_.link("/problem/" + name, target);
    writer_.array(target, numbers);
  }

  // `matrix`'s rows, as the columns of its transpose.
  void write_matrix(const std::string& name, const SparseMatrix& matrix) {
    const std::string group = root_ + "/" + name, ours = "/problem/" + name;
    write_header(group, matrix);
    if (!linked_) return write_arrays(group, matrix);
    writer_.link(ours + "/indptr", group + "/p");
    writer_.link(ours + "/indices", group + "/i");
    writer_.link(ours + "/data", group + "/x");
  }

  // A square matrix itself: its own rows serve when it is symmetric to the last bit.
  void write_by_columns(const std::string& name, const SparseMatrix& matrix) {
    const SparseMatrix columns = matrix.transpose();
    const bool symmetric = std::ranges::equal(begins(columns), begins(matrix)) &&
                           std::ranges::equal(inner_indices(columns), inner_indices(matrix)) &&
                           std::ranges::equal(values(columns), values(matrix));
    if (symmetric) return write_matrix(name, matrix);
    write_header(root_ + "/" + name, columns);
    write_arrays(root_ + "/" + name, columns);
  }

  void write_header(const std::string& group, const SparseMatrix& transposed) {
    writer_.group(group);
    writer_.scalar(group + "/m", static_cast<int>(transposed.cols()));
    writer_.scalar(group + "/n", static_cast<int>(transposed.rows()));
    writer_.scalar(group + "/nz", kCompressedColumns);
    writer_.scalar(group + "/nzmax", static_cast<int>(transposed.nonZeros()));
  }

  void write_arrays(const std::string& group, const SparseMatrix& transposed) {
    writer_.array(group + "/p", begins(transposed));
    writer_.array(group + "/i", inner_indices(transposed));
    writer_.array(group + "/x", values(transposed));
  }

  hdf5::Writer& writer_;
  const Problem& problem_;
  Problem standard_;
  bool linked_;
  std::string root_;
};

}  // namespace

bool fits_fclib(const Problem& problem) {
  if (problem.cone_count() == 0) return false;
  const int dim = problem.cones().front().dim;
  return (dim == 2 || dim == 3 || dim == 6) &&
         std::ranges::all_of(problem.cones(), [dim](const Cone& cone) {
           return cone.dim == dim && cone.theta == cone.mu;
         });
}

void write_fclib_view(hdf5::Writer& writer, const Problem& problem, FclibArrays arrays) {
  View(writer, problem, arrays).write();
}

}  // namespace conebench::problems
