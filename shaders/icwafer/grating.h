/* SPDX-License-Identifier: Apache-2.0 */

/* The grating in direction cosines.
 *
 * Local frame: n the normal, tau along the wires, nu = across them (the grating vector). With
 * directions pointing away from the surface and q = w_i + w_o, light of wavelength lambda leaves
 * wires of spacing d in order m where
 *
 *   u = q . nu = m lambda / d,    v = q . tau = 0
 *
 * for a wire of infinite length: the exact law also off the plane of incidence (conical mount),
 * because it shifts the tangential direction cosine (Harvey and Vernold, "Description of
 * diffraction grating behavior in direction cosine space", 1998, eq. 6).
 *
 * A real order is not infinitely sharp: a Gaussian of standard deviation sigma_u (the lobe width)
 * in u stands for the finite number of wires, roughness, and the original project's "Gaussian
 * instead of a delta function". In units of the order spacing lambda/d a point of the u axis is
 *
 *   x = u d / lambda (the fractional order),    w = sigma_u d / lambda. */

#pragma once

#include "platform.h"

namespace icwafer {

/* Directions relative to the wires at one shading point. */
struct GratingGeometry {
  /* Components of w_i + w_o across and along the wires. */
  float u, v;
  /* Cosines to the normal of the directions to the light and to the eye. */
  float cos_i, cos_o;
  /* Dot product of the two directions' components in the surface. */
  float tangential_dot;
};

/* Directions in the frame (nu, tau, n), pointing away from the surface. */
struct LocalDirection {
  float nu, tau, n;
};

ICW_DEVICE GratingGeometry grating_geometry(const LocalDirection i, const LocalDirection o)
{
  return {i.nu + o.nu, i.tau + o.tau, i.n, o.n, i.nu * o.nu + i.tau * o.tau};
}

ICW_DEVICE float gaussian(const float x, const float sigma)
{
  const float t = x / sigma;
  return 0.39894228f / sigma * expf(-0.5f * t * t);
}

/* (sin a / a)^2: diffraction at a slit or wire, a = pi width u / lambda. */
ICW_DEVICE float sinc_squared(const float a)
{
  if (fabsf(a) < 1e-2f) {
    return 1.0f - a * a * (1.0f / 3.0f);
  }
  return square(sinf(a) / a);
}

/* Sum over all orders m of Gaussian(x - m; w): what order lobes of width w add up to at the
 * fractional order x. Narrow lobes: the nearest five. Wide lobes: Poisson's sum of the same,
 * 1 + 2 sum_j cos(2 pi j x) exp(-2 pi^2 j^2 w^2), of which two terms are left (Jacobi's
 * imaginary transformation of the theta function). Both are exact to 1e-6 at w = 0.5; for w -> oo
 * the sum is 1: orders that overlap melt into an even shine. */
ICW_DEVICE float order_lobes(const float x, const float w)
{
  const float r = x - floorf(x + 0.5f);
  if (w < 0.5f) {
    float sum = 0.0f;
    for (int m = -2; m <= 2; m++) {
      sum += gaussian(r - float(m), w);
    }
    return sum;
  }
  const float c = cosf(two_pi * r);
  const float e = expf(-2.0f * pi * pi * w * w);
  const float e4 = square(square(e));
  return 1.0f + 2.0f * (c * e + (2.0f * c * c - 1.0f) * e4);
}

}  // namespace icwafer
