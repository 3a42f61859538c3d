/* SPDX-License-Identifier: Apache-2.0 */

/* The PHYSICAL model at given wavelengths, added up with the sensitivities of the eye. */

#pragma once

#include "mirror_bound.h"
#include "order_sum.h"
#include "tables.h"

namespace icwafer {

namespace physical_detail {

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
      metal = custom_metal(p, wavelength);
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
        metal = custom_metal(p, wavelength);
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

  /* The ripples of a density, without those that are hidden, may go below 0. */
  ICW_DEVICE_METHOD Rgb sum() const
  {
    return {larger(lanes_sum(red), 0.0f),
            larger(lanes_sum(green), 0.0f),
            larger(lanes_sum(blue), 0.0f)};
  }

  /* Divided by the weights, so that a flat spectrum is exactly white at any step. */
  ICW_DEVICE_METHOD Rgb mean() const
  {
    const Rgb s = sum();
    return {
        s.r / lanes_sum(weight_red), s.g / lanes_sum(weight_green), s.b / lanes_sum(weight_blue)};
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
    const Lanes sigma_m = p.variation > 0.0f ?
                              lanes_sqrt(lobe_variance(p, first, wavelength, shift)) :
                              sigma;
    return order_power(node_order, lanes(first.duty)) * lanes_gaussian(q_first - shift, sigma_m);
  }
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

}  // namespace icwafer
