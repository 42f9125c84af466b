#include "mpm/scene.h"

namespace conebench::mpm {
namespace {

constexpr std::array<std::string_view, 4> kFaces2D = {"left", "right", "bottom", "top"};
constexpr std::array<std::string_view, 6> kFaces3D = {"left", "right",  "front",
                                                      "back", "bottom", "top"};

}  // namespace

std::string_view to_string(Law law) {
  switch (law) {
    case Law::kUniform:
      return "uniform";
    case Law::kDenseOnly:
      return "dense-only";
    case Law::kDilationAware:
      return "dilation-aware";
    case Law::kMonotone:
      return "monotone";
  }
  return {};
}

std::string_view to_string(Refine refine) {
  switch (refine) {
    case Refine::kNone:
      return "none";
    case Refine::kBoundary:
      return "boundary";
  }
  return {};
}

std::string_view to_string(Condition condition) {
  switch (condition) {
    case Condition::kStick:
      return "stick";
    case Condition::kSlip:
      return "slip";
    case Condition::kFree:
      return "free";
    case Condition::kFrictional:
      return "frictional";
  }
  return {};
}

std::string_view to_string(Shape shape) {
  switch (shape) {
    case Shape::kBall:
      return "ball";
    case Shape::kBox:
      return "box";
    case Shape::kHalfSpace:
      return "half-space";
  }
  return {};
}

std::string_view to_string(Motion motion) {
  switch (motion) {
    case Motion::kStatic:
      return "static";
    case Motion::kDriven:
      return "driven";
    case Motion::kFree:
      return "free";
  }
  return {};
}

std::string_view face_name(int dim, int face) {
  const auto at = static_cast<std::size_t>(face);
  return dim == 2 ? kFaces2D[at] : kFaces3D[at];
}

Scene load_scene(const std::string& name_or_path) {
  const engine::SceneText scene = engine::load_scene_text(name_or_path, builtin_scenes());
  return parse_scene(scene.text, scene.subject);
}

}  // namespace conebench::mpm
