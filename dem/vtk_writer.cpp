#include "dem/vtk_writer.h"

#include <fmt/format.h>

#include <iterator>

#include "problems/engine/text_file.h"

namespace conebench::dem {
namespace {

// Poly data: points first, one vertex cell a point, then any number of point arrays.
class PolyData {
 public:
  explicit PolyData(int points) : points_(points) {
    print(
        "<?xml version=\"1.0\"?>\n"
        "<VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"LittleEndian\">\n<PolyData>\n"
        "<Piece NumberOfPoints=\"{0}\" NumberOfVerts=\"{0}\" NumberOfLines=\"0\" "
        "NumberOfStrips=\"0\" NumberOfPolys=\"0\">\n",
        points);
  }

  /// `point(i)` is a Vector3d.
  template <class Point>
  void points(const Point& point) {
    text_ += "<Points>\n";
    vectors("points", point);
    text_ += "</Points>\n<Verts>\n";
    integers("connectivity", [](int i) { return i; });
    integers("offsets", [](int i) { return i + 1; });
    text_ += "</Verts>\n<PointData>\n";
  }

  template <class Value>
  void vectors(std::string_view name, const Value& value) {
    open("Float64", name, 3);
    for (int i = 0; i < points_; ++i) {
      const Eigen::Vector3d x = value(i);
      print("{} {} {}\n", x[0], x[1], x[2]);
    }
    close();
  }

  template <class Value>
  void scalars(std::string_view name, const Value& value) {
    open("Float64", name, 1);
    for (int i = 0; i < points_; ++i) print("{}\n", value(i));
    close();
  }

  template <class Value>
  void integers(std::string_view name, const Value& value) {
    open("Int32", name, 1);
    for (int i = 0; i < points_; ++i) print("{}\n", value(i));
    close();
  }

  std::string finish() {
    text_ += "</PointData>\n</Piece>\n</PolyData>\n</VTKFile>\n";
    return std::move(text_);
  }

 private:
  template <class... Args>
  void print(fmt::format_string<Args...> format, Args&&... args) {
    fmt::format_to(std::back_inserter(text_), format, std::forward<Args>(args)...);
  }
  void open(std::string_view type, std::string_view name, int components) {
    print("<DataArray type=\"{}\" Name=\"{}\" NumberOfComponents=\"{}\" format=\"ascii\">\n", type,
          name, components);
  }
  void close() { text_ += "</DataArray>\n"; }

  int points_;
  std::string text_;
};

std::string spheres_file(const Spheres& spheres) {
  const auto at = [](const auto& array) {
    return [&array](int i) { return array[static_cast<std::size_t>(i)]; };
  };
  PolyData out(spheres.count());
  out.points(at(spheres.position));
  out.scalars("radius_m", at(spheres.radius));
  out.vectors("velocity_m_s", at(spheres.velocity));
  out.vectors("angular_velocity_rad_s", at(spheres.angular_velocity));
  out.scalars("speed_m_s",
              [&](int i) { return spheres.velocity[static_cast<std::size_t>(i)].norm(); });
  return out.finish();
}

std::string contacts_file(const StepView& view, double step_s) {
  const auto contact = [&](int i) -> const Contact& {
    const int index = view.entered[static_cast<std::size_t>(i)];
    return view.contacts->contacts()[static_cast<std::size_t>(index)];
  };
  PolyData out(static_cast<int>(view.entered.size()));
  out.points([&](int i) { return contact(i).point; });
  out.vectors("force_N", [&](int i) { return Eigen::Vector3d(contact(i).reaction / step_s); });
  out.vectors("normal", [&](int i) { return Eigen::Vector3d(contact(i).normal()); });
  out.scalars("gap_m", [&](int i) { return contact(i).gap; });
  out.integers("bonded", [&](int i) { return contact(i).bonded ? 1 : 0; });
  return out.finish();
}

std::string file_name(std::string_view prefix, std::int64_t step) {
  return fmt::format("{}_{:06}.vtp", prefix, step);
}

}  // namespace

VtkWriter::VtkWriter(std::filesystem::path folder, double step_s, std::int64_t stride)
    : folder_(std::move(folder)), step_s_(step_s), stride_(stride) {
  engine::make_folder(folder_);
}

void VtkWriter::operator()(const StepView& view) {
  if (view.step % stride_ != 0) return;
  engine::write_text_file(folder_ / file_name("spheres", view.step), spheres_file(*view.spheres));
  engine::write_text_file(folder_ / file_name("contacts", view.step), contacts_file(view, step_s_));
  entries_.push_back({view.time_s, view.step});
}

std::string VtkWriter::collection(std::string_view prefix) const {
  std::string out =
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\">\n<Collection>\n";
  for (const Entry& entry : entries_) {
    fmt::format_to(std::back_inserter(out), "<DataSet timestep=\"{}\" part=\"0\" file=\"{}\"/>\n",
                   entry.time_s, file_name(prefix, entry.step));
  }
  return out + "</Collection>\n</VTKFile>\n";
}

void VtkWriter::finish() const {
  engine::write_text_file(folder_ / "spheres.pvd", collection("spheres"));
  engine::write_text_file(folder_ / "contacts.pvd", collection("contacts"));
}

}  // namespace conebench::dem
