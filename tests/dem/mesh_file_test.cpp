#include "dem/mesh_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <bit>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <limits>
#include <sstream>

#include "tests/dem/shape_helper.h"
#include "tests/engine/scene_text.h"

namespace conebench::test {
namespace {

namespace fs = std::filesystem;
using Eigen::Vector3d;
using Eigen::Vector3i;
using testing::ElementsAre;
using testing::EndsWith;
using testing::HasSubstr;
using testing::SizeIs;

// A folder of its own for each test, gone with it.
class MeshFile : public testing::Test {
 protected:
  ~MeshFile() override { fs::remove_all(folder_); }

  fs::path write(const std::string& name, const std::string& bytes) const {
    std::ofstream(folder_ / name, std::ios::binary) << bytes;
    return folder_ / name;
  }
  dem::Mesh read(const std::string& name, const std::string& bytes) const {
    return dem::read_mesh(write(name, bytes));
  }
  // What is said after the name of the file.
  std::string error_of(const std::string& name, const std::string& bytes) const {
    const fs::path file = write(name, bytes);
    const std::string error = input_error(file.string(), [&] { dem::read_mesh(file); });
    return error.starts_with(file.string() + ": ") ? error.substr(file.string().size() + 2) : error;
  }
  const fs::path& folder() const { return folder_; }

 private:
  static fs::path make_folder() {
    std::string name = (fs::temp_directory_path() / "mesh-file-XXXXXX").string();
    return mkdtemp(name.data());
  }
  const fs::path folder_ = make_folder();
};

const std::string kSquare = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

TEST_F(MeshFile, ReadsVerticesAndTrianglesOfAnObj) {
  const dem::Mesh mesh = read("a.obj",
                              "# a remark\r\nmtllib x.mtl\no square\n\n  v 0 0 0 # one\n"
                              "v\t1e0 +0.5 -2.5e-1 1.0\r\nv 1 1 0 0.2 0.3 0.4\ng g\ns off\n"
                              "usemtl steel\nf 1 2 3");
  EXPECT_THAT(mesh.vertices_m,
              ElementsAre(Vector3d(0, 0, 0), Vector3d(1, 0.5, -0.25), Vector3d(1, 1, 0)));
  EXPECT_THAT(mesh.triangles, ElementsAre(Vector3i(0, 1, 2)));
}

TEST_F(MeshFile, CutsThePolygonsOfAnObjIntoFans) {
  EXPECT_THAT(read("a.obj", kSquare + "v 0 0.5 0\nf 1 2 3 4 5\n").triangles,
              ElementsAre(Vector3i(0, 1, 2), Vector3i(0, 2, 3), Vector3i(0, 3, 4)));
}

TEST_F(MeshFile, ReadsAllFormsOfCornersOfAnObj) {
  const std::string texture = "vt 0 0\nvt 1 0\nvn 0 0 1\n";
  for (const char* face : {"f 1 2 3", "f 1/1 2/2 3/1", "f 1//1 2//1 3//1", "f 1/1/1 2/2/1 3/1/1",
                           "f -4 -3 -2", "f -4/-1/-1 -3/-2/-1 -2/-1/-1", "f -4//-1 2//-1 3"}) {
    EXPECT_THAT(read("a.obj", kSquare + texture + face + "\n").triangles,
                ElementsAre(Vector3i(0, 1, 2)))
        << face;
  }
}

TEST_F(MeshFile, CountsNegativeCornersOfAnObjFromWhereTheyStand) {
  EXPECT_THAT(read("a.obj", kSquare + "f -4 -3 -2\nv 5 5 5\nf -4 -3 -2\n").triangles,
              ElementsAre(Vector3i(0, 1, 2), Vector3i(1, 2, 3)));
}

TEST_F(MeshFile, NamesTheLineOfAnObjThatIsWrong) {
  const auto error = [&](const std::string& line) { return error_of("a.obj", kSquare + line); };
  EXPECT_EQ(error("f 1 2\n"), "line 5: a face of 2 corners, expected at least 3");
  EXPECT_EQ(error("f 1 2 9\n"), "line 5: vertex 9 of 4 read so far, expected 1 to 4 or -4 to -1");
  EXPECT_THAT(error("f 1 2 0\n"), HasSubstr("vertex 0 of 4 read so far"));
  EXPECT_THAT(error("f 1 2 -5\n"), HasSubstr("vertex -5 of 4 read so far"));
  for (const std::string corner :
       {"x", "1/", "1//", "/1", "1/2/", "1/2/3/4", "1.5", "1/x/2", "99999999999", "\\"}) {
    EXPECT_EQ(error("f " + corner + " 2 3\n"),
              "line 5: found '" + corner + "', expected a corner: v, v/vt, v//vn or v/vt/vn");
  }
  EXPECT_EQ(error("v 1 2\n"), "line 5: the line ends, expected z, a finite number");
  EXPECT_EQ(error("v 1 nan 2\n"), "line 5: found 'nan', expected y, a finite number");
  EXPECT_EQ(error("v 1,5 0 0\n"), "line 5: found '1,5', expected x, a finite number");
  EXPECT_EQ(error("\n# remark\ncurv 1 2\n"),
            "line 7: found 'curv', expected a statement about vertices or polygons");
  EXPECT_EQ(error(""), "line 4: the file ends and has no faces, expected at least one");
  EXPECT_THAT(error_of("a.obj", ""), EndsWith("has no faces, expected at least one"));
}

std::string text_stl(const dem::Mesh& mesh) {
  const Eigen::IOFormat plain(Eigen::FullPrecision, Eigen::DontAlignCols);
  std::ostringstream out;
  out << "solid a cube # 3\n";
  for (const Vector3i& triangle : mesh.triangles) {
    out << "  facet normal 0 0 nan\n    outer loop\n";
    for (const int k : triangle) {
      out << "      vertex "
          << mesh.vertices_m[static_cast<std::size_t>(k)].transpose().format(plain) << "\n";
    }
    out << "    endloop\n  endfacet\n";
  }
  out << "endsolid a cube";
  return out.str();
}

std::string four_bytes(std::uint32_t value) {
  std::string bytes;
  for (int k = 0; k < 4; ++k) bytes += static_cast<char>(value >> (8 * k) & 0xff);
  return bytes;
}

std::string binary_stl(const dem::Mesh& mesh, std::string header = "made by nobody") {
  header.resize(80, ' ');
  std::string bytes = header + four_bytes(static_cast<std::uint32_t>(mesh.triangles.size()));
  for (const Vector3i& triangle : mesh.triangles) {
    bytes += std::string(12, '\0');
    for (const int k : triangle) {
      for (const double x : mesh.vertices_m[static_cast<std::size_t>(k)]) {
        bytes += four_bytes(std::bit_cast<std::uint32_t>(static_cast<float>(x)));
      }
    }
    bytes += "ab";
  }
  return bytes;
}

// 2 x 1 x 0.5: halves are floats.
const dem::Mesh kBox = box_mesh({1.0, 0.5, 0.25});

void expect_box(const dem::Mesh& mesh) {
  EXPECT_THAT(mesh.vertices_m, SizeIs(8));
  EXPECT_THAT(mesh.triangles, SizeIs(12));
  EXPECT_NO_THROW(dem::check_piece(mesh, "box", true));
  EXPECT_DOUBLE_EQ(mass_properties(mesh).volume_m3, 1.0);
}

TEST_F(MeshFile, ReadsAnStlAndMergesEqualVertices) {
  expect_box(read("text.stl", text_stl(kBox)));
  expect_box(read("BINARY.STL", binary_stl(kBox)));
  expect_box(read("solid.stl", binary_stl(kBox, "solid in name only")));
}

TEST_F(MeshFile, TakesNegativeZeroForZero) {
  const std::string text = text_stl(
      {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}});
  EXPECT_THAT(read("a.stl", changed(text, "vertex 0 1 0", "vertex -0 1 -0")).vertices_m, SizeIs(4));
}

TEST_F(MeshFile, ReadsCapitalsAndSeveralSolidsOfAnStl) {
  std::string capitals = text_stl(kBox);
  for (char& c : capitals) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  expect_box(read("a.stl", capitals));

  dem::Mesh beside = kBox;
  for (Vector3d& vertex : beside.vertices_m) vertex.x() += 4.0;
  const dem::Mesh both = read("b.stl", text_stl(kBox) + "\n" + text_stl(beside) + "\n");
  EXPECT_THAT(both.vertices_m, SizeIs(16));
  EXPECT_DOUBLE_EQ(mass_properties(both).volume_m3, 2.0);
}

TEST_F(MeshFile, NamesTheLineOfAnStlThatIsWrong) {
  const std::string good = text_stl(kBox);
  const auto error = [&](const std::string& from, const std::string& to) {
    return error_of("a.stl", changed(good, from, to));
  };
  EXPECT_EQ(error("facet", "fact"), "line 2: found 'fact', expected 'facet' or 'endsolid'");
  EXPECT_EQ(error("outer loop", "outer"), "line 3: found 'outer', expected 'outer loop'");
  EXPECT_EQ(error("vertex -1", "vertex one"), "line 4: found 'one', expected x, a finite number");
  EXPECT_EQ(error("-0.25", ""), "line 4: the line ends, expected z, a finite number");
  EXPECT_EQ(error("    endloop", "vertex 0 0 0"), "line 7: found 'vertex', expected 'endloop'");
  EXPECT_EQ(error("  endfacet", "endsolid"), "line 8: found 'endsolid', expected 'endfacet'");
  EXPECT_EQ(error_of("a.stl", good + "\nfacet"),
            "line 87: found 'facet', expected 'solid' or the end of the file");
  EXPECT_EQ(error("endsolid a cube", ""), "line 85: the file ends, expected 'facet' or 'endsolid'");
  EXPECT_EQ(error_of("a.stl", "solid nothing\nendsolid\n"),
            "has no triangles, expected at least one");
  EXPECT_THAT(error_of("a.stl", good.substr(0, good.size() / 2)), HasSubstr("line 4"));
}

TEST_F(MeshFile, NamesTheByteOfABinaryStlThatIsWrong) {
  const std::string good = binary_stl(kBox);
  EXPECT_EQ(error_of("a.stl", good.substr(0, 300)),
            "byte 80: says 12 triangles, which take 684 bytes, but the file holds 300");
  EXPECT_EQ(error_of("a.stl", good + "x"),
            "byte 80: says 12 triangles, which take 684 bytes, but the file holds 685");
  EXPECT_THAT(error_of("a.stl", "short"), HasSubstr("holds 5 bytes, expected text that begins"));
  EXPECT_THAT(error_of("a.stl", ""), HasSubstr("holds 0 bytes"));
  EXPECT_EQ(error_of("a.stl", binary_stl(dem::Mesh{})), "has no triangles, expected at least one");

  dem::Mesh broken = kBox;
  broken.vertices_m[4].y() = std::numeric_limits<double>::infinity();
  // The second corner of the first triangle: 84 + 2 x 12 and one number more.
  EXPECT_EQ(error_of("a.stl", binary_stl(broken)),
            "byte 112: found inf, expected a finite coordinate");
  // A count that no memory holds is refused before any is taken.
  EXPECT_THAT(error_of("a.stl", std::string(80, ' ') + four_bytes(0xffffffff)),
              HasSubstr("says 4294967295 triangles, which take 214748364834 bytes"));
}

TEST_F(MeshFile, MustBeThereAndNamedForWhatItIs) {
  EXPECT_EQ(error_of("mesh.ply", "ply"), "a mesh file's name should end in .obj or .stl");
  for (const fs::path& file : {folder() / "missing.obj", folder() / "folder.stl"}) {
    if (file.extension() == ".stl") fs::create_directory(file);
    EXPECT_THAT(input_error(file.string(), [&] { dem::read_mesh(file); }),
                EndsWith(": cannot be opened for reading"));
  }
}

}  // namespace
}  // namespace conebench::test
