# Writes OUTPUT, a C++ source that holds the text of every file in FILES (LANGUAGE/NAME, separated by
# "|") of the folder ROOT.
string(REPLACE "|" ";" FILES "${FILES}")
set(entries "")
foreach(file IN LISTS FILES)
  get_filename_component(language "${file}" DIRECTORY)
  get_filename_component(name "${file}" NAME)
  file(READ "${ROOT}/${file}" text)
  string(APPEND entries "    {\"${language}\", \"${name}\", R\"skeleton(${text})skeleton\"},\n")
endforeach()
file(WRITE "${OUTPUT}" "#include \"harness/skeleton.h\"

namespace conebench::harness {
namespace {
constexpr SkeletonFile kFiles[] = {
${entries}};
}  // namespace

std::span<const SkeletonFile> skeleton_files() { return kFiles; }

}  // namespace conebench::harness
")
