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

/* Fresnel's amplitudes P / Q at the upper face and N / D at the lower. */
template<typename Real>
struct Faces {
  Real p, q;
  Complex<Real> n, d;
};

/* What the formulas are made of. */
template<typename Real>
struct Films {
  Faces<Real> s, p;
  Complex<Real> ridge_trip, groove_trip;
};

template<typename Real>
ICW_DEVICE Films<Real> films(const Real cos_air,
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
  const Real film_cos = film_squared * cos_air;
  const Complex<Real> metal_film = film * metal_squared, film_below = film_squared * below;
  return {{cos_air - film,
           cos_air + film,
           {film - below.re, -below.im},
           {film + below.re, below.im}},
          {film_cos - film, film_cos + film, metal_film - film_below, metal_film + film_below},
          unit_turns(2.0f * film * ridge_waves),
          unit_turns(2.0f * film * groove_waves)};
}

/* |r - r'|^2 but for its divisor. */
template<typename Real>
ICW_DEVICE Real contrast_above(const Faces<Real> &faces, const Real chord_squared)
{
  const Real face = faces.q * faces.q - faces.p * faces.p;
  return face * face * norm(faces.n) * norm(faces.d) * chord_squared;
}

template<typename Real>
ICW_DEVICE FilmPair<Real> film_pair(const Faces<Real> &faces,
                                    const Films<Real> &films,
                                    const Real chord_squared)
{
  const Complex<Real> pd = faces.p * faces.d, qd = faces.q * faces.d;
  const Complex<Real> ridge = faces.n * films.ridge_trip, groove = faces.n * films.groove_trip;
  const Real per_ridge = 1.0f / norm(qd + faces.p * ridge);
  const Real per_groove = 1.0f / norm(qd + faces.p * groove);
  return {norm(pd + faces.q * ridge) * per_ridge,
          norm(pd + faces.q * groove) * per_groove,
          contrast_above(faces, chord_squared) * (per_ridge * per_groove)};
}

template<typename Real>
ICW_DEVICE Real film_contrast(const Faces<Real> &faces,
                              const Films<Real> &films,
                              const Real chord_squared)
{
  const Complex<Real> qd = faces.q * faces.d;
  return contrast_above(faces, chord_squared) /
         (norm(qd + faces.p * (faces.n * films.ridge_trip)) *
          norm(qd + faces.p * (faces.n * films.groove_trip)));
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
  using namespace film_detail;
  const Films<Real> f = films(cos_air, film_ior, metal, ridge_waves, groove_waves);
  const Real chord_squared = norm(f.ridge_trip - f.groove_trip);
  return {film_pair(f.s, f, chord_squared), film_pair(f.p, f, chord_squared)};
}

/* |r_ridge - r_groove|^2 only, the mean of both polarisations. */
template<typename Real>
ICW_DEVICE_LARGE Real film_contrast(const Real cos_air,
                                    const Real film_ior,
                                    const Complex<Real> metal,
                                    const Real ridge_waves,
                                    const Real groove_waves)
{
  using namespace film_detail;
  const Films<Real> f = films(cos_air, film_ior, metal, ridge_waves, groove_waves);
  const Real chord_squared = norm(f.ridge_trip - f.groove_trip);
  return 0.5f * (film_contrast(f.s, f, chord_squared) + film_contrast(f.p, f, chord_squared));
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
