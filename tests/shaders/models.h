/* SPDX-License-Identifier: GPL-2.0-or-later */

/* Every model of the material behind one interface, so that one set of tests (test_models.cpp)
 * asks all of them the same questions. A new model adds its adaptor and an entry in `models`. */

#pragma once

#include <functional>
#include <memory>
#include <sstream>

#include "icwafer/physical_sample.h"
#include "support.h"

namespace icwafer::test {

/* Sampling for one view. */
class Sampler {
 public:
  virtual ~Sampler() = default;
  /* Density over solid angle. */
  virtual float pdf(LocalDirection i) const = 0;
  /* The component n is 0 where the model finds no direction. */
  virtual LocalDirection sample(float random_across, float random_along) const = 0;
};

/* Edges of bins over the tangential components of a direction, across and along the wires. No
 * feature of the density is narrower than twice a bin. */
struct Bins {
  std::vector<double> across, along;
};

/* A model with one set of parameters. */
class Surface {
 public:
  virtual ~Surface() = default;
  /* Not multiplied by the cosine. */
  virtual Rgb eval(LocalDirection i, LocalDirection o) const = 0;
  virtual std::unique_ptr<Sampler> sampler(LocalDirection o) const = 0;
  virtual Bins bins(LocalDirection o) const = 0;
  virtual std::string description() const = 0;
};

struct Model {
  std::string name;
  /* The published film of CS348B depends on which direction is the light's, and its reflectivity
   * is a free factor. */
  bool reciprocal, energy_bounded;
  /* Sets of parameters for the chi-squared test. */
  int chi_squared_sets;
  /* In the ranges that artists use. */
  std::function<std::unique_ptr<Surface>(Random &)> random;
  /* Where most is reflected and the energy is hardest to bound; may be empty where it is not. */
  std::function<std::unique_ptr<Surface>(Random &)> brightest;
  /* Anything that a texture may hold, NaN and infinities included. */
  std::function<std::unique_ptr<Surface>(Random &)> any;
};

/* Google Test prints the parameters of a failing test. */
inline void PrintTo(const Model &model, std::ostream *out)
{
  *out << model.name;
}

inline std::vector<double> even_edges(const double width)
{
  const int count = int(std::ceil(2.0 / width));
  std::vector<double> edges;
  for (int k = 0; k <= count; k++) {
    edges.push_back(-1.0 + 2.0 * k / count);
  }
  return edges;
}

/* -1, 1, and what lies between of centre +- each distance. */
inline std::vector<double> edges_around(const double centre, const std::vector<double> &distances)
{
  std::vector<double> edges = {-1.0, 1.0};
  for (const double distance : distances) {
    for (const double edge : {centre - distance, centre + distance}) {
      if (std::fabs(edge) < 1.0) {
        edges.push_back(edge);
      }
    }
  }
  std::sort(edges.begin(), edges.end());
  return edges;
}

inline std::vector<double> merged(const std::vector<double> &a, const std::vector<double> &b)
{
  std::vector<double> edges;
  std::merge(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(edges));
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  return edges;
}

/* ---- CS348B ---- */

class Cs348bSampler : public Sampler {
 public:
  Cs348bSampler(const Cs348bParams &p, const LocalDirection o)
      : p_(p), o_(o), total_(cs348b_total_power(p, o.nu))
  {
  }

  float pdf(const LocalDirection i) const override
  {
    return cs348b_pdf(p_, total_, o_, i);
  }

  LocalDirection sample(const float random_across, const float random_along) const override
  {
    return cs348b_sample(p_, total_, o_, random_across, random_along);
  }

 private:
  Cs348bParams p_;
  LocalDirection o_;
  float total_;
};

class Cs348bSurface : public Surface {
 public:
  explicit Cs348bSurface(const Cs348bParams &p) : p_(p) {}

  Rgb eval(const LocalDirection i, const LocalDirection o) const override
  {
    static const TableSensitivity sensitivity(colour_table(working_spaces[0].xyz_to_rgb));
    return cs348b_eval(p_, grating_geometry(i, o), sensitivity);
  }

  std::unique_ptr<Sampler> sampler(const LocalDirection o) const override
  {
    return std::make_unique<Cs348bSampler>(p_, o);
  }

  Bins bins(const LocalDirection o) const override
  {
    /* |v|^p has a cusp at v = 0. */
    return {even_edges(std::max(p_.lobe_width / 3.0f, 1.0f / 6000.0f)),
            edges_around(-o.tau,
                         {0.0, 0.01, 0.03, 0.08, 0.15, 0.25, 0.35, 0.5, 0.65, 0.8, 1.0, 1.2, 1.4})};
  }

  std::string description() const override
  {
    std::ostringstream text;
    text << "spacing " << p_.spacing_nm << " nm, width " << p_.width_nm << " nm, lobe "
         << p_.lobe_width << ", p " << p_.anisotropy << ", effects " << p_.effects;
    return text.str();
  }

 private:
  Cs348bParams p_;
};

/* ---- PHYSICAL ---- */

struct ReadFloats {
  const float *data;

  const float *operator()(const int i) const
  {
    return data + i;
  }
};

/* The renderer's tables in Rec.709. */
inline MaterialTables<ReadFloats> rec709_tables()
{
  static const std::vector<float> tables = material_tables(working_spaces[0].xyz_to_rgb);
  return {{tables.data()}};
}

class PhysicalSampler : public Sampler {
 public:
  PhysicalSampler(const PhysicalParams &p, const LocalDirection o)
      : p_(p), o_(o), view_(physical_view(p, o, rec709_tables()))
  {
  }

  float pdf(const LocalDirection i) const override
  {
    return physical_pdf(p_, view_, o_, i);
  }

  LocalDirection sample(const float random_across, const float random_along) const override
  {
    return physical_sample(p_, view_, o_, random_across, random_along);
  }

 private:
  PhysicalParams p_;
  LocalDirection o_;
  PhysicalView view_;
};

class PhysicalSurface : public Surface {
 public:
  explicit PhysicalSurface(const PhysicalParams &p) : p_(p) {}

  Rgb eval(const LocalDirection i, const LocalDirection o) const override
  {
    return physical_eval(p_, i, o, rec709_tables());
  }

  std::unique_ptr<Sampler> sampler(const LocalDirection o) const override
  {
    return std::make_unique<PhysicalSampler>(p_, o);
  }

  Bins bins(const LocalDirection o) const override
  {
    using physical_detail::mean_nm, physical_detail::tail_begin;
    const double sigma = std::sqrt(physical_lobe_variance(p_, p_.across));
    const double sigma_along = std::sqrt(physical_lobe_variance(p_, p_.along));
    /* The density has a step where its tails begin. */
    const double tail_across = tail_begin * mean_nm / p_.across.spacing_nm;
    if (p_.along.spacing_nm > 0.0f) {
      const double tail_along = tail_begin * mean_nm / p_.along.spacing_nm;
      return {merged(even_edges(std::min(0.5 * sigma, 0.05)), edges_around(-o.nu, {tail_across})),
              merged(even_edges(std::min(0.5 * sigma_along, 0.05)),
                     edges_around(-o.tau, {tail_along}))};
    }
    std::vector<double> distances = {0.0, 0.25, 0.5, 1.0, 1.5, 2.0, 3.0, 4.0, 6.0, 9.0, 13.0};
    for (double &distance : distances) {
      distance *= sigma_along;
    }
    return {merged(even_edges(std::min(sigma / 3.0, 0.05)), edges_around(-o.nu, {tail_across})),
            edges_around(-o.tau, distances)};
  }

  std::string description() const override
  {
    std::ostringstream text;
    text << "spacing " << p_.across.spacing_nm << " nm, duty " << p_.across.duty << ", across "
         << p_.along.spacing_nm << " nm, duty " << p_.along.duty << ", oxide " << p_.oxide_nm
         << " nm of index " << p_.oxide.a << ", groove " << p_.groove_nm << " nm, coherence "
         << 0.376e-3f / p_.across.coherence_per_nm << " and "
         << 0.376e-3f / p_.along.coherence_per_nm << " um, roughness sigma " << p_.roughness
         << ", variation " << p_.variation << ", metal " << p_.metal << " (n " << p_.custom_n[1]
         << ", k " << p_.custom_k[1] << "), illuminant " << p_.illuminant;
    return text.str();
  }

 private:
  PhysicalParams p_;
};

/* A real number for each input of the model, by a function from its ordinary range (low, high)
 * to a number. */
template<typename Number> PhysicalParams physical_params_of(Random &random, const Number &number)
{
  const float spacing_nm = number(200.0f, 200000.0f);
  const bool cross = random() % 3 == 0;
  const float cross_nm = cross ? number(200.0f, 200000.0f) : 0.0f;
  const Metal metal = Metal(random() % (metal_custom + 1));
  /* The chi-squared test has fine bins along both axes if wires cross. */
  const float coherence_most_um = cross ? 6.0f : 100.0f;
  PhysicalParams p = physical_params(
      physical_lattice(
          spacing_nm, spacing_nm * number(0.02f, 0.98f), number(2.0f, coherence_most_um)),
      physical_lattice(
          cross_nm, cross_nm * number(0.02f, 0.98f), number(0.5f, coherence_most_um)),
      number(1.0f, 2000.0f),
      number(10.0f, 1500.0f),
      random() % 2 ? number(0.01f, 0.6f) : 0.0f,
      random() % 2 ? number(0.005f, 0.2f) : 0.0f,
      Oxide(random() % (oxide_custom + 1)),
      number(1.0f, 3.0f),
      metal,
      Illuminant(random() % illuminant_count));
  if (metal == metal_custom) {
    physical_set_custom_metal(p,
                              number(0.02f, 5.0f),
                              number(0.02f, 5.0f),
                              number(0.02f, 5.0f),
                              number(0.1f, 10.0f),
                              number(0.1f, 10.0f),
                              number(0.1f, 10.0f));
  }
  return p;
}

inline PhysicalParams random_physical_params(Random &random)
{
  return physical_params_of(random, [&random](const float low, const float high) {
    return log_uniform(random, low, high);
  });
}

/* Next to perfect metals, deep grooves and thick oxide, half of the area ridge, any width of the
 * lobes, a single wavelength. */
inline PhysicalParams bright_physical_params(Random &random)
{
  const bool thick = random() % 2;
  const float spacing_nm = log_uniform(random, 300.0f, 5000.0f);
  const float cross_nm = random() % 4 == 0 ? log_uniform(random, 300.0f, 5000.0f) : 0.0f;
  PhysicalParams p = physical_params(
      physical_lattice(spacing_nm,
                       spacing_nm * (random() % 2 ? 0.5f : uniform(random)),
                       log_uniform(random, 0.5f, 30.0f)),
      physical_lattice(cross_nm,
                       cross_nm * (random() % 2 ? 0.5f : uniform(random)),
                       log_uniform(random, 0.5f, 30.0f)),
      random() % 2 ? 0.0f : log_uniform(random, 50.0f, thick ? 10000.0f : 1000.0f),
      log_uniform(random, 50.0f, thick ? 10000.0f : 600.0f),
      random() % 2 ? 0.0f : log_uniform(random, 0.05f, 0.6f),
      random() % 2 ? 0.0f : uniform(random, 0.0f, 0.2f),
      oxide_custom,
      uniform(random, 1.0f, 3.0f),
      metal_custom,
      illuminant_sodium);
  const float n = random() % 2 ? 0.02f : log_uniform(random, 0.02f, 1.0f);
  const float k = random() % 2 ? 15.0f : log_uniform(random, 2.0f, 15.0f);
  physical_set_custom_metal(p, n, n, n, k, k, k);
  return p;
}

/* ---- All of them ---- */

/* Zero, infinite, negative, not a number, or anything. */
inline float any_value(Random &random)
{
  static const float extremes[] = {0.0f,
                                   -0.0f,
                                   1e9f,
                                   -1e9f,
                                   1e-9f,
                                   1.0f,
                                   -1.0f,
                                   1e30f,
                                   std::numeric_limits<float>::infinity(),
                                   -std::numeric_limits<float>::infinity(),
                                   std::numeric_limits<float>::quiet_NaN()};
  const unsigned choice = random() % 32;
  return choice < std::size(extremes) ? extremes[choice] : log_uniform(random, 1e-4f, 1e5f);
}

inline std::unique_ptr<Surface> any_cs348b(Random &random)
{
  const auto any = [&random] { return any_value(random); };
  float x[6];
  for (float &value : x) {
    value = any();
  }
  return std::make_unique<Cs348bSurface>(
      cs348b_params(x[0], x[1], x[2], x[3], x[4], x[5], int(random() % 8)));
}

inline std::unique_ptr<Surface> any_physical(Random &random)
{
  return std::make_unique<PhysicalSurface>(
      physical_params_of(random, [&random](const float low, const float high) {
        return random() % 4 == 0 ? any_value(random) : log_uniform(random, low, high);
      }));
}

inline const std::vector<Model> models = {
    {"Cs348b",
     false,
     false,
     56,
     [](Random &random) { return std::make_unique<Cs348bSurface>(random_params(random)); },
     {},
     any_cs348b},
    {"Physical",
     true,
     true,
     200,
     [](Random &random) {
       return std::make_unique<PhysicalSurface>(random_physical_params(random));
     },
     [](Random &random) {
       return std::make_unique<PhysicalSurface>(bright_physical_params(random));
     },
     any_physical},
};

}  // namespace icwafer::test
