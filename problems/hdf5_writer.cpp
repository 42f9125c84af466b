#include <algorithm>
#include <array>
#include <cstdlib>
#include <cstring>

#include "problems/atomic_file.h"
#include "problems/error.h"
#include "problems/hdf5_file.h"

namespace conebench::problems::hdf5 {
namespace {

constexpr hsize_t kLargestChunk = 1 << 16;    // entries of the first dimension
constexpr std::size_t kMemoryStep = 1 << 20;  // bytes
constexpr unsigned kCompressionLevel = 2;     // half the time of 6, 3 % more bytes

// HDF5's memory for the file, through its callbacks: kept when HDF5 closes the file, because only
// then is it whole. (H5Fget_file_image clears a flag under the checksum of the 1.10 layout.)
void* grow(void* old, std::size_t size, H5FD_file_image_op_t, void* image) {
  void* grown = std::realloc(old, size);
  if (grown == nullptr) return nullptr;
  static_cast<Writer::Image*>(image)->bytes = grown;
  static_cast<Writer::Image*>(image)->capacity = size;
  return grown;
}

void* allocate(std::size_t size, H5FD_file_image_op_t operation, void* image) {
  return grow(nullptr, size, operation, image);
}

herr_t keep(void*, H5FD_file_image_op_t, void*) { return 0; }
void* share(void* image) { return image; }
herr_t leave(void*) { return 0; }

Handle new_file(Writer::Image& image) {
  silence_messages();
  const Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  H5FD_file_image_callbacks_t callbacks{allocate, nullptr, grow, keep, share, leave, &image};
  H5Pset_file_image_callbacks(access.get(), &callbacks);
  H5Pset_fapl_core(access.get(), kMemoryStep, false);
  // The 1.10 layout carries checksums over everything that is not data.
  H5Pset_libver_bounds(access.get(), H5F_LIBVER_V110, H5F_LIBVER_V110);
  const Handle creation(H5Pcreate(H5P_FILE_CREATE), H5Pclose);
  H5Pset_obj_track_times(creation.get(), false);
  return {H5Fcreate("in memory", H5F_ACC_TRUNC, creation.get(), access.get()), H5Fclose};
}

Handle text_type(std::string_view text) {
  Handle type(H5Tcopy(H5T_C_S1), H5Tclose);
  H5Tset_size(type.get(), text.size() + 1);
  H5Tset_cset(type.get(), H5T_CSET_UTF8);
  return type;
}

Handle missing_folders() {
  Handle properties(H5Pcreate(H5P_LINK_CREATE), H5Pclose);
  H5Pset_create_intermediate_group(properties.get(), 1);
  return properties;
}

}  // namespace

Writer::Image::~Image() { std::free(bytes); }

Writer::Writer(const std::filesystem::path& path)
    : path_(path), image_(std::make_unique<Image>()), file_(new_file(*image_)) {
  require_ok(static_cast<bool>(file_), "/");
}

void Writer::require_ok(bool ok, const std::string& object) const {
  if (!ok) throw OutputError(path_.string(), "HDF5 cannot write " + object);
}

void Writer::group(const std::string& name) {
  const Handle creation(H5Pcreate(H5P_GROUP_CREATE), H5Pclose);
  H5Pset_obj_track_times(creation.get(), false);
  const Handle links = missing_folders();
  const Handle created(
      H5Gcreate2(file_.get(), name.c_str(), links.get(), creation.get(), H5P_DEFAULT), H5Gclose);
  require_ok(static_cast<bool>(created), name);
}

void Writer::write(const std::string& dataset, std::span<const hsize_t> extent, hid_t stored,
                   hid_t in_memory, const void* values) {
  const int rank = static_cast<int>(extent.size());
  const Handle space(H5Screate_simple(rank, extent.data(), nullptr), H5Sclose);
  const Handle creation(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
  H5Pset_obj_track_times(creation.get(), false);
  const bool empty = std::find(extent.begin(), extent.end(), hsize_t{0}) != extent.end();
  if (!empty) {
    std::vector<hsize_t> chunk(extent.begin(), extent.end());
    chunk[0] = std::min(chunk[0], kLargestChunk);
    H5Pset_chunk(creation.get(), rank, chunk.data());
    H5Pset_shuffle(creation.get());
    H5Pset_deflate(creation.get(), kCompressionLevel);
  }
  const Handle created(H5Dcreate2(file_.get(), dataset.c_str(), stored, space.get(), H5P_DEFAULT,
                                  creation.get(), H5P_DEFAULT),
                       H5Dclose);
  require_ok(static_cast<bool>(created), dataset);
  if (empty) return;
  require_ok(H5Dwrite(created.get(), in_memory, H5S_ALL, H5S_ALL, H5P_DEFAULT, values) >= 0,
             dataset);
}

void Writer::array(const std::string& dataset, std::span<const double> values) {
  const std::array<hsize_t, 1> extent{values.size()};
  write(dataset, extent, H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, values.data());
}

void Writer::array(const std::string& dataset, const Eigen::VectorXd& values) {
  array(dataset, std::span(values.data(), static_cast<std::size_t>(values.size())));
}

void Writer::array(const std::string& dataset, std::span<const int> values) {
  const std::array<hsize_t, 1> extent{values.size()};
  write(dataset, extent, H5T_STD_I32LE, H5T_NATIVE_INT, values.data());
}

void Writer::table(const std::string& dataset, const Geometry::Table& values) {
  const std::array<hsize_t, 2> extent{static_cast<hsize_t>(values.rows()),
                                      static_cast<hsize_t>(values.cols())};
  write(dataset, extent, H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, values.data());
}

void Writer::table(const std::string& dataset, const Geometry::Pairs& values) {
  const std::array<hsize_t, 2> extent{static_cast<hsize_t>(values.rows()), 2};
  write(dataset, extent, H5T_STD_I32LE, H5T_NATIVE_INT, values.data());
}

void Writer::scalar(const std::string& dataset, int value) {
  const hsize_t one = 1;
  const Handle space(H5Screate_simple(1, &one, nullptr), H5Sclose);
  const Handle creation(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
  H5Pset_obj_track_times(creation.get(), false);
  const Handle created(H5Dcreate2(file_.get(), dataset.c_str(), H5T_STD_I32LE, space.get(),
                                  H5P_DEFAULT, creation.get(), H5P_DEFAULT),
                       H5Dclose);
  require_ok(created && H5Dwrite(created.get(), H5T_NATIVE_INT, H5S_ALL, H5S_ALL, H5P_DEFAULT,
                                 &value) >= 0,
             dataset);
}

void Writer::scalar(const std::string& dataset, std::string_view text) {
  const Handle type = text_type(text);
  const Handle space(H5Screate(H5S_SCALAR), H5Sclose);
  const Handle creation(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
  H5Pset_obj_track_times(creation.get(), false);
  const Handle created(H5Dcreate2(file_.get(), dataset.c_str(), type.get(), space.get(),
                                  H5P_DEFAULT, creation.get(), H5P_DEFAULT),
                       H5Dclose);
  const std::string terminated(text);
  require_ok(created && H5Dwrite(created.get(), type.get(), H5S_ALL, H5S_ALL, H5P_DEFAULT,
                                 terminated.c_str()) >= 0,
             dataset);
}

void Writer::link(const std::string& existing, const std::string& name) {
  require_ok(H5Lcreate_hard(file_.get(), existing.c_str(), file_.get(), name.c_str(), H5P_DEFAULT,
                            H5P_DEFAULT) >= 0,
             name);
}

void Writer::write_attribute(const std::string& object, const std::string& name,
                             const Handle& space, hid_t stored, hid_t in_memory,
                             const void* values) {
  const Handle created(H5Acreate_by_name(file_.get(), object.c_str(), name.c_str(), stored,
                                         space.get(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT),
                       H5Aclose);
  require_ok(created && H5Awrite(created.get(), in_memory, values) >= 0, object + "@" + name);
}

void Writer::attribute(const std::string& object, const std::string& name, std::string_view text) {
  const Handle type = text_type(text);
  const std::string terminated(text);
  write_attribute(object, name, {H5Screate(H5S_SCALAR), H5Sclose}, type.get(), type.get(),
                  terminated.c_str());
}

void Writer::attribute(const std::string& object, const std::string& name, double value) {
  write_attribute(object, name, {H5Screate(H5S_SCALAR), H5Sclose}, H5T_IEEE_F64LE,
                  H5T_NATIVE_DOUBLE, &value);
}

void Writer::attribute(const std::string& object, const std::string& name, std::int64_t value) {
  write_attribute(object, name, {H5Screate(H5S_SCALAR), H5Sclose}, H5T_STD_I64LE, H5T_NATIVE_INT64,
                  &value);
}

void Writer::attribute(const std::string& object, const std::string& name,
                       std::span<const std::int64_t> values) {
  const hsize_t size = values.size();
  write_attribute(object, name, {H5Screate_simple(1, &size, nullptr), H5Sclose}, H5T_STD_I64LE,
                  H5T_NATIVE_INT64, values.data());
}

// Closing gives back space that was reserved, so the true size is the end-of-file address in the
// superblock: 8 bytes at 28 in versions 2 and 3 of the format specification.
std::size_t Writer::Image::size() const {
  constexpr std::size_t kVersionAt = 8, kEndAt = 28;
  std::uint64_t end = 0;
  if (capacity < kEndAt + sizeof end) return 0;
  const auto version = static_cast<const unsigned char*>(bytes)[kVersionAt];
  std::memcpy(&end, static_cast<const std::byte*>(bytes) + kEndAt, sizeof end);
  return (version == 2 || version == 3) && end <= capacity ? end : 0;
}

void Writer::save() {
  require_ok(H5Fflush(file_.get(), H5F_SCOPE_GLOBAL) >= 0 && file_.close() >= 0, "/");
  lock_.unlock();
  const std::size_t size = image_->size();
  require_ok(size > 0, "/");
  write_file_atomically(path_, {static_cast<const std::byte*>(image_->bytes), size});
}

void overwrite_attribute(const std::filesystem::path& path, const std::string& object,
                         const std::string& name, double value) {
  const Lock lock = lock_library();
  silence_messages();
  const Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  H5Pset_file_locking(access.get(), false, true);  // not every file system has locks
  Handle file(H5Fopen(path.c_str(), H5F_ACC_RDWR, access.get()), H5Fclose);
  Handle attribute(
      H5Aopen_by_name(file.get(), object.c_str(), name.c_str(), H5P_DEFAULT, H5P_DEFAULT),
      H5Aclose);
  const bool written = attribute && H5Awrite(attribute.get(), H5T_NATIVE_DOUBLE, &value) >= 0 &&
                       attribute.close() >= 0 && file.close() >= 0;
  if (!written) throw OutputError(path.string(), "HDF5 cannot write " + object + "@" + name);
}

}  // namespace conebench::problems::hdf5
