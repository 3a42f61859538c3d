/* SPDX-License-Identifier: GPL-2.0-or-later */

/* Cost of one evaluation, one density and one sample. Compare ratios within one run. */

#include <benchmark/benchmark.h>

#include "../shaders/support.h"
#include "icwafer/reference.h"

namespace icwafer::test {

static const ColourTable rec709 = colour_table(working_spaces[0].xyz_to_rgb);
static const TableSensitivity sensitivity(rec709);

static Cs348bParams params(const benchmark::State &state)
{
  return cs348b_params(float(state.range(0)),
                       0.25f * float(state.range(0)),
                       530.0f,
                       1.544f,
                       float(state.range(1)) * 1e-3f,
                       0.0f,
                       cs348b_all_effects);
}

static void evaluate(benchmark::State &state)
{
  Random random(1);
  const Cs348bParams p = params(state);
  for (auto _ : state) {
    benchmark::DoNotOptimize(cs348b_eval(
        p, grating_geometry(random_direction(random), random_direction(random)), sensitivity));
  }
}

static void density(benchmark::State &state)
{
  Random random(1);
  const Cs348bParams p = params(state);
  for (auto _ : state) {
    const LocalDirection o = random_direction(random);
    benchmark::DoNotOptimize(cs348b_pdf(p, 1.0f, o, random_direction(random)));
  }
}

static void setup_and_sample(benchmark::State &state)
{
  Random random(1);
  const Cs348bParams p = params(state);
  for (auto _ : state) {
    const LocalDirection o = random_direction(random);
    const float total = cs348b_total_power(p, o.nu);
    benchmark::DoNotOptimize(cs348b_sample(p, total, o, uniform(random), uniform(random)));
  }
}

/* The spectrum sampled at every nanometre: what the original did, made fine enough. */
static void brute_force(benchmark::State &state)
{
  Random random(1);
  const Cs348bParams p = params(state);
  for (auto _ : state) {
    benchmark::DoNotOptimize(reference::cs348b_eval(
        p, grating_geometry(random_direction(random), random_direction(random)), rec709, 1));
  }
}

static void arguments(benchmark::internal::Benchmark *benchmark)
{
  benchmark->ArgNames({"spacing_nm", "lobe_width_1e-3"})
      ->Args({1000, 2})
      ->Args({1000, 15})
      ->Args({1000, 50})
      ->Args({4000, 15})
      ->Args({100000, 15});
}

BENCHMARK(evaluate)->Apply(arguments);
BENCHMARK(density)->Apply(arguments);
BENCHMARK(setup_and_sample)->Apply(arguments);
BENCHMARK(brute_force)->Apply(arguments);

}  // namespace icwafer::test
