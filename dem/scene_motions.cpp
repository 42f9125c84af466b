#include "dem/scene_motions.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "problems/engine/scene_file.h"

namespace conebench::dem {
namespace {

using engine::quote;
using engine::Range;
using engine::show;
using engine::TomlReader;

const std::string kKinds[] = {"slide", "turn", "shake", "table"};

// Reads from_s and until_s, which may be missing: always.
template <class Kind>
Kind during(TomlReader& in, Kind kind) {
  kind.from_s = in.number("from_s", Range::kNotNegative, 0.0);
  kind.until_s = in.number("until_s", Range::kNotNegative, std::numeric_limits<double>::infinity());
  if (!(kind.until_s > kind.from_s)) {
    in.fail("until_s", fmt::format("found {}, expected > from_s = {}", kind.until_s, kind.from_s));
  }
  return kind;
}

Eigen::Vector3d read_axis(TomlReader& in) {
  const Eigen::Vector3d axis = in.vector("axis", Eigen::Vector3d(0.0, 1.0, 0.0));
  if (axis.norm() == 0.0) in.fail("axis", "found a zero vector, expected a direction");
  const bool is_unit = std::abs(axis.norm() - 1.0) < 1e-15;
  return is_unit ? axis : axis.normalized();
}

template <class Kind>
std::string show_times(const Kind& kind) {
  return fmt::format("from_s = {}\n", kind.from_s) +
         (std::isfinite(kind.until_s) ? fmt::format("until_s = {}\n", kind.until_s) : "");
}

struct ShowKind {
  std::string operator()(const Slide& s) const {
    return fmt::format("kind = \"slide\"\nvelocity_m_s = {}\n", show(s.velocity_m_s)) +
           show_times(s);
  }
  std::string operator()(const Turn& t) const {
    return fmt::format("kind = \"turn\"\npoint_m = {}\naxis = {}\nrate_rad_s = {}\n",
                       show(t.point_m), show(t.axis), t.rate_rad_s) +
           show_times(t);
  }
  std::string operator()(const Shake& s) const {
    return fmt::format("kind = \"shake\"\namplitude_m = {}\nfrequency_Hz = {}\n",
                       show(s.amplitude_m), s.frequency_Hz) +
           show_times(s);
  }
  std::string operator()(const Table& t) const {
    return fmt::format("kind = \"table\"\nfile = {}\npoint_m = {}\n",
                       quote(std::filesystem::absolute(t.file).string()), show(t.point_m));
  }
};

}  // namespace

Motion read_motion(TomlReader in, std::string_view subject) {
  Motion motion{in.text("name"), {}};
  switch (in.word("kind", kKinds)) {
    case 0:
      motion.kind = during(in, Slide{.velocity_m_s = in.vector("velocity_m_s")});
      break;
    case 1:
      motion.kind = during(in, Turn{.point_m = in.vector("point_m", Eigen::Vector3d(0, 0, 0)),
                                    .axis = read_axis(in),
                                    .rate_rad_s = in.number("rate_rad_s", Range::kAny)});
      break;
    case 2:
      motion.kind = during(in, Shake{.amplitude_m = in.vector("amplitude_m"),
                                     .frequency_Hz = in.number("frequency_Hz", Range::kPositive)});
      break;
    default: {
      const auto file = std::filesystem::path(subject).parent_path() / in.text("file");
      motion.kind = read_table(file, in.vector("point_m", Eigen::Vector3d(0, 0, 0)), subject);
    }
  }
  in.finish();
  return motion;
}

std::string show(const Motion& motion) {
  return fmt::format("\n[[motions]]\nname = {}\n", quote(motion.name)) +
         std::visit(ShowKind{}, motion.kind);
}

}  // namespace conebench::dem
