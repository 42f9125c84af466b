#pragma once

#include <hdf5.h>

#include <filesystem>
#include <string>
#include <vector>

namespace conebench::problems::test {

/// Changes an HDF5 file in place, as a program with other ideas of the format would.
class Edit {
 public:
  explicit Edit(const std::filesystem::path& path)
      : file_(H5Fopen(path.c_str(), H5F_ACC_RDWR, H5P_DEFAULT)) {}
  Edit(const Edit&) = delete;
  Edit& operator=(const Edit&) = delete;
  ~Edit() { H5Fclose(file_); }

  void remove(const std::string& name) { H5Ldelete(file_, name.c_str(), H5P_DEFAULT); }

  void put(const std::string& name, const std::vector<double>& values) {
    write(name, {values.size()}, H5T_NATIVE_DOUBLE, values.data());
  }
  void put(const std::string& name, const std::vector<int>& values) {
    write(name, {values.size()}, H5T_NATIVE_INT, values.data());
  }
  void put_table(const std::string& name, hsize_t rows, hsize_t cols) {
    write(name, {rows, cols}, H5T_NATIVE_DOUBLE, std::vector<double>(rows * cols).data());
  }
  /// Claims `size` numbers that were never written.
  void claim(const std::string& name, hsize_t size) {
    write(name, {size}, H5T_NATIVE_DOUBLE, nullptr);
  }
  void put_group(const std::string& name) {
    remove(name);
    H5Gclose(H5Gcreate2(file_, name.c_str(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT));
  }
  void dangle(const std::string& name) {
    remove(name);
    H5Lcreate_soft("/nowhere", file_, name.c_str(), H5P_DEFAULT, H5P_DEFAULT);
  }

  void put_attribute(const std::string& object, const std::string& name, std::int64_t value) {
    put_attribute(object, name, H5T_NATIVE_INT64, &value);
  }
  void put_attribute(const std::string& object, const std::string& name, const std::string& text) {
    const hid_t type = H5Tcopy(H5T_C_S1);
    H5Tset_size(type, text.size() + 1);
    put_attribute(object, name, type, text.c_str());
    H5Tclose(type);
  }
  void remove_attribute(const std::string& object, const std::string& name) {
    H5Adelete_by_name(file_, object.c_str(), name.c_str(), H5P_DEFAULT);
  }

 private:
  void write(const std::string& name, const std::vector<hsize_t>& extent, hid_t type,
             const void* values) {
    remove(name);
    const hid_t space = H5Screate_simple(static_cast<int>(extent.size()), extent.data(), nullptr);
    const hid_t set =
        H5Dcreate2(file_, name.c_str(), type, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
    if (values != nullptr) H5Dwrite(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values);
    H5Dclose(set);
    H5Sclose(space);
  }

  void put_attribute(const std::string& object, const std::string& name, hid_t type,
                     const void* value) {
    remove_attribute(object, name);
    const hid_t space = H5Screate(H5S_SCALAR);
    const hid_t created = H5Acreate_by_name(file_, object.c_str(), name.c_str(), type, space,
                                            H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
    H5Awrite(created, type, value);
    H5Aclose(created);
    H5Sclose(space);
  }

  hid_t file_;
};

}  // namespace conebench::problems::test
