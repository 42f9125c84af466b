#include "dem/svg_bodies.h"

#include <fmt/format.h>

#include <cmath>
#include <iterator>
#include <numbers>

#include "dem/svg_light.h"

namespace conebench::dem {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using engine::Colour;
using engine::hex;

constexpr int kColours = 32;
constexpr int kCorners = 12;  // of the contour of a ball
// Where a ball of radius 1 is the lightest, y downwards.
const Vector2d kHighlight(-0.28, -0.36);

Colour base_colour(int colour) {
  return colour < 0 ? Colour(200.0, 206.0, 210.0) : engine::viridis(colour / (kColours - 1.0));
}

// From lit (0) to dark (1); the colour itself at 0.45.
Colour shaded(const Colour& base, double dark) {
  const Colour lit = 0.5 * base + Colour::Constant(127.0);
  if (dark < 0.45) return lit + dark / 0.45 * (base - lit);
  return base - (dark - 0.45) / 0.55 * 0.45 * base;
}

Colour face_colour(const Colour& base, const Patch& patch) {
  const Vector3d normal = Vector3d(-patch.slope[0], patch.slope[1], 1.0).normalized();
  return shaded(base, 0.5 * (1.0 - normal.dot(to_light())));
}

// Of a face: strokes of its own colour close the gaps that drawing leaves between facets.
std::string edges_of(const Colour& fill, bool seamless, bool glass) {
  if (glass && seamless) return " fill-opacity=\"0.15\"";
  const std::string edges =
      fmt::format(" stroke=\"{}\"", hex(seamless ? fill : Colour(0.7 * fill)));
  return glass ? " fill-opacity=\"0.15\" stroke-opacity=\"0.6\"" + edges : edges;
}

// Half of a circle, anticlockwise as one sees it, around the side that `towards` points to.
void append_half_circle(const Vector2d& centre, double radius, double towards, Contour& out) {
  for (int k = 0; k <= kCorners / 2; ++k) {
    const double angle = towards + std::numbers::pi * (0.5 - 2.0 * k / kCorners);
    out.push_back(centre + radius * Vector2d(std::cos(angle), std::sin(angle)));
  }
}

// Of all points within a radius of a line: of its middle depth along the eye's ray.
Patch patch_of_line(const Vector3d& from, const Vector3d& to, double radius) {
  const Vector2d way = (to - from).head<2>();
  const double towards = std::atan2(way[1], way[0]);
  Patch patch;
  append_half_circle(to.head<2>(), radius, towards, patch.contour);
  append_half_circle(from.head<2>(), radius, towards + std::numbers::pi, patch.contour);
  const double slope = way.norm() > 0.0 ? (to[2] - from[2]) / way.squaredNorm() : 0.0;
  patch.slope << slope * way, from[2] - slope * way.dot(from.head<2>());
  patch.farthest = std::min(from[2], to[2]);
  patch.nearest = std::max(from[2], to[2]);
  return patch;
}

}  // namespace

BodiesDrawing::BodiesDrawing(std::span<const Solid> solids, const Frame& frame, const View& view,
                             const engine::Camera& camera)
    : solids_(solids.begin(), solids.end()),
      frame_(frame),
      view_(view),
      camera_(camera),
      faces_(solids, camera.scale()) {
  for (int body = 0; body < frame.bodies.count(); ++body) add_body(body);
}

int BodiesDrawing::colour_of(int body) const {
  if (!frame_.bodies.is_free(body)) return kGrey;
  const double speed = frame_.bodies.velocity[static_cast<std::size_t>(body)].norm();
  const double share = std::clamp(speed / view_.fastest_m_s, 0.0, 1.0);
  return static_cast<int>(std::lround(share * (kColours - 1)));
}

void BodiesDrawing::add_body(int body) {
  const Bodies& bodies = frame_.bodies;
  const auto b = static_cast<std::size_t>(body);
  const int colour = colour_of(body);
  if (bodies.is_ball(body)) return add_ball(bodies.position[b], bodies.radius[b], colour);
  const Pose pose = bodies.pose(body);
  for (const Part& part : solids_[static_cast<std::size_t>(bodies.solid[b])].parts) {
    const Pose place = pose * part.pose;
    if (const auto* ball = std::get_if<Ball>(&part.piece)) {
      add_ball(place.position, ball->radius_m, colour);
    } else if (const auto* capsule = std::get_if<Capsule>(&part.piece)) {
      add_capsule(*capsule, place, colour);
    }
  }
  for (Face& face : faces_.of(bodies.solid[b], pose, camera_, view_.middle)) {
    add_face(std::move(face), colour, view_.glass[b]);
  }
}

void BodiesDrawing::add_ball(const Vector3d& centre_m, double radius_m, int colour) {
  const Vector3d at = camera_.place(centre_m);
  const double radius = camera_.scale() * radius_m;
  gradients_.insert(colour);
  add(patch_of_line(at, at, radius),
      fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"{:.1f}\" fill=\"url(#s{})\"/>\n", at[0],
                  at[1], radius, colour));
}

// Like a ball that is drawn along: discs from its rim to where it is the lightest.
void BodiesDrawing::add_capsule(const Capsule& capsule, const Pose& pose, int colour) {
  const Vector3d half = capsule.half_length_m * (pose.orientation * Vector3d::UnitZ());
  const Vector3d from = camera_.place(pose.position - half);
  const Vector3d to = camera_.place(pose.position + half);
  const double radius = camera_.scale() * capsule.radius_m;
  const int discs = static_cast<int>(std::clamp(std::ceil(0.5 * radius), 3.0, 24.0));
  std::string svg;
  for (int k = 0; k < discs; ++k) {
    const double share = static_cast<double>(k) / discs;
    const Vector2d start = from.head<2>() + share * radius * kHighlight;
    fmt::format_to(
        std::back_inserter(svg),
        "<path stroke=\"{}\" stroke-width=\"{:.1f}\" d=\"M{:.1f} {:.1f}l{:.1f} {:.1f}\"/>\n",
        hex(shaded(base_colour(colour), 0.85 * (1.0 - share))), 2.0 * radius * (1.0 - share),
        start[0], start[1], to[0] - from[0], to[1] - from[1]);
  }
  add(patch_of_line(from, to, radius), std::move(svg));
}

void BodiesDrawing::add_face(Face face, int colour, bool glass) {
  const Colour fill = face_colour(base_colour(colour), face.patch);
  std::string svg = fmt::format("<polygon fill=\"{}\"{} points=\"", hex(fill),
                                edges_of(fill, face.seamless, glass && face.before));
  for (const Vector2d& corner : face.patch.contour) {
    fmt::format_to(std::back_inserter(svg), "{:.1f},{:.1f} ", corner[0], corner[1]);
  }
  svg.back() = '"';
  add(std::move(face.patch), std::move(svg) + "/>\n");
}

void BodiesDrawing::add(Patch patch, std::string svg) {
  Vector2d low = patch.contour.front(), high = low;
  for (const Vector2d& x : patch.contour) {
    low = low.cwiseMin(x);
    high = high.cwiseMax(x);
  }
  const Vector2d end(camera_.width_px(), camera_.height_px());
  if ((low.array() > end.array()).any() || (high.array() < 0.0).any()) return;
  patches_.push_back(std::move(patch));
  drawn_.push_back(std::move(svg));
}

std::string BodiesDrawing::bodies() const {
  std::string out = "<g stroke-width=\"0.8\" stroke-linejoin=\"round\" stroke-linecap=\"round\">\n";
  for (const int i : paint_order(patches_)) out += drawn_[static_cast<std::size_t>(i)];
  return out + "</g>\n";
}

// A ball with light from the upper left and a dark rim.
std::string BodiesDrawing::gradients() const {
  std::string out;
  for (const int colour : gradients_) {
    const Colour base = base_colour(colour);
    out += fmt::format(
        "<radialGradient id=\"s{}\" cx=\"{}\" cy=\"{}\" r=\"0.72\"><stop offset=\"0\" "
        "stop-color=\"{}\"/><stop offset=\"0.45\" stop-color=\"{}\"/><stop offset=\"1\" "
        "stop-color=\"{}\"/></radialGradient>\n",
        colour, 0.5 + 0.5 * kHighlight[0], 0.5 + 0.5 * kHighlight[1], hex(shaded(base, 0.0)),
        hex(base), hex(shaded(base, 1.0)));
  }
  return out;
}

}  // namespace conebench::dem
