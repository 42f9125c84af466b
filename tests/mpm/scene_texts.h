#pragma once

#include <string>

#include "mpm/scene.h"
#include "tests/engine/scene_text.h"

namespace conebench::test {

/// A heap of sand in a box, in two dimensions.
inline const std::string kScene = R"(schema = 1
engine = "mpm"
name = "heap"
step_s = 1e-3
duration_s = 0.3

[grid]
cells = [40, 20]
size_m = [2, 1]

[material]
density_kg_m3 = 1500
friction = 0.4

[[blocks]]
low_m = [0, 0]
high_m = [0.5, 0.5]
)";

/// Everything that a scene can hold.
inline const std::string kFull = R"(schema = 1
engine = "mpm"
name = "everything"
gravity_m_s2 = [0, 0, -9.81]
step_s = 0.001
duration_s = 0.3
seed = 7
cfl = 0.25

[solver]
name = "gs"
tol = 1e-07
time_limit_s = 1
max_iterations = 1000

[grid]
cells = [20, 10, 10]
size_m = [2, 1, 1]
low_m = [-1, 0.1, 0]
refine = "boundary"

[material]
density_kg_m3 = 1500
phi_max = 0.6
friction = 0.38
cohesion_Pa = 200
law = "dense-only"
cohesion_decay = 0.1
friction_rise = 0.2
inertial_number_0 = 0.4
grain_diameter_m = 0.001
viscosity_Pa_s = 0.5
viscosity_in_mass = true

[walls]
left = "stick"
right = "free"
front = "slip"
back = "slip"
bottom = { condition = "frictional", friction = 0.3 }
top = "free"

[[barriers]]
axis = "x"
position_m = 0.5
low_m = [0, 0.1, 0]
high_m = [0, 1.1, 0.6]
condition = "stick"
opens_s = 0.1
opening_m_s = 2

[[barriers]]
axis = "z"
position_m = 0.8
low_m = [-1, 0.1, 0]
high_m = [-0.5, 1.1, 0]
condition = "slip"

[[blocks]]
low_m = [-1, 0.1, 0]
high_m = [0, 1.1, 0.5]
fraction = 0.5
particles_per_cell = 3
jitter = 0.2
cohesion_factor = 2
velocity_m_s = [0.1, 0, -0.3333333333333333]

[[bodies]]
shape = "ball"
radius_m = 0.15
motion = "free"
centre_m = [0.7, 0.5, 0.5]
rotation_rad = [0, 0.1, 0]
velocity_m_s = [0, 0, -1]
angular_velocity_rad_s = [0, 3, 0]
density_kg_m3 = 2500
friction = 0.3

[[bodies]]
shape = "box"
half_size_m = [0.1, 0.2, 0.3]
motion = "static"
centre_m = [0.5, 0.5, 0.5]
rotation_rad = [0, 0, 0.7]
velocity_m_s = [0, 0, 0]
angular_velocity_rad_s = [0, 0, 0]
friction = 0

[[bodies]]
shape = "half-space"
normal = [0, 0, 1]
motion = "driven"
centre_m = [0, 0, 0.05]
rotation_rad = [0, 0, 0]
velocity_m_s = [0.1, 0, 0]
angular_velocity_rad_s = [0, 0, 0]
friction = 0.5
)";

/// What parsing `text` complains of, or "no error".
inline std::string error_of(const std::string& text) {
  return input_error("heap.toml", [&] { mpm::parse_scene(text, "heap.toml"); });
}

}  // namespace conebench::test
