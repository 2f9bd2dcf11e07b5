// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>

#include "vesicle/coefficients.h"
#include "vesicle/export.h"
#include "vesicle/sphere_grid.h"
#include "vesicle/surface.h"
#include "vesicle/types.h"

namespace vesiflow::vesicle {

/// How the degrees that are kept end.
enum class DegreeCut {
  /// Degrees below the cut as they are. A projection: applied twice it does no more than once, and a field of low
  /// degrees comes back as it was.
  sharp,
  /// Degree n times exp(-36 (n / degrees)^8): of degrees = 12, 97 % of n = 5, 62 % of n = 7, 2e-8 of n = 11. It does
  /// not ring where a field is not resolved, but damps as often as it is applied.
  smooth
};

/// What of a membrane's forces and jumps is kept.
struct JumpParameters {
  /// Degrees n < degrees of force and velocity jump are kept. A fluid grid of spacing h resolves n <= 1.5 R / h on a
  /// body of radius R. 0: force and velocity jump as they are.
  int degrees = 0;
  /// Degrees n < jump_degrees of the jumps are kept: force and geometry of few degrees make jumps of many. 0: as
  /// `degrees` says, or all that the surface has, its number of latitudes.
  int jump_degrees = 0;
  DegreeCut cut = DegreeCut::sharp;  ///< how those of less degrees than the surface end
};

/// Where the jumps are among the fields of MembraneJumps::coefficients() and the columns of
/// MembraneJumps::at_markers(): first columns of vectors are those of their x. The first twelve are always there.
struct JumpColumns {
  static constexpr int pressure = 0;                ///< [p]
  static constexpr int pressure_normal = 1;         ///< [p_n]
  static constexpr int pressure_second_normal = 2;  ///< [p_nn]
  static constexpr int velocity_normal = 3;         ///< [u_n], three columns
  static constexpr int velocity_second_normal = 6;  ///< [u_nn], three columns
  static constexpr int velocity_third_normal = 9;   ///< [u_nnn], three columns
  static constexpr int velocity = 12;               ///< [u], three columns, only with a velocity jump
  static constexpr int without_velocity_jump = 12;  ///< number of columns if [u] = 0
  static constexpr int with_velocity_jump = 15;     ///< number of columns otherwise
};

/// Jumps of velocity and pressure and of their normal derivatives across a membrane in a viscous fluid of viscosity 1
/// on both sides, [g] = outside - inside, from the force F of the membrane on the fluid per area and a jump q = [u] of
/// the velocity. With n the outward normal, S = grad_s n, kappa = div n = 2H (2 / R on a sphere), |S|^2 = 4 H^2 - 2K,
/// F_t the tangential part of F, and (grad_s q . n)_i = n_j d_i q_j, S : grad_s q = S_ij d_i q_j:
///
///     [u_n]   = -F_t - (grad_s q . n) - n div_s q
///     [p]     = F . n - 2 div_s q
///     [p_n]   = -div_s [u_n] + S : grad_s q + kappa n . [u_n] + n . Lap_s q
///     [u_nn]  = n [p_n] + grad_s [p] - kappa [u_n] - Lap_s q
///     [p_nn]  = -kappa [p_n] - Lap_s [p]
///     [u_nnn] = n [p_nn] + grad_s [p_n] - S grad_s [p] - kappa [u_nn] + |S|^2 [u_n] - Lap_s [u_n]
///               - grad_s kappa . grad_s q + 2 div_s (S grad_s q)
///
/// A side's velocity near the membrane, at the signed distance d (positive outside) along the normal, is that of the
/// other side and +- D_u = [u] + d [u_n] + d^2/2 [u_nn] + d^3/6 [u_nnn]; the pressure's is
/// D_p = [p] + d [p_n] + d^2/2 [p_nn]. The derivation, its sources (LeVeque & Li 1997; Xu & Wang 2006) and what changes
/// with inertia are in docs/jump_conditions.md. Two viscosities: u and q are those of mu u, of each side with its mu.
///
/// Surface derivatives are spectral: first and second derivatives of expansions, at the markers. Only q, [u_n], [p] and
/// a part of [p_n] are ever expanded, so that no error of an expansion is differentiated more than twice.
///
/// update() once for a shape, compute() for each force or velocity jump on it. Nothing allocates once both have been
/// called in the way that they are called again. The bits do not depend on the number of threads. One thread at a time.
class VESIFLOW_VESICLE_EXPORT MembraneJumps {
 public:
  /// For membranes on that grid.
  /// \throws std::invalid_argument unless the grid has 4 to 512 latitudes and both numbers of degrees are in
  /// [0, latitudes].
  explicit MembraneJumps(const SphereGrid& grid, const JumpParameters& parameters = {});
  ~MembraneJumps();
  MembraneJumps(MembraneJumps&&) noexcept;             ///< what is moved from can only be assigned to or destroyed
  MembraneJumps& operator=(MembraneJumps&&) noexcept;  ///< takes over the work space of another one

  const SphereGrid& grid() const;            ///< the grid of the markers
  const JumpParameters& parameters() const;  ///< the parameters that were given

  /// Takes the geometry of the surface, which may change or go afterwards. Jumps computed before stay.
  /// \throws std::invalid_argument if the surface is on another grid.
  void update(const Surface& surface);

  /// Computes the jumps of a membrane across which the velocity is continuous, q = 0.
  /// \param force F, force per area on the fluid, shape (markers, 3).
  /// \throws std::invalid_argument for a wrong size.
  /// \throws std::domain_error for a value that is not finite (with the first such marker).
  /// \throws std::logic_error before the first update(). The jumps are then as they were, as after the other errors.
  void compute(const VectorField& force);

  /// Computes the jumps with a jump of the velocity.
  /// \param force F, force per area on the fluid, shape (markers, 3).
  /// \param velocity_jump q = [u], shape (markers, 3).
  /// \throws std::invalid_argument for a wrong size.
  /// \throws std::domain_error for a value that is not finite (with the first such marker).
  /// \throws std::logic_error before the first update(). The jumps are then as they were, as after the other errors.
  void compute(const VectorField& force, const VectorField& velocity_jump);

  /// Whether the last compute() had a velocity jump.
  bool has_velocity_jump() const;

  /// The jumps of the last compute() as expansions, in the order of JumpColumns: 12 fields, or 15 with a velocity jump.
  /// To be synthesised on any mesh. As many degrees as are kept; no fields before the first compute().
  const Coefficients& coefficients() const;

  /// The jumps of the last compute() at the markers, shape (markers, 12), or (markers, 15) with a velocity jump, in the
  /// order of JumpColumns. Those of the filtered F and q, not filtered again: more exact than coefficients() where
  /// these are cut off. Zero before the first compute().
  Eigen::Ref<const Eigen::ArrayXXd> at_markers() const;

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace vesiflow::vesicle
