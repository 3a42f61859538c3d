/* SPDX-License-Identifier: Apache-2.0 */

/* The PHYSICAL model (physical_model.h), integrated over the spectrum.
 *
 * Given u and v the wavelengths are known, so nothing is chosen at random: orders, film and the
 * eye under the lamp say how fast the integrand varies, and that says which few wavelengths do.
 * Each way to choose them keeps the integral within 0.5 % (RMS over the directions), most within
 * 0.1 %.
 *
 * - Only film and lamp vary (the mirror order by itself), or little else does: a quadrature rule
 *   that was made for that (spectral_rules.h).
 * - Orders too close to tell apart, by their own width or because the eye blurs them: their mean
 *   density, with those of its ripples that are seen.
 * - Several orders: each by the one to three nodes of a Gauss-Hermite rule.
 * - A single order or two, and lamps with lines: the trapezoid rule over each order. With step h
 *   it is exact for a product of bandwidth below 2 pi / h. Seven tenths of the bandwidth of film
 *   and lamp (eight under lamps with lines), at which 0.1 % of the amplitude is left, keep the
 *   integral within 0.3 %.
 * - Else the trapezoid rule over the visible range, all orders at each node. */

#pragma once

#include "spectral_nodes.h"

namespace icwafer {

namespace physical_detail {

/* Without the ends, at which the eye hardly sees: 0.2 % of blue and 0.1 % of red, which only share
 * in a mean. */
constexpr float grid_first_nm = 390.0f;
constexpr float grid_last_nm = 730.0f;
/* The grid is even in 1 / lambda, in which film and orders are; its step where the eye sees
 * most. */
constexpr float grid_begin = 1.0f / grid_last_nm, grid_span = 1.0f / grid_first_nm - grid_begin;
constexpr float grid_middle_nm = 600.0f;
/* The shortest wavelength that matters to the eye: fringes are finest there. */
constexpr float blue_nm = 420.0f;
/* Bandwidth of a Gaussian of standard deviation 1 that leaves 0.15 % of it, and where it is cut
 * off. */
constexpr float gaussian_bandwidth = 3.6f;
constexpr float lobe_reach = 4.5f;
constexpr float mirror_reach = 5.5f;
/* Lamps with lines have a bandwidth above this. */
constexpr float smooth_lamp_per_nm = 0.6f;
/* Under a lamp without lines, a narrow lobe whose middle is where the eye sees well matters no
 * further than this. */
constexpr float bright_first_nm = 425.0f, bright_last_nm = 670.0f, bright_sigma_nm = 16.0f;
constexpr float bright_reach = 3.3f;
/* Orders further apart than twice this many standard deviations are told apart. */
constexpr float apart_reach = 3.0f;
/* A lobe of this standard deviation in orders hides them. */
constexpr float smooth_orders = 0.56f;
/* Ripples of less than exp(-hidden) in the mean density of orders are left out. */
constexpr float hidden = 5.0f;
/* An order's steps above this are rounded down to whole nanometres. */
constexpr float whole_step_nm = 2.0f;
/* No grid has fewer nodes. */
constexpr float few_nodes = 20.0f;
/* More orders than this are not summed one by one. */
constexpr int window_limit = 24;
constexpr int most_nodes_per_order = 3;
/* Between these an order counts; of fewer orders it matters more how well each is integrated. */
constexpr float order_first_nm = 387.0f, order_last_nm = 740.0f;
constexpr float least_orders = 3.0f, few_orders = 5.0f, few_orders_sigma = 0.7f;

/* How far lobes reach without the spread of the spacing. */
ICW_DEVICE float lobes_reach(const PhysicalParams &p, const Lattice &lattice)
{
  return lobe_reach * sqrtf(lobe_variance(p, lattice, last_nm, 0.0f));
}

/* The last order, no whole number, whose lobe is visible and reaches back to q. */
ICW_DEVICE float last_order(const PhysicalParams &p,
                            const Lattice &lattice,
                            const float q,
                            const float reach)
{
  return (q + reach) / larger(1.0f - lobe_reach * p.variation, 0.1f) * lattice.spacing_nm /
         first_nm;
}

/* How fast the integrand varies over the spectrum, for one pair of directions. A path X is what
 * makes cos(2 pi X / lambda). */
struct Variation {
  const PhysicalParams &p;
  Lattice lattice;
  /* Along the lattice's axis. */
  float q;
  /* Of light in the film, there and back. */
  float film_path_nm;

  ICW_DEVICE_METHOD float lamp_per_nm() const
  {
    return illuminant_bandwidth_per_nm(p.illuminant);
  }

  ICW_DEVICE_METHOD bool lamp_is_smooth() const
  {
    return lamp_per_nm() < smooth_lamp_per_nm;
  }

  /* Of one order. */
  ICW_DEVICE_METHOD float order_path_nm() const
  {
    return q * lattice.spacing_nm;
  }

  /* Standard deviation of the lobe around q at a wavelength: of q, in nanometres, in orders. */
  ICW_DEVICE_METHOD float sigma(const float wavelength_nm) const
  {
    return sqrtf(lobe_variance(p, lattice, wavelength_nm, q));
  }

  ICW_DEVICE_METHOD float sigma_nm(const float wavelength_nm) const
  {
    return wavelength_nm / larger(q, 1e-6f) * sigma(wavelength_nm);
  }

  ICW_DEVICE_METHOD float sigma_orders(const float wavelength_nm) const
  {
    return sigma(wavelength_nm) * lattice.spacing_nm / wavelength_nm;
  }

  /* Step of a trapezoid rule. Lobe and lamp count as Gaussians, whose product is narrower than
   * either; of a thick film the second pass counts, too. */
  ICW_DEVICE_METHOD float step_nm(const float wavelength_nm, const float lobe_per_nm) const
  {
    const float lamp_part = lamp_is_smooth() ? 0.7f : 0.8f;
    const float film_nm = larger(0.7f * film_path_nm, 2.6f * film_path_nm - 4600.0f);
    return two_pi / (sqrtf(square(lobe_per_nm) + square(lamp_part * lamp_per_nm())) +
                     two_pi * film_nm / square(wavelength_nm));
  }

  /* Nodes of a grid when `path_nm` is what varies beside film and lamp. */
  ICW_DEVICE_METHOD float grid_nodes(const float path_nm) const
  {
    return grid_span * square(grid_middle_nm) /
           step_nm(grid_middle_nm, two_pi * path_nm / square(grid_middle_nm));
  }

  /* Of an order's lobe. */
  ICW_DEVICE_METHOD float lobe_path_nm() const
  {
    return gaussian_bandwidth / two_pi * square(grid_last_nm) / sigma_nm(grid_last_nm);
  }

  /* The smallest rule (tables.h) for the film and this path; rule_count where none will do. */
  ICW_DEVICE_METHOD int rule(const float path_nm) const
  {
    int number = 0;
    while (number < rule_count &&
           (film_path_nm >= rule_path_nm(number) ||
            film_path_nm + path_nm >= rule_fitted_paths * rule_path_nm(number))) {
      number++;
    }
    return number;
  }

  /* How many ripples of the density of orders are seen: lobes of a standard deviation of
   * `own_orders` hide them, and the eye blurs them. */
  ICW_DEVICE_METHOD int ripples(const float own_orders) const
  {
    int count = 0;
    while (count < ripple_limit) {
      const float turns = ripple_turns(count, narrower_part(lattice.duty));
      if (2.0f * square(pi * turns * own_orders) +
              illuminant_blur_per_nm(p.illuminant) *
                  larger(turns * order_path_nm() - film_path_nm, 0.0f) >
          hidden) {
        break;
      }
      count++;
    }
    return count;
  }

  ICW_DEVICE_METHOD float ripple_path_nm(const int ripples) const
  {
    return ripples > 0 ? order_path_nm() * ripple_turns(ripples - 1, narrower_part(lattice.duty)) :
                         0.0f;
  }
};

/* Orders by Gauss-Hermite rules in 1 / lambda, in which a lobe from coherence is a Gaussian. The
 * nodes' steps are those of a sum over the exact lobe: weight over the Gaussian's density. */
struct OrderRules {
  /* The first order, and how many there are. */
  float first, count;
  int nodes_per_order;

  ICW_DEVICE_METHOD int node_count() const
  {
    return int(count) * nodes_per_order;
  }
};

/* Of a lobe of standard deviation s, Gauss-Hermite rules of one, two, three nodes leave x^2 / 2,
 * x^4 / 12, x^6 / 120 of what varies as cos(x q / s). They do for the sensitivities under a lamp
 * without lines up to such widths of the lobe, and for films up to such x. */
ICW_DEVICE OrderRules order_rules(const Variation &variation)
{
  constexpr float node_sigma_nm[most_nodes_per_order] = {4.5f, 9.0f, 11.0f};
  constexpr float node_film[most_nodes_per_order] = {0.18f, 0.6f, 1.1f};
  const float path_nm = variation.order_path_nm();
  const float first = larger(ceilf(path_nm / order_last_nm), 1.0f);
  constexpr float nm = 550.0f;
  const float sigma_nm = variation.sigma_nm(nm);
  const float film = sigma_nm * two_pi * variation.film_path_nm / square(nm);
  const float count = floorf(path_nm / order_first_nm) - first + 1.0f;
  const float part = count < few_orders ? few_orders_sigma : 1.0f;
  int nodes = 0;
  while (nodes < most_nodes_per_order &&
         (sigma_nm > part * node_sigma_nm[nodes] || film > node_film[nodes])) {
    nodes++;
  }
  return {first, count, nodes + 1};
}

template<typename Tables>
ICW_DEVICE_LARGE void add_order_rules(Integrator<Tables> &nodes,
                                      const Variation &variation,
                                      const OrderRules &rules)
{
  /* Places x of the nodes, and steps w exp(x^2 / 2) sqrt(2 pi) for the weights w. */
  const int per_order = rules.nodes_per_order;
  const float apart = per_order == 2 ? 2.0f : 1.7320508f;
  const float centre = 0.5f * float(per_order - 1);
  const float middle_step = per_order == 3 ? 1.6710855f : 2.5066283f;
  const float outer_step = per_order == 3 ? 1.8723007f : 2.0663657f;
  const float per_q = 1.0f / variation.q;
  for (int begin = 0; begin < rules.node_count(); begin += lane_count) {
    const Lanes k = float(begin) + lane_numbers();
    const Lanes number = lanes_floor((k + 0.5f) / float(per_order));
    const Lanes x = (k - float(per_order) * number - centre) * apart;
    const Lanes order = rules.first + number;
    const Lanes middle_per_nm = order / variation.order_path_nm();
    const Lanes sigma = per_q * lanes_sqrt(lobe_variance(variation.p,
                                                         variation.lattice,
                                                         1.0f / middle_per_nm,
                                                         lanes(variation.q)));
    const Lanes nm = 1.0f / (middle_per_nm * (1.0f + x * sigma));
    const Lanes step = (x == 0.0f ? lanes(middle_step) : lanes(outer_step)) * sigma *
                       middle_per_nm * nm * nm;
    const Lanes inside = lanes_min(lanes_max(nm, lanes(first_nm)), lanes(last_nm - 1.0f));
    const Lanes seen = k < float(rules.node_count()) ? step : lanes(0.0f);
    nodes.add_lanes(inside, inside == nm ? seen : lanes(0.0f), order);
  }
}

/* The lobe of one order in wavelength, and the step for it. */
struct OrderLobe {
  float centre_nm, sigma_nm, step_nm;

  ICW_DEVICE_METHOD float nodes() const
  {
    return 2.0f * lobe_reach * sigma_nm / step_nm + 1.0f;
  }
};

ICW_DEVICE OrderLobe order_lobe(const Variation &variation, const int order)
{
  const float centre_nm = variation.order_path_nm() / float(order);
  const float sigma_nm = variation.sigma_nm(clamped(centre_nm, first_nm, last_nm));
  return {centre_nm,
          sigma_nm,
          variation.step_nm(clamped(centre_nm, blue_nm, last_nm), gaussian_bandwidth / sigma_nm)};
}

/* Nodes of a trapezoid rule over each order; `last_lobe` is that of the last. */
template<typename Tables>
ICW_DEVICE_LARGE void add_trapezoids(Integrator<Tables> &nodes,
                                     const Variation &variation,
                                     const int first,
                                     const int last,
                                     const OrderLobe &last_lobe)
{
  nodes.whole = last_lobe.step_nm > whole_step_nm;
  NodeQueue<Tables> queue(nodes);
  for (int order = first; order <= last; order++) {
    const OrderLobe lobe = order < last ? order_lobe(variation, order) : last_lobe;
    const float step = nodes.whole ? floorf(lobe.step_nm) : lobe.step_nm;
    const bool bright = variation.lamp_is_smooth() && lobe.sigma_nm < bright_sigma_nm &&
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
      queue.add(node, step, float(order));
    }
  }
  queue.flush();
}

/* All orders at each node. */
struct AllOrders {
  Orders orders;
  int ripples;
  /* The rule that serves, or rule_count: then a grid of so many nodes. */
  int rule;
  float node_count;
};

/* `path_nm` is what varies beside film and lamp. */
ICW_DEVICE AllOrders at_each_node(const Variation &variation,
                                  const Orders orders,
                                  const int ripples,
                                  const float path_nm)
{
  /* A single one's nodes are chosen for its lobe, which no rule is. */
  const int rule = orders == Orders::Single ? rule_count : variation.rule(path_nm);
  return {orders,
          ripples,
          rule,
          rule < rule_count ? float(rule_nodes(rule)) : variation.grid_nodes(path_nm)};
}

ICW_DEVICE AllOrders choose_all_orders(const Variation &variation, const bool mirror)
{
  const float own_orders = variation.sigma_orders(last_nm);
  const bool far = !mirror &&
                   variation.order_path_nm() > larger(2.0f, 10.0f * own_orders) * last_nm;
  if (far || own_orders >= smooth_orders) {
    const int ripples = variation.ripples(own_orders);
    if (!far || ripples < ripple_limit) {
      return at_each_node(variation,
                          far ? Orders::Dense : Orders::All,
                          ripples,
                          variation.ripple_path_nm(ripples));
    }
  }
  const bool apart = 2.0f * apart_reach * variation.sigma_orders(first_nm) < 1.0f;
  return at_each_node(
      variation, apart ? Orders::Single : Orders::All, 0, variation.lobe_path_nm());
}

/* The same, chosen where it is asked for. */
struct LazyAllOrders {
  const Variation &variation;
  bool mirror;
  bool chosen = false;
  AllOrders all = {};

  ICW_DEVICE_METHOD LazyAllOrders(const Variation &variation, const bool mirror)
      : variation(variation), mirror(mirror)
  {
  }

  ICW_DEVICE_METHOD const AllOrders &get()
  {
    if (!chosen) {
      all = choose_all_orders(variation, mirror);
      chosen = true;
    }
    return all;
  }
};

/* One order after the other, if that takes fewer nodes than all of them at each. */
template<typename Tables>
ICW_DEVICE_LARGE bool add_orders(Integrator<Tables> &nodes,
                                 const Variation &variation,
                                 const int first,
                                 const float most,
                                 LazyAllOrders &all)
{
  const auto few = [&](const float count) {
    return count < few_nodes || count < all.get().node_count;
  };
  nodes.orders = Orders::Single;
  if (variation.lamp_is_smooth() && variation.order_path_nm() > least_orders * order_first_nm) {
    const OrderRules rules = order_rules(variation);
    if (rules.count >= least_orders && rules.nodes_per_order <= most_nodes_per_order) {
      /* Trapezoids would take more nodes. */
      if (!few(float(rules.node_count()))) {
        return false;
      }
      add_order_rules(nodes, variation, rules);
      return true;
    }
  }
  const int last = int(most);
  if (last - first >= window_limit) {
    return false;
  }
  const OrderLobe last_lobe = order_lobe(variation, last);
  float count = last_lobe.nodes();
  for (int order = first; order < last && few(count); order++) {
    count += order_lobe(variation, order).nodes();
  }
  if (!few(count)) {
    return false;
  }
  add_trapezoids(nodes, variation, first, last, last_lobe);
  return true;
}

template<typename Tables>
ICW_DEVICE_LARGE void add_grid(Integrator<Tables> &nodes,
                               const Variation &variation,
                               const float node_count)
{
  const int block_count = int(ceilf(node_count / float(lane_count)));
  const float step = grid_span / float(block_count * lane_count);
  for (int block = 0; block < block_count; block++) {
    const Lanes k = float(block * lane_count) + 0.5f + lane_numbers();
    const Lanes per_nm = grid_begin + step * k;
    const Lanes node = 1.0f / per_nm;
    nodes.add_lanes(node,
                    step * node * node,
                    lanes_max(lanes_round(variation.order_path_nm() * per_nm), lanes(1.0f)));
  }
}

}  // namespace physical_detail

/* f, integrated over the spectrum; not multiplied by the cosine. */
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
  const int order_first = int(
      ceilf(larger((q - reach) / (1.0f + lobe_reach * p.variation) * spacing_nm / last_nm, 1.0f)));
  const float order_most = last_order(p, nodes.first, q, reach);
  if (!mirror && order_most < float(order_first)) {
    return {0.0f, 0.0f, 0.0f};
  }

  const float blue_ior = cauchy_index(p.oxide, 1.0f / blue_nm);
  const Variation variation = {
      p,
      nodes.first,
      q,
      2.0f * sqrtf(larger(square(blue_ior) - 1.0f + square(pair.cosine), 0.0f)) *
          (p.oxide_nm + p.groove_nm)};
  const float order_1 = first_nm / spacing_nm;
  const bool alone = q + lobe_reach * sqrtf(lobe_variance(p, nodes.first, first_nm, order_1)) <
                     order_1;
  LazyAllOrders lazy(variation, mirror);
  if (!mirror && !alone && add_orders(nodes, variation, order_first, order_most, lazy)) {
    return nodes.sum();
  }
  const AllOrders all = alone ? at_each_node(variation, Orders::None, 0, 0.0f) : lazy.get();
  nodes.orders = all.orders;
  nodes.dense_ripples = all.ripples;
  if (all.rule < rule_count) {
    nodes.add_rule(all.rule);
    return nodes.sum();
  }
  add_grid(nodes, variation, all.node_count);
  return nodes.mean();
}

}  // namespace icwafer
