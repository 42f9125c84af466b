// Damaged files load or are refused with InputError; they never crash, hang or exhaust memory.

#include <functional>
#include <limits>
#include <map>

#include "problems/error.h"
#include "problems/fclib.h"
#include "problems/load.h"
#include "tests/problems/files_edit.h"
#include "tests/problems/files_support.h"

#ifdef CONEBENCH_SANITIZED
// HDF5 1.10 itself forgets a small block when it refuses a damaged object header.
extern "C" const char* __lsan_default_suppressions();
extern "C" const char* __lsan_default_suppressions() { return "leak:libhdf5"; }
#endif

namespace conebench::problems::test {
namespace {

constexpr int kTruncations = 60;
constexpr int kFlips = 120;

// A local problem with two contacts, in Siconos' sparse-block storage.
constexpr const char* kDat =
    "3\n2\n1\n6\n6\n2\n2\n2\n3 6\n3 6\n3\n2\n0 1 2\n0 1\n"
    "0\n2 0 0 0 1 0 0 0 1\n1\n4 0 0 0 5 0.5 0 0.5 5\n"
    "-1 0.5 0 -1 0 0.25\n0.5 0.7\n";

class Damage : public Files {
 protected:
  Damage() {
    write_problem_file(at("primal"), with_extras(sample_primal(coulomb_cones())));
    write_problem_file(at("reduced"), with_extras(sample_reduced(mixed_cones())));
    write_fclib_file(at("fclib"), with_extras(sample_primal(coulomb_cones())));
    write_bytes(at("dat"), kDat);
    for (const char* name : {"primal", "reduced", "fclib", "dat"}) {
      bytes_[name] = bytes_of(at(name));
      hash_[name] = content_sha256(load_problem(at(name)).problem);
    }
  }

  // True when it loads. Anything but a problem or an InputError fails the test.
  bool loads(const std::string& bytes, const std::string& name, bool must_be_intact) {
    write_bytes(at("damaged"), bytes);
    try {
      const ProblemFile file = load_problem(at("damaged"));
      if (must_be_intact) {
        EXPECT_EQ(content_sha256(file.problem), hash_.at(name));
      }
      return true;
    } catch (const InputError& error) {
      EXPECT_EQ(error.subject(), at("damaged").string());
      return false;
    }
  }

  std::map<std::string, std::string> bytes_, hash_;
};

TEST_F(Damage, TruncatedFilesAreRefused) {
  for (const auto& [name, whole] : bytes_) {
    for (int k = 0; k < kTruncations; ++k) {
      const std::size_t size = whole.size() * static_cast<std::size_t>(k) / kTruncations;
      SCOPED_TRACE(name + " cut at " + std::to_string(size));
      EXPECT_FALSE(loads(whole.substr(0, size), name, true));
    }
  }
}

// Our own files are guarded by content_sha256: what loads is what was written.
TEST_F(Damage, FlippedBytesAreRefusedOrHarmless) {
  std::mt19937 random(7);
  for (const auto& [name, whole] : bytes_) {
    const bool guarded = name == "primal" || name == "reduced";
    for (int k = 0; k < kFlips; ++k) {
      std::string bytes = whole;
      for (int flips = 1 + k % 3; flips > 0; --flips) {
        bytes[random() % bytes.size()] ^= static_cast<char>(1u << (random() % 8));
      }
      SCOPED_TRACE(name + " flip " + std::to_string(k));
      loads(bytes, name, guarded);
    }
  }
}

TEST_F(Damage, ForeignFilesWithoutChecksumsSurviveFlips) {
  const std::filesystem::path file =
      std::filesystem::path(CONEBENCH_SHARED_DATA) / "siconos/sic_sph27_s0010_nc20.hdf5";
  if (!std::filesystem::exists(file)) GTEST_SKIP() << "the shared data is not there";
  const std::string whole = bytes_of(file);
  std::mt19937 random(11);
  for (int k = 0; k < kFlips; ++k) {
    std::string bytes = whole;
    // The last third is bulk data, where nothing structural can break.
    bytes[random() % (bytes.size() * 2 / 3)] ^= static_cast<char>(1u << (random() % 8));
    SCOPED_TRACE(k);
    loads(bytes, "", false);
  }
}

struct Fault {
  const char* what;
  const char* file;
  std::function<void(Edit&)> make;
  const char* says = "";
};

const std::vector<double> kThreeNumbers{1.0, 2.0, 3.0};
const std::vector<double> kNan(9, std::numeric_limits<double>::quiet_NaN());

std::vector<Fault> faults_of_content() {
  return {
      {"an unknown version", "primal",
       [](Edit& e) { e.put_attribute("/", "format_version", std::int64_t{2}); }},
      {"another format", "primal",
       [](Edit& e) { e.put_attribute("/", "format", std::string("something-else")); }},
      {"no format", "primal", [](Edit& e) { e.remove_attribute("/", "format"); }},
      {"another hash", "primal",
       [](Edit& e) { e.put_attribute("/", "content_sha256", std::string(64, '0')); }},
      {"a hash of another type", "primal",
       [](Edit& e) { e.put_attribute("/", "content_sha256", std::int64_t{1}); }},
      {"another number", "primal", [](Edit& e) { e.put("/problem/w", std::vector<double>(9)); }},
      {"a NaN in w", "primal", [](Edit& e) { e.put("/problem/w", kNan); }, "w[0] is nan"},
      {"a NaN in mu", "primal",
       [](Edit& e) {
         e.put("/problem/mu", std::vector<double>{0.5, std::nan(""), 0.5});
       },
       "/problem/mu[1] is nan"},
      {"a NaN in the guess", "primal", [](Edit& e) { e.put("/guess/r", kNan); }},
      {"a NaN in the solution", "primal", [](Edit& e) { e.put("/solution/r", kNan); }},
      {"a negative mu", "primal",
       [](Edit& e) {
         e.put("/problem/mu", std::vector<double>{-1.0, 0.0, 0.0});
       }},
      {"theta above mu", "primal", [](Edit& e) { e.put("/problem/theta", kThreeNumbers); }},
      {"a rate_scale of text", "primal",
       [](Edit& e) { e.put_attribute("/", "rate_scale", std::string("large")); }},
  };
}

std::vector<Fault> faults_of_shape() {
  return {
      {"a short w", "primal", [](Edit& e) { e.put("/problem/w", kThreeNumbers); }},
      {"a long f", "primal", [](Edit& e) { e.put("/problem/f", std::vector<double>(40)); }},
      {"a short mu", "primal", [](Edit& e) { e.put("/problem/mu", std::vector<double>{0.5}); }},
      {"a short guess", "primal", [](Edit& e) { e.put("/guess/r", kThreeNumbers); }},
      {"a short solution", "primal", [](Edit& e) { e.put("/solution/r", kThreeNumbers); }},
      {"a dim of zero", "primal",
       [](Edit& e) {
         e.put("/problem/dim", std::vector<int>{0, 3, 6});
       }},
      {"a huge dim", "primal",
       [](Edit& e) {
         e.put("/problem/dim", std::vector<int>{2147483647, 3, 3});
       }},
      {"a geometry of another size", "primal",
       [](Edit& e) { e.put_table("/geometry/points", 4, 3); }},
      {"a body that is not there", "primal",
       [](Edit& e) { e.put("/geometry/body_radii", std::vector<double>{1.0}); }},
      {"a claim of 10^12 numbers", "primal",
       [](Edit& e) { e.claim("/problem/w", 1'000'000'000'000); }},
      {"a claim of 10^8 numbers", "fclib",
       [](Edit& e) { e.claim("/fclib_global/vectors/w", 100'000'000); }},
      {"a shape of one number", "reduced",
       [](Edit& e) { e.put_attribute("/problem/W", "shape", std::int64_t{1} << 40); }},
      {"a table for a vector", "reduced", [](Edit& e) { e.put_table("/problem/q", 3, 3); }},
      {"huge m and n", "fclib",
       [](Edit& e) {
         e.put("/fclib_global/H/m", std::vector<int>{2000000000});
         e.put("/fclib_global/H/n", std::vector<int>{2000000000});
       }},
      {"a spacedim of zero", "fclib",
       [](Edit& e) { e.put("/fclib_global/spacedim", std::vector<int>{0}); }},
      {"a spacedim of two", "fclib",
       [](Edit& e) { e.put("/fclib_global/spacedim", std::vector<int>{2}); }},
  };
}

std::vector<Fault> faults_of_structure() {
  return {
      {"no f", "primal", [](Edit& e) { e.remove("/problem/f"); }},
      {"no dim", "primal", [](Edit& e) { e.remove("/problem/dim"); }},
      {"no M", "primal", [](Edit& e) { e.remove("/problem/M"); }},
      {"no indptr", "primal", [](Edit& e) { e.remove("/problem/H/indptr"); }},
      {"a short indptr", "primal", [](Edit& e) { e.put("/problem/H/indptr", std::vector<int>(9)); },
       "/problem/H/indptr has 9 entries, expected 10 (rows + 1)"},
      {"a dense matrix", "primal", [](Edit& e) { e.put_table("/problem/H", 9, 12); },
       "/problem/H has no member data, expected a group of compressed rows"},
      {"a group for a dataset", "primal", [](Edit& e) { e.put_group("/problem/f"); }},
      {"a dangling link", "primal", [](Edit& e) { e.dangle("/problem/f"); }},
      {"integers for numbers", "primal",
       [](Edit& e) { e.put("/problem/f", std::vector<int>(12)); }},
      {"numbers for integers", "primal",
       [](Edit& e) {
         e.put("/problem/dim", std::vector<double>{3, 3, 3});
       }},
      {"an unknown matrix format", "primal",
       [](Edit& e) { e.put_attribute("/problem/M", "format", std::string("coo")); }},
      {"a dangling index", "reduced",
       [](Edit& e) { e.put("/problem/W/indices", std::vector<int>(60, 12)); }},
      {"positions that fall", "fclib",
       [](Edit& e) {
         e.put("/fclib_global/H/p", std::vector<int>{0, 9, 2, 9, 9, 9, 9, 9, 9, 9});
       }},
      {"a negative position", "fclib",
       [](Edit& e) { e.put("/fclib_global/H/p", std::vector<int>(10, -5)); }},
      {"positions beyond the arrays", "fclib",
       [](Edit& e) {
         std::vector<int> p(10, 100000);
         p[0] = 0;
         e.put("/fclib_global/H/p", p);
       }},
      {"a negative index", "fclib",
       [](Edit& e) { e.put("/fclib_global/H/i", std::vector<int>(108, -1)); }},
      {"an unknown storage", "fclib",
       [](Edit& e) { e.put("/fclib_global/H/nz", std::vector<int>{-7}); }},
      {"more triplets than entries", "fclib",
       [](Edit& e) { e.put("/fclib_global/H/nz", std::vector<int>{100000}); }},
      {"bilateral constraints", "fclib", [](Edit& e) { e.put_group("/fclib_global/G"); }},
  };
}

TEST_F(Damage, EveryFaultIsNamedAndRefused) {
  std::vector<Fault> faults = faults_of_content();
  for (const auto& more : {faults_of_shape(), faults_of_structure()}) {
    faults.insert(faults.end(), more.begin(), more.end());
  }
  for (const Fault& fault : faults) {
    SCOPED_TRACE(fault.what);
    write_bytes(at("damaged"), bytes_.at(fault.file));
    {
      Edit edit(at("damaged"));
      fault.make(edit);
    }
    try {
      load_problem(at("damaged"));
      ADD_FAILURE() << "was accepted";
    } catch (const InputError& error) {
      EXPECT_EQ(error.subject(), at("damaged").string());
      EXPECT_GT(std::string(error.what()).size(), error.subject().size() + 10);
      EXPECT_NE(std::string(error.what()).find(fault.says), std::string::npos) << error.what();
    }
  }
}

TEST_F(Damage, AsymmetricWIsRefusedByTheNameOfTheFile) {
  write_bytes(at("w.dat"), "2\n1\n0\n2\n2\n2 2\n1 0 0.5 1\n0 0\n0.5\n");
  try {
    load_problem(at("w.dat"));
    FAIL() << "was accepted";
  } catch (const InputError& error) {
    EXPECT_EQ(error.subject(), at("w.dat").string());
    EXPECT_NE(std::string(error.what()).find("symmetric"), std::string::npos) << error.what();
  }
}

TEST_F(Damage, GarbledTextNamesItsLine) {
  std::string text = kDat;
  text.replace(text.find("0.25"), 4, "nan!");
  write_bytes(at("damaged"), text);
  try {
    load_problem(at("damaged"));
    FAIL() << "was accepted";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("line 19"), std::string::npos) << error.what();
  }
  EXPECT_FALSE(loads(std::string(kDat) + "1\nmore\n", "dat", true));
  EXPECT_TRUE(loads(std::string(kDat) + "1\n", "dat", true));
}

TEST_F(Damage, ClaimsOfHugeTextMatricesAreRefusedAtOnce) {
  for (const char* text :
       {"3\n100000000\n1\n300000000\n300000000\n1\n", "3\n1\n0\n3\n3\n2000000000 3\n",
        "3\n1\n0\n2000000000\n2000000000\n2000000000 2000000000\n",
        "3\n1\n2\n3\n3\n2\nCSparse V\n3-by-3, nzmax: 9 nnz: 2000000000, 1\n"}) {
    EXPECT_FALSE(loads(text, "", false));
  }
}

}  // namespace
}  // namespace conebench::problems::test
