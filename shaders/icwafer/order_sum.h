/* SPDX-License-Identifier: Apache-2.0 */

/* The orders of wires of a given duty cycle, summed.
 *
 * A lattice of ridges, f of each period wide, sends into order m != 0 the part
 *
 *   A(m)^2 = (sin(pi m f) / (pi m))^2
 *
 * of the squared difference of the amplitudes of ridge and groove. Its lobe is a Gaussian in the
 * fractional order x = u d / lambda; its width w(m)^2 = w_0^2 + (variation m)^2 has a part that is
 * the same for all orders and one from the spread of the spacing itself. */

#pragma once

#include "complex.h"

namespace icwafer {

/* Ridges and grooves side by side: period, and the part of it that is ridge. A period of 0 means
 * that there is no such lattice. */
struct Lattice {
  float spacing_nm, duty;
  /* Standard deviation of a lobe from coherence along the axis, per nanometre of wavelength. */
  float coherence_per_nm;
};

/* The narrower of ridge and groove, as a part of the period: A(m)^2 is the same for both. */
ICW_DEVICE float narrower_part(const float duty)
{
  return smaller(duty, 1.0f - duty);
}

/* The part of the area that one or the other lattice covers. */
ICW_DEVICE float covered(const Lattice a, const Lattice b)
{
  const float duty_b = b.spacing_nm > 0.0f ? b.duty : 0.0f;
  return 1.0f - (1.0f - a.duty) * (1.0f - duty_b);
}

/* A(m); A(0) = f. */
ICW_DEVICE Lanes order_amplitude(const Lanes m, const Lanes duty)
{
  const Lanes divisor = m == 0.0f ? lanes(1.0f) : m;
  return m == 0.0f ? duty : lanes_sin_turns(0.5f * m * duty) / (pi * divisor);
}

/* A(m)^2. */
ICW_DEVICE Lanes order_power(const Lanes m, const Lanes duty)
{
  const Lanes amplitude = order_amplitude(m, duty);
  return amplitude * amplitude;
}

/* Sum over m != 0 of A(m)^2 Gaussian(x - m; w(m)).
 *
 * f <= 1/2 is that of the narrower. Two things bound the number of terms, both from the Fourier
 * transform of A^2, the triangle f - |y| that is the ridge's autocorrelation, under the Gaussian
 * exp(-2 pi^2 w^2 y^2):
 *
 * - Beyond |y| = 0.6 / w the Gaussian has vanished. A ridge that reaches further is as good as
 *   one of f' = 0.6 / w, but for the area of the triangle's tip: (f - f') Gaussian(x; w).
 * - What is left has the bandwidth f' + 0.67 / w; where that is below 1 / s, a sum over every s-th
 *   order, times s, is the same sum (the sampling theorem; s need not be whole).
 *
 * So at most 13 terms are needed, for any number of orders in a lobe. */
ICW_DEVICE_LARGE Lanes order_sum(const Lanes x,
                                 const Lanes w_0,
                                 const float duty,
                                 const float variation)
{
  const float f = narrower_part(duty);
  const Lanes spread = variation * x;
  const Lanes w = lanes_sqrt(w_0 * w_0 + spread * spread);
  const float w_most = lanes_largest(w);
  const float w_least = -lanes_largest(-w);
  const Lanes f_seen = lanes_min(lanes(f), 0.6f / w);
  const float stride = larger(1.0f, 1.0f / (smaller(f, 0.6f / w_least) + 0.67f / w_least));
  /* Lobes end at 4.2 standard deviations. */
  const int count = 1 + int(smaller(8.4f * w_most / stride, 16.0f));

  /* The nearest, the next on the other side of x, the one after the nearest, and so on. */
  const Lanes place = x / stride;
  const Lanes nearest = lanes_round(place);
  const Lanes across = place < nearest ? lanes(-1.0f) : lanes(1.0f);
  const Lanes per_w_0 = 1.0f / w_0;
  Lanes sum = lanes(0.0f);
  for (int j = 0; j < count; j++) {
    const float away = j % 2 == 0 ? -0.5f * float(j) : 0.5f * float(j + 1);
    const Lanes m = (nearest + away * across) * stride;
    Lanes per_w = per_w_0;
    if (variation > 0.0f) {
      const Lanes spread_m = variation * m;
      per_w = 1.0f / lanes_sqrt(w_0 * w_0 + spread_m * spread_m);
    }
    sum += order_power(m, f_seen) * per_w * lanes_bell((x - m) * per_w);
  }
  const Lanes tip = (f - f_seen - f * f) * per_w_0 * lanes_bell(x * per_w_0);
  return 0.39894228f * lanes_max(stride * sum + tip, lanes(0.0f));
}

/* Ripples of the density of orders by their turns for each order: f, 1 - f, 1, 1 + f, 2 - f, 2,
 * ...; the slower a ripple, the more of it is seen. `duty` is at most 1/2. */
constexpr int ripple_limit = 8;

ICW_DEVICE float ripple_turns(const int ripple, const float duty)
{
  const float sides[3] = {duty, -duty, 0.0f};
  return float((ripple + 2) / 3) + sides[ripple % 3];
}

/* The same by Poisson's formula, for x far from 0: the mean density of orders and the first
 * `ripples` of its ripples. A(m)^2 = (1 - cos(2 pi f m)) / (2 pi^2 m^2), so those of a whole
 * number of turns n are 2 cos(2 pi n x), and those of n +- f turns are subtracted. The mean of 1 /
 * m^2 under the Gaussian is (1 + 3 r^2 + 15 r^4 + ...) / x^2, r = w_0 / x; the spread of the
 * spacing does not change it. That of cos(2 pi t m) / m^2 is taken at the saddle x + i delta,
 * delta = 2 pi t w_0^2, and the spread damps it. */
ICW_DEVICE_LARGE Lanes order_density(const Lanes x,
                                     const Lanes w_0,
                                     const float duty,
                                     const float variation,
                                     const int ripples)
{
  const float f = narrower_part(duty);
  const Lanes per_x = 1.0f / x;
  const Lanes r = w_0 * per_x;
  const Lanes mean = 0.5f / (pi * pi) * per_x * per_x * (1.0f + r * r * (3.0f + 15.0f * r * r));
  const Lanes spread = variation * x;
  const Lanes w = lanes_sqrt(w_0 * w_0 + spread * spread);
  Lanes sum = lanes(1.0f);
  const Lanes shift_per_turn = two_pi * w_0 * r;
  const auto add = [&](const Complex<Lanes> wave, const float turns, const float weight) {
    const Lanes t = shift_per_turn * turns;
    const Lanes damping = 1.0f / (1.0f + t * t);
    sum += weight * lanes_bell(two_pi * turns * w) * damping * damping *
           ((1.0f - t * t) * wave.re + 2.0f * t * wave.im);
  };
  /* In the order of ripple_turns. */
  if (ripples > 0) {
    const Complex<Lanes> part = unit_turns(f * x), turn = unit_turns(x);
    Complex<Lanes> whole = {lanes(1.0f), lanes(0.0f)};
    float turns = 0.0f;
    for (int left = ripples; left > 0; left -= 3) {
      add(whole * part, turns + f, -1.0f);
      turns += 1.0f;
      whole = whole * turn;
      if (left > 1) {
        add(whole * Complex<Lanes>{part.re, -part.im}, turns - f, -1.0f);
      }
      if (left > 2) {
        add(whole, turns, 2.0f);
      }
    }
  }
  /* No A(m)^2 is above f^2; of wires far thinner than their period the sum is all rounding. */
  return lanes_min(mean * sum, lanes(20.0f * f * f));
}

}  // namespace icwafer
