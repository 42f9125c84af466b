#include <algorithm>
#include <cmath>
#include <cstring>

#include "problems/error.h"
#include "problems/hdf5_file.h"

namespace conebench::problems::hdf5 {
namespace {

// Deflate packs at most 1032 bytes into one; more than that is a damaged extent.
constexpr std::uintmax_t kLargestPacking = 1100;
constexpr std::size_t kLongestText = 1 << 16;

Handle open_file(const std::filesystem::path& path, const std::string& subject) {
  silence_messages();
  require(std::filesystem::is_regular_file(path), subject, "no such file");
  const Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  H5Pset_file_locking(access.get(), false, true);  // read-only network file systems have no locks
  Handle file(H5Fopen(path.c_str(), H5F_ACC_RDONLY, access.get()), H5Fclose);
  require(static_cast<bool>(file), subject, "cannot be opened as HDF5, expected a whole HDF5 file");
  return file;
}

const char* class_name(H5T_class_t type) {
  switch (type) {
    case H5T_FLOAT:
      return "floating-point numbers";
    case H5T_INTEGER:
      return "integers";
    case H5T_STRING:
      return "text";
    default:
      return "another type";
  }
}

std::string trimmed(std::string text) {
  text.resize(std::strlen(text.c_str()));
  return text;
}

// `read` fills a buffer for the given memory type; shared by datasets and attributes.
template <class Read>
std::string read_text(const Handle& type, const Read& read) {
  if (!type || H5Tget_class(type.get()) != H5T_STRING) return {};
  const Handle memory(H5Tcopy(H5T_C_S1), H5Tclose);
  H5Tset_cset(memory.get(), H5Tget_cset(type.get()));
  if (H5Tis_variable_str(type.get()) > 0) {
    H5Tset_size(memory.get(), H5T_VARIABLE);
    char* pointer = nullptr;
    if (read(memory.get(), &pointer) < 0 || pointer == nullptr) return {};
    const std::string text(pointer, strnlen(pointer, kLongestText));
    H5free_memory(pointer);
    return text;
  }
  const std::size_t size = H5Tget_size(type.get());
  if (size == 0 || size > kLongestText) return {};
  H5Tset_size(memory.get(), size + 1);  // room for the end that padded strings lack
  std::string text(size + 1, '\0');
  if (read(memory.get(), text.data()) < 0) return {};
  return trimmed(std::move(text));
}

}  // namespace

Lock lock_library() {
  static std::recursive_mutex mutex;
  return Lock(mutex);
}

void silence_messages() { H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr); }

Reader::Reader(const std::filesystem::path& path)
    : subject_(path.string()), file_(open_file(path, subject_)) {
  file_bytes_ = std::filesystem::file_size(path);
}

void Reader::fail(const std::string& object, const std::string& detail) const {
  throw InputError(subject_, object + " " + detail);
}

bool Reader::has(const std::string& object) const {
  for (std::size_t end = object.find('/', 1);; end = object.find('/', end + 1)) {
    const std::string part = object.substr(0, end);
    if (H5Lexists(file_.get(), part.c_str(), H5P_DEFAULT) <= 0) return false;
    if (H5Oexists_by_name(file_.get(), part.c_str(), H5P_DEFAULT) <= 0) return false;
    if (end == std::string::npos) return true;
  }
}

Handle Reader::open_dataset(const std::string& dataset) const {
  if (!has(dataset)) fail(dataset, "is missing");
  Handle handle(H5Dopen2(file_.get(), dataset.c_str(), H5P_DEFAULT), H5Dclose);
  if (!handle) fail(dataset, "cannot be opened, expected a dataset");
  return handle;
}

Reader::Shape Reader::shape_of(const std::string& dataset, const Handle& handle,
                               H5T_class_t wanted) const {
  const Handle type(H5Dget_type(handle.get()), H5Tclose);
  const H5T_class_t found = type ? H5Tget_class(type.get()) : H5T_NO_CLASS;
  if (found != wanted) {
    fail(dataset, std::string("holds ") + class_name(found) + ", expected " + class_name(wanted));
  }
  const Handle space(H5Dget_space(handle.get()), H5Sclose);
  const int rank = space ? H5Sget_simple_extent_ndims(space.get()) : -1;
  if (rank < 0 || rank > 2) fail(dataset, "has no readable extent, expected a vector or a table");
  Shape shape;
  shape.extent.resize(static_cast<std::size_t>(rank));
  shape.count = 1;
  if (rank > 0) H5Sget_simple_extent_dims(space.get(), shape.extent.data(), nullptr);
  const std::uintmax_t limit = kLargestPacking * file_bytes_ / 4;
  for (const hsize_t extent : shape.extent) {
    if (extent != 0 && shape.count > limit / extent) {
      fail(dataset,
           "claims more entries than a file of " + std::to_string(file_bytes_) + " bytes can hold");
    }
    shape.count *= extent;
  }
  if (shape.count > INT32_MAX) fail(dataset, "has more than 2^31 entries");
  return shape;
}

Eigen::VectorXd Reader::vector(const std::string& dataset) const {
  const Handle handle = open_dataset(dataset);
  const Shape shape = shape_of(dataset, handle, H5T_FLOAT);
  Eigen::VectorXd values(static_cast<Eigen::Index>(shape.count));
  if (shape.count > 0 &&
      H5Dread(handle.get(), H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()) < 0) {
    fail(dataset, "cannot be read, the file is damaged");
  }
  return values;
}

Eigen::VectorXd Reader::vector(const std::string& dataset, Eigen::Index size) const {
  Eigen::VectorXd values = vector(dataset);
  if (values.size() != size) {
    fail(dataset,
         "has " + std::to_string(values.size()) + " entries, expected " + std::to_string(size));
  }
  for (Eigen::Index i = 0; i < size; ++i) {
    if (!std::isfinite(values(i))) fail_not_finite(dataset, i, values(i));
  }
  return values;
}

void Reader::fail_not_finite(const std::string& dataset, Eigen::Index i, double value) const {
  throw InputError(subject_, dataset + "[" + std::to_string(i) + "] is " + std::to_string(value) +
                                 ", expected a finite number");
}

void Reader::require_table(const std::string& dataset, const Shape& shape, Eigen::Index rows,
                           Eigen::Index cols) const {
  const auto wanted_rows = static_cast<hsize_t>(rows), wanted_cols = static_cast<hsize_t>(cols);
  if (shape.extent == std::vector<hsize_t>{wanted_rows, wanted_cols}) return;
  fail(dataset,
       "has another shape, expected " + std::to_string(rows) + " x " + std::to_string(cols));
}

Geometry::Table Reader::table(const std::string& dataset, Eigen::Index rows,
                              Eigen::Index cols) const {
  const Handle handle = open_dataset(dataset);
  require_table(dataset, shape_of(dataset, handle, H5T_FLOAT), rows, cols);
  Geometry::Table values(rows, cols);
  if (values.size() > 0 &&
      H5Dread(handle.get(), H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()) < 0) {
    fail(dataset, "cannot be read, the file is damaged");
  }
  for (Eigen::Index i = 0; i < values.size(); ++i) {
    if (!std::isfinite(values.data()[i])) fail_not_finite(dataset, i, values.data()[i]);
  }
  return values;
}

std::vector<int> Reader::integers(const std::string& dataset) const {
  const Handle handle = open_dataset(dataset);
  const Shape shape = shape_of(dataset, handle, H5T_INTEGER);
  std::vector<int> values(shape.count);
  if (!values.empty() &&
      H5Dread(handle.get(), H5T_NATIVE_INT, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()) < 0) {
    fail(dataset, "cannot be read, the file is damaged");
  }
  return values;
}

std::vector<int> Reader::integers(const std::string& dataset, Eigen::Index rows,
                                  Eigen::Index cols) const {
  const Handle handle = open_dataset(dataset);
  require_table(dataset, shape_of(dataset, handle, H5T_INTEGER), rows, cols);
  return integers(dataset);
}

int Reader::integer(const std::string& dataset) const {
  const std::vector<int> values = integers(dataset);
  if (values.size() != 1) fail(dataset, "has another size, expected one integer");
  return values.front();
}

bool Reader::has_attribute(const std::string& object, const std::string& attribute) const {
  return H5Aexists_by_name(file_.get(), object.c_str(), attribute.c_str(), H5P_DEFAULT) > 0;
}

Handle Reader::open_attribute(const std::string& object, const std::string& attribute) const {
  if (!has_attribute(object, attribute)) fail(object, "lacks the attribute " + attribute);
  Handle handle(
      H5Aopen_by_name(file_.get(), object.c_str(), attribute.c_str(), H5P_DEFAULT, H5P_DEFAULT),
      H5Aclose);
  if (!handle) fail(object, "has an unreadable attribute " + attribute);
  return handle;
}

std::string Reader::text(const std::string& object, const std::string& attribute) const {
  const Handle handle = open_attribute(object, attribute);
  const Handle type(H5Aget_type(handle.get()), H5Tclose);
  const Handle space(H5Aget_space(handle.get()), H5Sclose);
  if (!type || H5Tget_class(type.get()) != H5T_STRING || !space ||
      H5Sget_simple_extent_npoints(space.get()) != 1) {
    fail(object, "has an attribute " + attribute + " of another type, expected one text");
  }
  return read_text(type,
                   [&](hid_t memory, void* out) { return H5Aread(handle.get(), memory, out); });
}

double Reader::number(const std::string& object, const std::string& attribute) const {
  const Handle handle = open_attribute(object, attribute);
  const Handle type(H5Aget_type(handle.get()), H5Tclose);
  const Handle space(H5Aget_space(handle.get()), H5Sclose);
  const H5T_class_t found = type ? H5Tget_class(type.get()) : H5T_NO_CLASS;
  double value = 0.0;
  if ((found != H5T_FLOAT && found != H5T_INTEGER) || !space ||
      H5Sget_simple_extent_npoints(space.get()) != 1 ||
      H5Aread(handle.get(), H5T_NATIVE_DOUBLE, &value) < 0 || !std::isfinite(value)) {
    fail(object, "has an unreadable attribute " + attribute + ", expected one finite number");
  }
  return value;
}

std::vector<std::int64_t> Reader::whole_numbers(const std::string& object,
                                                const std::string& attribute,
                                                std::size_t size) const {
  const Handle handle = open_attribute(object, attribute);
  const Handle type(H5Aget_type(handle.get()), H5Tclose);
  const Handle space(H5Aget_space(handle.get()), H5Sclose);
  std::vector<std::int64_t> values(size);
  if (!type || H5Tget_class(type.get()) != H5T_INTEGER || !space ||
      H5Sget_simple_extent_npoints(space.get()) != static_cast<hssize_t>(size) ||
      H5Aread(handle.get(), H5T_NATIVE_INT64, values.data()) < 0) {
    fail(object, "has an unreadable attribute " + attribute + ", expected " + std::to_string(size) +
                     " integer(s)");
  }
  return values;
}

std::int64_t Reader::whole_number(const std::string& object, const std::string& attribute) const {
  return whole_numbers(object, attribute, 1).front();
}

std::string Reader::text_dataset(const std::string& dataset) const {
  if (!has(dataset)) return {};
  const Handle handle = open_dataset(dataset);
  const Handle type(H5Dget_type(handle.get()), H5Tclose);
  const Handle space(H5Dget_space(handle.get()), H5Sclose);
  if (!space || H5Sget_simple_extent_npoints(space.get()) != 1) return {};
  return read_text(type, [&](hid_t memory, void* out) {
    return H5Dread(handle.get(), memory, H5S_ALL, H5S_ALL, H5P_DEFAULT, out);
  });
}

}  // namespace conebench::problems::hdf5
