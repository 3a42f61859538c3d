/* SPDX-License-Identifier: Apache-2.0 */

/* The PHYSICAL model: metal wires under oxide as a phase grating, in one amplitude formula.
 *
 * The surface has two levels. On the ridges (the wires) oxide of thickness h covers the metal, in
 * the grooves oxide of thickness h + t covers metal that lies deeper by t. Each level reflects
 * with the amplitude r of its film stack (film.h). Ridges fill the part f of a period, and a
 * second family of wires at 90 degrees may cross the first at the same level. The pattern's
 * Fourier series gives the amplitude of order (m, n), in the scalar (Fraunhofer) approximation
 * (Goodman, "Introduction to Fourier Optics", 3rd ed., section 4.4):
 *
 *   eta_mn = U_mn^2 |r_ridge - r_groove|^2                         (m, n) != (0, 0)
 *   eta_00 = |F r_ridge + (1 - F) r_groove|^2,  F = 1 - (1 - f_u)(1 - f_v)
 *   U_m0 = A_u(m) (1 - f_v),  U_0n = A_v(n) (1 - f_u),  U_mn = A_u(m) A_v(n)
 *
 * with A(m) = sin(pi m f) / (pi m), s and p averaged, and the cosine of the angle of incidence
 * the mean of those of the two directions, which makes it reciprocal. The BRDF is the density of
 * reflected power in direction cosines,
 *
 *   f = sum_mn eta_mn G(u - m lambda / d_u; sigma_m) G(v - n lambda / d_v; sigma_n)
 *
 * and a lobe's width comes from the coherence width W, the roughness and the spread of the
 * spacing: sigma_m^2 = (0.376 lambda / W)^2 + sigma_rough^2 + (variation m lambda / d)^2 (0.376
 * turns the full width at half maximum 0.886 lambda / W of an aperture W wide into a Gaussian's).
 * Along the wires W is the length over which they run on undisturbed.
 *
 * Energy. At one cosine, Parseval's theorem gives sum eta = F |r_ridge|^2 + (1 - F) |r_groove|^2
 * <= 1. As each order has its own cosine, the sum may pass 1. The orders other than (0, 0) never
 * do so alone: their U^2 add up to F (1 - F) <= 1/4, and |r_ridge - r_groove|^2 <= 4. So the
 * mirror order, whose pair of directions no other order shares, gives way:
 *
 *   eta_00' = min(eta_00, 1 - sum of the others)
 *
 * which is the same in both directions, and leaves everything else as it is. */

#pragma once

#include "film.h"
#include "grating.h"
#include "illuminants.h"
#include "metals.h"
#include "order_sum.h"
#include "oxides.h"
#include "spectrum.h"

namespace icwafer {

struct PhysicalParams {
  /* Wires, and those that cross them. */
  Lattice across, along;
  float oxide_nm, groove_nm;
  /* Standard deviation of a lobe from roughness; relative spread of the spacing. */
  float roughness, variation;
  Cauchy oxide;
  /* Index of metal_custom in red, green and blue light. */
  float custom_n[3], custom_k[3];
  Metal metal;
  Illuminant illuminant;
};

/* 0.376 is 0.886 / (2 sqrt(2 ln 2)). */
ICW_DEVICE float physical_coherence_per_nm(const float coherence_width_um)
{
  return 0.376f / (1000.0f * clamped(coherence_width_um, 0.5f, 2000.0f));
}

/* A facet that is tilted by the slope z turns light by 2 z; GGX of width alpha has slopes of
 * about alpha / sqrt(2) in each direction. */
ICW_DEVICE float physical_roughness_sigma(const float roughness)
{
  return 1.4142136f * square(clamped(roughness, 0.0f, 0.6f));
}

/* A lattice of wires; none where the spacing is not positive. `coherence_width_um` is along its
 * own axis. */
ICW_DEVICE Lattice physical_lattice(const float spacing_nm,
                                    const float width_nm,
                                    const float coherence_width_um)
{
  const float coherence_per_nm = physical_coherence_per_nm(coherence_width_um);
  if (!(spacing_nm > 0.0f) || !(width_nm > 0.0f)) {
    return {0.0f, 0.0f, coherence_per_nm};
  }
  const float spacing = clamped(spacing_nm, 50.0f, 1e6f);
  return {spacing, clamped(width_nm / spacing, 0.0f, 1.0f), coherence_per_nm};
}

/* A component of the index of metal_custom, kept to what can be divided by. */
ICW_DEVICE float physical_custom_index(const float component)
{
  return clamped(component, 0.02f, 20.0f);
}

/* The parameters with everything inside the range for which the formulas are meant, whatever an
 * artist's texture says. Without wires across (a spacing of 0 or below) those along remain. */
ICW_DEVICE PhysicalParams physical_params(const Lattice across,
                                          const Lattice along,
                                          const float oxide_nm,
                                          const float groove_nm,
                                          const float roughness,
                                          const float variation,
                                          const Oxide oxide,
                                          const float custom_oxide_ior,
                                          const Metal metal,
                                          const Illuminant illuminant)
{
  PhysicalParams p = {};
  p.across = across;
  if (!(across.spacing_nm > 0.0f)) {
    /* Wires of no width: a mirror under oxide. */
    p.across.spacing_nm = 1000.0f;
  }
  p.along = along;
  p.oxide_nm = clamped(oxide_nm, 0.0f, 1e4f);
  p.groove_nm = clamped(groove_nm, 0.0f, 1e4f);
  p.roughness = physical_roughness_sigma(roughness);
  p.variation = clamped(variation, 0.0f, 0.3f);
  p.oxide = oxide_series(oxide, clamped(custom_oxide_ior, 1.0f, 5.0f));
  p.metal = metal;
  p.illuminant = illuminant;
  return p;
}

/* The index of metal_custom in red, green and blue light. */
ICW_DEVICE void physical_set_custom_metal(PhysicalParams &p,
                                          const float n_red,
                                          const float n_green,
                                          const float n_blue,
                                          const float k_red,
                                          const float k_green,
                                          const float k_blue)
{
  p.custom_n[0] = physical_custom_index(n_red);
  p.custom_n[1] = physical_custom_index(n_green);
  p.custom_n[2] = physical_custom_index(n_blue);
  p.custom_k[0] = physical_custom_index(k_red);
  p.custom_k[1] = physical_custom_index(k_green);
  p.custom_k[2] = physical_custom_index(k_blue);
}

namespace physical_detail {

constexpr float first_nm = float(visible_first_nm);
constexpr float last_nm = float(visible_last_nm);

/* Variance of the lobe around order * lambda / d along the lattice's axis. `shift` is
 * order * lambda / d. */
template<typename Real>
ICW_DEVICE Real lobe_variance(const PhysicalParams &p,
                              const Lattice &lattice,
                              const Real wavelength_nm,
                              const Real shift)
{
  const Real coherence = lattice.coherence_per_nm * wavelength_nm;
  const Real spread = p.variation * shift;
  return coherence * coherence + square(p.roughness) + spread * spread;
}

}  // namespace physical_detail

/* Variance of the mirror lobe along an axis at a mean wavelength. */
ICW_DEVICE float physical_lobe_variance(const PhysicalParams &p, const Lattice &axis)
{
  return physical_detail::lobe_variance(p, axis, 550.0f, 0.0f);
}

namespace physical_detail {

/* Index of metal_custom: linear between the wavelengths of sRGB's blue, green and red. */
ICW_DEVICE ComplexIndex custom_index(const PhysicalParams &p, const float wavelength_nm)
{
  constexpr float blue = 464.0f, green = 549.0f, red = 612.0f;
  const float to_green = clamped((wavelength_nm - blue) / (green - blue), 0.0f, 1.0f);
  const float to_red = clamped((wavelength_nm - green) / (red - green), 0.0f, 1.0f);
  return {p.custom_n[2] + to_green * (p.custom_n[1] - p.custom_n[2]) +
              to_red * (p.custom_n[0] - p.custom_n[1]),
          p.custom_k[2] + to_green * (p.custom_k[1] - p.custom_k[2]) +
              to_red * (p.custom_k[0] - p.custom_k[1])};
}

ICW_DEVICE Complex<Lanes> custom_metal(const PhysicalParams &p, const Lanes wavelength)
{
  float n[lane_count], k[lane_count];
  for (int lane = 0; lane < lane_count; lane++) {
    const ComplexIndex index = custom_index(p, get_lane(wavelength, lane));
    n[lane] = index.n;
    k[lane] = index.k;
  }
  return {load_lanes(n), load_lanes(k)};
}

/* The two levels, the mean of both polarisations. */
ICW_DEVICE FilmPair<Lanes> levels(const PhysicalParams &p,
                                  const Lanes cosine,
                                  const Lanes film_ior,
                                  const Complex<Lanes> metal,
                                  const Lanes per_nm)
{
  return unpolarised(film_on_metal<Lanes>(
      cosine, film_ior, metal, p.oxide_nm * per_nm, (p.oxide_nm + p.groove_nm) * per_nm));
}

/* Only how much they differ. */
ICW_DEVICE Lanes levels_contrast(const PhysicalParams &p,
                                 const Lanes cosine,
                                 const Lanes film_ior,
                                 const Complex<Lanes> metal,
                                 const Lanes per_nm)
{
  return film_contrast<Lanes>(
      cosine, film_ior, metal, p.oxide_nm * per_nm, (p.oxide_nm + p.groove_nm) * per_nm);
}

/* What is the same for all wavelengths of one evaluation. u and v are |u|, |v|: the lattices have
 * no preferred side. */
struct Pair {
  float u, v;
  float cosine;
  /* Half the difference of the two directions, in the surface: near the mirror direction, where
   * the light comes from. */
  float mid_nu, mid_tau;
};

}  // namespace physical_detail

}  // namespace icwafer
