/* SPDX-License-Identifier: Apache-2.0 */

/* The CS348B model: the diffraction term of the original student project (Stanford CS 348B,
 * "render silicon wafers", pbrt), evaluated without noise and without its renderer's spectra.
 *
 *   f_r  = f_dr + f_sr + R c_a f_IW f_IB f_DW
 *   f_DW = (sin a / a)^2,  a = (pi / lambda) A (sin phi_r - sin phi_i)      within one wire
 *   f_IB = sum_k G(b - k pi),  b = (pi / lambda) D (k_r - k_i) . nu         between wires
 *   f_IW = cos^2 g,  g = (pi / lambda) n H (cos phi_r + (1 - sin phi_r sin phi_i) / cos phi_i)
 *   c_a  = |(k_r - k_i) . tau|^p                                            anisotropy
 *
 * f_dr and f_sr, diffuse and specular reflection, are left to the renderer's own closures.
 *
 * Where the published formulas can be read in more than one way, this is the reading taken:
 *
 * - k_i points towards the surface and k_r away from it, so k_r - k_i = w_o + w_i with directions
 *   that both point away: (k_r - k_i) . nu = u and (k_r - k_i) . tau = v (grating.h).
 * - phi in f_DW is measured across the wires, so sin phi_r - sin phi_i = u, as in f_IB: a wire's
 *   own diffraction and the interference between wires are one Fraunhofer pattern. At order k
 *   then a = pi k A / D for every wavelength.
 * - delta(b - k pi) = lambda / (pi D) delta(u - k lambda / D). The Gaussian that replaces it has
 *   the same area, so the lobe width does not change the energy. In order_lobes' terms
 *   f_IB = (1 / pi) sum_k Gaussian(x - k; w). k = 0, white in the mirror direction, is in it.
 * - phi in f_IW is the angle to the normal: cos phi_i = w_i . n, and sin phi_r sin phi_i is the
 *   dot product of the tangential parts of k_r and k_i, -(w_i . w_o)_tangential, so that in the
 *   mirror direction g = (2 pi / lambda) n H cos phi, the textbook's film. The angles are those
 *   in air, as printed. The formula is not symmetric in the two directions: i is the light's.
 * - An effect that is switched off becomes the factor 1, except f_IB, which becomes its mean over
 *   the angles, 1 / pi: wires at random distances, with the same energy.
 *
 * All wavelengths that reach a direction are integrated there (quadrature.h); what leaves the
 * model is the working space's red, green and blue. */

#pragma once

#include "quadrature.h"

namespace icwafer {

enum Cs348bEffect {
  cs348b_wire_diffraction = 1 << 0,
  cs348b_grating = 1 << 1,
  cs348b_thin_film = 1 << 2,
  cs348b_all_effects = cs348b_wire_diffraction | cs348b_grating | cs348b_thin_film,
};

struct Cs348bParams {
  /* Wires: distance from one to the next (D), width of one (A). */
  float spacing_nm, width_nm;
  /* Index of refraction times thickness of the oxide (n H). */
  float optical_thickness_nm;
  /* Standard deviation of an order in u. */
  float lobe_width;
  /* The exponent p. */
  float anisotropy;
  /* Cs348bEffect, or-ed. */
  int effects;
};

/* The parameters with everything inside the range for which the formulas are meant, whatever an
 * artist's texture says; a spacing of 0 or below means wires too fine to diffract. */
ICW_DEVICE Cs348bParams cs348b_params(const float spacing_nm,
                                      const float width_nm,
                                      const float oxide_thickness_nm,
                                      const float oxide_ior,
                                      const float lobe_width,
                                      const float anisotropy,
                                      const int effects)
{
  Cs348bParams p;
  p.spacing_nm = clamped(spacing_nm, 50.0f, 1e6f);
  p.width_nm = clamped(width_nm, 0.0f, p.spacing_nm);
  p.optical_thickness_nm = clamped(oxide_thickness_nm, 0.0f, 1e5f) *
                           clamped(oxide_ior, 1.0f, 5.0f);
  p.lobe_width = clamped(lobe_width, 1e-4f, 0.5f);
  p.anisotropy = clamped(anisotropy, 0.0f, 16.0f);
  p.effects = effects;
  return p;
}

/* n H (cos phi_r + (1 - sin phi_r sin phi_i) / cos phi_i): the path in g = pi path / lambda. */
ICW_DEVICE float cs348b_film_path_nm(const float optical_thickness_nm, const GratingGeometry g)
{
  /* At grazing light the published path grows without bound; beyond this its fringes are finer
   * than any eye, and average out. */
  const float cos_i = g.cos_i > 1e-3f ? g.cos_i : 1e-3f;
  return optical_thickness_nm * (g.cos_o + (1.0f + g.tangential_dot) / cos_i);
}

/* c_a */
ICW_DEVICE float cs348b_anisotropy(const float v, const float exponent)
{
  return exponent > 0.0f ? powf(fabsf(v), exponent) : 1.0f;
}

/* f_IW f_DW at one wavelength, with the fringes in `average` at their mean. */
struct Cs348bFactor {
  /* pi A |u| and 2 pi path; 0 where the effect is off. */
  float slit_phase_nm, film_phase_nm;
  bool film;

  ICW_DEVICE_METHOD float operator()(const float wavelength_nm, const FringeAverage average) const
  {
    const float per_nm = 1.0f / wavelength_nm;
    const float a = slit_phase_nm * per_nm;
    const float slit = average.slit ? 0.5f / square(a) : sinc_squared(a);
    if (!film) {
      return slit;
    }
    return slit * (average.film ? 0.5f : 0.5f + 0.5f * cosf(film_phase_nm * per_nm));
  }
};

/* c_a f_IW f_IB f_DW, integrated over the spectrum. Not multiplied by the cosine, nor by R. */
template<typename Sensitivity>
ICW_DEVICE_LARGE Rgb cs348b_eval(const Cs348bParams &p,
                                 const GratingGeometry &g,
                                 const Sensitivity &sensitivity)
{
  const float u = fabsf(g.u);
  Cs348bFactor factor;
  factor.slit_phase_nm = p.effects & cs348b_wire_diffraction ? pi * p.width_nm * u : 0.0f;
  factor.film = p.effects & cs348b_thin_film;
  factor.film_phase_nm = factor.film ? two_pi * cs348b_film_path_nm(p.optical_thickness_nm, g) :
                                       0.0f;

  /* d(phase / lambda) / d lambda at 420 nm, the shortest wavelength that matters to the eye;
   * sin^2 a goes through a fringe twice as fast as a. */
  constexpr float blue_nm = 420.0f;
  const Fringes fringes = {factor.film_phase_nm / (blue_nm * blue_nm),
                           2.0f * factor.slit_phase_nm / (blue_nm * blue_nm)};
  const float scale = cs348b_anisotropy(g.v, p.anisotropy) / pi;
  if (!(p.effects & cs348b_grating)) {
    return scale * smooth_integral(fringes, factor, sensitivity);
  }
  return scale * grating_integral(
                     u * p.spacing_nm, p.lobe_width * p.spacing_nm, fringes, factor, sensitivity);
}

}  // namespace icwafer
