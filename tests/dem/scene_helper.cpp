#include "tests/dem/scene_helper.h"

namespace conebench::test {

dem::Scene small_scene(const dem::PairLaw& law) {
  dem::Scene scene;
  scene.name = "small";
  scene.step_s = 1e-3;
  scene.duration_s = 1.0;
  scene.skin_m = 5e-3;
  scene.materials = {{"grain", 2500.0}};
  scene.default_pair = law;
  return scene;
}

void add_floor(dem::Scene& scene) {
  dem::Plane floor;
  floor.material = "grain";
  scene.planes.push_back(floor);
}

dem::Body& add_body(dem::Scene& scene, const Eigen::Vector3d& position_m, double radius_m) {
  dem::Body body;
  body.position_m = position_m;
  body.radius_m = radius_m;
  body.material = "grain";
  scene.bodies.push_back(body);
  return scene.bodies.back();
}

void add_shape(dem::Scene& scene, const std::string& name, const dem::Piece& piece) {
  dem::ScenePart part;
  part.piece = piece;
  scene.shapes.push_back({name, {part}});
}

dem::Body& add_body(dem::Scene& scene, const Eigen::Vector3d& position_m,
                    const std::string& shape) {
  dem::Body& body = add_body(scene, position_m, 0.0);
  body.shape = shape;
  return body;
}

}  // namespace conebench::test
