#include <algorithm>
#include <cmath>

#include "mpm/nodes.h"

namespace conebench::mpm {
namespace {

// A pressure below this share of a grain layer's weight counts as that much, so that mu(I) is
// defined at a free surface.
constexpr double kLeastPressure = 0.1;

template <int D>
double inertial_number(const Scene& scene, const Sym<D>& rate, const Particles::Stress& stress) {
  const Material& m = scene.material;
  const double shear = std::sqrt(2.0) * rate.tail(kEntries<D> - 1).norm();
  const double layer = m.density_kg_m3 * scene.gravity_m_s2.norm() * m.grain_diameter_m;
  const double p = std::max(pressure(D, stress[0]), kLeastPressure * layer);
  return p > 0.0 ? shear * m.grain_diameter_m * std::sqrt(m.density_kg_m3 / p) : 0.0;
}

template <int D>
void gather_in(const Scene& scene, const Nodes& nodes, const std::vector<Eigen::Vector3d>& velocity,
               const std::vector<Particles::Stress>& stress, double h, Particles& particles) {
  const Material& material = scene.material;
  for (std::size_t p = 0; p < particles.count(); ++p) {
    const Stencil<D> s = active_stencil<D>(nodes, particles.position[p]);
    Vec<D> v = Vec<D>::Zero();
    Eigen::Matrix<double, D, D> C = Eigen::Matrix<double, D, D>::Zero();
    Particles::Stress lambda = Particles::Stress::Zero();
    for (std::size_t k = 0; k < Stencil<D>::kNodes; ++k) {
      const int slot = nodes.slot_of[static_cast<std::size_t>(s.node[k])];
      if (slot < 0) continue;
      const Vec<D> at = velocity[static_cast<std::size_t>(slot)].template head<D>();
      v += s.weight[k] * at;
      C += at * s.gradient[k].transpose();
      lambda += s.weight[k] * stress[static_cast<std::size_t>(slot)];
    }
    particles.velocity[p].template head<D>() = v;
    particles.affine[p].template topLeftCorner<D, D>() = C;
    particles.stress[p] = lambda;
    particles.position[p].template head<D>() += h * v;
    if (material.friction_rise == 0.0 && material.cohesion_decay == 0.0) continue;
    const Sym<D> rate = to_sym<D>(0.5 * (C + C.transpose()));
    if (material.friction_rise > 0.0) {
      particles.inertial_number[p] = inertial_number<D>(scene, rate, lambda);
    }
    const double strain = h * 2.0 * rate.tail(kEntries<D> - 1).norm();
    particles.cohesion[p] *= std::exp(-material.cohesion_decay * strain);
  }
}

template <int D>
double crossed_in(const Nodes& nodes, const std::vector<Eigen::Vector3d>& velocity,
                  const Particles& particles) {
  const Grid& grid = nodes.mesh.grid();
  double most = 0.0;
  for (std::size_t p = 0; p < particles.count(); ++p) {
    const Stencil<D> s = active_stencil<D>(nodes, particles.position[p]);
    Vec<D> v = Vec<D>::Zero();
    for (std::size_t k = 0; k < Stencil<D>::kNodes; ++k) {
      const int slot = nodes.slot_of[static_cast<std::size_t>(s.node[k])];
      if (slot < 0) continue;
      v += s.weight[k] * velocity[static_cast<std::size_t>(slot)].template head<D>();
    }
    for (int a = 0; a < D; ++a) most = std::max(most, std::abs(v[a]) / grid.spacing(a));
  }
  return most;
}

}  // namespace

void gather(const Scene& scene, const Nodes& nodes, const std::vector<Eigen::Vector3d>& velocity,
            const std::vector<Particles::Stress>& stress, double h, Particles& particles) {
  if (scene.grid.dim == 2) {
    gather_in<2>(scene, nodes, velocity, stress, h, particles);
  } else {
    gather_in<3>(scene, nodes, velocity, stress, h, particles);
  }
}

double cells_crossed(const Nodes& nodes, const std::vector<Eigen::Vector3d>& velocity,
                     const Particles& particles, double h) {
  const Grid& grid = nodes.mesh.grid();
  double bound = 0.0;  // no particle is faster than the nodes around it
  for (const Eigen::Vector3d& v : velocity) {
    for (int a = 0; a < grid.dim; ++a) bound = std::max(bound, std::abs(v[a]) / grid.spacing(a));
  }
  if (h * bound <= 1.0) return h * bound;
  return h * (grid.dim == 2 ? crossed_in<2>(nodes, velocity, particles)
                            : crossed_in<3>(nodes, velocity, particles));
}

}  // namespace conebench::mpm
