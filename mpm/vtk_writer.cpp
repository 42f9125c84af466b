#include "mpm/vtk_writer.h"

#include "problems/engine/text_file.h"

namespace conebench::mpm {
namespace {

using engine::PolyData;
using engine::vtk_file_name;

template <class Array>
auto at(const Array& array) {
  return [&array](int i) { return array[static_cast<std::size_t>(i)]; };
}

std::string particles_file(const Particles& particles, int dim) {
  const auto velocity = at(particles.velocity);
  const auto stress = at(particles.stress);
  PolyData out(static_cast<int>(particles.count()));
  out.points(at(particles.position));
  out.vectors("velocity_m_s", velocity);
  out.scalars("speed_m_s", [&](int i) { return velocity(i).norm(); });
  out.scalars("volume_m3", at(particles.volume));
  out.scalars("cohesion_Pa", at(particles.cohesion));
  out.scalars("pressure_Pa", [&](int i) { return pressure(dim, stress(i)[0]); });
  return out.finish();
}

// What the step's solution says of the stress at the nodes.
struct NodeStress {
  Eigen::VectorXd pressure, shear;  // sqrt(J2) = |Dev|_F / sqrt 2 = |rbar_t| [Pa]
};

NodeStress stress_of(const StepView& view) {
  const int count = view.problem ? view.nodes->count() : 0;
  NodeStress out{Eigen::VectorXd(count), Eigen::VectorXd(count)};
  if (count == 0) return out;
  const Eigen::VectorXd r = (view.answer->r - view.problem->tip_shift()) / view.h;
  for (int i = 0; i < count; ++i) {
    const int start = view.problem->start(i);
    out.pressure[i] = pressure(view.scene->grid.dim, r[start]);
    out.shear[i] = r.segment(start + 1, view.problem->start(i + 1) - start - 1).norm();
  }
  return out;
}

std::string nodes_file(const StepView& view) {
  const Nodes& nodes = *view.nodes;
  const NodeStress stress = stress_of(view);
  PolyData out(static_cast<int>(stress.pressure.size()));
  out.points([&](int i) { return nodes.mesh.grid().position(at(nodes.index)(i)); });
  out.scalars("volume_fraction", [&](int i) { return nodes.fraction(i); });
  out.integers("state", [&](int i) { return static_cast<int>(at(*view.states)(i)); });
  out.vectors("velocity_m_s", at(*view.velocity));
  out.scalars("pressure_Pa", [&](int i) { return stress.pressure[i]; });
  out.scalars("shear_stress_Pa", [&](int i) { return stress.shear[i]; });
  return out.finish();
}

}  // namespace

VtkWriter::VtkWriter(std::filesystem::path folder, std::int64_t stride)
    : folder_(std::move(folder)), stride_(stride) {
  engine::make_folder(folder_);
}

void VtkWriter::operator()(const StepView& view) {
  if (view.step % stride_ != 0) return;
  engine::write_text_file(folder_ / vtk_file_name("particles", view.step),
                          particles_file(*view.particles, view.scene->grid.dim));
  engine::write_text_file(folder_ / vtk_file_name("nodes", view.step), nodes_file(view));
  steps_.push_back({view.time_s, view.step});
}

void VtkWriter::finish() const {
  engine::write_vtk_series(folder_, "particles", steps_);
  engine::write_vtk_series(folder_, "nodes", steps_);
}

}  // namespace conebench::mpm
