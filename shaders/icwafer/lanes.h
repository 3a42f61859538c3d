/* SPDX-License-Identifier: Apache-2.0 */

/* Several wavelengths at once. `Lanes` is a vector of floats where the compiler has them (GCC and
 * Clang on a CPU, whatever its instruction set), and a single float elsewhere, as on a GPU, where
 * each thread has its own wavelengths and registers are scarce. Arithmetic and comparisons are the
 * operators of the type; `mask ? a : b` selects lane by lane.
 *
 * The functions here are for the ranges that the optics needs, with a relative error below 1e-6.
 */

#pragma once

#include "platform.h"

#if defined(__GNUC__) && !defined(__CUDACC__) && !defined(__HIPCC__) && !defined(__METAL_VERSION__)
#  define ICW_VECTOR_LANES
#endif

namespace icwafer {

#ifdef ICW_VECTOR_LANES

constexpr int lane_count = 8;
typedef float Lanes __attribute__((vector_size(4 * lane_count)));
typedef int LanesInt __attribute__((vector_size(4 * lane_count)));

ICW_DEVICE Lanes lanes(const float x)
{
  return Lanes{} + x;
}

/* 0, 1, 2, ... */
ICW_DEVICE Lanes lane_numbers()
{
  return Lanes{0.0f, 1.0f, 2.0f, 3.0f, 4.0f, 5.0f, 6.0f, 7.0f};
}

ICW_DEVICE float get_lane(const Lanes &x, const int lane)
{
  return x[lane];
}

/* The values of lane_count floats. */
ICW_DEVICE Lanes load_lanes(const float *x)
{
  Lanes result;
  __builtin_memcpy(&result, x, sizeof(result));
  return result;
}

/* Four neighbouring floats for each lane, from where `at` says. */
ICW_DEVICE void load_records(const float *const *at, Lanes &a, Lanes &b, Lanes &c, Lanes &d)
{
  typedef float Record __attribute__((vector_size(16)));
  const auto pair = [&](const int k) {
    Record low, high;
    __builtin_memcpy(&low, at[k], sizeof(low));
    __builtin_memcpy(&high, at[k + 4], sizeof(high));
    return __builtin_shufflevector(low, high, 0, 1, 2, 3, 4, 5, 6, 7);
  };
  const Lanes r0 = pair(0), r1 = pair(1), r2 = pair(2), r3 = pair(3);
  const Lanes ab01 = __builtin_shufflevector(r0, r1, 0, 8, 1, 9, 4, 12, 5, 13);
  const Lanes ab23 = __builtin_shufflevector(r2, r3, 0, 8, 1, 9, 4, 12, 5, 13);
  const Lanes cd01 = __builtin_shufflevector(r0, r1, 2, 10, 3, 11, 6, 14, 7, 15);
  const Lanes cd23 = __builtin_shufflevector(r2, r3, 2, 10, 3, 11, 6, 14, 7, 15);
  a = __builtin_shufflevector(ab01, ab23, 0, 1, 8, 9, 4, 5, 12, 13);
  b = __builtin_shufflevector(ab01, ab23, 2, 3, 10, 11, 6, 7, 14, 15);
  c = __builtin_shufflevector(cd01, cd23, 0, 1, 8, 9, 4, 5, 12, 13);
  d = __builtin_shufflevector(cd01, cd23, 2, 3, 10, 11, 6, 7, 14, 15);
}

ICW_DEVICE Lanes lanes_sqrt(Lanes x)
{
  for (int lane = 0; lane < lane_count; lane++) {
    x[lane] = sqrtf(x[lane]);
  }
  return x;
}

/* Writes lane_count whole parts and fractions of x >= 0. */
ICW_DEVICE void split_lanes(const Lanes x, int *whole, float *fraction)
{
  const LanesInt i = __builtin_convertvector(x, LanesInt);
  const Lanes f = x - __builtin_convertvector(i, Lanes);
  __builtin_memcpy(whole, &i, sizeof(i));
  __builtin_memcpy(fraction, &f, sizeof(f));
}

ICW_DEVICE void store_lanes(const Lanes x, float *to)
{
  __builtin_memcpy(to, &x, sizeof(x));
}

/* The nearest whole number; |x| < 2^22. Floats as large as the one that is added are whole. */
ICW_DEVICE Lanes lanes_round(const Lanes x)
{
  constexpr float whole = 12582912.0f; /* 1.5 * 2^23 */
  return (x + whole) - whole;
}

/* The whole number below; 0 <= x < 2^31. */
ICW_DEVICE Lanes lanes_floor(const Lanes x)
{
  return __builtin_convertvector(__builtin_convertvector(x, LanesInt), Lanes);
}

/* 2^x for -126 <= x <= 126: the whole part goes into the exponent, for the rest on [-1/2, 1/2]
 * the Taylor series of 2^x. */
ICW_DEVICE Lanes lanes_exp2(const Lanes x)
{
  const Lanes whole = lanes_round(x);
  const Lanes t = (x - whole) * 0.69314718f;
  const Lanes series = 1.0f +
                       t * (1.0f +
                            t * (0.5f + t * (1.6666667e-1f +
                                             t * (4.1666667e-2f +
                                                  t * (8.3333333e-3f + t * 1.3888889e-3f)))));
  const LanesInt bits = (__builtin_convertvector(whole, LanesInt) + 127) << 23;
  return series * (Lanes)bits;
}

ICW_DEVICE Lanes lanes_max(const Lanes a, const Lanes b)
{
  return a > b ? a : b;
}

/* Halves, quarters and neighbours change places, so that after three steps every lane has met all
 * others. */
ICW_DEVICE float lanes_largest(Lanes x)
{
  x = lanes_max(x, __builtin_shufflevector(x, x, 4, 5, 6, 7, 0, 1, 2, 3));
  x = lanes_max(x, __builtin_shufflevector(x, x, 2, 3, 0, 1, 6, 7, 4, 5));
  x = lanes_max(x, __builtin_shufflevector(x, x, 1, 0, 3, 2, 5, 4, 7, 6));
  return x[0];
}

ICW_DEVICE float lanes_sum(Lanes x)
{
  x += __builtin_shufflevector(x, x, 4, 5, 6, 7, 0, 1, 2, 3);
  x += __builtin_shufflevector(x, x, 2, 3, 0, 1, 6, 7, 4, 5);
  x += __builtin_shufflevector(x, x, 1, 0, 3, 2, 5, 4, 7, 6);
  return x[0];
}

#else

constexpr int lane_count = 1;
typedef float Lanes;

ICW_DEVICE Lanes lanes(const float x)
{
  return x;
}

ICW_DEVICE Lanes lane_numbers()
{
  return 0.0f;
}

ICW_DEVICE float get_lane(const Lanes x, const int)
{
  return x;
}

ICW_DEVICE Lanes load_lanes(const float *x)
{
  return *x;
}

ICW_DEVICE void load_records(const float *const *at, Lanes &a, Lanes &b, Lanes &c, Lanes &d)
{
  a = at[0][0];
  b = at[0][1];
  c = at[0][2];
  d = at[0][3];
}

ICW_DEVICE Lanes lanes_sqrt(const Lanes x)
{
  return sqrtf(x);
}

ICW_DEVICE void split_lanes(const Lanes x, int *whole, float *fraction)
{
  *whole = int(x);
  *fraction = x - float(*whole);
}

ICW_DEVICE void store_lanes(const Lanes x, float *to)
{
  *to = x;
}

ICW_DEVICE Lanes lanes_round(const Lanes x)
{
  return floorf(x + 0.5f);
}

ICW_DEVICE Lanes lanes_floor(const Lanes x)
{
  return floorf(x);
}

ICW_DEVICE Lanes lanes_exp2(const Lanes x)
{
  return exp2f(x);
}

ICW_DEVICE Lanes lanes_max(const Lanes a, const Lanes b)
{
  return a > b ? a : b;
}

ICW_DEVICE float lanes_largest(const Lanes x)
{
  return x;
}

ICW_DEVICE float lanes_sum(const Lanes x)
{
  return x;
}

#endif

ICW_DEVICE Lanes lanes_min(const Lanes a, const Lanes b)
{
  return a < b ? a : b;
}

/* exp(-x^2 / 2), 0 below 1e-18. */
ICW_DEVICE Lanes lanes_bell(const Lanes x)
{
  const Lanes exponent = -0.72134752f * x * x;
  return exponent > -60.0f ? lanes_exp2(lanes_max(exponent, lanes(-60.0f))) : lanes(0.0f);
}

/* Gaussian density of standard deviation sigma. */
ICW_DEVICE Lanes lanes_gaussian(const Lanes x, const Lanes sigma)
{
  return 0.39894228f / sigma * lanes_bell(x / sigma);
}

namespace lanes_detail {

/* sin(2 pi t) for -1/4 <= t <= 1/4, the Taylor series. */
ICW_DEVICE Lanes sin_quarter(const Lanes t)
{
  const Lanes a = two_pi * t;
  const Lanes a2 = a * a;
  return a *
         (1.0f + a2 * (-1.6666667e-1f +
                       a2 * (8.3333333e-3f +
                             a2 * (-1.9841270e-4f + a2 * (2.7557319e-6f + a2 * -2.5052108e-8f)))));
}

}  // namespace lanes_detail

/* Sine and cosine of 2 pi turns, folded to a quarter on either side of 0. */
ICW_DEVICE void lanes_sincos_turns(const Lanes turns, Lanes &sine, Lanes &cosine)
{
  const Lanes t = turns - lanes_round(turns);
  const Lanes magnitude = lanes_max(t, -t);
  const Lanes folded = lanes_min(magnitude, 0.5f - magnitude);
  sine = lanes_detail::sin_quarter(t < 0.0f ? -folded : folded);
  cosine = lanes_detail::sin_quarter(0.25f - magnitude);
}

ICW_DEVICE Lanes lanes_sin_turns(const Lanes turns)
{
  const Lanes t = turns - lanes_round(turns);
  const Lanes magnitude = lanes_max(t, -t);
  const Lanes folded = lanes_min(magnitude, 0.5f - magnitude);
  return lanes_detail::sin_quarter(t < 0.0f ? -folded : folded);
}

ICW_DEVICE Lanes lanes_cos_turns(const Lanes turns)
{
  const Lanes t = turns - lanes_round(turns);
  return lanes_detail::sin_quarter(0.25f - lanes_max(t, -t));
}

}  // namespace icwafer
