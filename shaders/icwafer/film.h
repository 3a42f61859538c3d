/* SPDX-License-Identifier: Apache-2.0 */

/* Reflection of a transparent film on metal, for two thicknesses of the film at once: the ridges
 * and the grooves of a surface, and how much their amplitudes differ.
 *
 * With Airy's sum over all passes through the film (Born and Wolf, "Principles of Optics", 7th
 * ed., section 1.6.4, eq. 55-57), Fresnel's amplitudes P / Q at the upper face and N / D at the
 * lower, and e = exp(i phase) for the way there and back,
 *
 *   r = (P D + Q N e) / (Q D + P N e)
 *
 * and two films that differ in e only have
 *
 *   r - r' = (Q^2 - P^2) N D (e - e') / ((Q D + P N e) (Q D + P N e'))
 *
 * so that nothing cancels and few divisions are left. The metal has the complex index n + i k
 * (absorbing: k > 0, fields vary as exp(-i omega t)); above is air.
 *
 * `Real` is Lanes in a renderer; tests that need more digits take double. */

#pragma once

#include "complex.h"

namespace icwafer {

/* |r_ridge|^2, |r_groove|^2, |r_ridge - r_groove|^2. */
template<typename Real>
struct FilmPair {
  Real ridge, groove, contrast;
};

/* For the electric field across (s) and in (p) the plane of incidence. */
template<typename Real>
struct PolarisedFilmPair {
  FilmPair<Real> s, p;
};

namespace film_detail {

template<typename Real>
ICW_DEVICE FilmPair<Real> film_pair(const Real p,
                                    const Real q,
                                    const Complex<Real> n,
                                    const Complex<Real> d,
                                    const Complex<Real> ridge_trip,
                                    const Complex<Real> groove_trip,
                                    const Real chord_squared)
{
  const Complex<Real> pd = p * d, qd = q * d;
  const Complex<Real> ridge = n * ridge_trip, groove = n * groove_trip;
  const Real below_ridge = 1.0f / norm(qd + p * ridge);
  const Real below_groove = 1.0f / norm(qd + p * groove);
  const Real face = q * q - p * p;
  return {norm(pd + q * ridge) * below_ridge,
          norm(pd + q * groove) * below_groove,
          face * face * norm(n) * norm(d) * chord_squared * below_ridge * below_groove};
}

}  // namespace film_detail

/*   cos_air        cosine of the angle of incidence in air
 *   film_ior       index of the film, real, at least 1
 *   metal          complex index of the metal
 *   ridge_waves, groove_waves   thickness of the film over the wavelength in vacuum */
template<typename Real>
ICW_DEVICE_LARGE PolarisedFilmPair<Real> film_on_metal(const Real cos_air,
                                                       const Real film_ior,
                                                       const Complex<Real> metal,
                                                       const Real ridge_waves,
                                                       const Real groove_waves)
{
  const Real sin_squared = 1.0f - cos_air * cos_air;
  const Real film_squared = film_ior * film_ior;
  const Complex<Real> metal_squared = metal * metal;
  /* n cos theta in the film and in the metal; in air it is the cosine. Written so that a film of
   * index 1 keeps it at grazing light too. */
  const Real film = real_sqrt((film_squared - 1.0f) + cos_air * cos_air);
  const Complex<Real> below = decaying_sqrt<Real>(
      {metal_squared.re - sin_squared, metal_squared.im});

  const Complex<Real> ridge_trip = unit_turns(2.0f * film * ridge_waves);
  const Complex<Real> groove_trip = unit_turns(2.0f * film * groove_waves);
  const Real chord_squared = norm(ridge_trip - groove_trip);

  const Real film_cos = film_squared * cos_air;
  const Complex<Real> metal_film = film * metal_squared, film_below = film_squared * below;
  return {film_detail::film_pair<Real>(cos_air - film,
                                       cos_air + film,
                                       {film - below.re, -below.im},
                                       {film + below.re, below.im},
                                       ridge_trip,
                                       groove_trip,
                                       chord_squared),
          film_detail::film_pair<Real>(film_cos - film,
                                       film_cos + film,
                                       metal_film - film_below,
                                       metal_film + film_below,
                                       ridge_trip,
                                       groove_trip,
                                       chord_squared)};
}

/* The mean of both polarisations. */
template<typename Real>
ICW_DEVICE FilmPair<Real> unpolarised(const PolarisedFilmPair<Real> &pair)
{
  return {0.5f * (pair.s.ridge + pair.p.ridge),
          0.5f * (pair.s.groove + pair.p.groove),
          0.5f * (pair.s.contrast + pair.p.contrast)};
}

}  // namespace icwafer
