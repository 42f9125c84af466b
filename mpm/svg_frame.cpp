#include "mpm/svg_frame.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "mpm/svg_solids.h"

namespace conebench::mpm {
namespace {

constexpr int kColours = 32;
constexpr double kLeastDot_px = 1.5;

template <int D>
std::vector<double> fractions_at(const Nodes& nodes, const Particles& particles) {
  std::vector<double> fractions(particles.count(), 0.0);
  for (std::size_t p = 0; p < particles.count(); ++p) {
    const Stencil<D> s = stencil_at<D>(nodes.mesh, particles.position[p]);
    for (std::size_t k = 0; k < Stencil<D>::kNodes; ++k) {
      const int slot = nodes.slot_of[static_cast<std::size_t>(s.node[k])];
      if (slot >= 0) fractions[p] += s.weight[k] * nodes.fraction(slot);
    }
  }
  return fractions;
}

// One layer of the picture: dots of each colour, as path data, and bodies.
struct Layer {
  std::map<int, std::string> dots;
  std::string bodies;
};

class Drawing {
 public:
  Drawing(const Scene& scene, const Frame& frame, const View& view)
      : scene_(scene), frame_(frame), view_(view), camera_(window_of(scene)) {}

  std::string draw() const {
    const SolidsDrawing solids(scene_, camera_);
    std::string out = engine::svg_start(camera_.height_px()) + "<defs>\n" +
                      engine::scale_gradient() + "</defs>\n" +
                      solids.behind(frame_.bodies, frame_.cut);
    for (const auto& [depth, layer] : make_layers(solids)) out += draw_layer(layer);
    for (const Barrier& barrier : scene_.barriers) out += solids.barrier(barrier, frame_.time_s);
    return out + draw_caption() + "</svg>\n";
  }

 private:
  bool flat() const { return scene_.grid.dim == 2; }

  // A cell thick each, far ones first; a single one in 2D.
  std::map<long, Layer> make_layers(const SolidsDrawing& solids) const {
    const auto place = [&](const Eigen::Vector3d& x) {
      return flat() ? 0 : std::lround(camera_.depth(x) / scene_.grid.smallest_spacing());
    };
    std::map<long, Layer> layers;
    for (std::size_t p = 0; p < frame_.positions.size(); ++p) {
      const Eigen::Vector2d at = camera_(frame_.positions[p]);
      layers[place(frame_.positions[p])].dots[colour_of(p)] +=
          fmt::format("M{:.1f} {:.1f}h0", at[0], at[1]);
    }
    for (const RigidBody& body : frame_.bodies) {
      layers[place(body.centre_m)].bodies += solids.body(body);
    }
    return layers;
  }

  int colour_of(std::size_t particle) const {
    const bool by_speed = view_.colour_by == ColourBy::kSpeed;
    const double value = by_speed ? frame_.speeds[particle] : frame_.fractions[particle];
    const double share = std::clamp(value / view_.end, 0.0, 1.0);
    return static_cast<int>(std::lround(share * (kColours - 1)));
  }

  // The room of a particle in a cell of the first block.
  double dot_px() const {
    const auto side =
        scene_.blocks.empty() ? 2.0 : static_cast<double>(scene_.blocks[0].particles_per_cell);
    return std::max(kLeastDot_px, camera_.scale() * scene_.grid.smallest_spacing() / side);
  }

  // Dots are strokes of no length with round caps: the shortest way to write them.
  std::string draw_layer(const Layer& layer) const {
    std::string out = fmt::format(
        "<g fill=\"none\" stroke-linecap=\"round\" stroke-width=\"{:.1f}\">\n", dot_px());
    for (const auto& [colour, dots] : layer.dots) {
      out += fmt::format("<path stroke=\"{}\" d=\"{}\"/>\n",
                         engine::hex(engine::viridis(colour / (kColours - 1.0))), dots);
    }
    return out + "</g>\n" + layer.bodies;
  }

  std::string draw_caption() const {
    const bool by_speed = view_.colour_by == ColourBy::kSpeed;
    return engine::caption({.title = scene_.name,
                            .moment = fmt::format("t = {:.3f} s", frame_.time_s),
                            .meaning = by_speed ? "speed" : "volume fraction",
                            .end = fmt::format("{:.2g}{}", view_.end, by_speed ? " m/s" : "")});
  }

  const Scene& scene_;
  const Frame& frame_;
  const View& view_;
  engine::Camera camera_;
};

}  // namespace

Frame make_frame(const Simulation& simulation) {
  const Scene& scene = simulation.scene();
  const Particles& particles = simulation.particles();
  Nodes nodes;
  scatter(scene, particles, nodes);
  cover(scene, simulation.bodies(), simulation.time_s(), nodes);
  Frame frame;
  frame.time_s = simulation.time_s();
  frame.positions = particles.position;
  for (const Eigen::Vector3d& v : particles.velocity) frame.speeds.push_back(v.norm());
  frame.fractions =
      scene.grid.dim == 2 ? fractions_at<2>(nodes, particles) : fractions_at<3>(nodes, particles);
  frame.bodies = simulation.bodies();
  frame.cut = nodes.mesh.cut();
  return frame;
}

View fit_view(const Scene& scene, std::span<const Frame> frames, ColourBy colour_by) {
  if (colour_by == ColourBy::kFraction) return {colour_by, scene.material.phi_max};
  double fastest = 0.0;
  for (const Frame& frame : frames) {
    for (const double speed : frame.speeds) fastest = std::max(fastest, speed);
  }
  return {colour_by, fastest > 0.0 ? fastest : 1.0};
}

std::string draw_svg(const Scene& scene, const Frame& frame, const View& view) {
  return Drawing(scene, frame, view).draw();
}

}  // namespace conebench::mpm
