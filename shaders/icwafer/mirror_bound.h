/* SPDX-License-Identifier: Apache-2.0 */

/* What keeps the PHYSICAL model from reflecting more light than comes in: a bound for the mirror
 * order (physical_model.h, "Energy"). */

#pragma once

#include "physical_model.h"

namespace icwafer {

namespace physical_detail {

/* Orders +-m of one axis in groups, wider and wider: 1, 2, 3-4, 5-7, 8-11, 12-16, 17-23. */
constexpr int group_limit = 7;
constexpr int grouped_orders = 24;

ICW_DEVICE constexpr int group_first(const int group)
{
  constexpr int first[group_limit + 1] = {1, 2, 3, 5, 8, 12, 17, 24};
  return first[group];
}

ICW_DEVICE constexpr int group_last(const int group)
{
  return group_first(group + 1) - 1;
}

/* How many of the groups there are, and U^2 of each for one side of the axis. */
struct OrderGroups {
  int count;
  float weight[group_limit];
  /* Twice U^2 of all orders beyond. */
  float rest;
};

/* Those within `farthest` of the mirror order, in direction cosines. */
ICW_DEVICE OrderGroups order_groups(const Lattice lattice, const float open, const float farthest)
{
  OrderGroups groups;
  groups.count = 0;
  groups.rest = 0.0f;
  if (!(lattice.spacing_nm > 0.0f)) {
    return groups;
  }
  const float horizon = farthest * lattice.spacing_nm / first_nm;
  /* The last group within the horizon may reach beyond it. */
  float power[grouped_orders];
  for (int k = 0; k < grouped_orders && float(k) < 1.4f * horizon; k += lane_count) {
    store_lanes(square(open) * order_power(float(k + 1) + lane_numbers(), lanes(lattice.duty)),
                power + k);
  }
  float left = square(open) * lattice.duty * (1.0f - lattice.duty);
  for (; groups.count < group_limit && float(group_first(groups.count)) <= horizon;
       groups.count++) {
    float weight = 0.0f;
    for (int m = group_first(groups.count); m <= group_last(groups.count); m++) {
      weight += power[m - 1];
    }
    groups.weight[groups.count] = weight;
    left -= 2.0f * weight;
  }
  groups.rest = float(group_first(groups.count)) <= horizon ? larger(left, 0.0f) : 0.0f;
  return groups;
}

/* The most that the contrast can be within a group of orders, and its mean over lobes, from what
 * it is in their middle.
 *
 * With thickness h of the film, 4 pi h / lambda bounds how much its phase changes an amplitude per
 * unit of the cosine (Airy's resonances are narrower at grazing angles, but the phase is slower
 * there by the same factor); 8 more was found to cover Fresnel's amplitudes. Over a lobe in which
 * the phase between the two levels has the standard deviation s, the mean of 2 - 2 cos(phase) is
 * nearer to 2 by exp(-s^2 / 2).
 *   group_range, lobe_range   how far the cosine reaches from the middle; the cosine of the film
 *                             is the mean of two, one of which is the same for all orders */
ICW_DEVICE Lanes largest_contrast(const PhysicalParams &p,
                                  const Lanes contrast,
                                  const Lanes group_range,
                                  const Lanes lobe_range,
                                  const Lanes per_nm)
{
  const Lanes slope = (two_pi * (p.oxide_nm + p.groove_nm)) * per_nm + 4.0f;
  const Lanes amplitude = lanes_min(lanes_sqrt(contrast) + group_range * slope, lanes(2.0f));
  const Lanes group = amplitude * amplitude;
  const Lanes s = (two_pi * (0.5f * p.oxide_nm + p.groove_nm)) * per_nm * lobe_range;
  return group + lanes_max(2.0f - group, lanes(0.0f)) * lanes_min(0.5f * s * s, lanes(1.0f));
}

/* One axis of a mirror order's bound. */
struct BoundAxis {
  OrderGroups groups;
  float spacing_nm;
  /* The pair's middle direction along this axis and along the other. */
  float mid, mid_other;
};

/* The most that a group of orders reflects on one side; no contrast is above `limit`. */
ICW_DEVICE_LARGE Lanes largest_power(const PhysicalParams &p,
                                     const BoundAxis &axis,
                                     const int group,
                                     const float side,
                                     const float cosine,
                                     const float sigma_0,
                                     const Lanes limit,
                                     const Lanes film_ior,
                                     const Complex<Lanes> metal,
                                     const Lanes per_nm)
{
  const Lanes per_order = 1.0f / (axis.spacing_nm * per_nm);
  /* How far from the normal an order is, and its cosine, 0 below the horizon. */
  const auto sine_of = [&](const float order) {
    const Lanes sine = axis.mid + side * order * per_order;
    return lanes_sqrt(square(axis.mid_other) + sine * sine);
  };
  const auto cosine_of = [](const Lanes sine) {
    return lanes_sqrt(lanes_max(1.0f - sine * sine, lanes(0.0f)));
  };
  const float first_order = float(group_first(group)), last_order = float(group_last(group));
  const float order = 0.5f * (first_order + last_order);
  const Lanes middle = sine_of(order), cos_middle = cosine_of(middle);
  Lanes nearest = middle, group_range = lanes(0.0f);
  if (last_order > first_order) {
    const Lanes first = sine_of(first_order), last = sine_of(last_order);
    const Lanes cos_first = cosine_of(first), cos_last = cosine_of(last);
    nearest = lanes_min(first, last);
    group_range = lanes_max(lanes_max(cos_first, cos_last) - cos_middle,
                            cos_middle - lanes_min(cos_first, cos_last));
  }
  const Lanes sigma = sigma_0 + p.variation * order * per_order;
  /* The part of a lobe that may be above the horizon, at least. */
  const Lanes above = lanes_min(lanes_max(1.0f + 0.5f * (1.0f - nearest) / sigma, lanes(0.0f)),
                                lanes(1.0f));
  const Lanes lobe_range = 0.5f * (cosine_of(lanes_max(middle - sigma, lanes(0.0f))) -
                                   cosine_of(middle + sigma));
  const Lanes contrast = levels_contrast(p, 0.5f * (cosine + cos_middle), film_ior, metal, per_nm);
  return axis.groups.weight[group] * above *
         lanes_min(largest_contrast(p, contrast, group_range, lobe_range, per_nm), limit);
}

/* What bounds the mirror order: all others, for light from the pair's middle direction. */
struct MirrorBound {
  BoundAxis axes[2];
  float cosine, sigma_0;
  /* U^2 of the orders with m and n, few and taken at the most that they can be. */
  float diagonal;
};

/* Where lobes that reach above the horizon have their middle, at most; the widest is that of the
 * order as far away as can be. */
ICW_DEVICE float lobes_horizon(const PhysicalParams &p, const float sigma_0)
{
  return 1.0f + 2.0f * (sigma_0 + 2.0f * p.variation);
}

ICW_DEVICE_LARGE MirrorBound mirror_bound(const PhysicalParams &p, const Pair &pair)
{
  const bool cross = p.along.spacing_nm > 0.0f;
  const float sigma_0 = sqrtf(
      larger(physical_lobe_variance(p, p.across), physical_lobe_variance(p, p.along)));
  const float horizon = lobes_horizon(p, sigma_0);
  return {
      {{order_groups(p.across,
                     cross ? 1.0f - p.along.duty : 1.0f,
                     smaller(horizon + fabsf(pair.mid_nu), 2.0f)),
        p.across.spacing_nm,
        pair.mid_nu,
        pair.mid_tau},
       {order_groups(p.along, 1.0f - p.across.duty, smaller(horizon + fabsf(pair.mid_tau), 2.0f)),
        p.along.spacing_nm,
        pair.mid_tau,
        pair.mid_nu}},
      sqrtf(larger(1.0f - square(pair.mid_nu) - square(pair.mid_tau), 0.0f)),
      sigma_0,
      cross ? p.across.duty * (1.0f - p.across.duty) * p.along.duty * (1.0f - p.along.duty) :
              0.0f};
}

/* The most that |r_ridge - r_groove|^2 can be, whatever the thicknesses and the angle. The phase
 * of the film moves r on a circle; for an amplitude r' of the lower face its diameter is at most
 * 2 |r'|, and no light is reflected better there than that which is polarised across the plane of
 * incidence and came in at grazing angles. */
ICW_DEVICE Lanes contrast_limit(const Lanes film_ior, const Complex<Lanes> metal)
{
  const Lanes film = lanes_sqrt(film_ior * film_ior - 1.0f);
  const Complex<Lanes> squared = metal * metal;
  const Complex<Lanes> below = decaying_sqrt<Lanes>({squared.re - 1.0f, squared.im});
  return 4.0f * norm(Complex<Lanes>{film - below.re, below.im}) /
         norm(Complex<Lanes>{film + below.re, below.im});
}

/* eta_00', the smaller of eta_00 and 1 less all other orders. No order takes more than U^2 times
 * `limit`, so most wavelengths need only the first few for the bound to be out of reach. */
ICW_DEVICE_LARGE Lanes bounded_mirror(const PhysicalParams &p,
                                      const MirrorBound &bound,
                                      const Lanes eta,
                                      const Lanes limit,
                                      const Lanes film_ior,
                                      const Complex<Lanes> metal,
                                      const Lanes per_nm)
{
  const float shortest_nm = 1.0f / lanes_largest(per_nm);
  const float horizon = lobes_horizon(p, bound.sigma_0);
  /* U^2 of what may be above the horizon and is not in the sum yet, and two bits for each group
   * that it has. */
  float rest = 0.0f;
  unsigned int left[2] = {0, 0};
  for (int i = 0; i < 2; i++) {
    const BoundAxis &axis = bound.axes[i];
    if (axis.groups.count == 0) {
      continue;
    }
    const float reach = sqrtf(square(horizon) - square(axis.mid_other));
    const float per_order = axis.spacing_nm / shortest_nm;
    const float last_negative = (reach + axis.mid) * per_order;
    const float last_positive = (reach - axis.mid) * per_order;
    for (int group = 0; group < axis.groups.count; group++) {
      const float first = float(group_first(group));
      const float weight = axis.groups.weight[group];
      if (first < last_negative) {
        left[i] |= 1u << 2 * group;
        rest += weight;
      }
      if (first < last_positive) {
        left[i] |= 2u << 2 * group;
        rest += weight;
      }
    }
    rest += axis.groups.rest;
  }
  Lanes others = bound.diagonal * limit;
  for (int k = 0; (left[0] | left[1]) >> k != 0u; k++) {
    for (int axis = 0; axis < 2; axis++) {
      if ((left[axis] >> k & 1u) == 0u) {
        continue;
      }
      if (lanes_largest(eta + others + rest * limit) <= 1.0f) {
        return eta;
      }
      rest -= bound.axes[axis].groups.weight[k / 2];
      others += largest_power(p,
                              bound.axes[axis],
                              k / 2,
                              k % 2 == 0 ? -1.0f : 1.0f,
                              bound.cosine,
                              bound.sigma_0,
                              limit,
                              film_ior,
                              metal,
                              per_nm);
    }
  }
  return lanes_max(lanes_min(eta, 1.0f - rest * limit - others), lanes(0.0f));
}

}  // namespace physical_detail

}  // namespace icwafer
