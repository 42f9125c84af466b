#include "problems/siconos_dat.h"

#include <array>
#include <charconv>

#include "problems/error.h"
#include "problems/file_parts.h"
#include "problems/siconos_matrix.h"
#include "problems/text_reader.h"

namespace conebench::problems {
namespace {

constexpr int kLargestDim = 6;
constexpr int kLargestContacts = 100'000'000;

std::vector<Cone> read_cones(TextReader& in, int dim, int contacts) {
  std::vector<Cone> cones;
  for (const double mu : in.numbers("mu", contacts)) cones.push_back(Cone::coulomb(dim, mu));
  return cones;
}

// Old versions of Siconos end the file with one flag.
void expect_end(TextReader& in) {
  if (in.at_end()) return;
  in.integer("the end of the file or one flag", 0, 1);
  if (!in.at_end()) in.fail("text after the end of the problem");
}

Problem read_local(TextReader& in, SparseMatrix W, int dim, int contacts, Metadata metadata) {
  if (W.rows() != W.cols()) in.fail("W is not square");
  Eigen::VectorXd q = in.numbers("q", static_cast<int>(W.rows()));
  std::vector<Cone> cones = read_cones(in, dim, contacts);
  expect_end(in);
  return {ReducedData{std::move(W), std::move(q)}, std::move(cones), std::move(metadata)};
}

Problem read_global(TextReader& in, SparseMatrix M, int dim, int contacts, Metadata metadata) {
  if (M.rows() != M.cols()) in.fail("M is not square");
  const SparseMatrix H = read_siconos_matrix(in, "H");
  if (H.rows() != M.rows() || H.cols() != dim * contacts) {
    in.fail("H is " + std::to_string(H.rows()) + " x " + std::to_string(H.cols()) + ", expected " +
            std::to_string(M.rows()) + " x " + std::to_string(dim * contacts));
  }
  Eigen::VectorXd f = in.numbers("q", static_cast<int>(M.rows()));
  Eigen::VectorXd w = in.numbers("b", static_cast<int>(H.cols()));
  std::vector<Cone> cones = read_cones(in, dim, contacts);
  expect_end(in);
  return {PrimalData{std::move(M), H.transpose(), std::move(f), std::move(w)}, std::move(cones),
          std::move(metadata)};
}

Problem read_problem(TextReader& in, Metadata metadata) {
  const int dim = in.integer("the dimension", 1, kLargestDim);
  const int contacts = in.integer("the number of contacts", 0, kLargestContacts);
  in.require_room("contacts", contacts);
  SparseMatrix first = read_siconos_matrix(in, "the first matrix");
  return first.rows() == dim * contacts
             ? read_local(in, std::move(first), dim, contacts, std::move(metadata))
             : read_global(in, std::move(first), dim, contacts, std::move(metadata));
}

}  // namespace

ProblemFile read_siconos_dat(const std::filesystem::path& path) {
  TextReader in(path);
  Metadata metadata;
  metadata.name = path.stem().string();
  metadata.engine = "siconos";
  metadata.origin = path.filename().string();
  return {make_problem(in.subject(), [&] { return read_problem(in, std::move(metadata)); }),
          {},
          {},
          {}};
}

bool looks_like_siconos_dat(std::string_view text) {
  constexpr std::array<int, 3> kHighest{kLargestDim, kLargestContacts, 2};
  for (const int highest : kHighest) {
    const std::size_t first = text.find_first_not_of(" \t\r\n");
    if (first == std::string_view::npos) return false;
    text.remove_prefix(first);
    int value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || value < 0 || value > highest) return false;
    text.remove_prefix(static_cast<std::size_t>(end - text.data()));
    if (!text.empty() && text.find_first_of(" \t\r\n") != 0) return false;
  }
  return true;
}

}  // namespace conebench::problems
