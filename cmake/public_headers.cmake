# The headers that are installed: what programs of one's own call, and whatever those include.
# None names a type of HDF5, SuiteSparse, Ipopt, NLopt, Bullet or SQLite.
set(conebench_problems_headers
  problems/carry_over.h problems/collection.h problems/cone.h problems/engine/checkpoint.h
  problems/engine/exporter.h problems/engine/island_solver.h problems/engine/provisional_folder.h
  problems/engine/scene_file.h problems/engine/step_sample.h problems/engine/step_selection.h
  problems/engine/step_solver.h problems/engine/svg.h problems/engine/text_file.h
  problems/engine/toml_reader.h problems/engine/vtk.h problems/engine/write_queue.h
  problems/error.h problems/fclib.h problems/features_json.h problems/inertia.h problems/load.h
  problems/made_backwards.h problems/problem.h problems/problem_file.h problems/residual.h
  problems/siconos_dat.h problems/sparse.h problems/spectrum.h problems/suggest.h)
set(conebench_solvers_headers
  solvers/certificate.h solvers/external.h solvers/iteration.h solvers/local/exact.h
  solvers/local/isotropic.h solvers/local/outcome.h
  solvers/method.h solvers/monitor.h solvers/registry.h solvers/solver.h solvers/variant_text.h)
set(conebench_dem_headers
  dem/assembly.h dem/bodies.h dem/contacts.h dem/energy.h dem/export.h dem/generators/arch.h
  dem/generators/bed.h dem/generators/clump.h dem/generators/column.h dem/generators/deposition.h
  dem/generators/drum.h dem/generators/generator.h dem/generators/hopper.h
  dem/generators/lattice.h dem/generators/stack.h dem/generators/tower.h dem/generators/wall.h
  dem/hierarchical_grid.h dem/motion.h dem/narrow_phase.h dem/neighbours.h dem/pair_list.h
  dem/placement.h dem/row_order.h dem/row_table.h dem/scene.h dem/shape.h dem/simulation.h
  dem/solid.h dem/step.h dem/svg_frame.h)
set(conebench_mpm_headers
  mpm/assembly.h mpm/cohesion_law.h mpm/export.h mpm/grid.h mpm/mesh.h mpm/nodes.h mpm/particles.h
  mpm/rigid_body.h mpm/scene.h mpm/simulation.h mpm/step.h mpm/svg_frame.h mpm/tensor.h)
set(conebench_results_headers
  results/bootstrap.h results/compare.h results/journal.h results/line_file.h
  results/paired_quantities.h results/profiles.h results/record.h results/shares.h
  results/status.h results/store.h results/tails.h results/text.h)
