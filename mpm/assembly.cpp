#include "mpm/assembly.h"

#include <algorithm>

#include "mpm/viscosity.h"
#include "mpm/walls.h"

namespace conebench::mpm {
namespace {

using problems::Cone;
using problems::SparseMatrix;

// Rows of H, one after the other, written straight into compressed storage.
class RowWriter {
 public:
  RowWriter(Eigen::Index rows, Eigen::Index columns, Eigen::Index nonzeros)
      : matrix_(rows, columns) {
    matrix_.reserve(nonzeros);
  }

  void open() { matrix_.startVec(row_); }
  void add(int column, double value) {
    if (value != 0.0) matrix_.insertBack(row_, column) = value;
  }
  void close() { ++row_; }

  SparseMatrix finish() {
    matrix_.finalize();
    return std::move(matrix_);
  }

 private:
  SparseMatrix matrix_;
  Eigen::Index row_ = 0;
};

// The step's problem while it is being put together; D is the dimension of space.
template <int D>
class Assembler {
 public:
  Assembler(const Scene& scene, const Particles& particles, const Nodes& nodes,
            const std::vector<RigidBody>& bodies, double time_s, double h)
      : scene_(scene), particles_(particles), nodes_(nodes), bodies_(bodies), h_(h) {
    const Material& m = scene.material;
    stress_dim_ = m.friction == 0.0 && m.friction_rise == 0.0 ? 1 : kEntries<D>;
    for (const int node : nodes.index) walls_.push_back(walls_at(scene, node, time_s));
  }

  Assembly run() {
    number_dofs();
    fill_inertia();
    out_.interfaces = find_interfaces(scene_, nodes_, bodies_);
    list_cones();
    fill_strain();
    fill_law();
    fill_guess();
    return std::move(out_);
  }

 private:
  static constexpr int kSpin = D == 2 ? 1 : 3;
  static constexpr int kBodyDofs = D + kSpin;
  static constexpr int kMostNeighbours = neighbour_count(D, 2);

  void number_dofs() {
    dofs_ = 0;
    for (const NodeWalls& walls : walls_) {
      std::array<int, 3> dof = {-1, -1, -1};
      for (std::size_t a = 0; a < D; ++a) {
        if (!walls.held[a]) dof[a] = dofs_++;
      }
      out_.dof.push_back(dof);
    }
    for (const RigidBody& body : bodies_) {
      out_.body_dof.push_back(body.moves_freely() ? dofs_ : -1);
      if (body.moves_freely()) dofs_ += kBodyDofs;
    }
  }

  void fill_inertia() {
    const Material& m = scene_.material;
    std::vector<Eigen::Triplet<double, int>> entries;
    Eigen::VectorXd momentum = Eigen::VectorXd::Zero(dofs_);
    for (int i = 0; i < nodes_.count(); ++i) {
      const auto slot = static_cast<std::size_t>(i);
      const double mass = m.density_kg_m3 * nodes_.solid[i];
      const Eigen::Vector3d v = nodes_.velocity[slot] + h_ * scene_.gravity_m_s2;
      for (std::size_t a = 0; a < D; ++a) {
        const int dof = out_.dof[slot][a];
        if (dof < 0) continue;
        entries.emplace_back(dof, dof, mass);
        momentum[dof] = mass * v[static_cast<Eigen::Index>(a)];
      }
    }
    for (std::size_t b = 0; b < bodies_.size(); ++b) add_body_inertia(b, entries, momentum);
    out_.data.M.resize(dofs_, dofs_);
    out_.data.M.setFromTriplets(entries.begin(), entries.end());
    apply_viscosity(momentum);
  }

  void add_body_inertia(std::size_t b, std::vector<Eigen::Triplet<double, int>>& entries,
                        Eigen::VectorXd& momentum) {
    const RigidBody& body = bodies_[b];
    const int first = out_.body_dof[b];
    if (first < 0) return;
    const Eigen::Matrix3d inertia = body.inertia_tensor();
    const Eigen::Vector3d omega = body.angular_velocity;
    const Eigen::Vector3d spin = inertia * omega - h_ * omega.cross(inertia * omega);
    const Eigen::Vector3d v = body.velocity + h_ * scene_.gravity_m_s2;
    for (int a = 0; a < D; ++a) {
      entries.emplace_back(first + a, first + a, body.mass);
      momentum[first + a] = body.mass * v[a];
    }
    for (int a = 0; a < kSpin; ++a) {
      const int row = D == 2 ? 2 : a;
      momentum[first + D + a] = spin[row];
      for (int c = 0; c < kSpin; ++c) {
        entries.emplace_back(first + D + a, first + D + c, inertia(row, D == 2 ? 2 : c));
      }
    }
  }

  // Leaves the free velocity, and f = M v* with the M of the cone problem.
  void apply_viscosity(const Eigen::VectorXd& momentum) {
    SparseMatrix& M = out_.data.M;
    if (scene_.material.viscosity_Pa_s == 0.0) {
      out_.free_velocity = problems::Inertia(M, scene_.name).solve(momentum);
      out_.data.f = momentum;
      return;
    }
    const SparseMatrix viscous = M + h_ * viscous_form(scene_, particles_, nodes_, out_.dof, dofs_);
    out_.free_velocity = problems::Inertia(viscous, scene_.name).solve(momentum);
    if (scene_.material.viscosity_in_mass) {
      M = viscous;
      out_.data.f = momentum;
    } else {
      out_.data.f = M * out_.free_velocity;
    }
  }

  void list_cones() {
    for (int i = 0; i < nodes_.count(); ++i) {
      out_.cones.push_back(Cone::coulomb(stress_dim_, cone_friction(D, nodes_.friction[i])));
    }
    for (const Interface& contact : out_.interfaces) {
      const int dim = contact.friction == 0.0 ? 1 : D;
      out_.cones.push_back(Cone::coulomb(dim, contact.friction));
    }
  }

  void fill_strain() {
    Eigen::Index rows = stress_dim_ * nodes_.count();
    for (const Interface& contact : out_.interfaces) rows += contact.friction == 0.0 ? 1 : D;
    const Eigen::Index nonzeros =
        stress_dim_ * nodes_.count() * neighbour_count(D, 1) * D + (D + 2 * kBodyDofs) * rows;
    RowWriter writer(rows, dofs_, nonzeros);
    out_.data.w = Eigen::VectorXd::Zero(rows);
    for (int i = 0; i < nodes_.count(); ++i) write_stress_rows(i, writer);
    Eigen::Index row = stress_dim_ * nodes_.count();
    for (const Interface& contact : out_.interfaces) row = write_interface(contact, row, writer);
    out_.data.H = writer.finish();
  }

  // The shear components on a slip wall: no traction along it.
  std::array<bool, kEntries<D>> silent_rows(const NodeWalls& walls) const {
    std::array<bool, kEntries<D>> silent{};
    const auto& s = walls.smooth;
    if constexpr (D == 2) {
      silent[2] = s[0] || s[1];
    } else {
      silent[3] = s[0] || s[1];
      silent[4] = s[0] || s[2];
      silent[5] = s[1] || s[2];
    }
    return silent;
  }

  void write_stress_rows(int node, RowWriter& writer) {
    struct Block {
      const std::array<int, 3>* dof;
      Eigen::Matrix<double, kEntries<D>, D> strain;
    };
    std::array<Block, kMostNeighbours> blocks;
    std::size_t count = 0;
    const auto slot = static_cast<std::size_t>(node);
    const Grid& grid = nodes_.mesh.grid();
    const int row = grid.cells[0] + 1, layer = row * (grid.cells[1] + 1);
    const int reach = nodes_.mesh.reach(), side = 2 * reach + 1;
    const int neighbours = neighbour_count(D, reach);
    const Eigen::Vector3d* coupling = nodes_.coupling.data() + Eigen::Index{node} * neighbours;
    for (int k = 0; k < neighbours; ++k) {
      const Vec<D> g = coupling[k].template head<D>();
      if (g.isZero(0.0)) continue;
      const int other = nodes_.index[slot] + k % side - reach + (k / side % side - reach) * row +
                        (D == 3 ? k / (side * side) - reach : 0) * layer;
      const int place = nodes_.slot_of[static_cast<std::size_t>(other)];
      if (place < 0) continue;
      blocks[count++] = {&out_.dof[static_cast<std::size_t>(place)], strain_block<D>(g)};
    }
    const auto silent = silent_rows(walls_[slot]);
    for (int r = 0; r < stress_dim_; ++r) {
      writer.open();
      for (std::size_t k = 0; k < count && !silent[static_cast<std::size_t>(r)]; ++k) {
        for (int a = 0; a < D; ++a) {
          const int dof = (*blocks[k].dof)[static_cast<std::size_t>(a)];
          if (dof >= 0) writer.add(dof, blocks[k].strain(r, a));
        }
      }
      writer.close();
    }
  }

  Eigen::Index write_interface(const Interface& contact, Eigen::Index row, RowWriter& writer) {
    const int dim = contact.friction == 0.0 ? 1 : D;
    const double sign = contact.node < 0 ? 1.0 : -1.0;  // the body itself moves, or what it meets
    for (int r = 0; r < dim; ++r, ++row) {
      const Eigen::Vector3d along = contact.weight * contact.frame.col(r);
      writer.open();
      if (contact.node >= 0) {
        const auto& dof = out_.dof[static_cast<std::size_t>(contact.node)];
        for (int a = 0; a < D; ++a) {
          if (dof[static_cast<std::size_t>(a)] >= 0) {
            writer.add(dof[static_cast<std::size_t>(a)], along[a]);
          }
        }
      }
      if (contact.body >= 0) write_body(contact, sign * along, row, writer);
      writer.close();
      if (r == 0) out_.data.w[row] += contact.weight * contact.gap_m / h_;
    }
    return row;
  }

  // `along` . (velocity of the body at the contact): unknown for a free body, data otherwise.
  void write_body(const Interface& contact, const Eigen::Vector3d& along, Eigen::Index row,
                  RowWriter& writer) {
    const auto b = static_cast<std::size_t>(contact.body);
    const RigidBody& body = bodies_[b];
    const int first = out_.body_dof[b];
    if (first < 0) {
      out_.data.w[row] += along.dot(body.velocity_at(contact.point));
      return;
    }
    const Eigen::Vector3d turn = (contact.point - body.centre_m).cross(along);
    for (int a = 0; a < D; ++a) writer.add(first + a, along[a]);
    for (int a = 0; a < kSpin; ++a) writer.add(first + D + a, turn[D == 2 ? 2 : a]);
  }

  void fill_law() {
    const double phi_max = scene_.material.phi_max;
    const int count = nodes_.count();
    LawInput& law = out_.law;
    law.density.resize(count);
    law.gap.resize(count);
    law.tip.resize(count);
    law.free_rate.resize(count);
    const Eigen::VectorXd rate = out_.data.H * out_.free_velocity;
    for (int i = 0; i < count; ++i) {
      const double room = phi_max * (nodes_.volume[i] - nodes_.covered[i]);
      const double gap = std::max(0.0, room - nodes_.solid[i]);
      law.density[i] = nodes_.solid[i] / std::max(room, phi_max * 1e-3 * nodes_.volume[i]);
      law.gap[i] = std::sqrt(2.0 / D) * gap / h_;
      law.tip[i] = h_ * cone_tip(D, nodes_.friction[i], nodes_.cohesion[i]);
      law.free_rate[i] = rate[i * stress_dim_];
    }
  }

  void fill_guess() {
    out_.guess.resize(out_.data.H.rows());
    for (int i = 0; i < nodes_.count(); ++i) {
      out_.guess.segment(i * stress_dim_, stress_dim_) =
          h_ * nodes_.stress[static_cast<std::size_t>(i)].head(stress_dim_);
    }
    Eigen::Index row = stress_dim_ * nodes_.count();
    for (const Interface& contact : out_.interfaces) {
      const int dim = contact.friction == 0.0 ? 1 : D;
      const Eigen::Vector3d r = traction(contact);
      for (int k = 0; k < dim; ++k) out_.guess[row++] = r[k];
    }
  }

  // h times the traction of the node's stress on the interface, in its frame.
  Eigen::Vector3d traction(const Interface& contact) const {
    if (contact.node < 0) return Eigen::Vector3d::Zero();
    const Sym<D> s =
        nodes_.stress[static_cast<std::size_t>(contact.node)].template head<kEntries<D>>();
    const Vec<D> normal = contact.frame.col(0).template head<D>();
    Eigen::Vector3d out = Eigen::Vector3d::Zero();
    out.head<D>() =
        contact.frame.template topLeftCorner<D, D>().transpose() * (h_ * to_tensor<D>(s) * normal);
    return out;
  }

  const Scene& scene_;
  const Particles& particles_;
  const Nodes& nodes_;
  const std::vector<RigidBody>& bodies_;
  double h_;
  int stress_dim_ = 0, dofs_ = 0;
  std::vector<NodeWalls> walls_;
  Assembly out_;
};

}  // namespace

Assembly assemble(const Scene& scene, const Particles& particles, const Nodes& nodes,
                  const std::vector<RigidBody>& bodies, double time_s, double h) {
  if (scene.grid.dim == 2) {
    return Assembler<2>(scene, particles, nodes, bodies, time_s, h).run();
  }
  return Assembler<3>(scene, particles, nodes, bodies, time_s, h).run();
}

std::vector<Eigen::Vector3d> node_velocities(const Assembly& assembly, const Eigen::VectorXd& v) {
  std::vector<Eigen::Vector3d> out(assembly.dof.size(), Eigen::Vector3d::Zero());
  for (std::size_t i = 0; i < out.size(); ++i) {
    for (std::size_t a = 0; a < 3; ++a) {
      const int dof = assembly.dof[i][a];
      if (dof >= 0) out[i][static_cast<Eigen::Index>(a)] = v[dof];
    }
  }
  return out;
}

}  // namespace conebench::mpm
