/* SPDX-License-Identifier: Apache-2.0 */

/* Sampling of the PHYSICAL model: the order by its power, the wavelength by the eye's sensitivity
 * under the lamp, then the place within the lobe.
 *
 * Because du dv = cos theta d omega, directions are sampled as points of the unit disc. The
 * density of (u, v) is a mixture of the mirror order, of the orders of each axis, and of a tail for
 * orders too many to tell apart, which falls off as their power does,
 *
 *   1 / (1 + (m / m_1)^2),  m_1 = 1 / (sqrt(2) pi f).
 *
 * Lobes are logistic densities, close to Gaussians but with heavier tails. The spectrum of an
 * order consists of bands in which it is even (tables.h), each as bright as the sensitivities and
 * the film in its middle make it. An even band from a to b under a logistic density of scale s is
 *
 *   (L((u - a) / s) - L((u - b) / s)) / (b - a),  L(x) = 1 / (1 + exp(-x))
 *
 * and the point below which the part t / D of it lies, D = (b - a) / s, is
 *
 *   a + s (t + log((1 - exp(-t)) / (1 - exp(t - D)))).
 *
 * The order and its u tell the wavelength, which gives the width of v. With crossing wires an order
 * (m, n) has its u and its v from one wavelength, too: u is drawn first.
 *
 * Orders and bands follow each other as their places do, so that samples whose random numbers are
 * spread evenly spread evenly over colours. A point outside the disc is no direction: a sample that
 * finds none, as in other closures. Evaluation and sampling use this one density. */

#pragma once

#include "physical.h"

namespace icwafer {

/* What depends on the parameters and the view only. */
struct PhysicalView {
  /* Edges of the spectrum's bands, and by how much the density of light over wavelength rises at
   * each, but for A(m)^2: on the negative and on the positive side. */
  float edge_nm[band_edge_count], rise[2][band_edge_count];
  /* Its integral over all bands, and the mean of both sides. */
  float side_power[2], mean_power;
  /* Power of the mirror order and of all orders together: an estimate of the reflectance. */
  float mirror_power, total_power;
};

namespace physical_detail {

/* Orders that are told apart on either side; beyond them the colours overlap. */
constexpr int order_limit = 6;
constexpr float shortest_nm = 400.0f;
constexpr float mean_nm = 550.0f, spectrum_sigma_nm = 60.0f;
/* Where the tail begins, in orders: the blue of the first order beyond the limit. */
constexpr float tail_begin = 5.0f;
/* A tail that ends before this is left out. */
constexpr float tail_least = 6.5f;
/* How much of the light behind the horizon is sampled. */
constexpr float hidden_part = 0.05f;
/* Fits a Gaussian's body best. */
constexpr float logistic_per_sigma = 0.59f;
/* Where the density is left out: at 2e-6 of its middle, 13 scales away. */
constexpr float logistic_reach = 13.0f * logistic_per_sigma;

/* L(x). */
ICW_DEVICE Lanes logistic_part(const Lanes x)
{
  const Lanes exponent = -1.44269504f * x;
  return 1.0f / (1.0f + lanes_exp2(lanes_max(lanes_min(exponent, lanes(60.0f)), lanes(-60.0f))));
}

ICW_DEVICE Lanes logistic_lobes(const Lanes x, const Lanes sigma)
{
  const Lanes scale = logistic_per_sigma * sigma;
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
  /* How far there are directions on either side. */
  float open_negative, open_positive;
  /* Where the tails end, in orders of the mean wavelength; tail_begin where there is none. */
  float tail_negative, tail_positive;
  /* Power of A^2 on one side beyond the limit. */
  float tail_power;
};

/* `view` is the component of the view along the axis, `other` along the other one. */
ICW_DEVICE Comb comb(const PhysicalParams &p,
                     const Lattice lattice,
                     const Lattice other_lattice,
                     const float view,
                     const float other)
{
  Comb c = {lattice, 0, 0, 0.0f, 0.0f, tail_begin, tail_begin, 0.0f};
  if (!(lattice.spacing_nm > 0.0f)) {
    return c;
  }
  const float sigma = sqrtf(physical_lobe_variance(p, lattice));
  const float other_sigma = sqrtf(physical_lobe_variance(p, other_lattice));
  const float radius = sigma +
                       sqrtf(1.0f - square(larger(fabsf(other) - 2.0f * other_sigma, 0.0f)));
  c.open_negative = larger(radius - view, 0.0f);
  c.open_positive = larger(radius + view, 0.0f);
  const float per_order = lattice.spacing_nm / shortest_nm;
  c.negative = int(smaller((c.open_negative + 2.0f * sigma) * per_order, float(order_limit)));
  c.positive = int(smaller((c.open_positive + 2.0f * sigma) * per_order, float(order_limit)));
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

/* The orders of one side of a comb: side 1 the positive ones. Along the wires the spectrum is the
 * mean of the sides across. */
struct Side {
  int count;
  /* How far there are directions. */
  float open;
  /* The parts that the sides across have in the spectrum. */
  float part[2];
};

ICW_DEVICE Side comb_side(const Comb &c, const int side)
{
  return {side ? c.positive : c.negative, side ? c.open_positive : c.open_negative, {0.5f, 0.5f}};
}

ICW_DEVICE Side side_across(const Comb &c, const int side)
{
  Side result = comb_side(c, side);
  result.part[0] = side ? 0.0f : 1.0f;
  result.part[1] = side ? 1.0f : 0.0f;
  return result;
}

/* first, first + 1, ... */
ICW_DEVICE Lanes counted_lanes(const int first)
{
  float numbers[lane_count];
  for (int lane = 0; lane < lane_count; lane++) {
    numbers[lane] = float(first + lane);
  }
  return load_lanes(numbers);
}

/* Where the horizon is at open_nm, of the light beyond little is sampled, right behind it: for the
 * lobes' edges that come back over it. */
template<typename Real> ICW_DEVICE Real before_horizon(const Real nm, const float open_nm)
{
  const Real behind = (1.0f - hidden_part) * open_nm + hidden_part * nm;
  return nm < behind ? nm : behind;
}

/* Power of a band of an order and how far it reaches. */
struct Band {
  float begin_nm, end_nm, power;
};

/* `density` is that in the band before, and becomes that in this one. */
ICW_DEVICE Band order_band(
    const PhysicalView &view, const Side &side, const int band, const float per_nm, float &density)
{
  density += side.part[0] * view.rise[0][band] + side.part[1] * view.rise[1][band];
  const float open_nm = side.open / per_nm;
  const float begin = before_horizon(view.edge_nm[band], open_nm);
  const float end = before_horizon(view.edge_nm[band + 1], open_nm);
  return {begin, end, larger(density, 0.0f) * (end - begin)};
}

/* But for A(m)^2. */
ICW_DEVICE float spectrum_power(const PhysicalView &view, const Side &side, const float per_nm)
{
  if (view.edge_nm[band_count] * per_nm < side.open) {
    return side.part[0] * view.side_power[0] + side.part[1] * view.side_power[1];
  }
  float sum = 0.0f, density = 0.0f;
  for (int band = 0; band < band_count; band++) {
    sum += order_band(view, side, band, per_nm, density).power;
  }
  return sum;
}

ICW_DEVICE float orders_power(const PhysicalView &view, const Side &side, const Lattice &lattice)
{
  float sum = 0.0f;
  for (int first = 1; first <= side.count; first += lane_count) {
    const Lanes amplitude = order_amplitude(counted_lanes(first), lanes(lattice.duty));
    for (int lane = 0; lane < lane_count && first + lane <= side.count; lane++) {
      sum += square(get_lane(amplitude, lane)) *
             spectrum_power(view, side, float(first + lane) / lattice.spacing_nm);
    }
  }
  return sum;
}

/* Standard deviation of the lobe of an order, the same for all of its colours. */
template<typename Real>
ICW_DEVICE Real order_variance(const PhysicalParams &p, const Lattice &lattice, const Real m)
{
  return lobe_variance(p, lattice, Real{} + mean_nm, m * (mean_nm / lattice.spacing_nm));
}

/* Density over q > 0 of light whose spectrum an order spreads by this much per nanometre. */
ICW_DEVICE float spectrum_density(const PhysicalView &view,
                                  const Side &side,
                                  const float q,
                                  const float per_nm,
                                  const float scale)
{
  Lanes sum = lanes(0.0f);
  const float per_scale = 1.0f / scale, open_nm = side.open / per_nm;
  for (int first = 0; first < band_edge_count; first += lane_count) {
    const Lanes rise = side.part[0] * load_lanes(view.rise[0] + first) +
                       side.part[1] * load_lanes(view.rise[1] + first);
    const Lanes x = (q - per_nm * before_horizon(load_lanes(view.edge_nm + first), open_nm)) *
                    per_scale;
    sum += rise * logistic_part(x);
  }
  return larger(lanes_sum(sum), 0.0f) / per_nm;
}

/* The part of a band of width D, in scales, and of what is beyond: see above. */
ICW_DEVICE float one_minus_exp(const float x)
{
  return x < 0.01f ? x * (1.0f - 0.5f * x) : 1.0f - expf(-x);
}

ICW_DEVICE float band_point(const float begin,
                            const float end,
                            const float part,
                            const float scale)
{
  const float inside = clamped(part, 1e-6f, 1.0f - 1e-6f);
  const float width = (end - begin) / scale;
  const float t = inside * width;
  return begin + scale * (t + logf(one_minus_exp(t) / one_minus_exp((1.0f - inside) * width)));
}

/* The q > 0 below which the part `part` of the light of an order lies. */
ICW_DEVICE float spectrum_point(const PhysicalView &view,
                                const Side &side,
                                const float part,
                                const float per_nm,
                                const float scale)
{
  float left = part * spectrum_power(view, side, per_nm), density = 0.0f;
  for (int number = 0;; number++) {
    const Band band = order_band(view, side, number, per_nm, density);
    if (left < band.power || number == band_count - 1) {
      return band_point(per_nm * band.begin_nm, per_nm * band.end_nm, left / band.power, scale);
    }
    left -= band.power;
  }
}

/* All that evaluation and sampling of the density share for one view. */
struct Mixture {
  Comb across, along;
  /* The part of the other axis that is open: the factor of an axis' own orders, and what the
   * orders (m, n) of one m add up to. That of the wires along is divided by, so never 0. */
  float open_across, open_along;
  /* Standard deviations of the mirror lobe. */
  float sigma_u, sigma_v;
};

ICW_DEVICE Mixture mixture(const PhysicalParams &p, const LocalDirection o)
{
  Mixture x;
  x.across = comb(p, p.across, p.along, o.nu, o.tau);
  x.along = comb(p, p.along, p.across, o.tau, o.nu);
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
  const float sigma_0 = row_sigma(p, wavelength_nm, 0.0f, 0.0f);
  if (!(p.along.spacing_nm > 0.0f)) {
    return logistic_density(v, sigma_0);
  }
  float sum = x.open_along * logistic_density(v, sigma_0);
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
  const float sigma_0 = row_sigma(p, wavelength_nm, 0.0f, 0.0f);
  if (!(p.along.spacing_nm > 0.0f)) {
    return logistic_point(random, sigma_0);
  }
  float left = random - x.open_along;
  if (left < 0.0f) {
    return logistic_point(random / x.open_along, sigma_0);
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

/* How well u tells the wavelength of an order. */
ICW_DEVICE float row_relative(const PhysicalParams &p,
                              const Mixture &x,
                              const float m,
                              const float wavelength_nm)
{
  return x.sigma_u * p.across.spacing_nm / (m * wavelength_nm);
}

/* Wavelength that order m has at q > 0; the less a lobe of width sigma tells it, the nearer to the
 * mean. */
template<typename Real>
ICW_DEVICE Real order_wavelength(const PhysicalView &view,
                                 const Lattice &lattice,
                                 const Real m,
                                 const float q,
                                 const float sigma)
{
  const Real nm_per_q = lattice.spacing_nm / m;
  const Real unknown = (sigma / spectrum_sigma_nm) * nm_per_q;
  const Real nm = mean_nm + (q * nm_per_q - mean_nm) / (1.0f + unknown * unknown);
  const float least = view.edge_nm[0], most = view.edge_nm[band_count];
  return nm > least ? (nm < most ? nm : Real{} + most) : Real{} + least;
}

/* Orders of a side whose lobes reach q. */
struct OrderRange {
  int first, last;
};

ICW_DEVICE OrderRange orders_near(const PhysicalParams &p,
                                  const PhysicalView &view,
                                  const Lattice &lattice,
                                  const Side &side,
                                  const float q)
{
  const float reach = logistic_reach * sqrtf(order_variance(p, lattice, 0.0f));
  const float spread_nm = logistic_reach * p.variation * mean_nm;
  const float least_nm = view.edge_nm[0] - spread_nm;
  const float most_nm = view.edge_nm[band_count] + spread_nm;
  const float count = float(side.count);
  const float least = (q - reach) * lattice.spacing_nm / most_nm;
  float most = least_nm > 0.0f ? (q + reach) * lattice.spacing_nm / least_nm : count;
  /* Those behind the horizon are not where their wavelengths say. */
  const float behind = q + reach - (1.0f - hidden_part) * side.open;
  if (behind + count * spread_nm / lattice.spacing_nm > 0.0f) {
    most = spread_nm > 0.0f ?
               count :
               larger(most, behind / hidden_part * lattice.spacing_nm / least_nm);
  }
  return {int(ceilf(clamped(least, 1.0f, count + 1.0f))),
          q + reach > 0.0f ? int(smaller(most, count)) : 0};
}

/* Density of the orders of one side, q > 0 there, and `other` across it. `rows`: each is a row of
 * orders of the wires along. */
ICW_DEVICE_LARGE float side_density(const PhysicalParams &p,
                                    const PhysicalView &view,
                                    const Mixture &x,
                                    const Side &side,
                                    const Lattice &lattice,
                                    const Lattice &other_lattice,
                                    const float q,
                                    const float other,
                                    const bool rows)
{
  const OrderRange range = orders_near(p, view, lattice, side, q);
  const float sigma = sqrtf(physical_lobe_variance(p, lattice));
  float sum = 0.0f;
  for (int first = range.first; first <= range.last; first += lane_count) {
    const Lanes m = counted_lanes(first);
    const Lanes amplitude = order_amplitude(m, lanes(lattice.duty));
    const Lanes scale = logistic_per_sigma * lanes_sqrt(order_variance(p, lattice, m));
    const Lanes nm = order_wavelength(view, lattice, m, q, sigma);
    Lanes power = amplitude * amplitude;
    if (!rows) {
      power *= logistic_lobes(
          lanes(other), lanes_sqrt(lobe_variance(p, other_lattice, nm, lanes(0.0f))));
    }
    for (int lane = 0; lane < lane_count && first + lane <= range.last; lane++) {
      const float order = float(first + lane);
      float density = get_lane(power, lane) *
                      spectrum_density(
                          view, side, q, order / lattice.spacing_nm, get_lane(scale, lane));
      if (rows && density > 0.0f) {
        const float wavelength_nm = get_lane(nm, lane);
        density *= row_density(
            p, x, other, wavelength_nm, row_relative(p, x, order, wavelength_nm));
      }
      sum += density;
    }
  }
  return sum;
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
  for (int edge = 0; edge < band_edge_count; edge++) {
    view.edge_nm[edge] = tables.band_edge_nm(p.illuminant, edge);
  }
  /* Lanes: the first order on the negative and on the positive side, in every other band. */
  constexpr int nodes = 4;
  float contrast[2][nodes];
  const float ridge_part = covered(p.across, p.along);
  for (int first = 0; first < 2 * nodes; first += lane_count) {
    float cosine[lane_count], wavelength[lane_count], n[lane_count], k[lane_count];
    for (int lane = 0; lane < lane_count; lane++) {
      const int index = first + lane, band = 2 * (index % nodes);
      const float side = float(2 * (index / nodes) - 1);
      const float nm = 0.5f * (view.edge_nm[band] + view.edge_nm[band + 1]);
      const float out = side * nm / p.across.spacing_nm - o.nu;
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
    for (int lane = 0; lane < lane_count; lane++) {
      const int index = first + lane;
      /* A little of each order is always sampled: what is dark here need not be so between. */
      contrast[index / nodes][index % nodes] = get_lane(r.contrast, lane) + 0.05f;
      view.mirror_power += (get_lane(mirror, lane) + 0.01f) / float(2 * nodes);
    }
  }
  for (int side = 0; side < 2; side++) {
    for (int band = 0; band < band_count; band++) {
      const float power = tables.band_weight(p.illuminant, band) * 0.5f *
                          (contrast[side][band / 2] + contrast[side][(band + 1) / 2]);
      const float density = power / (view.edge_nm[band + 1] - view.edge_nm[band]);
      view.rise[side][band] += density;
      view.rise[side][band + 1] -= density;
      view.side_power[side] += power;
    }
  }
  view.mean_power = 0.5f * (view.side_power[0] + view.side_power[1]);

  const Mixture x = mixture(p, o);
  float across = tail_total(x.across) * view.mean_power;
  float along = tail_total(x.along) * view.mean_power;
  for (int side = 0; side < 2; side++) {
    across += orders_power(view, side_across(x.across, side), p.across);
    along += orders_power(view, comb_side(x.along, side), p.along);
  }
  view.total_power = view.mirror_power + x.open_along * across + square(x.open_across) * along;
  return view;
}

/* Density of the sampled direction i over solid angle. */
ICW_DEVICE_LARGE float physical_pdf(const PhysicalParams &p,
                                    const PhysicalView &view,
                                    const LocalDirection o,
                                    const LocalDirection i)
{
  using namespace physical_detail;
  const Mixture x = mixture(p, o);
  const float u = i.nu + o.nu, v = i.tau + o.tau;
  const bool cross = p.along.spacing_nm > 0.0f;
  const float mirror_u = logistic_density(u, x.sigma_u);
  float across = tail_density(x.across, u) * view.mean_power;
  if (across > 0.0f) {
    across *= row_density(p, x, v, mean_nm, 0.2f);
  }
  float along = 0.0f;
  for (int side = 0; side < 2; side++) {
    const float sign = side ? 1.0f : -1.0f;
    across += side_density(p,
                           view,
                           x,
                           side_across(x.across, side),
                           p.across,
                           p.along,
                           sign * u,
                           v,
                           cross);
    if (cross) {
      along += side_density(p,
                            view,
                            x,
                            comb_side(x.along, side),
                            p.along,
                            p.across,
                            sign * v,
                            u,
                            false);
    }
  }
  if (cross) {
    along += tail_density(x.along, v) * view.mean_power * mirror_u;
  }
  const float sum = view.mirror_power * mirror_u * logistic_density(v, x.sigma_v) +
                    x.open_along * across + square(x.open_across) * along;
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
  const Mixture x = mixture(p, o);
  float u = 0.0f, v = 0.0f;

  /* Choose a lobe by its power, in the order of their places; what is left of the random number
   * chooses the place in it. */
  float left = random_across * view.total_power;
  bool found = false;
  const auto choose_order = [&](const bool is_across, const int side) {
    const Lattice &lattice = is_across ? p.across : p.along;
    const Side orders = is_across ? side_across(x.across, side) :
                                    comb_side(x.along, side);
    const float scale = is_across ? x.open_along : square(x.open_across);
    const float sigma = is_across ? x.sigma_u : x.sigma_v;
    for (int k = 1; k <= orders.count && !found; k++) {
      const int m = side ? k : orders.count + 1 - k;
      const float power = scale * square(sinf(pi * float(m) * lattice.duty) / (pi * float(m))) *
                          spectrum_power(view, orders, float(m) / lattice.spacing_nm);
      if (left < power) {
        const float part = left / power, order = float(m), sign = side ? 1.0f : -1.0f;
        const float q = spectrum_point(view,
                                       orders,
                                       side ? part : 1.0f - part,
                                       order / lattice.spacing_nm,
                                       logistic_per_sigma *
                                           sqrtf(order_variance(p, lattice, order)));
        const float wavelength_nm = order_wavelength(view, lattice, order, q, sigma);
        if (is_across) {
          u = sign * q;
          v = row_point(
              p, x, random_along, wavelength_nm, row_relative(p, x, order, wavelength_nm));
        }
        else {
          v = sign * q;
          u = logistic_point(random_along,
                             sqrtf(lobe_variance(p, p.across, wavelength_nm, 0.0f)));
        }
        found = true;
      }
      left -= power;
    }
  };
  choose_order(true, 0);
  if (!found && left < view.mirror_power) {
    u = logistic_point(left / view.mirror_power, x.sigma_u);
    v = logistic_point(random_along, x.sigma_v);
    found = true;
  }
  left -= view.mirror_power;
  if (!found) {
    choose_order(true, 1);
  }
  const float across_tail = x.open_along * tail_total(x.across) * view.mean_power;
  if (!found && left < across_tail) {
    u = tail_point(x.across, left / across_tail);
    v = row_point(p, x, random_along, mean_nm, 0.2f);
    found = true;
  }
  left -= across_tail;
  if (!found) {
    choose_order(false, 0);
  }
  if (!found) {
    choose_order(false, 1);
  }
  const float along_tail = square(x.open_across) * tail_total(x.along) * view.mean_power;
  if (!found && left < along_tail) {
    v = tail_point(x.along, left / along_tail);
    u = logistic_point(random_along, x.sigma_u);
    found = true;
  }

  const float nu = u - o.nu, tau = v - o.tau;
  const float cos_squared = 1.0f - square(nu) - square(tau);
  if (!found || !(cos_squared > 0.0f)) {
    return {0.0f, 0.0f, 0.0f};
  }
  return {nu, tau, sqrtf(cos_squared)};
}

}  // namespace icwafer
