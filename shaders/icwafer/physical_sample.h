/* SPDX-License-Identifier: Apache-2.0 */

/* Sampling of the PHYSICAL model: the order by its power, the wavelength by the eye's sensitivity
 * under the lamp, then the place within the lobe.
 *
 * Because du dv = cos theta d omega, directions are sampled as points of the unit disc. The
 * density of (u, v) is a mixture of the mirror order, of the orders of each axis, each over the
 * two humps that the sum of the three sensitivities has (blue; green and red), and of a tail for
 * orders too many to tell apart, which falls off as their power does,
 *
 *   1 / (1 + (m / m_1)^2),  m_1 = 1 / (sqrt(2) pi f).
 *
 * With crossing wires an order (m, n) has its u and its v from one wavelength: u is drawn first,
 * and the v of order n follows from the wavelength that u is of in order m.
 *
 * Lobes are logistic densities, close to Gaussians but with heavier tails. A point outside the
 * disc is no direction: a sample that finds none, as in other closures. Evaluation and sampling
 * use this one density. */

#pragma once

#include "physical.h"

namespace icwafer {

/* What depends on the parameters and the view only. */
struct PhysicalView {
  /* Squared difference of the amplitudes at the humps: in the mirror direction, and for the first
   * order on either side. */
  float mirror_contrast[2], contrast[2][2];
  /* Power of the mirror order and of all orders together: an estimate of the reflectance. */
  float mirror_power, total_power;
};

namespace physical_detail {

/* Orders that are told apart on either side; beyond them the colours overlap. */
constexpr int order_limit = 6;
constexpr float shortest_nm = 400.0f;
constexpr float mean_nm = 550.0f;
/* Where the tail begins, in orders: the blue of the first order beyond the limit. */
constexpr float tail_begin = 5.0f;
/* A tail that ends before this is left out. */
constexpr float tail_least = 6.5f;
/* Fits a Gaussian's body best. */
constexpr float logistic_per_sigma = 0.59f;

ICW_DEVICE Lanes logistic_lobes(const Lanes x, const Lanes scale)
{
  const Lanes t = x / scale;
  const Lanes e = lanes_exp2(lanes_max(-1.44269504f * lanes_max(t, -t), lanes(-60.0f)));
  const Lanes sum = 1.0f + e;
  return e / (sum * sum * scale);
}

ICW_DEVICE float logistic_density(const float x, const float sigma)
{
  const float scale = logistic_per_sigma * sigma;
  const float e = expf(-smaller(fabsf(x) / scale, 42.0f));
  return e / (square(1.0f + e) * scale);
}

/* The point below which the part `part` of a logistic density lies. */
ICW_DEVICE float logistic_point(const float part, const float sigma)
{
  const float inside = clamped(part, 1e-7f, 1.0f - 1e-6f);
  return logistic_per_sigma * sigma * logf(inside / (1.0f - inside));
}

/* The orders of one lattice other than 0, seen along one axis. */
struct Comb {
  Lattice lattice;
  /* Orders told apart on the negative and on the positive side. */
  int negative, positive;
  /* Where the tails end, in orders of the mean wavelength; tail_begin where there is none. */
  float tail_negative, tail_positive;
  /* Power of A^2 on one side beyond the limit. */
  float tail_power;
};

/* `view` is the component of the view along the axis. */
ICW_DEVICE Comb comb(const Lattice lattice, const float view)
{
  Comb c = {lattice, 0, 0, tail_begin, tail_begin, 0.0f};
  if (!(lattice.spacing_nm > 0.0f)) {
    return c;
  }
  const float per_order = lattice.spacing_nm / shortest_nm;
  c.negative = int(smaller((1.0f - view) * per_order, float(order_limit)));
  c.positive = int(smaller((1.0f + view) * per_order, float(order_limit)));
  c.tail_negative = larger((1.0f - view) * lattice.spacing_nm / mean_nm, tail_begin);
  c.tail_positive = larger((1.0f + view) * lattice.spacing_nm / mean_nm, tail_begin);
  if (larger(c.tail_negative, c.tail_positive) > tail_least) {
    float power = 0.5f * lattice.duty * (1.0f - lattice.duty);
    for (int m = 1; m <= order_limit; m++) {
      power -= square(sinf(pi * float(m) * lattice.duty) / (pi * float(m)));
    }
    c.tail_power = larger(power, 0.0f);
  }
  return c;
}

ICW_DEVICE float tail_scale(const Comb &c)
{
  const float duty = smaller(c.lattice.duty, 1.0f - c.lattice.duty);
  return larger(0.2250791f / larger(duty, 1e-4f), tail_begin);
}

/* Tails on the negative and the positive side; a side that ends before it begins has none. */
ICW_DEVICE float tail_share(const Comb &c, const bool positive)
{
  return (positive ? c.tail_positive : c.tail_negative) > tail_least ? c.tail_power : 0.0f;
}

ICW_DEVICE float tail_total(const Comb &c)
{
  return tail_share(c, false) + tail_share(c, true);
}

/* Density of the tails over q, times their power. */
ICW_DEVICE float tail_density(const Comb &c, const float q)
{
  const bool positive = q > 0.0f;
  const float share = tail_share(c, positive);
  const float order = fabsf(q) * c.lattice.spacing_nm / mean_nm;
  const float end = positive ? c.tail_positive : c.tail_negative;
  if (!(share > 0.0f) || order < tail_begin || order > end) {
    return 0.0f;
  }
  const float scale = tail_scale(c);
  const float span = scale * (atanf(end / scale) - atanf(tail_begin / scale));
  return share * c.lattice.spacing_nm / (mean_nm * span * (1.0f + square(order / scale)));
}

/* The q below which the part `part` of the tails lies. */
ICW_DEVICE float tail_point(const Comb &c, const float part)
{
  const float left = part * tail_total(c);
  const bool positive = left >= tail_share(c, false);
  const float share = tail_share(c, positive);
  const float inside = clamped(
      (positive ? left - tail_share(c, false) : left) / share, 0.0f, 1.0f);
  const float end = positive ? c.tail_positive : c.tail_negative;
  const float scale = tail_scale(c);
  const float begin = atanf(tail_begin / scale);
  const float order = scale * tanf(begin + inside * (atanf(end / scale) - begin));
  return (positive ? order : -order) * mean_nm / c.lattice.spacing_nm;
}

/* Lobes of a comb, lane_count at a time, at the humps of the sensitivities. */
struct Humps {
  Lanes order, mean, scale, power;
};

ICW_DEVICE int hump_count(const Comb &c)
{
  return 2 * (c.negative + c.positive);
}

/* `contrast[side][hump]`, side 1 for positive orders. */
ICW_DEVICE_LARGE Humps humps(const PhysicalParams &p,
                             const Comb &c,
                             const float contrast[2][2],
                             const int first)
{
  /* Lanes: order -1 at both humps, -2, ..., then 1, 2, ... */
  float numbers[lane_count];
  for (int lane = 0; lane < lane_count; lane++) {
    numbers[lane] = float(first + lane);
  }
  const Lanes number = load_lanes(numbers);
  const Lanes position = lanes_round(0.5f * number - 0.25f);
  const Lanes second = number - 2.0f * position;
  const float negative = float(c.negative);
  const IlluminantHump blue = illuminant_hump(p.illuminant, 0),
                       red = illuminant_hump(p.illuminant, 1);
  const auto hump = [&](const float at_blue, const float at_red) {
    return second > 0.5f ? lanes(at_red) : lanes(at_blue);
  };

  Humps lobes;
  lobes.order = position < negative ? -1.0f - position : position - negative + 1.0f;
  const Lanes nm = hump(blue.mean_nm, red.mean_nm);
  const Lanes power = position < negative ?
                          hump(blue.weight * contrast[0][0], red.weight * contrast[0][1]) :
                          hump(blue.weight * contrast[1][0], red.weight * contrast[1][1]);
  const Lanes per_nm = lobes.order / c.lattice.spacing_nm;
  lobes.mean = nm * per_nm;
  const Lanes spread_nm = hump(blue.sigma_nm, red.sigma_nm) * per_nm;
  lobes.scale = logistic_per_sigma *
                lanes_sqrt(lobe_variance(p, c.lattice, nm, lobes.mean) + spread_nm * spread_nm);
  const Lanes amplitude = order_amplitude(lobes.order, lanes(c.lattice.duty));
  lobes.power = number < float(hump_count(c)) ? power * amplitude * amplitude : lanes(0.0f);
  return lobes;
}

ICW_DEVICE float comb_power(const PhysicalParams &p, const Comb &c, const float contrast[2][2])
{
  float sum = 0.0f;
  for (int first = 0; first < hump_count(c); first += lane_count) {
    sum += lanes_sum(humps(p, c, contrast, first).power);
  }
  return sum;
}

/* Mean over sides and humps, for the tails. */
ICW_DEVICE float mean_contrast(const float contrast[2][2])
{
  return 0.25f * (contrast[0][0] + contrast[0][1] + contrast[1][0] + contrast[1][1]);
}

/* All that evaluation and sampling of the density share for one view. */
struct Mixture {
  Comb across, along;
  /* Both sides alike: for orders along the wires the mirror's. */
  float along_contrast[2][2];
  /* The part of the other axis that is open: the factor of an axis' own orders, and what the
   * orders (m, n) of one m add up to. That of the wires along is divided by, so never 0. */
  float open_across, open_along;
  /* Standard deviations of the mirror lobe. */
  float sigma_u, sigma_v;
};

ICW_DEVICE Mixture mixture(const PhysicalParams &p,
                           const PhysicalView &view,
                           const LocalDirection o)
{
  Mixture x;
  x.across = comb(p.across, o.nu);
  x.along = comb(p.along, o.tau);
  for (int hump = 0; hump < 2; hump++) {
    x.along_contrast[0][hump] = view.mirror_contrast[hump];
    x.along_contrast[1][hump] = view.mirror_contrast[hump];
  }
  x.open_across = 1.0f - p.across.duty;
  x.open_along = p.along.spacing_nm > 0.0f ? larger(1.0f - p.along.duty, 1e-6f) : 1.0f;
  x.sigma_u = sqrtf(physical_lobe_variance(p, p.across));
  x.sigma_v = sqrtf(physical_lobe_variance(p, p.along));
  return x;
}

/* Standard deviation of v around order n, given the wavelength and how well u tells it. */
ICW_DEVICE float row_sigma(const PhysicalParams &p,
                           const float wavelength_nm,
                           const float shift,
                           const float relative)
{
  return sqrtf(lobe_variance(p, p.along, wavelength_nm, shift) + square(relative * shift));
}

/* Scale of a Cauchy density of v that far out is that of the orders beyond the limit: their power
 * falls off as 1 / (2 pi^2 n^2) and is 1 / (pi^2 (limit + 1/2)) in all. */
ICW_DEVICE float row_tail_scale(const float per_order)
{
  return 0.5f * pi * (float(order_limit) + 0.5f) * per_order;
}

/* Density of v in a row m != 0 of orders (m, n), light of this wavelength, known to the part
 * `relative`. */
ICW_DEVICE_LARGE float row_density(const PhysicalParams &p,
                                   const Mixture &x,
                                   const float v,
                                   const float wavelength_nm,
                                   const float relative)
{
  if (!(p.along.spacing_nm > 0.0f)) {
    return logistic_density(v, x.sigma_v);
  }
  float sum = x.open_along * logistic_density(v, x.sigma_v);
  float left = p.along.duty;
  const float per_order = wavelength_nm / p.along.spacing_nm;
  for (int n = 1; n <= order_limit; n++) {
    const float share = square(sinf(pi * float(n) * p.along.duty) / (pi * float(n))) /
                        x.open_along;
    const float shift = float(n) * per_order;
    const float sigma = row_sigma(p, wavelength_nm, shift, relative);
    sum += share * (logistic_density(v - shift, sigma) + logistic_density(v + shift, sigma));
    left -= 2.0f * share;
  }
  const float scale = row_tail_scale(per_order);
  return sum + larger(left, 0.0f) * scale / (pi * (square(v) + square(scale)));
}

ICW_DEVICE float row_point(const PhysicalParams &p,
                           const Mixture &x,
                           const float random,
                           const float wavelength_nm,
                           const float relative)
{
  if (!(p.along.spacing_nm > 0.0f)) {
    return logistic_point(random, x.sigma_v);
  }
  float left = random - x.open_along;
  if (left < 0.0f) {
    return logistic_point(random / x.open_along, x.sigma_v);
  }
  const float per_order = wavelength_nm / p.along.spacing_nm;
  float rest = p.along.duty;
  for (int n = 1; n <= order_limit; n++) {
    const float share = square(sinf(pi * float(n) * p.along.duty) / (pi * float(n))) /
                        x.open_along;
    const float shift = float(n) * per_order;
    if (left < 2.0f * share) {
      const bool positive = left < share;
      const float part = (positive ? left : left - share) / share;
      return (positive ? shift : -shift) +
             logistic_point(part, row_sigma(p, wavelength_nm, shift, relative));
    }
    left -= 2.0f * share;
    rest -= 2.0f * share;
  }
  const float part = clamped(left / larger(rest, 1e-12f), 1e-6f, 1.0f - 1e-6f);
  return row_tail_scale(per_order) * tanf(pi * (part - 0.5f));
}

/* Wavelength that u is of in order m, and how well u tells it. */
struct RowWavelength {
  float nm, relative;
};

ICW_DEVICE RowWavelength row_wavelength(const PhysicalParams &p,
                                        const Mixture &x,
                                        const float u,
                                        const float order)
{
  const float nm = clamped(u * p.across.spacing_nm / order, shortest_nm, 700.0f);
  return {nm, x.sigma_u * p.across.spacing_nm / (fabsf(order) * nm)};
}

}  // namespace physical_detail

/* Once for each view. */
template<typename Tables>
ICW_DEVICE_LARGE PhysicalView physical_view(const PhysicalParams &p,
                                            const LocalDirection o,
                                            const Tables &tables)
{
  using namespace physical_detail;
  PhysicalView view = {};
  /* Lanes: the mirror order, the first order on the negative and on the positive side, each at
   * both humps. */
  constexpr int used = 6;
  float power[2] = {0.0f, 0.0f};
  const float ridge_part = covered(p.across, p.along);
  for (int first = 0; first < used; first += lane_count) {
    float cosine[lane_count], wavelength[lane_count], n[lane_count], k[lane_count];
    for (int lane = 0; lane < lane_count; lane++) {
      const int index = first + lane < used ? first + lane : 0;
      const int hump = index % 2, side = index / 2 == 0 ? 0 : 2 * (index / 2) - 3;
      const float nm = illuminant_hump(p.illuminant, hump).mean_nm;
      const float out = -o.nu + float(side) * nm / p.across.spacing_nm;
      cosine[lane] = larger(0.5f * (o.n + sqrtf(larger(1.0f - square(out) - square(o.tau), 0.0f))),
                            1e-4f);
      wavelength[lane] = nm;
      const int cell = int(nm) - visible_first_nm;
      const ComplexIndex metal = p.metal == metal_custom ? custom_index(p, nm) :
                                                           tables.metal(p.metal, cell);
      n[lane] = metal.n;
      k[lane] = metal.k;
    }
    const Lanes per_nm = 1.0f / load_lanes(wavelength);
    const FilmPair<Lanes> r = levels(p,
                                     load_lanes(cosine),
                                     cauchy_index(p.oxide, per_nm),
                                     {load_lanes(n), load_lanes(k)},
                                     per_nm);
    const Lanes mirror = ridge_part * r.ridge + (1.0f - ridge_part) * r.groove -
                         ridge_part * (1.0f - ridge_part) * r.contrast;
    for (int lane = 0; lane < lane_count && first + lane < used; lane++) {
      const int index = first + lane, hump = index % 2;
      /* A little of each order is always sampled: what is dark at the humps need not be so
       * between them. */
      const float contrast = get_lane(r.contrast, lane) + 0.05f;
      if (index < 2) {
        view.mirror_contrast[hump] = contrast;
        power[hump] = get_lane(mirror, lane) + 0.01f;
      }
      else {
        view.contrast[index / 2 - 1][hump] = contrast;
      }
    }
  }
  const float blue = illuminant_hump(p.illuminant, 0).weight;
  view.mirror_power = blue * power[0] + (1.0f - blue) * power[1];

  const Mixture x = mixture(p, view, o);
  view.total_power = view.mirror_power +
                     x.open_along * (comb_power(p, x.across, view.contrast) +
                                     tail_total(x.across) * mean_contrast(view.contrast)) +
                     square(x.open_across) *
                         (comb_power(p, x.along, x.along_contrast) +
                          tail_total(x.along) * mean_contrast(x.along_contrast));
  return view;
}

/* Density of the sampled direction i over solid angle. */
ICW_DEVICE_LARGE float physical_pdf(const PhysicalParams &p,
                                    const PhysicalView &view,
                                    const LocalDirection o,
                                    const LocalDirection i)
{
  using namespace physical_detail;
  const Mixture x = mixture(p, view, o);
  const float u = i.nu + o.nu, v = i.tau + o.tau;
  const bool cross = p.along.spacing_nm > 0.0f;
  const float mirror_u = logistic_density(u, x.sigma_u);
  float sum = view.mirror_power * mirror_u * logistic_density(v, x.sigma_v);

  float rows = 0.0f;
  for (int first = 0; first < hump_count(x.across); first += lane_count) {
    const Humps lobes = humps(p, x.across, view.contrast, first);
    const Lanes density = lobes.power * logistic_lobes(u - lobes.mean, lobes.scale);
    if (!cross) {
      rows += lanes_sum(density);
      continue;
    }
    for (int lane = 0; lane < lane_count; lane++) {
      if (get_lane(density, lane) > 0.0f) {
        const RowWavelength row = row_wavelength(p, x, u, get_lane(lobes.order, lane));
        rows += get_lane(density, lane) * row_density(p, x, v, row.nm, row.relative);
      }
    }
  }
  const float tail = tail_density(x.across, u) * mean_contrast(view.contrast);
  if (!cross) {
    sum += (rows + tail) * logistic_density(v, x.sigma_v);
  }
  else {
    sum += x.open_along * (rows + tail * row_density(p, x, v, mean_nm, 0.2f));
    float along = tail_density(x.along, v) * mean_contrast(x.along_contrast);
    for (int first = 0; first < hump_count(x.along); first += lane_count) {
      const Humps lobes = humps(p, x.along, x.along_contrast, first);
      along += lanes_sum(lobes.power * logistic_lobes(v - lobes.mean, lobes.scale));
    }
    sum += square(x.open_across) * along * mirror_u;
  }
  return sum / view.total_power * i.n;
}

/* A direction for the view o from two random numbers in [0, 1). i.n = 0 where there is none. */
ICW_DEVICE_LARGE LocalDirection physical_sample(const PhysicalParams &p,
                                                const PhysicalView &view,
                                                const LocalDirection o,
                                                const float random_across,
                                                const float random_along)
{
  using namespace physical_detail;
  const Mixture x = mixture(p, view, o);
  float u = 0.0f, v = 0.0f;

  /* Choose a lobe by its power; what is left of the random number chooses the place in it. */
  float left = random_across * view.total_power;
  const float across_tail = x.open_along * tail_total(x.across) * mean_contrast(view.contrast);
  const float along_tail = square(x.open_across) * tail_total(x.along) *
                           mean_contrast(x.along_contrast);
  bool found = false;
  if (left < view.mirror_power) {
    u = logistic_point(left / view.mirror_power, x.sigma_u);
    v = logistic_point(random_along, x.sigma_v);
    found = true;
  }
  left -= view.mirror_power;
  if (!found && left < across_tail) {
    u = tail_point(x.across, left / across_tail);
    v = row_point(p, x, random_along, mean_nm, 0.2f);
    found = true;
  }
  left -= across_tail;
  if (!found && left < along_tail) {
    v = tail_point(x.along, left / along_tail);
    u = logistic_point(random_along, x.sigma_u);
    found = true;
  }
  left -= along_tail;
  for (int axis = 0; axis < 2 && !found; axis++) {
    const Comb &c = axis == 0 ? x.across : x.along;
    const float scale = axis == 0 ? x.open_along : square(x.open_across);
    for (int first = 0; first < hump_count(c) && !found; first += lane_count) {
      const Humps lobes = humps(p, c, axis == 0 ? view.contrast : x.along_contrast, first);
      for (int lane = 0; lane < lane_count && !found; lane++) {
        const float power = scale * get_lane(lobes.power, lane);
        if (left < power) {
          const float q = get_lane(lobes.mean, lane) +
                          logistic_point(left / power,
                                         get_lane(lobes.scale, lane) / logistic_per_sigma);
          if (axis == 0) {
            const RowWavelength row = row_wavelength(p, x, q, get_lane(lobes.order, lane));
            u = q;
            v = row_point(p, x, random_along, row.nm, row.relative);
          }
          else {
            v = q;
            u = logistic_point(random_along, x.sigma_u);
          }
          found = true;
        }
        left -= power;
      }
    }
  }

  const float nu = u - o.nu, tau = v - o.tau;
  const float cos_squared = 1.0f - square(nu) - square(tau);
  if (!found || !(cos_squared > 0.0f)) {
    return {0.0f, 0.0f, 0.0f};
  }
  return {nu, tau, sqrtf(cos_squared)};
}

}  // namespace icwafer
