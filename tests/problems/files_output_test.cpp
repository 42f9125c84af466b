// Writing: all or nothing.

#include <sys/resource.h>
#include <unistd.h>

#include <csignal>

#include "problems/atomic_file.h"
#include "problems/collection.h"
#include "problems/error.h"
#include "problems/fclib.h"
#include "tests/problems/files_support.h"

namespace conebench::problems::test {
namespace {

using Output = Files;

// A disk that is full after `bytes`, as far as this process can tell.
class FullDisk {
 public:
  explicit FullDisk(rlim_t bytes) : handler_(std::signal(SIGXFSZ, SIG_IGN)) {
    getrlimit(RLIMIT_FSIZE, &before_);
    const rlimit limit{bytes, before_.rlim_max};
    setrlimit(RLIMIT_FSIZE, &limit);
  }
  FullDisk(const FullDisk&) = delete;
  FullDisk& operator=(const FullDisk&) = delete;
  ~FullDisk() {
    setrlimit(RLIMIT_FSIZE, &before_);
    std::signal(SIGXFSZ, handler_);
  }

 private:
  rlimit before_{};
  void (*handler_)(int);
};

ProblemFile sample() { return with_extras(sample_primal(coulomb_cones())); }

TEST_F(Output, IntoAFolderThatIsNotThereIsAnOutputError) {
  EXPECT_THROW(write_problem_file(at("none/p.h5"), sample()), OutputError);
  EXPECT_THROW(write_fclib_file(at("none/p.h5"), sample()), OutputError);
  EXPECT_THROW(write_solution_file(at("none/s.h5"), sample().problem, *sample().solution),
               OutputError);
  EXPECT_EQ(files_in(folder_), 0u);
}

TEST_F(Output, OntoAFolderIsAnOutputError) {
  std::filesystem::create_directory(at("p.h5"));
  EXPECT_THROW(write_problem_file(at("p.h5"), sample()), OutputError);
  EXPECT_EQ(files_in(folder_), 1u);
}

TEST_F(Output, IntoAnUnwritableFolderIsAnOutputError) {
  if (::geteuid() == 0) GTEST_SKIP() << "root can write everywhere";
  std::filesystem::permissions(
      folder_, std::filesystem::perms::owner_read | std::filesystem::perms::owner_exec);
  EXPECT_THROW(write_problem_file(at("p.h5"), sample()), OutputError);
  std::filesystem::permissions(folder_, std::filesystem::perms::owner_all);
  EXPECT_EQ(files_in(folder_), 0u);
}

TEST_F(Output, OnAFullDiskLeavesNothingBehind) {
  for (const rlim_t bytes : {rlim_t{0}, rlim_t{1}, rlim_t{1000}, rlim_t{5000}}) {
    const ProblemFile file = sample();
    const FullDisk disk(bytes);
    EXPECT_THROW(write_problem_file(at("p.h5"), file), OutputError);
    EXPECT_EQ(files_in(folder_), 0u);
  }
}

TEST_F(Output, OnAFullDiskKeepsTheOldFile) {
  const Problem old = sample_reduced(coulomb_cones());
  write_problem_file(at("p.h5"), {old, {}, {}, {}});
  {
    const ProblemFile file = sample();
    const FullDisk disk(1000);
    EXPECT_THROW(write_problem_file(at("p.h5"), file), OutputError);
  }
  EXPECT_EQ(content_sha256(read_problem_file(at("p.h5")).problem), content_sha256(old));
  EXPECT_EQ(files_in(folder_), 1u);
}

TEST_F(Output, ReplacesTheOldFile) {
  write_problem_file(at("p.h5"), {sample_reduced(coulomb_cones()), {}, {}, {}});
  write_problem_file(at("p.h5"), sample());
  EXPECT_TRUE(read_problem_file(at("p.h5")).problem.is_primal());
  EXPECT_EQ(files_in(folder_), 1u);
}

TEST_F(Output, IndexIsRebuiltAndReadBack) {
  write_problem_file(at("a.h5"), sample());
  std::filesystem::create_directory(at("deeper"));
  write_problem_file(at("deeper/b.h5"), {sample_reduced(mixed_cones()), {}, {}, {}});
  write_bytes(at("notes.txt"), "no problem");
  write_bytes(at("cut.h5"), bytes_of(at("a.h5")).substr(0, 3000));
  std::vector<std::string> rejected;
  Collection::index(folder_, rejected).write();
  ASSERT_EQ(rejected.size(), 1u);
  EXPECT_NE(rejected.front().find("cut.h5"), std::string::npos);

  const auto found = Collection::read(folder_);
  ASSERT_TRUE(found);
  ASSERT_EQ(found->entries().size(), 2u);
  const CollectionEntry& entry = found->entries().back();
  const Problem problem = read_problem_file(at("deeper/b.h5")).problem;
  EXPECT_EQ(entry.path, "deeper/b.h5");
  EXPECT_EQ(entry.content_sha256, content_sha256(problem));
  EXPECT_EQ(entry.metadata.step, 420);
  EXPECT_EQ(entry.features.cones_of_dim, problem.features().cones_of_dim);
  EXPECT_EQ(entry.features.mu, problem.features().mu);
  EXPECT_EQ(found->entries().front().solution_eta, 0.125);
}

TEST_F(Output, IndexForgetsAFileThatChanged) {
  write_problem_file(at("a.h5"), sample());
  std::vector<std::string> rejected;
  Collection::index(folder_, rejected).write();
  EXPECT_NE(Collection::read(folder_)->find_current(at("a.h5")), nullptr);
  write_problem_file(at("a.h5"), {sample_reduced(coulomb_cones()), {}, {}, {}});
  EXPECT_EQ(Collection::read(folder_)->find_current(at("a.h5")), nullptr);
}

TEST_F(Output, ADamagedIndexIsAnInputError) {
  EXPECT_FALSE(Collection::read(folder_));
  for (const char* text : {"", "{", "[]", "{\"format\": 3}",
                           "{\"format\": \"conebench-collection\", \"format_version\": 1, "
                           "\"problems\": [{\"path\": 4}]}"}) {
    write_bytes(at(Collection::kFileName), text);
    EXPECT_THROW(Collection::read(folder_), InputError) << text;
  }
}

}  // namespace
}  // namespace conebench::problems::test
