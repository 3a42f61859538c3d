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
#include "tables.h"

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
/* Without the ends, at which the eye hardly sees: 0.2 % of blue and 0.1 % of red, which only share
 * in a mean. */
constexpr float grid_first_nm = 390.0f;
constexpr float grid_last_nm = 730.0f;
/* The shortest wavelength that matters to the eye: fringes are finest there. */
constexpr float blue_nm = 420.0f;
/* Bandwidth of a Gaussian of standard deviation 1 that leaves 0.15 % of it, and where it is cut
 * off. */
constexpr float gaussian_bandwidth = 3.6f;
constexpr float lobe_reach = 4.5f;
constexpr float mirror_reach = 5.5f;
/* Under a lamp without lines, a narrow lobe whose middle is where the eye sees well matters no
 * further than this. */
constexpr float bright_first_nm = 425.0f, bright_last_nm = 670.0f, bright_sigma_nm = 16.0f;
constexpr float bright_lamp_per_nm = 0.6f, bright_reach = 3.3f;
/* Orders further apart than twice this many standard deviations are told apart. */
constexpr float apart_reach = 3.0f;
/* A lobe of this standard deviation in orders hides them. */
constexpr float smooth_orders = 0.56f;
/* Ripples of less than exp(-hidden) in the mean density of orders are left out. */
constexpr float hidden = 6.5f;
/* Where a grid's step is found. */
constexpr float grid_middle_nm = 600.0f;
/* An order's steps above this are rounded down to whole nanometres. */
constexpr float whole_step_nm = 2.0f;
/* No grid has fewer nodes. */
constexpr float few_nodes = 20.0f;
/* More orders than this are not summed one by one. */
constexpr int window_limit = 24;

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

/* Orders +-m of one axis in groups, wider and wider (1, 2, 3-4, 5-7, 8-11, ...): the middle of
 * each and how far it reaches on either side, and U^2 for one side of the axis. */
constexpr int group_limit = 9;

struct OrderGroups {
  int count;
  float order[group_limit], reach[group_limit], weight[group_limit];
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
  /* A(m)^2 = (1 - cos(2 pi m f)) / (2 pi^2 m^2); the cosines by Chebyshev's recurrence. */
  const float cosine_1 = cosf(two_pi * lattice.duty);
  float cosine = cosine_1, before = 1.0f;
  float left = lattice.duty * (1.0f - lattice.duty);
  const float horizon = farthest * lattice.spacing_nm / first_nm;
  int first = 1;
  for (; groups.count < group_limit && float(first) <= horizon; groups.count++) {
    const int last = first + (2 * first) / 5;
    float weight = 0.0f;
    for (int m = first; m <= last; m++) {
      weight += (1.0f - cosine) / (2.0f * square(pi * float(m)));
      const float next = 2.0f * cosine_1 * cosine - before;
      before = cosine;
      cosine = next;
    }
    groups.order[groups.count] = 0.5f * float(first + last);
    groups.reach[groups.count] = 0.5f * float(last - first);
    groups.weight[groups.count] = square(open) * larger(weight, 0.0f);
    left -= 2.0f * weight;
    first = last + 1;
  }
  groups.rest = float(first) <= horizon ? square(open) * larger(left, 0.0f) : 0.0f;
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
  const float order = axis.groups.order[group], reach = axis.groups.reach[group];
  const Lanes middle = sine_of(order), cos_middle = cosine_of(middle);
  Lanes nearest = middle, group_range = lanes(0.0f);
  if (reach > 0.0f) {
    const Lanes first = sine_of(order - reach), last = sine_of(order + reach);
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
      const float first = axis.groups.order[group] - axis.groups.reach[group];
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

/* How the orders of the axis that tells the wavelength best are summed. */
enum class Orders {
  /* Out of reach. */
  None,
  /* One order for each node, where the lobes leave gaps in between. */
  Single,
  /* All orders at each node. */
  All,
  /* Their mean density. */
  Dense,
};

/* The integration over the wavelengths. */
template<typename Tables>
struct Integrator {
  const PhysicalParams &p;
  const Pair &pair;
  const Tables &tables;
  /* The axis that tells the wavelength best comes first. */
  Lattice first, second;
  float q_first, q_second;
  Orders orders;
  /* Where the mirror order is in reach, what bounds it. */
  const MirrorBound *bound = nullptr;
  int dense_ripples = 0;

  /* Whether all nodes are whole nanometres, where the tables need no interpolation. */
  bool whole = false;
  Lanes red = lanes(0.0f), green = lanes(0.0f), blue = lanes(0.0f);
  Lanes weight_red = lanes(0.0f), weight_green = lanes(0.0f), weight_blue = lanes(0.0f);

  /* Adds a node in each lane. They are inside the visible range, so there is a next entry in the
   * tables. */
  ICW_DEVICE_LARGE_METHOD void add_lanes(const Lanes wavelength,
                                         const Lanes step,
                                         const Lanes node_order)
  {
    int cell[lane_count];
    float fraction[lane_count];
    split_lanes(wavelength - (whole ? first_nm - 0.5f : first_nm), cell, fraction);
    Lanes s_red, s_green, s_blue;
    tables.sensitivities(p.illuminant, cell, s_red, s_green, s_blue);
    Complex<Lanes> metal, next_metal;
    if (p.metal == metal_custom) {
      metal = custom_metal(wavelength);
    }
    else {
      tables.metals(p.metal, cell, metal, next_metal);
    }
    if (!whole) {
      const Lanes part = load_lanes(fraction);
      for (int &i : cell) {
        i++;
      }
      Lanes next_red, next_green, next_blue;
      tables.sensitivities(p.illuminant, cell, next_red, next_green, next_blue);
      s_red += part * (next_red - s_red);
      s_green += part * (next_green - s_green);
      s_blue += part * (next_blue - s_blue);
      if (p.metal != metal_custom) {
        metal = metal + part * (next_metal - metal);
      }
    }
    const Lanes f = reflected(wavelength, node_order, metal);
    s_red *= step;
    s_green *= step;
    s_blue *= step;
    red += s_red * f;
    green += s_green * f;
    blue += s_blue * f;
    weight_red += s_red;
    weight_green += s_green;
    weight_blue += s_blue;
  }

  /* Adds up the nodes of a rule (tables.h). */
  ICW_DEVICE_LARGE_METHOD void add_rule(const int rule)
  {
    for (int node = 0; node < rule_nodes(rule); node += lane_count) {
      const auto row = [&](const int number) {
        return tables.rule_row(p.illuminant, rule, number, node);
      };
      const Lanes wavelength = row(0);
      Complex<Lanes> metal;
      if (p.metal == metal_custom) {
        metal = custom_metal(wavelength);
      }
      else {
        metal = {row(4 + 2 * int(p.metal)), row(5 + 2 * int(p.metal))};
      }
      const Lanes f = reflected(wavelength, lanes(0.0f), metal);
      red += row(1) * f;
      green += row(2) * f;
      blue += row(3) * f;
    }
  }

  ICW_DEVICE_METHOD Complex<Lanes> custom_metal(const Lanes wavelength) const
  {
    float n[lane_count], k[lane_count];
    for (int lane = 0; lane < lane_count; lane++) {
      const ComplexIndex index = custom_index(p, get_lane(wavelength, lane));
      n[lane] = index.n;
      k[lane] = index.k;
    }
    return {load_lanes(n), load_lanes(k)};
  }

  ICW_DEVICE_METHOD Rgb sum() const
  {
    return {lanes_sum(red), lanes_sum(green), lanes_sum(blue)};
  }

  /* Divided by the weights, so that a flat spectrum is exactly white at any step. The ripples of
   * a density, without those that are hidden, may go below 0. */
  ICW_DEVICE_METHOD Rgb mean() const
  {
    return {larger(lanes_sum(red), 0.0f) / lanes_sum(weight_red),
            larger(lanes_sum(green), 0.0f) / lanes_sum(weight_green),
            larger(lanes_sum(blue), 0.0f) / lanes_sum(weight_blue)};
  }

  /* f at the wavelengths of the nodes. */
  ICW_DEVICE_METHOD Lanes reflected(const Lanes wavelength,
                                    const Lanes node_order,
                                    const Complex<Lanes> metal) const
  {
    const Lanes per_nm = 1.0f / wavelength;
    const Lanes film_ior = cauchy_index(p.oxide, per_nm);
    FilmPair<Lanes> r = {};
    if (bound) {
      r = levels(p, lanes(pair.cosine), film_ior, metal, per_nm);
    }
    else {
      r.contrast = levels_contrast(p, lanes(pair.cosine), film_ior, metal, per_nm);
    }
    const Lanes sigma_first = lanes_sqrt(lobe_variance(p, first, wavelength, lanes(0.0f)));
    const Lanes sigma_second = lanes_sqrt(lobe_variance(p, second, wavelength, lanes(0.0f)));
    const Lanes zero_second = lanes_gaussian(lanes(q_second), sigma_second);
    const float open_first = first.spacing_nm > 0.0f ? 1.0f - first.duty : 1.0f;
    const float open_second = second.spacing_nm > 0.0f ? 1.0f - second.duty : 1.0f;
    const Lanes others_second = all_orders(second, q_second, sigma_second, per_nm);
    const Lanes others_first = first_orders(wavelength, node_order, sigma_first, per_nm);

    Lanes f = r.contrast * others_first * (square(open_second) * zero_second + others_second);
    if (bound) {
      const float ridge_part = covered(p.across, p.along);
      const float groove_part = 1.0f - ridge_part;
      Lanes eta = ridge_part * r.ridge + groove_part * r.groove -
                  ridge_part * groove_part * r.contrast;
      const Lanes limit = contrast_limit(film_ior, metal);
      if (lanes_largest(eta + ridge_part * groove_part * limit) > 1.0f) {
        eta = bounded_mirror(p, *bound, eta, limit, film_ior, metal, per_nm);
      }
      f += lanes_gaussian(lanes(q_first), sigma_first) *
           (eta * zero_second + square(open_first) * r.contrast * others_second);
    }
    return f;
  }

  /* Sum over the orders but 0 of A^2 G along one axis. */
  ICW_DEVICE_METHOD Lanes all_orders(const Lattice lattice,
                                     const float q,
                                     const Lanes sigma,
                                     const Lanes per_nm) const
  {
    if (!(lattice.spacing_nm > 0.0f)) {
      return lanes(0.0f);
    }
    const Lanes per_shift = lattice.spacing_nm * per_nm;
    return per_shift * order_sum(q * per_shift, sigma * per_shift, lattice.duty, p.variation);
  }

  ICW_DEVICE_METHOD Lanes first_orders(const Lanes wavelength,
                                       const Lanes node_order,
                                       const Lanes sigma,
                                       const Lanes per_nm) const
  {
    if (orders == Orders::None) {
      return lanes(0.0f);
    }
    if (orders == Orders::All) {
      return all_orders(first, q_first, sigma, per_nm);
    }
    if (orders == Orders::Dense) {
      const Lanes per_shift = first.spacing_nm * per_nm;
      return per_shift *
             order_density(
                 q_first * per_shift, sigma * per_shift, first.duty, p.variation, dense_ripples);
    }
    const Lanes shift = node_order * wavelength / first.spacing_nm;
    const Lanes amplitude = order_amplitude(node_order, lanes(first.duty));
    const Lanes sigma_m = p.variation > 0.0f ?
                              lanes_sqrt(lobe_variance(p, first, wavelength, shift)) :
                              sigma;
    return amplitude * amplitude * lanes_gaussian(q_first - shift, sigma_m);
  }
};

/* The lobe of one order in wavelength, and the step for it. */
struct OrderLobe {
  float centre_nm, sigma_nm, step_nm;
};

/* Nodes, gathered until all lanes are full. */
template<typename Tables>
struct NodeQueue {
  Integrator<Tables> &integrator;
  int count = 0;
  float wavelength_nm[lane_count], step_nm[lane_count], order[lane_count];

  ICW_DEVICE_METHOD explicit NodeQueue(Integrator<Tables> &to) : integrator(to)
  {
  }

  ICW_DEVICE_METHOD void add(const float node_nm, const float node_step_nm, const float node_order)
  {
    wavelength_nm[count] = node_nm;
    step_nm[count] = node_step_nm;
    order[count] = node_order;
    if (++count == lane_count) {
      flush();
    }
  }

  /* Adds up the nodes gathered so far. */
  ICW_DEVICE_METHOD void flush()
  {
    if (count == 0) {
      return;
    }
    for (; count < lane_count; count++) {
      wavelength_nm[count] = wavelength_nm[0];
      step_nm[count] = 0.0f;
      order[count] = order[0];
    }
    count = 0;
    integrator.add_lanes(load_lanes(wavelength_nm), load_lanes(step_nm), load_lanes(order));
  }
};

}  // namespace physical_detail

/* f, integrated over the spectrum; not multiplied by the cosine.
 *
 * Given u and v the wavelengths are known, so nothing is chosen at random. The trapezoid rule with
 * step h is exact for a product of bandwidth below 2 pi / h; what varies is the film, and a lobe
 * (bandwidth 3.6 / sigma) or the sensitivities under the lamp, whichever is narrower. Seven tenths
 * of the bandwidth of film and lamp (eight under lamps with lines), at which 0.1 % of the
 * amplitude is left, keep the integral within 0.3 %. Few orders are taken one after the other,
 * with a step for each; many on a grid; where the eye cannot tell them, their density. Where only
 * film and lamp vary, as for the mirror order by itself, the fewer wavelengths of a rule
 * (tables.h) do. */
template<typename Tables>
ICW_DEVICE_LARGE Rgb physical_eval(const PhysicalParams &p,
                                   const LocalDirection i,
                                   const LocalDirection o,
                                   const Tables &tables)
{
  using namespace physical_detail;
  const Pair pair = {fabsf(i.nu + o.nu),
                     fabsf(i.tau + o.tau),
                     larger(0.5f * (i.n + o.n), 1e-4f),
                     0.5f * (i.nu - o.nu),
                     0.5f * (i.tau - o.tau)};

  /* Most pairs of directions have nothing to do with each other. */
  const bool cross = p.along.spacing_nm > 0.0f;
  const float sigma_u = sqrtf(lobe_variance(p, p.across, last_nm, 0.0f));
  const float sigma_v = sqrtf(lobe_variance(p, p.along, last_nm, 0.0f));
  const bool near_u = pair.u < mirror_reach * sigma_u, near_v = pair.v < mirror_reach * sigma_v;
  if (!near_v && !cross) {
    return {0.0f, 0.0f, 0.0f};
  }
  /* An order's light at q has a spread of wavelengths in proportion to sigma / q. */
  const bool swap = cross && !near_v && (near_u || pair.v * sigma_u > pair.u * sigma_v);
  Integrator<Tables> nodes = {p,
                              pair,
                              tables,
                              swap ? p.along : p.across,
                              swap ? p.across : p.along,
                              swap ? pair.v : pair.u,
                              swap ? pair.u : pair.v,
                              Orders::All};
  const float q = nodes.q_first;
  const float spacing_nm = nodes.first.spacing_nm;
  const bool mirror = near_u && near_v;
  MirrorBound bound;
  if (mirror) {
    bound = mirror_bound(p, pair);
    nodes.bound = &bound;
  }

  /* Orders whose lobes reach into the visible range. */
  const float reach = lobe_reach * (swap ? sigma_v : sigma_u);
  const float reach_spread = lobe_reach * p.variation;
  const int order_first = int(
      ceilf(larger((q - reach) / (1.0f + reach_spread) * spacing_nm / last_nm, 1.0f)));
  const float order_most = (q + reach) / larger(1.0f - reach_spread, 0.1f) * spacing_nm / first_nm;
  if (!mirror && order_most < float(order_first)) {
    return {0.0f, 0.0f, 0.0f};
  }

  /* Phase of the film over 1 / lambda, there and back. */
  const float sine_squared = 1.0f - square(pair.cosine);
  const float blue_ior = cauchy_index(p.oxide, 1.0f / blue_nm);
  const float film_path_nm = 2.0f * sqrtf(larger(square(blue_ior) - sine_squared, 0.0f)) *
                             (p.oxide_nm + p.groove_nm);

  /* The mirror order by itself. */
  const auto rule_for_film = [&]() {
    int rule = 0;
    while (rule < rule_count && film_path_nm >= rule_path_nm(rule)) {
      rule++;
    }
    return rule;
  };
  const float order_1 = first_nm / spacing_nm;
  const bool alone = q + lobe_reach * sqrtf(lobe_variance(p, nodes.first, first_nm, order_1)) <
                     order_1;
  if (alone) {
    nodes.orders = Orders::None;
    const int rule = rule_for_film();
    if (rule < rule_count) {
      nodes.add_rule(rule);
      return nodes.sum();
    }
  }

  const float lamp_per_nm = illuminant_bandwidth_per_nm(p.illuminant);
  const float lamp_part = lamp_per_nm < bright_lamp_per_nm ? 0.7f : 0.8f;

  const auto sigma_nm = [&](const float wavelength_nm) {
    return wavelength_nm / larger(q, 1e-6f) *
           sqrtf(lobe_variance(p, nodes.first, wavelength_nm, q));
  };
  const auto step_nm = [&](const float wavelength_nm, const float lobe_per_nm) {
    /* Lobe and lamp as Gaussians, whose product is narrower than either; of a thick film the
     * second pass counts, too. */
    const float film_path = larger(0.7f * film_path_nm, 2.6f * film_path_nm - 4600.0f);
    return two_pi / (sqrtf(square(lobe_per_nm) + square(lamp_part * lamp_per_nm)) +
                     two_pi * film_path / square(wavelength_nm));
  };
  /* The grid is even in 1 / lambda, in which film and orders are; its step where the eye sees
   * most. `path_nm` is what varies beside film and lamp, over 1 / lambda. */
  constexpr float grid_begin = 1.0f / grid_last_nm, grid_span = 1.0f / grid_first_nm - grid_begin;
  const auto grid_nodes = [&](const float path_nm) {
    return grid_span * square(grid_middle_nm) /
           step_nm(grid_middle_nm, two_pi * path_nm / square(grid_middle_nm));
  };
  const auto lobe_path_nm = [&]() {
    return gaussian_bandwidth / two_pi * square(grid_last_nm) / sigma_nm(grid_last_nm);
  };
  const auto sigma_orders = [&](const float wavelength_nm) {
    return sqrtf(lobe_variance(p, nodes.first, wavelength_nm, q)) * spacing_nm / wavelength_nm;
  };

  /* One order after the other. */
  if (!mirror && order_most - float(order_first) < float(window_limit)) {
    const int order_last = int(order_most);
    const auto lobe_of = [&](const int m) {
      const float centre_nm = q * spacing_nm / float(m);
      const float sigma = sigma_nm(clamped(centre_nm, first_nm, last_nm));
      return OrderLobe{centre_nm,
                       sigma,
                       step_nm(clamped(centre_nm, blue_nm, last_nm), gaussian_bandwidth / sigma)};
    };
    const OrderLobe last = lobe_of(order_last);
    float node_count = 0.0f;
    for (int m = order_first; m <= order_last; m++) {
      const OrderLobe lobe = m < order_last ? lobe_of(m) : last;
      node_count += 2.0f * lobe_reach * lobe.sigma_nm / lobe.step_nm + 1.0f;
    }
    if (node_count < few_nodes ||
        node_count < grid_nodes(sigma_orders(last_nm) > smooth_orders ? 0.0f : lobe_path_nm())) {
      nodes.orders = Orders::Single;
      nodes.whole = last.step_nm > whole_step_nm;
      NodeQueue<Tables> queue(nodes);
      for (int m = order_first; m <= order_last; m++) {
        const OrderLobe lobe = m < order_last ? lobe_of(m) : last;
        const float step = nodes.whole ? floorf(lobe.step_nm) : lobe.step_nm;
        const bool bright = lamp_per_nm < bright_lamp_per_nm && lobe.sigma_nm < bright_sigma_nm &&
                            lobe.centre_nm > bright_first_nm && lobe.centre_nm < bright_last_nm;
        const float reach_nm = (bright ? bright_reach : lobe_reach) * lobe.sigma_nm;
        const float count = ceilf(2.0f * reach_nm / step);
        float node = lobe.centre_nm - 0.5f * step * (count - 1.0f);
        if (nodes.whole) {
          node = floorf(node + 0.5f);
        }
        const float end = smaller(node + step * (count - 0.5f), last_nm);
        if (node < first_nm) {
          node += step * ceilf((first_nm - node) / step);
        }
        for (; node < end; node += step) {
          queue.add(node, step, float(m));
        }
      }
      queue.flush();
      return nodes.sum();
    }
  }

  /* All orders at each node of a grid over the visible range. */
  float path_nm = 0.0f;
  const float path_1_nm = q * spacing_nm;
  const float own_orders = sigma_orders(last_nm);
  /* A ripple of so many turns for each order is hidden by the lobes' width, and as the eye blurs
   * it. */
  const auto seen = [&](const float turns) {
    return 2.0f * square(pi * turns * own_orders) +
               illuminant_blur_per_nm(p.illuminant) *
                   larger(turns * path_1_nm - film_path_nm, 0.0f) <
           hidden;
  };
  const float slit = smaller(nodes.first.duty, 1.0f - nodes.first.duty);
  const int ripples = seen(1.0f - slit) ? 2 : seen(slit) ? 1 : 0;
  const float ripple_path_nm = path_1_nm * (ripples == 2 ? 1.0f - slit :
                                            ripples == 1 ? slit :
                                                           0.0f);
  if (alone) {
    /* Only film and lamp vary. */
  }
  else if (!mirror && !seen(1.0f) && path_1_nm > larger(2.0f, 10.0f * own_orders) * last_nm) {
    nodes.orders = Orders::Dense;
    nodes.dense_ripples = ripples;
    path_nm = ripple_path_nm;
  }
  else if (own_orders < smooth_orders) {
    path_nm = lobe_path_nm();
    if (2.0f * apart_reach * sigma_orders(first_nm) < 1.0f) {
      nodes.orders = Orders::Single;
    }
  }
  else {
    path_nm = ripple_path_nm;
  }
  if (path_nm == 0.0f) {
    const int rule = rule_for_film();
    if (rule < rule_count) {
      nodes.add_rule(rule);
      return nodes.sum();
    }
  }
  const int block_count = int(ceilf(grid_nodes(path_nm) / float(lane_count)));
  const float step = grid_span / float(block_count * lane_count);
  for (int block = 0; block < block_count; block++) {
    const Lanes k = float(block * lane_count) + 0.5f + lane_numbers();
    const Lanes per_nm = grid_begin + step * k;
    const Lanes node = 1.0f / per_nm;
    nodes.add_lanes(
        node, step * node * node, lanes_max(lanes_round(path_1_nm * per_nm), lanes(1.0f)));
  }
  return nodes.mean();
}

}  // namespace icwafer
