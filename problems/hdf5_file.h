#pragma once

// Internal to problems/: the only header that names HDF5 types.

#include <hdf5.h>

#include <cstdint>
#include <filesystem>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "problems/problem_file.h"

namespace conebench::problems::hdf5 {

/// Owns one HDF5 identifier. Negative means none.
class Handle {
 public:
  using Close = herr_t (*)(hid_t);

  Handle(hid_t id, Close closer) : id_(id), close_(closer) {}
  Handle(Handle&& other) noexcept : id_(std::exchange(other.id_, -1)), close_(other.close_) {}
  Handle& operator=(Handle&&) = delete;
  ~Handle() {
    if (id_ >= 0) close_(id_);
  }

  hid_t get() const { return id_; }
  /// Closes at once; negative when that fails.
  herr_t close() { return close_(std::exchange(id_, -1)); }
  explicit operator bool() const { return id_ >= 0; }

 private:
  hid_t id_;
  Close close_;
};

/// HDF5 may be built for one thread only, and then keeps state that all share: whoever uses it
/// holds this lock. The same thread may hold it more than once.
using Lock = std::unique_lock<std::recursive_mutex>;
Lock lock_library();

/// Silences HDF5's own messages in this thread: every failure becomes an exception of ours.
void silence_messages();

/// Reads a file of any origin, damaged ones included. Object names are absolute: "/problem/f".
/// Extents are checked against the size of the file before memory is taken for them.
/// Every failure is an InputError whose subject is the file and whose detail names the object,
/// what was found and what was expected.
class Reader {
 public:
  explicit Reader(const std::filesystem::path& path);

  const std::string& subject() const { return subject_; }

  /// True when the object is there: every folder on the way and no dangling link.
  bool has(const std::string& object) const;

  Eigen::VectorXd vector(const std::string& dataset) const;
  /// As above, with `size` finite numbers or an InputError.
  Eigen::VectorXd vector(const std::string& dataset, Eigen::Index size) const;
  Geometry::Table table(const std::string& dataset, Eigen::Index rows, Eigen::Index cols) const;
  /// Integers of any stored width; what does not fit is clamped to the ends of int.
  std::vector<int> integers(const std::string& dataset) const;
  /// The same for a table, row by row.
  std::vector<int> integers(const std::string& dataset, Eigen::Index rows, Eigen::Index cols) const;
  /// A dataset with one entry.
  int integer(const std::string& dataset) const;

  bool has_attribute(const std::string& object, const std::string& attribute) const;
  std::string text(const std::string& object, const std::string& attribute) const;
  double number(const std::string& object, const std::string& attribute) const;
  std::int64_t whole_number(const std::string& object, const std::string& attribute) const;
  std::vector<std::int64_t> whole_numbers(const std::string& object, const std::string& attribute,
                                          std::size_t size) const;

  /// A dataset that holds one string; empty when it is not there.
  std::string text_dataset(const std::string& dataset) const;

  [[noreturn]] void fail(const std::string& object, const std::string& detail) const;
  [[noreturn]] void fail_not_finite(const std::string& dataset, Eigen::Index i, double value) const;

 private:
  struct Shape {
    std::vector<hsize_t> extent;
    hsize_t count = 0;
  };

  Handle open_dataset(const std::string& dataset) const;
  Handle open_attribute(const std::string& object, const std::string& attribute) const;
  Shape shape_of(const std::string& dataset, const Handle& handle, H5T_class_t wanted) const;
  void require_table(const std::string& dataset, const Shape& shape, Eigen::Index rows,
                     Eigen::Index cols) const;

  Lock lock_ = lock_library();  // first: until the file is closed
  std::string subject_;
  std::uintmax_t file_bytes_ = 0;
  Handle file_;
};

/// Builds a file in memory, so that no failure of the disk happens inside HDF5, and saves it in
/// one step. One at a time in a process: others wait. Arrays are chunked, shuffled and deflated;
/// the bytes depend on the content alone. Objects' folders must exist; names are absolute. Throws
/// OutputError.
class Writer {
 public:
  /// The memory that HDF5 writes to.
  struct Image {
    Image() = default;
    Image(const Image&) = delete;
    Image& operator=(const Image&) = delete;
    ~Image();

    /// Bytes of the finished file, once HDF5 has closed it; 0 when they make no file.
    std::size_t size() const;

    void* bytes = nullptr;
    std::size_t capacity = 0;
  };

  explicit Writer(const std::filesystem::path& path);

  void group(const std::string& name);
  void array(const std::string& dataset, std::span<const double> values);
  void array(const std::string& dataset, const Eigen::VectorXd& values);
  void array(const std::string& dataset, std::span<const int> values);
  void table(const std::string& dataset, const Geometry::Table& values);
  void table(const std::string& dataset, const Geometry::Pairs& values);
  /// One int, or one string, in a dataset: FCLIB's way of storing scalars.
  void scalar(const std::string& dataset, int value);
  void scalar(const std::string& dataset, std::string_view text);
  /// A second name for the same object.
  void link(const std::string& existing, const std::string& name);

  void attribute(const std::string& object, const std::string& name, std::string_view text);
  void attribute(const std::string& object, const std::string& name, double value);
  void attribute(const std::string& object, const std::string& name, std::int64_t value);
  void attribute(const std::string& object, const std::string& name,
                 std::span<const std::int64_t> values);

  /// Writes the file to its path: all of it, or nothing. Call once, last.
  void save();

 private:
  void write(const std::string& dataset, std::span<const hsize_t> extent, hid_t stored,
             hid_t in_memory, const void* values);
  void write_attribute(const std::string& object, const std::string& name, const Handle& space,
                       hid_t stored, hid_t in_memory, const void* values);
  void require_ok(bool ok, const std::string& object) const;

  Lock lock_ = lock_library();  // first: until the file is closed
  std::filesystem::path path_;
  std::unique_ptr<Image> image_;  // outlives file_, which writes into it
  Handle file_;
};

/// Another value for an attribute that is one double, in place. Throws OutputError.
void overwrite_attribute(const std::filesystem::path& path, const std::string& object,
                         const std::string& name, double value);

}  // namespace conebench::problems::hdf5
