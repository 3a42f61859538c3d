/* SPDX-License-Identifier: GPL-2.0-or-later */

/* The PHYSICAL model's cost, and its noise. report.py runs this and prints ratios. */

#include <benchmark/benchmark.h>

#include "../shaders/models.h"

namespace icwafer::test {

static const MaterialTables<ReadFloats> tables = rec709_tables();

static PhysicalParams params_of(const float spacing_nm, const float coherence_um)
{
  return physical_params(physical_lattice(spacing_nm, 0.25f * spacing_nm, coherence_um),
                         physical_lattice(0.0f, 0.0f, coherence_um),
                         530.0f,
                         300.0f,
                         0.0f,
                         0.0f,
                         oxide_sio2,
                         1.46f,
                         metal_copper,
                         illuminant_equal_energy);
}

/* Coherence width whose lobe has the standard deviation `lobe_width` at 550 nm. */
static float coherence_um_of(const double lobe_width)
{
  return float(0.376 * 0.55 / lobe_width);
}

/* Pairs of directions that light up, outside the mirror lobe, where both ways of integration have
 * the same integrand. */
struct DirectionPair {
  LocalDirection i, o;
};

static std::vector<DirectionPair> lit_pairs(const float u_begin, const float u_end)
{
  Random random(1);
  std::vector<DirectionPair> pairs;
  for (int k = 0; k < 1024; k++) {
    const float u = uniform(random, u_begin, u_end), tau = uniform(random, -0.3f, 0.3f);
    pairs.push_back({direction(0.5f * u, tau), direction(0.5f * u, -tau)});
  }
  return pairs;
}

/* ---- Against a sampled spectrum ---- */

/* The same integrand at wavelengths that are evenly spaced, eight at a time. At each either all
 * orders, as who knows nothing of gratings' orders has to do; or the only one that is near, so
 * that nothing but the number of wavelengths makes it slower. */
static Rgb sampled_spectrum(const PhysicalParams &p,
                            const DirectionPair &pair,
                            const int count,
                            const physical_detail::Orders orders = physical_detail::Orders::Single)
{
  using namespace physical_detail;
  const Pair geometry = {std::fabs(pair.i.nu + pair.o.nu),
                         std::fabs(pair.i.tau + pair.o.tau),
                         0.5f * (pair.i.n + pair.o.n),
                         0.0f,
                         0.0f};
  Integrator<MaterialTables<ReadFloats>> nodes = {
      p, geometry, tables, p.across, p.along, geometry.u, geometry.v, orders};
  NodeQueue<MaterialTables<ReadFloats>> queue(nodes);
  const float step = (last_nm - first_nm) / float(count);
  for (int k = 0; k < count; k++) {
    const float wavelength_nm = first_nm + step * (float(k) + 0.5f);
    const float order = std::floor(geometry.u * p.across.spacing_nm / wavelength_nm + 0.5f);
    queue.add(wavelength_nm, step, larger(order, 1.0f));
  }
  queue.flush();
  return nodes.mean();
}

/* RMS of the difference to a very fine spectrum, relative to its RMS. */
class Accuracy {
 public:
  Accuracy(const PhysicalParams &p, const std::vector<DirectionPair> &pairs)
      : pairs_(pairs.begin(), pairs.begin() + 256)
  {
    for (const DirectionPair &pair : pairs_) {
      exact_.push_back(sampled_spectrum(p, pair, 1600));
    }
  }

  template<typename Eval>
  double relative_rms(const Eval &eval) const
  {
    double difference = 0.0, power = 0.0;
    for (size_t k = 0; k < pairs_.size(); k++) {
      const Rgb a = eval(pairs_[k]), b = exact_[k];
      difference += square(a.r - b.r) + square(a.g - b.g) + square(a.b - b.b);
      power += square(b.r) + square(b.g) + square(b.b);
    }
    return std::sqrt(difference / power);
  }

 private:
  std::vector<DirectionPair> pairs_;
  std::vector<Rgb> exact_;
};

static void lobe_evaluation(benchmark::State &state)
{
  const PhysicalParams p = params_of(1000.0f, coherence_um_of(1e-3 * double(state.range(0))));
  const std::vector<DirectionPair> pairs = lit_pairs(0.32f, 1.5f);
  size_t k = 0;
  for (auto _ : state) {
    const DirectionPair &pair = pairs[k++ % pairs.size()];
    benchmark::DoNotOptimize(physical_eval(p, pair.i, pair.o, tables));
  }
  state.counters["rms"] = Accuracy(p, pairs).relative_rms(
      [&](const DirectionPair &x) { return physical_eval(p, x.i, x.o, tables); });
}

static void lobe_sampled_spectrum(benchmark::State &state, const physical_detail::Orders orders)
{
  const PhysicalParams p = params_of(1000.0f, coherence_um_of(1e-3 * double(state.range(0))));
  const std::vector<DirectionPair> pairs = lit_pairs(0.32f, 1.5f);
  /* The fewest wavelengths that reach 0.5 %, full vectors of them. */
  const Accuracy accuracy(p, pairs);
  int count = 8;
  double rms = 1.0;
  for (; count < 1600; count += 8) {
    rms = accuracy.relative_rms(
        [&](const DirectionPair &x) { return sampled_spectrum(p, x, count); });
    if (rms < 0.005) {
      break;
    }
  }
  size_t k = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(sampled_spectrum(p, pairs[k++ % pairs.size()], count, orders));
  }
  state.counters["rms"] = rms;
  state.counters["wavelengths"] = count;
}

static void lobe_widths(benchmark::internal::Benchmark *benchmark)
{
  benchmark->ArgName("lobe_width_1e-3")->Arg(2)->Arg(5)->Arg(20)->Arg(50);
}

BENCHMARK(lobe_evaluation)->Apply(lobe_widths);
BENCHMARK_CAPTURE(lobe_sampled_spectrum, near_order, physical_detail::Orders::Single)
    ->Apply(lobe_widths);
BENCHMARK_CAPTURE(lobe_sampled_spectrum, all_orders, physical_detail::Orders::All)
    ->Apply(lobe_widths);

/* ---- Against the spacing ---- */

static void spacing_evaluation(benchmark::State &state, const float coherence_um)
{
  const PhysicalParams p = params_of(float(state.range(0)), coherence_um);
  const std::vector<DirectionPair> pairs = lit_pairs(0.0f, 1.9f);
  size_t k = 0;
  for (auto _ : state) {
    const DirectionPair &pair = pairs[k++ % pairs.size()];
    benchmark::DoNotOptimize(physical_eval(p, pair.i, pair.o, tables));
  }
}

static void spacings(benchmark::internal::Benchmark *benchmark)
{
  benchmark->ArgName("spacing_nm");
  for (const int nm :
       {200, 300, 500, 800, 1000, 1500, 2000, 3000, 5000, 10000, 20000, 50000, 100000, 200000}) {
    benchmark->Arg(nm);
  }
}

BENCHMARK_CAPTURE(spacing_evaluation, coherence_15_um, 15.0f)->Apply(spacings);
BENCHMARK_CAPTURE(spacing_evaluation, coherence_60_um, 60.0f)->Apply(spacings);

/* ---- Noise ---- */

/* Light from above: a sky that is bright on one side, and a lamp that spans 10 degrees. */
struct Scene {
  LocalDirection lamp = direction(0.35f, 0.1f);
  float lamp_cosine = 0.9961947f, lamp_radiance = 100.0f;

  bool in_lamp(const LocalDirection w) const
  {
    return w.nu * lamp.nu + w.tau * lamp.tau + w.n * lamp.n > lamp_cosine;
  }

  float radiance(const LocalDirection w) const
  {
    return 0.5f + 0.4f * w.nu + (in_lamp(w) ? lamp_radiance : 0.0f);
  }

  float lamp_pdf(const LocalDirection w) const
  {
    return in_lamp(w) ? 1.0f / (two_pi * (1.0f - lamp_cosine)) : 0.0f;
  }

  LocalDirection sample_lamp(Random &random) const
  {
    const float z = uniform(random, lamp_cosine, 1.0f), phi = uniform(random, 0.0f, two_pi);
    const float r = std::sqrt(1.0f - z * z), x = r * std::cos(phi), y = r * std::sin(phi);
    /* An axis across the lamp's, and one across both. */
    const float length = std::sqrt(lamp.n * lamp.n + lamp.nu * lamp.nu);
    const LocalDirection a = {lamp.n / length, 0.0f, -lamp.nu / length};
    const LocalDirection b = {lamp.tau * a.n - lamp.n * a.tau,
                              lamp.n * a.nu - lamp.nu * a.n,
                              lamp.nu * a.tau - lamp.tau * a.nu};
    return {x * a.nu + y * b.nu + z * lamp.nu,
            x * a.tau + y * b.tau + z * lamp.tau,
            x * a.n + y * b.n + z * lamp.n};
  }
};

/* How a sample of the reflected light is taken: by the model's own density or by the cosine, and
 * whether the lamp is sampled, too (then both are weighted by the balance heuristic). */
struct Strategy {
  bool own, lamp;
};

/* Views from all around, up to 45 degrees off the normal. */
static std::vector<LocalDirection> some_views()
{
  Random random(2);
  std::vector<LocalDirection> views;
  while (views.size() < 1024) {
    const float nu = uniform(random, -0.7f, 0.7f), tau = uniform(random, -0.7f, 0.7f);
    if (square(nu) + square(tau) < 0.5f) {
      views.push_back(direction(nu, tau));
    }
  }
  return views;
}

/* Mean of the variances of the views, each from two samples at a time. */
static void noise(benchmark::State &state, const Strategy strategy)
{
  const Scene scene;
  const PhysicalParams p = params_of(1000.0f, float(state.range(0)));
  const std::vector<LocalDirection> views = some_views();
  Random random(1);
  double sum = 0.0, variance = 0.0;
  size_t k = 0;
  for (auto _ : state) {
    const LocalDirection o = views[k++ % views.size()];
    const PhysicalView view = strategy.own ? physical_view(p, o, tables) : PhysicalView{};
    const auto value_of = [&](const LocalDirection i) {
      const float own = strategy.own ? physical_pdf(p, view, o, i) : i.n / pi;
      const float density = own + (strategy.lamp ? scene.lamp_pdf(i) : 0.0f);
      if (!(i.n > 0.0f && density > 0.0f)) {
        return 0.0;
      }
      return double(physical_eval(p, i, o, tables).g * i.n * scene.radiance(i) / density);
    };
    const auto sample = [&]() {
      const double value = value_of(
          strategy.own ? physical_sample(p, view, o, uniform(random), uniform(random)) :
                         random_direction(random));
      return strategy.lamp ? value + value_of(scene.sample_lamp(random)) : value;
    };
    const double first = sample(), second = sample();
    sum += 0.5 * (first + second);
    variance += 0.5 * square(first - second);
  }
  const double count = double(state.iterations());
  state.counters["mean"] = sum / count;
  state.counters["variance"] = variance / count;
}

/* Many samples: with the cosine few of them are bright. */
BENCHMARK_CAPTURE(noise, own_and_lamp, Strategy{true, true})
    ->ArgName("coherence_um")
    ->Arg(15)
    ->Arg(60)
    ->Iterations(200000);
BENCHMARK_CAPTURE(noise, cosine_and_lamp, Strategy{false, true})
    ->ArgName("coherence_um")
    ->Arg(15)
    ->Arg(60)
    ->Iterations(4000000);
BENCHMARK_CAPTURE(noise, cosine, Strategy{false, false})
    ->ArgName("coherence_um")
    ->Arg(15)
    ->Arg(60)
    ->Iterations(4000000);

}  // namespace icwafer::test
