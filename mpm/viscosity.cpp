#include "mpm/viscosity.h"

namespace conebench::mpm {
namespace {

// 2 eta D : D' = eta (b v) . (b v') with b the strain block: D : D' = 2 Dbar . Dbar', 2 Dbar = b v.
template <int D>
problems::SparseMatrix form_in(const Scene& scene, const Particles& particles, const Nodes& nodes,
                               const std::vector<std::array<int, 3>>& dof, int dofs) {
  constexpr std::size_t kNodes = Stencil<D>::kNodes;
  std::vector<Eigen::Triplet<double, int>> entries;
  for (std::size_t p = 0; p < particles.count(); ++p) {
    const Stencil<D> s = active_stencil<D>(nodes, particles.position[p]);
    Eigen::Matrix<double, kEntries<D>, D*(1 << D)> strain;
    std::array<int, D * kNodes> column;
    for (std::size_t k = 0; k < kNodes; ++k) {
      const auto first = static_cast<Eigen::Index>(D * k);
      strain.template middleCols<D>(first) = strain_block<D>(s.gradient[k]);
      const int slot = nodes.slot_of[static_cast<std::size_t>(s.node[k])];
      for (std::size_t a = 0; a < D; ++a) {
        column[D * k + a] = slot < 0 ? -1 : dof[static_cast<std::size_t>(slot)][a];
      }
    }
    const double weight = scene.material.viscosity_Pa_s * particles.volume[p];
    for (std::size_t i = 0; i < column.size(); ++i) {
      for (std::size_t j = 0; j < column.size(); ++j) {
        if (column[i] < 0 || column[j] < 0) continue;
        const double value =
            strain.col(static_cast<Eigen::Index>(i)).dot(strain.col(static_cast<Eigen::Index>(j)));
        entries.emplace_back(column[i], column[j], weight * value);
      }
    }
  }
  problems::SparseMatrix K(dofs, dofs);
  K.setFromTriplets(entries.begin(), entries.end());
  return K;
}

}  // namespace

problems::SparseMatrix viscous_form(const Scene& scene, const Particles& particles,
                                    const Nodes& nodes, const std::vector<std::array<int, 3>>& dof,
                                    int dofs) {
  return scene.grid.dim == 2 ? form_in<2>(scene, particles, nodes, dof, dofs)
                             : form_in<3>(scene, particles, nodes, dof, dofs);
}

}  // namespace conebench::mpm
