/* SPDX-License-Identifier: Apache-2.0 */

/* Sampling of the CS348B model: the order by its power, the wavelength by the eye's sensitivity,
 * then the place within the lobe.
 *
 * Because du dv = cos theta d omega, directions are sampled as points (s, t) of the unit disc:
 * s = w_i . nu across the wires, t = w_i . tau along them. The model spreads each order evenly
 * along the wires but for c_a = |v|^p, which is inverted in closed form; across them
 *
 *   p(s) = sum_j P_j L((u - mu_j) / s_j) / s_j / total,   u = s + w_o . nu,  |s| <= 1,
 *
 * a mixture over order 0, and for each other order over the two humps that the sum of the three
 * sensitivities has (blue; green and red), plus an even part for what is left: orders too many to
 * tell apart, and whatever the humps miss. L is the logistic density: close to a Gaussian, with
 * heavier tails, and both its integral and the inverse of that are elementary, so each part is
 * cut off exactly at the horizon. `total` depends on the view only and is computed once.
 *
 * Evaluation and sampling use this one density. */

#pragma once

#include "cs348b.h"

namespace icwafer {

namespace cs348b_detail {

/* Orders that are told apart on either side; beyond them the colours overlap. */
constexpr int order_limit = 12;
constexpr float shortest_nm = 400.0f;
constexpr float mean_nm = 550.0f;
/* The humps of the sum of the three sensitivities: blue; green and red. */
constexpr int hump_count = 2;
/* Standard deviation of the logistic density is pi / sqrt(3); this scale fits a Gaussian's body
 * best. */
constexpr float logistic_per_sigma = 0.59f;
/* Power of the even part besides the unresolved orders, relative to 1 / pi. */
constexpr float even_floor = 0.01f;

/* One part of the mixture: a logistic density in u and its power. */
struct Lobe {
  float mean, scale, power;
};

ICW_DEVICE float logistic_cdf(const float x)
{
  return 1.0f / (1.0f + expf(-x));
}

ICW_DEVICE float logistic_pdf(const float x)
{
  const float e = expf(-fabsf(x));
  return e / square(1.0f + e);
}

/* The interval of a lobe that is above the horizon, in units of its scale, mirrored where that
 * keeps the differences of the integral exact (the far tail on the left). */
struct Interval {
  float begin, end, mirror;
};

ICW_DEVICE Interval lobe_interval(const Lobe lobe, const float view_u)
{
  const float begin = (view_u - 1.0f - lobe.mean) / lobe.scale;
  const float end = (view_u + 1.0f - lobe.mean) / lobe.scale;
  if (begin + end > 0.0f) {
    return {-end, -begin, -1.0f};
  }
  return {begin, end, 1.0f};
}

ICW_DEVICE float lobe_mass(const Interval interval)
{
  return logistic_cdf(interval.end) - logistic_cdf(interval.begin);
}

ICW_DEVICE Lobe lobe_of(const float mean, const float sigma, const float power)
{
  return {mean, logistic_per_sigma * sigma, power};
}

ICW_DEVICE float order_power(const Cs348bParams &p, const float order)
{
  return p.effects & cs348b_wire_diffraction ?
             sinc_squared(pi * order * p.width_nm / p.spacing_nm) :
             1.0f;
}

/* Hump number `hump` of an order other than 0. */
ICW_DEVICE Lobe hump_lobe(const Cs348bParams &p,
                          const int order,
                          const int hump,
                          const float power)
{
  const float hump_nm = hump == 0 ? 452.0f : 572.0f;
  const float sigma_nm = hump == 0 ? 24.0f : 48.0f;
  const float weight = hump == 0 ? 0.34f : 0.66f;
  const float per_nm = float(order) / p.spacing_nm;
  return lobe_of(hump_nm * per_nm,
                 sqrtf(square(p.lobe_width) + square(sigma_nm * per_nm)),
                 weight * hump_nm / (pi * p.spacing_nm) * power);
}

/* Order 0; without a grating, the central peak of the wire's own diffraction. */
ICW_DEVICE Lobe central_lobe(const Cs348bParams &p)
{
  if (p.effects & cs348b_grating) {
    return lobe_of(0.0f, p.lobe_width, mean_nm / (pi * p.spacing_nm));
  }
  const bool slit = (p.effects & cs348b_wire_diffraction) && p.width_nm > 0.5f * mean_nm;
  const float width = mean_nm / (slit ? p.width_nm : mean_nm);
  return lobe_of(0.0f, 0.4f * width, slit ? width / pi : 0.0f);
}

/* Highest order whose colours begin above the horizon on the side where |u| <= reach. */
ICW_DEVICE int order_reach(const Cs348bParams &p, const float reach)
{
  if (!(p.effects & cs348b_grating)) {
    return 0;
  }
  const float order = reach * p.spacing_nm / shortest_nm;
  return order < float(order_limit) ? int(order) : order_limit;
}

/* Power of the orders beyond the limit, with the mean 1 / (1 + 2 a^2) of (sin a / a)^2. */
ICW_DEVICE float unresolved_power(const Cs348bParams &p, const float reach)
{
  const float begin = float(order_limit) + 0.5f;
  const float end = reach * p.spacing_nm / mean_nm;
  if (!(p.effects & cs348b_grating) || end <= begin) {
    return 0.0f;
  }
  const float c = p.effects & cs348b_wire_diffraction ?
                      1.4142136f * pi * p.width_nm / p.spacing_nm :
                      0.0f;
  const float orders = c > 1e-4f ? (atanf(c * end) - atanf(c * begin)) / c : end - begin;
  return orders * mean_nm / (pi * p.spacing_nm);
}

/* Power of the part that is even over s in [-1, 1]. */
ICW_DEVICE float even_power(const Cs348bParams &p, const float view_u)
{
  return unresolved_power(p, 1.0f - view_u) + unresolved_power(p, 1.0f + view_u) +
         2.0f / pi * (p.effects & cs348b_grating ? even_floor : 0.3f);
}

/* sign(x) |x|^(p + 1), the integral of (p + 1) |x|^p. */
ICW_DEVICE float anisotropy_integral(const float x, const float exponent)
{
  return exponent > 0.0f ? copysignf(powf(fabsf(x), exponent + 1.0f), x) : x;
}

/* Density of t given s. */
ICW_DEVICE float along_pdf(const float exponent,
                           const float view_v,
                           const float half,
                           const float v)
{
  const float integral = anisotropy_integral(view_v + half, exponent) -
                         anisotropy_integral(view_v - half, exponent);
  return integral > 0.0f ? (exponent + 1.0f) * cs348b_anisotropy(v, exponent) / integral : 0.0f;
}

}  // namespace cs348b_detail

/* The normalisation of the density of u for one view, w_o . nu = view_u. It is also an estimate of
 * the power that is reflected, per unit of t, for R = 1. */
ICW_DEVICE_LARGE float cs348b_total_power(const Cs348bParams &p, const float view_u)
{
  using namespace cs348b_detail;
  const Lobe central = central_lobe(p);
  float total = even_power(p, view_u) + central.power * lobe_mass(lobe_interval(central, view_u));
  const int last = order_reach(p, 1.0f + view_u);
  for (int order = -order_reach(p, 1.0f - view_u); order <= last; order++) {
    if (order != 0) {
      const float power = order_power(p, float(order));
      for (int hump = 0; hump < hump_count; hump++) {
        const Lobe lobe = hump_lobe(p, order, hump, power);
        total += lobe.power * lobe_mass(lobe_interval(lobe, view_u));
      }
    }
  }
  return total;
}

/* Density of the sampled direction i over solid angle. */
ICW_DEVICE_LARGE float cs348b_pdf(const Cs348bParams &p,
                                  const float total_power,
                                  const LocalDirection o,
                                  const LocalDirection i)
{
  using namespace cs348b_detail;
  const float u = i.nu + o.nu;
  const auto density = [u](const Lobe lobe) {
    const float x = (u - lobe.mean) / lobe.scale;
    return fabsf(x) < 20.0f ? lobe.power * logistic_pdf(x) / lobe.scale : 0.0f;
  };

  float across = 0.5f * even_power(p, o.nu) + density(central_lobe(p));
  const int last = order_reach(p, 1.0f + o.nu);
  for (int order = -order_reach(p, 1.0f - o.nu); order <= last; order++) {
    if (order != 0) {
      const float power = order_power(p, float(order));
      for (int hump = 0; hump < hump_count; hump++) {
        across += density(hump_lobe(p, order, hump, power));
      }
    }
  }
  const float half = sqrtf(fmaxf(1.0f - square(i.nu), 0.0f));
  return across / total_power * along_pdf(p.anisotropy, o.tau, half, i.tau + o.tau) * i.n;
}

/* A direction for the view o from two random numbers in [0, 1). i.n = 0 where there is none. */
ICW_DEVICE_LARGE LocalDirection cs348b_sample(const Cs348bParams &p,
                                              const float total_power,
                                              const LocalDirection o,
                                              const float random_across,
                                              const float random_along)
{
  using namespace cs348b_detail;

  /* Choose a lobe by the power that it has above the horizon; what is left of the random number
   * chooses the place in it. */
  float left = random_across * total_power;
  const float even = even_power(p, o.nu);
  float s = 2.0f * left / even - 1.0f;
  if (left >= even) {
    left -= even;
    const int last = order_reach(p, 1.0f + o.nu);
    Lobe lobe = central_lobe(p);
    Interval interval = lobe_interval(lobe, o.nu);
    float mass = lobe_mass(interval);
    for (int order = -order_reach(p, 1.0f - o.nu); left >= lobe.power * mass && order <= last;
         order++) {
      if (order == 0) {
        continue;
      }
      const float power = order_power(p, float(order));
      for (int hump = 0; hump < hump_count && left >= lobe.power * mass; hump++) {
        left -= lobe.power * mass;
        lobe = hump_lobe(p, order, hump, power);
        interval = lobe_interval(lobe, o.nu);
        mass = lobe_mass(interval);
      }
    }
    const float part = clamped(left / (lobe.power * mass), 0.0f, 1.0f);
    const float y = logistic_cdf(interval.begin) + part * mass;
    const float x = clamped(logf(y / (1.0f - y)), interval.begin, interval.end);
    s = lobe.mean + interval.mirror * x * lobe.scale - o.nu;
  }
  s = clamped(s, -1.0f, 1.0f);

  const float half = sqrtf(fmaxf(1.0f - square(s), 0.0f));
  const float begin = anisotropy_integral(o.tau - half, p.anisotropy);
  const float end = anisotropy_integral(o.tau + half, p.anisotropy);
  const float y = begin + random_along * (end - begin);
  const float v = p.anisotropy > 0.0f ?
                      copysignf(powf(fabsf(y), 1.0f / (p.anisotropy + 1.0f)), y) :
                      y;
  const float t = clamped(v - o.tau, -half, half);
  return {s, t, sqrtf(fmaxf(1.0f - square(s) - square(t), 0.0f))};
}

}  // namespace icwafer
