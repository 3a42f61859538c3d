/* SPDX-License-Identifier: Apache-2.0 */

/* Integration over the wavelengths that the grating sends into one direction.
 *
 *   I(u) = integral S(lambda) F(lambda) sum_m Gaussian(x - m; w) d lambda,
 *   x = u d / lambda, w = sigma_u d / lambda
 *
 * with S the sensitivities and F whatever varies with wavelength besides (film, slit). Nothing is
 * chosen at random: given u the wavelengths are known. In lambda, order m is a Gaussian around
 * u d / m of standard deviation sigma_u d / |m|, times lambda / |m|.
 *
 * Steps. The trapezoid rule with step h is exact for a product whose bandwidth is below 2 pi / h.
 * The fringes of film and slit oscillate as exp(i k lambda) with a known k; the rest is a
 * Gaussian lobe of bandwidth 4.2 / sigma, or the sensitivities with 0.5 / nm, whichever varies
 * faster (both leave 0.1 %). So h = 2 pi / (k + max(4.2 / sigma, 0.5 / nm)). Fringes that go
 * through several periods within a lobe average out and are replaced by their mean: the number
 * of nodes stays bounded for any film and any wire.
 *
 * Three ways, the cheapest that resolves everything:
 *   windows  order by order, nodes only where the lobe is (narrow lobes: 1 or 3 Gauss-Hermite
 *            nodes, when neither S nor F bends within the lobe),
 *   grid     one uniform grid over the visible range with all orders summed at each node
 *            (lobes wider than the step),
 *   smooth   the same grid with the sum at its limit 1 (so many orders within a feature of S and
 *            F that the sum over them is itself a fine trapezoid rule). */

#pragma once

#include "grating.h"
#include "spectrum.h"

namespace icwafer {

namespace quadrature_detail {

constexpr float first_nm = float(visible_first_nm);
constexpr float last_nm = float(visible_last_nm);
/* Bandwidth of the sensitivities, radian per nanometre. */
constexpr float sensitivity_bandwidth = 0.5f;
/* Bandwidth of a Gaussian of standard deviation 1. */
constexpr float gaussian_bandwidth = 4.2f;
/* Where a lobe is cut off, in standard deviations, and the part of it that is inside. */
constexpr float lobe_reach = 3.5f;
constexpr float lobe_inside = 0.999535f;
/* Fringes average out over the sensitivities too, as over a lobe of this width. */
constexpr float sensitivity_sigma_nm = 9.0f;

/* Step that resolves a lobe or the sensitivities, whichever is narrower, and fringes. */
ICW_DEVICE float step_nm(const float sigma_nm, const float fringes_per_nm)
{
  const float lobe = gaussian_bandwidth / sigma_nm;
  return two_pi / (fringes_per_nm + (lobe > sensitivity_bandwidth ? lobe : sensitivity_bandwidth));
}

}  // namespace quadrature_detail

/* Phase of film and slit per nanometre of wavelength, in radian, where it is fastest (blue). */
struct Fringes {
  float film_per_nm, slit_per_nm;
};

/* Which fringes average out inside a lobe (their contrast there is below 4e-4). */
struct FringeAverage {
  bool film, slit;
};

namespace quadrature_detail {

ICW_DEVICE FringeAverage fringe_average(const Fringes fringes, const float sigma_nm)
{
  const float sigma = sigma_nm < sensitivity_sigma_nm ? sigma_nm : sensitivity_sigma_nm;
  return {fringes.film_per_nm * sigma > 4.0f, fringes.slit_per_nm * sigma > 4.0f};
}

/* Phase per nanometre that is left to resolve. */
ICW_DEVICE float resolved_per_nm(const Fringes fringes, const FringeAverage average)
{
  return (average.film ? 0.0f : fringes.film_per_nm) + (average.slit ? 0.0f : fringes.slit_per_nm);
}

/* Mean of lobes(lambda) F(lambda) over the visible range with the weights S(lambda). Dividing by
 * the sum of the weights makes a flat spectrum exactly white at any step. */
template<typename Lobes, typename Factor, typename Sensitivity>
ICW_DEVICE Rgb grid_integral(const float step,
                             const FringeAverage average,
                             const Lobes &lobes,
                             const Factor &factor,
                             const Sensitivity &sensitivity)
{
  Rgb sum = {0.0f, 0.0f, 0.0f};
  Rgb weight = {0.0f, 0.0f, 0.0f};
  for (float wavelength = first_nm + 0.5f * step; wavelength < last_nm; wavelength += step) {
    const Rgb s = sensitivity(wavelength);
    sum = sum + lobes(wavelength) * factor(wavelength, average) * s;
    weight = weight + s;
  }
  return {sum.r / weight.r, sum.g / weight.g, sum.b / weight.b};
}

/* One order: a Gaussian around centre_nm, times lambda / m. */
template<typename Factor, typename Sensitivity>
ICW_DEVICE Rgb window_integral(const float centre_nm,
                               const float sigma_nm,
                               const float per_order,
                               const Fringes fringes,
                               const Factor &factor,
                               const Sensitivity &sensitivity)
{
  const FringeAverage average = fringe_average(fringes, sigma_nm);
  const float resolved = resolved_per_nm(fringes, average);
  /* How much the rest bends within the lobe; 0.08 / nm is the curvature of the sensitivities. */
  const float bend = sigma_nm * (resolved + 0.08f);
  Rgb sum = {0.0f, 0.0f, 0.0f};

  if (bend < 0.7f) {
    /* Gauss-Hermite: exact for polynomials of degree 1 (one node) and 5 (three). */
    const float offset = 1.7320508f * sigma_nm;
    const float side = bend < 0.05f ? 0.0f : 1.0f / 6.0f;
    for (int node = -1; node <= 1; node++) {
      const float weight = node == 0 ? 1.0f - 2.0f * side : side;
      const float wavelength = centre_nm + float(node) * offset;
      if (weight > 0.0f && wavelength > first_nm && wavelength < last_nm) {
        sum = sum + (weight * per_order * wavelength) * factor(wavelength, average) *
                        sensitivity(wavelength);
      }
    }
    return sum;
  }

  const float step = step_nm(sigma_nm, resolved);
  float wavelength = centre_nm - step * floorf(lobe_reach * sigma_nm / step);
  if (wavelength < first_nm) {
    wavelength += step * ceilf((first_nm - wavelength) / step);
  }
  const float end = fminf(centre_nm + lobe_reach * sigma_nm, last_nm);
  for (; wavelength < end; wavelength += step) {
    const float weight = per_order * wavelength * gaussian(wavelength - centre_nm, sigma_nm);
    sum = sum + weight * factor(wavelength, average) * sensitivity(wavelength);
  }
  return step / lobe_inside * sum;
}

}  // namespace quadrature_detail

/* The integral with the sum over the orders at its limit 1: no order is to be told from another,
 * or there is no grating. factor(lambda, average) is F, with the fringes in `average` replaced by
 * their mean. */
template<typename Factor, typename Sensitivity>
ICW_DEVICE Rgb smooth_integral(const Fringes fringes,
                               const Factor &factor,
                               const Sensitivity &sensitivity)
{
  using namespace quadrature_detail;
  const FringeAverage average = fringe_average(fringes, last_nm);
  return grid_integral(
      step_nm(last_nm, resolved_per_nm(fringes, average)),
      average,
      [](float) { return 1.0f; },
      factor,
      sensitivity);
}

/* The integral I(u) at the head of this file.
 *   ud_nm       |u| d, the path difference between neighbouring wires
 *   sigma_d_nm  sigma_u d */
template<typename Factor, typename Sensitivity>
ICW_DEVICE Rgb grating_integral(const float ud_nm,
                                const float sigma_d_nm,
                                const Fringes fringes,
                                const Factor &factor,
                                const Sensitivity &sensitivity)
{
  using namespace quadrature_detail;

  /* Neighbouring orders are lambda^2 / ud apart in wavelength. Where that resolves everything,
   * the sum over the orders is a trapezoid rule itself. */
  const float resolved = resolved_per_nm(fringes, fringe_average(fringes, last_nm));
  if (ud_nm * two_pi > (resolved + 1.25f * sensitivity_bandwidth) * square(last_nm)) {
    return smooth_integral(fringes, factor, sensitivity);
  }

  /* Orders whose lobes reach into the visible range; negative ones when lobes are so wide that
   * they reach across u = 0. */
  const float reach_nm = lobe_reach * sigma_d_nm;
  const float low_nm = ud_nm - reach_nm;
  const int order_first = low_nm > 0.0f ? int(ceilf(low_nm / last_nm)) : -int(-low_nm / first_nm);
  const int order_last = int((ud_nm + reach_nm) / first_nm);
  if (order_first > order_last) {
    return {0.0f, 0.0f, 0.0f};
  }

  /* All orders at each node, where that takes fewer nodes than order by order. */
  const float sigma_least_nm = sigma_d_nm / float(order_last > 0 ? order_last : 1);
  const FringeAverage average = fringe_average(fringes, sigma_least_nm);
  const float step = step_nm(order_last > 0 ? sigma_least_nm : last_nm,
                             resolved_per_nm(fringes, average));
  const float window_nm = fminf(2.0f * lobe_reach * sigma_least_nm, last_nm - first_nm) + step;
  if (order_first <= 0 || float(order_last - order_first + 1) * window_nm > last_nm - first_nm) {
    return grid_integral(
        step,
        average,
        [=](const float wavelength) {
          return order_lobes(ud_nm / wavelength, sigma_d_nm / wavelength);
        },
        factor,
        sensitivity);
  }

  Rgb sum = {0.0f, 0.0f, 0.0f};
  for (int order = order_first; order <= order_last; order++) {
    sum = sum + window_integral(ud_nm / float(order),
                                sigma_d_nm / float(order),
                                1.0f / float(order),
                                fringes,
                                factor,
                                sensitivity);
  }
  return sum;
}

}  // namespace icwafer
