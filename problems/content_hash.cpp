// content_sha256(): the numbers of a problem, whatever file they came from.

#include <openssl/evp.h>

#include <array>
#include <bit>
#include <memory>
#include <stdexcept>

#include "problems/problem_file.h"

namespace conebench::problems {
namespace {

static_assert(std::endian::native == std::endian::little, "the hash is over little-endian numbers");

class Sha256 {
 public:
  Sha256() : context_(EVP_MD_CTX_new(), EVP_MD_CTX_free) {
    if (!context_ || EVP_DigestInit_ex(context_.get(), EVP_sha256(), nullptr) != 1) {
      throw std::runtime_error("OpenSSL has no SHA-256");
    }
  }

  void add(std::string_view text) { update(text.data(), text.size()); }
  void add(std::int64_t value) { update(&value, sizeof value); }

  void add(double value) {
    value += 0.0;  // -0.0 and 0.0 are the same number
    update(&value, sizeof value);
  }

  void add(const Eigen::VectorXd& values) {
    add(static_cast<std::int64_t>(values.size()));
    for (const double value : values) add(value);
  }

  // Row by row: the number of entries, then (column, value). Rows are sorted, without zeros.
  void add(const SparseMatrix& matrix) {
    add(static_cast<std::int64_t>(matrix.rows()));
    add(static_cast<std::int64_t>(matrix.cols()));
    for (int row = 0; row < matrix.outerSize(); ++row) {
      add(static_cast<std::int64_t>(matrix.innerVector(row).nonZeros()));
      for (SparseMatrix::InnerIterator it(matrix, row); it; ++it) {
        add(static_cast<std::int64_t>(it.col()));
        add(it.value());
      }
    }
  }

  std::string hex() {
    std::array<unsigned char, EVP_MAX_MD_SIZE> digest{};
    unsigned size = 0;
    EVP_DigestFinal_ex(context_.get(), digest.data(), &size);
    std::string text;
    for (unsigned k = 0; k < size; ++k) {
      constexpr std::string_view kDigits = "0123456789abcdef";
      text += kDigits[digest[k] >> 4];
      text += kDigits[digest[k] & 15];
    }
    return text;
  }

 private:
  void update(const void* data, std::size_t size) { EVP_DigestUpdate(context_.get(), data, size); }

  std::unique_ptr<EVP_MD_CTX, decltype(&EVP_MD_CTX_free)> context_;
};

}  // namespace

std::string content_sha256(const Problem& problem) {
  Sha256 hash;
  hash.add(problem.is_primal() ? std::string_view("primal") : std::string_view("reduced"));
  hash.add(static_cast<std::int64_t>(problem.cone_count()));
  for (const Cone& cone : problem.cones()) {
    hash.add(static_cast<std::int64_t>(cone.dim));
    hash.add(cone.mu);
    hash.add(cone.kappa);
    hash.add(cone.theta);
  }
  if (problem.is_primal()) {  // the constructor made the matrices canonical
    hash.add(problem.f());
    hash.add(problem.w());
    hash.add(problem.M());
    hash.add(problem.H());
  } else {
    hash.add(problem.q());
    hash.add(problem.W());
  }
  if (!problem.rate_scale_is_of_data()) {
    hash.add(std::string_view("rate_scale"));
    hash.add(problem.rate_scale());
  }
  return hash.hex();
}

}  // namespace conebench::problems
