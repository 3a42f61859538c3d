/* SPDX-License-Identifier: Apache-2.0 */

/* The PHYSICAL model by brute force: every wavelength, every order, in double, straight from the
 * formulas at the head of physical_model.h, the film by the transfer-matrix method. Slow on
 * purpose; what the renderer's evaluation is compared with (host only). */

#pragma once

#include <complex>

#include "metal_table.h"
#include "physical.h"
#include "reference.h"

namespace icwafer::reference {

using Amplitude = std::complex<double>;

/* Amplitude of a film on metal: {s, p}. The characteristic matrix of the film (Born and Wolf,
 * "Principles of Optics", 7th ed., section 1.6.2) carries the tangential fields from the metal to
 * the air. exp(-i omega t), so an absorbing metal has a positive imaginary part. */
inline std::array<Amplitude, 2> film_on_metal(const double cos_air,
                                              const double film_ior,
                                              const Amplitude metal,
                                              const double thickness_nm,
                                              const double wavelength_nm)
{
  const double sin_squared = 1.0 - cos_air * cos_air;
  const Amplitude below = std::sqrt(metal * metal - sin_squared);
  const double film = std::sqrt(film_ior * film_ior - sin_squared);
  const double delta = 2.0 * M_PI * film * thickness_nm / wavelength_nm;
  const Amplitude i(0.0, 1.0);
  std::array<Amplitude, 2> r;
  for (int polarisation = 0; polarisation < 2; polarisation++) {
    /* Admittances, tangential magnetic over electric field: n cos theta for s, n / cos theta for
     * p. The sign of p is that in which s and p agree at normal incidence, up to the sign of r. */
    const bool s = polarisation == 0;
    const double y_air = s ? cos_air : 1.0 / cos_air;
    const double y_film = s ? film : film_ior * film_ior / film;
    const Amplitude y_metal = s ? below : metal * metal / below;
    const Amplitude b = std::cos(delta) - i * std::sin(delta) / y_film * y_metal;
    const Amplitude c = -i * y_film * std::sin(delta) + std::cos(delta) * y_metal;
    r[polarisation] = (y_air * b - c) / (y_air * b + c);
  }
  return r;
}

/* Amplitudes of ridge and groove. */
struct PhysicalLevels {
  std::array<Amplitude, 2> ridge, groove;
};

inline PhysicalLevels physical_levels(const PhysicalParams &p,
                                      const double cosine,
                                      const double wavelength_nm)
{
  const double x = 1.0 / (wavelength_nm * wavelength_nm);
  const double film_ior = p.oxide.a + x * (p.oxide.b + x * p.oxide.c);
  const ComplexIndex index = p.metal == metal_custom ?
                                 physical_detail::custom_index(p, float(wavelength_nm)) :
                                 metal_index_at(p.metal, float(wavelength_nm), [](const int i) {
                                   return metal_table[i];
                                 });
  const Amplitude metal(index.n, index.k);
  return {film_on_metal(cosine, film_ior, metal, p.oxide_nm, wavelength_nm),
          film_on_metal(cosine, film_ior, metal, double(p.oxide_nm) + p.groove_nm, wavelength_nm)};
}

/* |U_mn|^2 */
inline double physical_weight(const PhysicalParams &p, const int m, const int n)
{
  const auto amplitude = [](const int order, const double duty) {
    return order == 0 ? duty : std::sin(M_PI * order * duty) / (M_PI * order);
  };
  const double f_u = p.across.duty, f_v = p.along.spacing_nm > 0.0f ? p.along.duty : 0.0;
  const double a = amplitude(m, f_u), b = amplitude(n, f_v);
  const double u = m == 0 ? (n == 0 ? f_u + f_v - f_u * f_v : b * (1.0 - f_u)) :
                            (n == 0 ? a * (1.0 - f_v) : a * b);
  return u * u;
}

/* |r_ridge - r_groove|^2, mean of s and p. */
inline double physical_contrast(const PhysicalLevels &r)
{
  return 0.5 * (std::norm(r.ridge[0] - r.groove[0]) + std::norm(r.ridge[1] - r.groove[1]));
}

/* Orders of a lattice below the horizon, at the shortest wavelength. */
inline int last_order(const Lattice lattice, const double reach = 2.2)
{
  return lattice.spacing_nm > 0.0f ? int(reach * lattice.spacing_nm / visible_first_nm) : 0;
}

/* Sum of eta_mn over the orders other than (0, 0) for light whose mirror direction has the
 * tangential part (nu, tau). */
inline double physical_diffracted(const PhysicalParams &p,
                                  const double nu,
                                  const double tau,
                                  const double wavelength_nm)
{
  const double cosine = std::sqrt(std::max(1.0 - nu * nu - tau * tau, 0.0));
  const int last_m = last_order(p.across), last_n = last_order(p.along);
  double sum = 0.0;
  for (int m = -last_m; m <= last_m; m++) {
    for (int n = -last_n; n <= last_n; n++) {
      const double x = nu + m * wavelength_nm / p.across.spacing_nm;
      const double y = tau + (n == 0 ? 0.0 : n * wavelength_nm / p.along.spacing_nm);
      const double cos_squared = 1.0 - x * x - y * y;
      const double weight = physical_weight(p, m, n);
      if ((m != 0 || n != 0) && cos_squared > 0.0 && weight > 1e-9) {
        const double c = 0.5 * (cosine + std::sqrt(cos_squared));
        sum += weight * physical_contrast(physical_levels(p, c, wavelength_nm));
      }
    }
  }
  return sum;
}

/* eta_00': the mirror order, for directions whose half difference is (nu, tau). */
inline double physical_mirror(const PhysicalParams &p,
                              const PhysicalLevels &r,
                              const double nu,
                              const double tau,
                              const double wavelength_nm)
{
  const double part = std::sqrt(physical_weight(p, 0, 0));
  double eta = 0.0;
  for (int polarisation = 0; polarisation < 2; polarisation++) {
    eta += 0.5 * std::norm(part * r.ridge[polarisation] + (1.0 - part) * r.groove[polarisation]);
  }
  return std::max(std::min(eta, 1.0 - physical_diffracted(p, nu, tau, wavelength_nm)), 0.0);
}

/* f at one wavelength. */
inline double physical_spectral(const PhysicalParams &p,
                                const LocalDirection i,
                                const LocalDirection o,
                                const double wavelength_nm)
{
  const double u = double(i.nu) + o.nu, v = double(i.tau) + o.tau;
  const auto lobe = [&](const Lattice &axis, const double q, const double shift) {
    const double sigma = std::sqrt(std::pow(axis.coherence_per_nm * wavelength_nm, 2) +
                                   std::pow(double(p.roughness), 2) +
                                   std::pow(p.variation * shift, 2));
    const double t = (q - shift) / sigma;
    return std::exp(-0.5 * t * t) / (sigma * std::sqrt(2.0 * M_PI));
  };
  const PhysicalLevels r = physical_levels(
      p, std::fmax(0.5 * (double(i.n) + o.n), 1e-4), wavelength_nm);
  const double contrast = physical_contrast(r);
  const int last_m = last_order(p.across, 2.6), last_n = last_order(p.along, 2.6);
  double f = 0.0;
  for (int n = -last_n; n <= last_n; n++) {
    const double lobe_n = lobe(p.along, v, n == 0 ? 0.0 : n * wavelength_nm / p.along.spacing_nm);
    if (lobe_n < 1e-12) {
      continue;
    }
    for (int m = -last_m; m <= last_m; m++) {
      const double lobe_m = lobe(p.across, u, m * wavelength_nm / p.across.spacing_nm);
      if (lobe_m < 1e-12) {
        continue;
      }
      const double eta = m == 0 && n == 0 ? physical_mirror(p,
                                                            r,
                                                            0.5 * (double(i.nu) - o.nu),
                                                            0.5 * (double(i.tau) - o.tau),
                                                            wavelength_nm) :
                                            physical_weight(p, m, n) * contrast;
      f += eta * lobe_m * lobe_n;
    }
  }
  return f;
}

/* physical_eval by a sum over the visible range in steps of 1 / per_nm nanometre. */
inline Rgb physical_eval(const PhysicalParams &p,
                         const LocalDirection i,
                         const LocalDirection o,
                         const ColourTable &table,
                         const int per_nm = 4)
{
  Rgb sum = {0.0, 0.0, 0.0};
  for (int k = 0; k < (visible_count - 1) * per_nm; k++) {
    const double position = (k + 0.5) / per_nm;
    const double f = physical_spectral(p, i, o, visible_first_nm + position);
    const int cell = int(position);
    const double t = position - cell;
    const auto s = [&](int c) { return (1.0 - t) * table[cell][c] + t * table[cell + 1][c]; };
    sum.r += f * s(0);
    sum.g += f * s(1);
    sum.b += f * s(2);
  }
  return {sum.r / per_nm, sum.g / per_nm, sum.b / per_nm};
}

}  // namespace icwafer::reference
