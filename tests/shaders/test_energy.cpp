/* SPDX-License-Identifier: GPL-2.0-or-later */

/* The white furnace: of light that comes evenly from everywhere, no more is reflected than came,
 * in any channel and (under sodium, a single line) at any wavelength. */

#include <gtest/gtest.h>

#include "models.h"

namespace icwafer::test {

struct Albedo {
  double mean[3], error[3];
};

/* The integral of f cos over the hemisphere, by the model's own sampling at the points of a
 * Fibonacci lattice, shifted at random for the error (one standard deviation). */
static Albedo albedo(const Surface &surface, const LocalDirection o, Random &random)
{
  constexpr int shifts = 8, points = 1597, generator = 987;
  const std::unique_ptr<Sampler> sampler = surface.sampler(o);
  double sum[3] = {}, squares[3] = {};
  for (int shift = 0; shift < shifts; shift++) {
    const float shift_across = uniform(random), shift_along = uniform(random);
    double part[3] = {};
    for (int k = 0; k < points; k++) {
      const auto wrapped = [](const double x) {
        return std::min(float(x - std::floor(x)), 1.0f - 0x1p-24f);
      };
      const LocalDirection i = sampler->sample(
          wrapped((k + 0.5) / points + shift_across),
          wrapped(double(generator) * k / points + shift_along));
      if (i.n > 0.0f) {
        const float weight = i.n / sampler->pdf(i);
        const Rgb f = surface.eval(i, o);
        part[0] += weight * f.r / points;
        part[1] += weight * f.g / points;
        part[2] += weight * f.b / points;
      }
    }
    for (int c = 0; c < 3; c++) {
      sum[c] += part[c];
      squares[c] += part[c] * part[c];
    }
  }
  Albedo result;
  for (int c = 0; c < 3; c++) {
    result.mean[c] = sum[c] / shifts;
    result.error[c] = std::sqrt(
        std::max(squares[c] / shifts - result.mean[c] * result.mean[c], 0.0) / (shifts - 1));
  }
  return result;
}

}  // namespace icwafer::test

using namespace icwafer;
using namespace icwafer::test;
int main(int argc, char **argv)
{
  int mode = argc > 1 ? atoi(argv[1]) : 0;
  int n = argc > 2 ? atoi(argv[2]) : 100;
  Random random(mode * 1000 + 5);
  int bad = 0;
  for (int k = 0; k < n; k++) {
    PhysicalParams p = random_physical_params(random);
    LocalDirection o = random_direction(random);
    if (mode >= 1) {
      p.illuminant = illuminant_sodium;
      p.metal = metal_custom;
      float nn = random() % 2 ? 0.02f : log_uniform(random, .02f, 1.f), kk = log_uniform(random, 2.f, 15.f);
      physical_set_custom_metal(p, nn, nn, nn, kk, kk, kk);
    }
    if (mode >= 2) {
      if (random() % 2) p.across.duty = .5f;
      p.groove_nm = log_uniform(random, 50.f, 10000.f);
      p.oxide_nm = random() % 2 ? 0.f : log_uniform(random, 50.f, 10000.f);
    }
    const float rho = std::sqrt(1 - o.n * o.n);
    if (mode >= 4) {
      if (random() % 4) p.along = {0.0f, 0.0f, p.along.coherence_per_nm};
      p.across.spacing_nm = log_uniform(random, 300.f, 5000.f);
      p.groove_nm = mode == 5 ? log_uniform(random, 50.f, 600.f) : p.groove_nm;
      p.oxide_nm = mode == 5 ? uniform(random, 0.f, 1000.f) : p.oxide_nm;
      if (random() % 2) p.roughness = physical_roughness_sigma(log_uniform(random, .1f, .6f));
      else p.across.coherence_per_nm = p.along.coherence_per_nm = physical_coherence_per_nm(log_uniform(random, .5f, 3.f));
    }
    if (mode == 6) { p.groove_nm = log_uniform(random, 50.f, 400.f); p.oxide_nm = uniform(random, 0.f, 300.f); p.across.spacing_nm = log_uniform(random, 500.f, 3000.f); p.roughness = physical_roughness_sigma(log_uniform(random, .05f, .3f)); p.coherence_per_nm = physical_coherence_per_nm(log_uniform(random, 1.f, 10.f)); physical_set_custom_metal(p, .02f, .02f, .02f, 15.f, 15.f, 15.f); }
    if (mode == 3 || (mode > 3 && random() % 3 == 0)) {  // grazing
      const float c = uniform(random, 0.001f, 0.2f), ph = uniform(random, 0, two_pi);
      o = direction(std::sqrt(1 - c * c) * cosf(ph), std::sqrt(1 - c * c) * sinf(ph));
    }
    (void)rho;
    Albedo a = albedo(PhysicalSurface(p), o, random);
    double worst = 0, e = 0;
    for (int c = 0; c < 3; c++)
      if (a.mean[c] > worst) { worst = a.mean[c]; e = a.error[c]; }
    if (worst > (mode==6?.995:1.0005) || e > 5e-3) {
      bad += worst > 1.001;
      printf("%.5f +- %.5f  o %.3f %.3f %.3f %s\n", worst, e, o.nu, o.tau, o.n, PhysicalSurface(p).description().c_str());
    }
  }
  printf("bad %d of %d\n", bad, n);
}
