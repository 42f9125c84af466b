# Writes OUTPUT, a C++ source of namespace conebench::ENGINE that holds the text of every file in SCENES (separated by "|").
string(REPLACE "|" ";" SCENES "${SCENES}")
set(entries "")
foreach(path IN LISTS SCENES)
  get_filename_component(name "${path}" NAME_WE)
  file(READ "${path}" text)
  string(APPEND entries "    {\"${name}\", R\"scene(${text})scene\"},\n")
endforeach()
file(WRITE "${OUTPUT}" "#include \"${ENGINE}/scene.h\"

namespace conebench::${ENGINE} {
namespace {
constexpr engine::BuiltinScene kScenes[] = {
${entries}};
}  // namespace

std::span<const engine::BuiltinScene> builtin_scenes() { return kScenes; }

}  // namespace conebench::${ENGINE}
")
