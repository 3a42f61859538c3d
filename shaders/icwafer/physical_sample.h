/* SPDX-License-Identifier: Apache-2.0 */

/* Sampling of the PHYSICAL model: the order by its power, the wavelength by the eye's sensitivity
 * under the lamp, then the place within the lobe.
 *
 * Because du dv = cos theta d omega, directions are sampled as points of the unit disc. The
 * density of (u, v) is a mixture of the mirror order, of the orders of each axis, and of a tail
 * for orders too many to tell apart, which falls off about as their power does,
 *
 *   1 / (m + m_1)^2.
 *
 * Lobes are logistic densities, close to Gaussians but with heavier tails. The spectrum of an
 * order consists of bands in which it is even (tables.h), each as bright as the sensitivities and
 * the film in its middle make it, and of a little that is even over all that is visible. A band
 * from a to b under a logistic density of scale s is
 *
 *   (L((u - a) / s) - L((u - b) / s)) / (b - a),  L(x) = 1 / (1 + exp(-x))
 *
 * and the point below which the part t / D of it lies, D = (b - a) / s, is
 *
 *   a + s (t + log((1 - exp(-t)) / (1 - exp(t - D)))).
 *
 * The order and its u tell the wavelength, which gives the width of v. With crossing wires an
 * order (m, n) has its u and its v from one wavelength, too: u is drawn first.
 *
 * Orders and bands follow each other as their places do, so that samples whose random numbers are
 * spread evenly spread evenly over colours. A point outside the disc is no direction: a sample
 * that finds none, as in other closures. Evaluation and sampling use this one density. */

#pragma once

#include "physical.h"

namespace icwafer {

namespace physical_detail {

/* Axes and sides of the directions: of the lattice across and of that along, 1 the positive. */
constexpr int axis_across = 0, axis_along = 1;

}  // namespace physical_detail

/* What depends on the parameters and the view only. */
struct PhysicalView {
  /* Edges of the spectrum's bands, and by how much the density of light over wavelength rises at
   * each, but for A(m)^2: on the negative and on the positive side. */
  float edge_nm[band_edge_count], rise[2][band_edge_count];
  /* For each axis and side, how far there are directions, and the last order that is told apart
   * there. */
  float open[2][2], last_order[2][2];
  /* Power of the orders beyond on one side of each axis, spread over their tail. */
  float tail_power[2];
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
/* Of each order some is always sampled: what is dark at the nodes need not be so between. And all
 * of them less than they reflect, for the mirror order is where a lamp makes most noise. Under a
 * lamp and a sky the noise of frames was found to be least with these two; under a sky alone an
 * order_part of 1 leaves a fifth less. */
constexpr float between_nodes = 0.3f, order_part = 0.63f;
/* Of each order so much is spread evenly over the visible range and all that its lobes reach, so
 * that there are samples of the darkest ends of the spectrum, too. */
constexpr float even_power = 0.01f * order_part;
/* Fits a Gaussian's body best. */
constexpr float logistic_per_sigma = 0.59f;
/* Where the density is left out, at 1e-6 of its middle, and the part of it that lies beyond. */
constexpr float logistic_reach = 8.0f, logistic_beyond = 1.5e-6f;
/* Where the lobe of the longest wavelength has vanished, in standard deviations of that of the
 * mean wavelength. */
constexpr float vanished = 13.0f;

/* L(x). */
ICW_DEVICE Lanes logistic_part(const Lanes x)
{
  const Lanes exponent = -1.44269504f * x;
  return 1.0f / (1.0f + lanes_exp2(lanes_max(lanes_min(exponent, lanes(60.0f)), lanes(-60.0f))));
}

ICW_DEVICE Lanes logistic_lobes(const Lanes x, const Lanes sigma)
{
  const Lanes per_scale = 1.0f / (logistic_per_sigma * sigma);
  const Lanes t = x * per_scale;
  const Lanes e = lanes_exp2(lanes_max(-1.44269504f * lanes_max(t, -t), lanes(-60.0f)));
  const Lanes sum = 1.0f + e;
  return e * per_scale / (sum * sum);
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
  const float inside = clamped(part, logistic_beyond, 1.0f - logistic_beyond);
  return logistic_per_sigma * sigma * logf(inside / (1.0f - inside));
}

/* One axis as the sampling sees it: its lattice, that across it, and what the view knows. */
struct Axis {
  const Lattice &lattice, &other;
  const float *open, *last_order;
  float tail_power;
  /* The parts that the spectra on either side have in that of the axis: across each has its own,
   * along all have the mean. */
  bool own_spectra;
};

ICW_DEVICE Axis view_axis(const PhysicalParams &p, const PhysicalView &view, const int axis)
{
  const bool across = axis == axis_across;
  return {across ? p.across : p.along,
          across ? p.along : p.across,
          view.open[axis],
          view.last_order[axis],
          view.tail_power[axis],
          across};
}

/* ---- Tails ---- */

/* That on one side of an axis, in orders of the mean wavelength. */
struct Tail {
  float end, shift, per_q;

  /* One that ends before it begins is none. */
  ICW_DEVICE_METHOD bool exists() const
  {
    return end > tail_least;
  }

  /* Density over q > 0 of a tail of power 1. No direction is beyond its end. */
  ICW_DEVICE_METHOD float density(const float q) const
  {
    const float order = q * per_q;
    if (!exists() || order < tail_begin) {
      return 0.0f;
    }
    const float span = 1.0f / (tail_begin + shift) - 1.0f / (end + shift);
    return per_q / (span * square(order + shift));
  }

  /* The q > 0 below which the part `part` of it lies. */
  ICW_DEVICE_METHOD float point(const float part) const
  {
    const float first = 1.0f / (tail_begin + shift), last = 1.0f / (end + shift);
    return (1.0f / (first + clamped(part, 0.0f, 1.0f) * (last - first)) - shift) / per_q;
  }
};

/* `view` is the component of the view along the axis. */
ICW_DEVICE Tail tail(const Lattice &lattice, const float view, const int side)
{
  const float per_q = lattice.spacing_nm / mean_nm;
  const float duty = larger(narrower_part(lattice.duty), 1e-4f);
  return {(side ? 1.0f + view : 1.0f - view) * per_q,
          0.5f * larger(0.2250791f / duty, tail_begin),
          per_q};
}

/* ---- The spectrum of an order ---- */

ICW_DEVICE Lanes spectrum_rise(const PhysicalView &view,
                               const bool own_spectra,
                               const int side,
                               const int edge)
{
  const Lanes own = load_lanes(view.rise[side] + edge);
  return own_spectra ? own : 0.5f * (own + load_lanes(view.rise[1 - side] + edge));
}

/* Where the horizon is at open_nm, of the light beyond little is sampled, right behind it: for the
 * lobes' edges that come back over it. */
template<typename Real>
ICW_DEVICE Real before_horizon(const Real nm, const float open_nm)
{
  const Real behind = (1.0f - hidden_part) * open_nm + hidden_part * nm;
  return nm < behind ? nm : behind;
}

/* Power of an order but for A(m)^2, its light open up to open_nm. The integral over bands of
 * rising density is the negative sum of the edges' rises times their places. */
ICW_DEVICE float spectrum_power(const PhysicalView &view,
                                const bool own_spectra,
                                const int side,
                                const float open_nm)
{
  Lanes sum = lanes(0.0f);
  for (int edge = 0; edge < band_edge_count; edge += lane_count) {
    sum -= spectrum_rise(view, own_spectra, side, edge) *
           before_horizon(load_lanes(view.edge_nm + edge), open_nm);
  }
  return larger(lanes_sum(sum), 0.0f);
}

/* Power of each order of an axis on a side, up to the last that is told apart. */
struct OrderPowers {
  int count;
  float power[order_limit];
  float sum;
};

ICW_DEVICE OrderPowers side_powers(const PhysicalView &view,
                                   const Axis &axis,
                                   const float *amplitude_squared,
                                   const int side)
{
  OrderPowers powers;
  powers.count = int(axis.last_order[side]);
  powers.sum = 0.0f;
  const float open_nm = axis.open[side] * axis.lattice.spacing_nm;
  for (int k = 0; k < powers.count; k++) {
    powers.power[k] = amplitude_squared[k] *
                      (spectrum_power(view, axis.own_spectra, side, open_nm / float(k + 1)) +
                       even_power);
    powers.sum += powers.power[k];
  }
  return powers;
}

/* A(m)^2 of the orders 1, 2, ..., at least order_limit of them. */
struct AmplitudesSquared {
  float order[order_limit + lane_count];
};

ICW_DEVICE AmplitudesSquared amplitudes_squared(const Lattice &lattice)
{
  AmplitudesSquared result;
  for (int k = 0; k < order_limit; k += lane_count) {
    store_lanes(order_power(float(k + 1) + lane_numbers(), lanes(lattice.duty)), result.order + k);
  }
  return result;
}

/* Density over q > 0 of light whose spectrum an order spreads by this much per nanometre. */
ICW_DEVICE float spectrum_density(const PhysicalView &view,
                                  const Axis &axis,
                                  const int side,
                                  const float q,
                                  const float nm_per_q,
                                  const float scale)
{
  const float per_scale_nm = 1.0f / (scale * nm_per_q);
  const float nm = q * nm_per_q, open_nm = axis.open[side] * nm_per_q;
  Lanes sum = lanes(0.0f);
  for (int edge = 0; edge < band_edge_count; edge += lane_count) {
    const Lanes edge_nm = before_horizon(load_lanes(view.edge_nm + edge), open_nm);
    sum += spectrum_rise(view, axis.own_spectra, side, edge) *
           logistic_part((nm - edge_nm) * per_scale_nm);
  }
  return larger(lanes_sum(sum), 0.0f) * nm_per_q;
}

/* Where the light of an order is that is spread evenly. */
struct EvenRange {
  float begin, end;
};

ICW_DEVICE EvenRange even_range(const float nm_per_q, const float scale)
{
  const float beyond = logistic_reach / logistic_per_sigma * scale;
  return {first_nm / nm_per_q - beyond, last_nm / nm_per_q + beyond};
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
  const float point = begin + scale * (t + logf(one_minus_exp(t) /
                                                one_minus_exp((1.0f - inside) * width)));
  const float reach = 0.98f * logistic_reach / logistic_per_sigma * scale;
  return clamped(point, begin - reach, end + reach);
}

/* The q below which `left` of the power of an order lies, but for A(m)^2; the even part first. */
ICW_DEVICE float spectrum_point(const PhysicalView &view,
                                const Axis &axis,
                                const int side,
                                float left,
                                const float nm_per_q,
                                const float scale)
{
  if (left < even_power) {
    const EvenRange even = even_range(nm_per_q, scale);
    return even.begin + left / even_power * (even.end - even.begin);
  }
  left -= even_power;
  const float open_nm = axis.open[side] * nm_per_q;
  float density = 0.0f, end = before_horizon(view.edge_nm[0], open_nm);
  for (int band = 0;; band++) {
    density += axis.own_spectra ? view.rise[side][band] :
                                  0.5f * (view.rise[0][band] + view.rise[1][band]);
    const float begin = end;
    end = before_horizon(view.edge_nm[band + 1], open_nm);
    const float power = larger(density, 0.0f) * (end - begin);
    if (left < power || band == band_count - 1) {
      return band_point(begin / nm_per_q, end / nm_per_q, left / power, scale);
    }
    left -= power;
  }
}

/* Variance of the lobe of an order, the same for all of its colours. */
template<typename Real>
ICW_DEVICE Real order_variance(const PhysicalParams &p, const Lattice &lattice, const Real m)
{
  return lobe_variance(p, lattice, Real{} + mean_nm, m * (mean_nm / lattice.spacing_nm));
}

/* Wavelength that order m has at q > 0; the less a lobe of variance sigma^2 tells it, the nearer
 * to the mean. */
template<typename Real>
ICW_DEVICE Real order_wavelength(const PhysicalView &view,
                                 const Lattice &lattice,
                                 const Real m,
                                 const float q,
                                 const float variance)
{
  const Real nm_per_q = lattice.spacing_nm / m;
  const Real unknown = (variance / square(spectrum_sigma_nm)) * nm_per_q * nm_per_q;
  const Real nm = mean_nm + (q * nm_per_q - mean_nm) / (1.0f + unknown);
  const float least = view.edge_nm[0], most = view.edge_nm[band_count];
  return nm > least ? (nm < most ? nm : Real{} + most) : Real{} + least;
}

/* ---- Rows of orders (m, n) of one m ---- */

/* The part of the surface that the wires of the other axis leave open: the factor of an axis' own
 * orders, and what the orders of a row add up to. That of the wires along is divided by, so never
 * 0. */
ICW_DEVICE float open_across(const PhysicalParams &p)
{
  return 1.0f - p.across.duty;
}

ICW_DEVICE float open_along(const PhysicalParams &p)
{
  return p.along.spacing_nm > 0.0f ? larger(1.0f - p.along.duty, 1e-6f) : 1.0f;
}

/* Variance of v around order n, given the wavelength and how well u tells it. */
template<typename Real>
ICW_DEVICE Real row_variance(const PhysicalParams &p,
                             const float wavelength_nm,
                             const Real shift,
                             const float relative)
{
  return lobe_variance(p, p.along, Real{} + wavelength_nm, shift) +
         square(relative) * shift * shift;
}

/* Scale of a Cauchy density of v that far out is that of the orders beyond the limit: their power
 * falls off as 1 / (2 pi^2 n^2) and is 1 / (pi^2 (limit + 1/2)) in all. */
ICW_DEVICE float row_tail_scale(const float per_order)
{
  return 0.5f * pi * (float(order_limit) + 0.5f) * per_order;
}

/* Density of v in a row m != 0, light of this wavelength, known to the part `relative`. */
ICW_DEVICE_LARGE float row_density(const PhysicalParams &p,
                                   const float v,
                                   const float wavelength_nm,
                                   const float relative)
{
  const float per_order = wavelength_nm / p.along.spacing_nm;
  float sum = open_along(p) *
              logistic_density(v, sqrtf(row_variance(p, wavelength_nm, 0.0f, 0.0f)));
  Lanes lobes = lanes(0.0f), shares = lanes(0.0f);
  for (int first = 1; first <= order_limit; first += lane_count) {
    const Lanes n = float(first) + lane_numbers();
    const Lanes share = n <= float(order_limit) ?
                            order_power(n, lanes(p.along.duty)) * (1.0f / open_along(p)) :
                            lanes(0.0f);
    const Lanes shift = per_order * n;
    const Lanes sigma = lanes_sqrt(row_variance(p, wavelength_nm, shift, relative));
    lobes += share * (logistic_lobes(v - shift, sigma) + logistic_lobes(v + shift, sigma));
    shares += share;
  }
  const float rest = larger(p.along.duty - 2.0f * lanes_sum(shares), 0.0f);
  const float scale = row_tail_scale(per_order);
  return sum + lanes_sum(lobes) + rest * scale / (pi * (square(v) + square(scale)));
}

/* Its inverse. The random number chooses the side, then the order from the middle outwards. */
ICW_DEVICE_LARGE float row_point(const PhysicalParams &p,
                                 const float random,
                                 const float wavelength_nm,
                                 const float relative)
{
  const float sigma_0 = sqrtf(row_variance(p, wavelength_nm, 0.0f, 0.0f));
  if (!(p.along.spacing_nm > 0.0f)) {
    return logistic_point(random, sigma_0);
  }
  const float away = 2.0f * random - 1.0f, sign = away < 0.0f ? -1.0f : 1.0f;
  const float open = open_along(p);
  float left = fabsf(away);
  if (left < open) {
    return logistic_point(0.5f + 0.5f * away / open, sigma_0);
  }
  left -= open;
  const float per_order = wavelength_nm / p.along.spacing_nm;
  const AmplitudesSquared amplitudes = amplitudes_squared(p.along);
  float rest = p.along.duty;
  for (int n = 1; n <= order_limit; n++) {
    const float share = 2.0f * amplitudes.order[n - 1] / open;
    if (left < share) {
      const float shift = float(n) * per_order;
      return sign *
             (shift + logistic_point(left / share,
                                     sqrtf(row_variance(p, wavelength_nm, shift, relative))));
    }
    left -= share;
    rest -= share;
  }
  const float part = clamped(left / larger(rest, 1e-12f), 0.0f, 1.0f - 1e-6f);
  return sign * row_tail_scale(per_order) * tanf(0.5f * pi * part);
}

/* How well u tells the wavelength of an order. */
ICW_DEVICE float row_relative(const PhysicalParams &p, const float m, const float wavelength_nm)
{
  return sqrtf(physical_lobe_variance(p, p.across)) * p.across.spacing_nm / (m * wavelength_nm);
}

/* What the wavelength of a tail is known to. */
constexpr float tail_relative = 0.2f;

/* ---- All orders of a side ---- */

/* Density of the orders of one side, q > 0 there, and `other` across it. `rows`: each is a row of
 * orders of the wires along. */
ICW_DEVICE_LARGE float side_density(const PhysicalParams &p,
                                    const PhysicalView &view,
                                    const int axis_number,
                                    const int side,
                                    const float q,
                                    const float other,
                                    const bool rows)
{
  /* Orders whose lobes reach q: those behind the horizon are not where their wavelengths say. */
  const Axis axis = view_axis(p, view, axis_number);
  const float spacing_nm = axis.lattice.spacing_nm;
  const float variance = physical_lobe_variance(p, axis.lattice);
  const float reach = logistic_reach * sqrtf(variance);
  const float spread_nm = logistic_reach * p.variation * mean_nm;
  const auto first_reaching = [&](const float most_nm) {
    return larger((q - reach) * spacing_nm / (most_nm + spread_nm), 1.0f);
  };
  const auto last_reaching = [&](const float least_nm) {
    const float nm = least_nm - spread_nm;
    return nm > 0.0f ? smaller(axis.last_order[side], (q + reach) * spacing_nm / nm) :
                       axis.last_order[side];
  };
  const bool hidden = q + reach + axis.last_order[side] * spread_nm / spacing_nm >=
                      (1.0f - hidden_part) * axis.open[side];
  const float bands_first = first_reaching(view.edge_nm[band_count]);
  const float bands_last = hidden ? axis.last_order[side] : last_reaching(view.edge_nm[0]);
  const float least = first_reaching(last_nm);
  const float most = hidden ? axis.last_order[side] : last_reaching(first_nm);
  if (!(least <= most)) {
    return 0.0f;
  }
  const int last = int(most);
  float sum = 0.0f;
  for (int first = int(ceilf(least)); first <= last; first += lane_count) {
    const Lanes m = float(first) + lane_numbers();
    const Lanes scale = logistic_per_sigma * lanes_sqrt(order_variance(p, axis.lattice, m));
    const Lanes nm = order_wavelength(view, axis.lattice, m, q, variance);
    Lanes power = order_power(m, lanes(axis.lattice.duty));
    if (!rows) {
      power *= logistic_lobes(lanes(other),
                              lanes_sqrt(lobe_variance(p, axis.other, nm, lanes(0.0f))));
    }
    for (int lane = 0; lane < lane_count && first + lane <= last; lane++) {
      const float order = float(first + lane), nm_per_q = spacing_nm / order;
      const float lobe_scale = get_lane(scale, lane);
      const EvenRange even = even_range(nm_per_q, lobe_scale);
      float density = q > even.begin && q < even.end ? even_power / (even.end - even.begin) : 0.0f;
      if (order >= bands_first && order <= bands_last) {
        density += spectrum_density(view, axis, side, q, nm_per_q, lobe_scale);
      }
      density *= get_lane(power, lane);
      if (rows && density > 0.0f) {
        const float wavelength_nm = get_lane(nm, lane);
        density *= row_density(p, other, wavelength_nm, row_relative(p, order, wavelength_nm));
      }
      sum += density;
    }
  }
  return sum;
}

/* Fills in what the view sees of an axis, and returns the power of its orders. `along_axis` is the
 * component of the view, `other` that across. */
ICW_DEVICE float view_orders(const PhysicalParams &p,
                             PhysicalView &view,
                             const int axis_number,
                             const float along_axis,
                             const float other)
{
  const Lattice &lattice = axis_number == axis_across ? p.across : p.along;
  if (!(lattice.spacing_nm > 0.0f)) {
    return 0.0f;
  }
  const Lattice &other_lattice = axis_number == axis_across ? p.along : p.across;
  const float sigma = sqrtf(physical_lobe_variance(p, lattice));
  const float other_sigma = sqrtf(physical_lobe_variance(p, other_lattice));
  /* How far directions go that are so many standard deviations across the axis off the view. */
  const auto radius = [&](const float deviations) {
    return sqrtf(1.0f - square(larger(fabsf(other) - deviations * other_sigma, 0.0f)));
  };
  const bool rows = axis_number == axis_across && p.along.spacing_nm > 0.0f;
  for (int side = 0; side < 2; side++) {
    const float view_side = side ? along_axis : -along_axis;
    view.open[axis_number][side] = larger(sigma + radius(2.0f) + view_side, 0.0f);
    /* An order (m, n) may be open where (m, 0) is not. */
    const float farthest = larger((rows ? 1.0f : radius(vanished)) + view_side, 0.0f);
    view.last_order[axis_number][side] = float(int(
        smaller(last_order(p, lattice, farthest, lobes_reach(p, lattice)), float(order_limit))));
  }
  const AmplitudesSquared amplitudes = amplitudes_squared(lattice);
  const Tail tails[2] = {tail(lattice, along_axis, 0), tail(lattice, along_axis, 1)};
  if (tails[0].exists() || tails[1].exists()) {
    float rest = 0.5f * lattice.duty * (1.0f - lattice.duty);
    for (int k = 0; k < order_limit; k++) {
      rest -= amplitudes.order[k];
    }
    const float far = 1e6f;
    view.tail_power[axis_number] = larger(rest, 0.0f) * 0.5f *
                                   (spectrum_power(view, true, 0, far) +
                                    spectrum_power(view, true, 1, far));
  }
  const Axis axis = view_axis(p, view, axis_number);
  float sum = 0.0f;
  for (int side = 0; side < 2; side++) {
    sum += side_powers(view, axis, amplitudes.order, side).sum +
           (tails[side].exists() ? axis.tail_power : 0.0f);
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
  const auto row = [&](const int number, const int column) {
    return tables.band_row(p.illuminant, number, column);
  };
  /* The film for the first order on the negative and on the positive side, at the nodes. */
  float contrast[2 * band_node_count];
  Lanes mirror_power = lanes(0.0f);
  const float ridge_part = covered(p.across, p.along);
  for (int first = 0; first < 2 * band_node_count; first += lane_count) {
    const Lanes nm = row(band_row_node_nm, first);
    const Lanes number = float(first) + lane_numbers();
    const Lanes shift = nm * (1.0f / p.across.spacing_nm);
    const Lanes out = (number < float(band_node_count) ? -shift : shift) - o.nu;
    const Lanes cosine = lanes_sqrt(lanes_max(1.0f - square(o.tau) - out * out, lanes(0.0f)));
    Complex<Lanes> metal;
    if (p.metal == metal_custom) {
      metal = custom_metal(p, nm);
    }
    else {
      metal = {row(band_row_metal + 2 * int(p.metal), first),
               row(band_row_metal + 2 * int(p.metal) + 1, first)};
    }
    const Lanes per_nm = 1.0f / nm;
    const FilmPair<Lanes> r = levels(p,
                                     lanes_max(0.5f * (o.n + cosine), lanes(1e-4f)),
                                     cauchy_index(p.oxide, per_nm),
                                     metal,
                                     per_nm);
    store_lanes(order_part * (r.contrast + between_nodes), contrast + first);
    mirror_power += row(band_row_part, first) *
                    (ridge_part * r.ridge + (1.0f - ridge_part) * r.groove -
                     ridge_part * (1.0f - ridge_part) * r.contrast + 0.01f);
  }
  view.mirror_power = lanes_sum(mirror_power);
  for (int edge = 0; edge < band_edge_count; edge += lane_count) {
    store_lanes(row(band_row_edge_nm, edge), view.edge_nm + edge);
    Lanes rise[2] = {lanes(0.0f), lanes(0.0f)};
    for (int node = 0; node < band_node_count; node++) {
      const Lanes of_node = row(band_row_rise + node, edge);
      rise[0] += contrast[node] * of_node;
      rise[1] += contrast[band_node_count + node] * of_node;
    }
    store_lanes(rise[0], view.rise[0] + edge);
    store_lanes(rise[1], view.rise[1] + edge);
  }
  const float across = view_orders(p, view, axis_across, o.nu, o.tau);
  const float along = view_orders(p, view, axis_along, o.tau, o.nu);
  view.total_power = view.mirror_power + open_along(p) * across + square(open_across(p)) * along;
  return view;
}

/* Density of the sampled direction i over solid angle. */
ICW_DEVICE_LARGE float physical_pdf(const PhysicalParams &p,
                                    const PhysicalView &view,
                                    const LocalDirection o,
                                    const LocalDirection i)
{
  using namespace physical_detail;
  const float u = i.nu + o.nu, v = i.tau + o.tau;
  const float sigma_u = sqrtf(physical_lobe_variance(p, p.across));
  const float sigma_v = sqrtf(physical_lobe_variance(p, p.along));
  const bool cross = p.along.spacing_nm > 0.0f;
  const float reach_u = logistic_reach * sigma_u, reach_v = logistic_reach * sigma_v;
  if (!cross && fabsf(v) > vanished * sigma_v) {
    return 0.0f;
  }
  float sum = 0.0f;
  if (fabsf(u) < reach_u && fabsf(v) < reach_v) {
    sum = view.mirror_power * logistic_density(u, sigma_u) * logistic_density(v, sigma_v);
  }
  float across = 0.0f;
  /* Without a spread of the spacing no lobe reaches further beyond the mirror direction. */
  const float beyond = p.variation > 0.0f ? 1e6f : reach_u;
  for (int side = 0; side < 2; side++) {
    const float sign = side ? 1.0f : -1.0f;
    if (sign * u > -beyond) {
      across += side_density(p, view, axis_across, side, sign * u, v, cross);
    }
  }
  const float across_tail = view.tail_power[axis_across] *
                            tail(p.across, o.nu, u > 0.0f).density(fabsf(u));
  if (across_tail > 0.0f) {
    across += across_tail *
              (cross ? row_density(p, v, mean_nm, tail_relative) : logistic_density(v, sigma_v));
  }
  sum += open_along(p) * across;
  if (cross && fabsf(u) < vanished * sigma_u) {
    float along = view.tail_power[axis_along] * tail(p.along, o.tau, v > 0.0f).density(fabsf(v)) *
                  logistic_density(u, sigma_u);
    for (int side = 0; side < 2; side++) {
      along += side_density(p, view, axis_along, side, side ? v : -v, u, false);
    }
    sum += square(open_across(p)) * along;
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
  float u = 0.0f, v = 0.0f;

  /* Choose a lobe by its power, those of an axis in the order of their places; what is left of the
   * random number chooses the place in it. */
  float left = random_across * view.total_power;
  bool found = false;
  const auto choose_order =
      [&](const Axis &axis, const float scale, const float *amplitudes, const int side) {
        const OrderPowers powers = side_powers(view, axis, amplitudes, side);
        if (left >= scale * powers.sum) {
          left -= scale * powers.sum;
          return;
        }
        for (int k = 0; k < powers.count && !found; k++) {
          const int m = side ? k + 1 : powers.count - k;
          const float power = scale * powers.power[m - 1];
          if (left < power) {
            const float order = float(m), sign = side ? 1.0f : -1.0f;
            const float part = (side ? left : power - left) / (scale * amplitudes[m - 1]);
            const float nm_per_q = axis.lattice.spacing_nm / order;
            const float q = spectrum_point(
                view,
                axis,
                side,
                part,
                nm_per_q,
                logistic_per_sigma * sqrtf(order_variance(p, axis.lattice, order)));
            const float wavelength_nm = order_wavelength(
                view, axis.lattice, order, q, physical_lobe_variance(p, axis.lattice));
            if (axis.own_spectra) {
              u = sign * q;
              v = row_point(p, random_along, wavelength_nm, row_relative(p, order, wavelength_nm));
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
  const Axis across = view_axis(p, view, axis_across);
  {
    const AmplitudesSquared amplitudes = amplitudes_squared(p.across);
    const float scale = open_along(p);
    choose_order(across, scale, amplitudes.order, 0);
    if (!found && left < view.mirror_power) {
      u = logistic_point(left / view.mirror_power, sqrtf(physical_lobe_variance(p, p.across)));
      v = logistic_point(random_along, sqrtf(physical_lobe_variance(p, p.along)));
      found = true;
    }
    left -= view.mirror_power;
    if (!found) {
      choose_order(across, scale, amplitudes.order, 1);
    }
    for (int side = 0; side < 2 && !found; side++) {
      const Tail beyond = tail(p.across, o.nu, side);
      const float power = beyond.exists() ? scale * across.tail_power : 0.0f;
      if (left < power) {
        const float q = beyond.point(left / power);
        u = side ? q : -q;
        v = row_point(p, random_along, mean_nm, tail_relative);
        found = true;
      }
      left -= power;
    }
  }
  if (!found && p.along.spacing_nm > 0.0f) {
    const Axis along = view_axis(p, view, axis_along);
    const AmplitudesSquared amplitudes = amplitudes_squared(p.along);
    const float scale = square(open_across(p));
    for (int side = 0; side < 2 && !found; side++) {
      choose_order(along, scale, amplitudes.order, side);
    }
    for (int side = 0; side < 2 && !found; side++) {
      const Tail beyond = tail(p.along, o.tau, side);
      const float power = beyond.exists() ? scale * along.tail_power : 0.0f;
      if (left < power) {
        const float q = beyond.point(left / power);
        v = side ? q : -q;
        u = logistic_point(random_along, sqrtf(physical_lobe_variance(p, p.across)));
        found = true;
      }
      left -= power;
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
