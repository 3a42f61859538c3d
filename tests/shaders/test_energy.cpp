/* SPDX-License-Identifier: GPL-2.0-or-later */

/* The white furnace: of light that comes evenly from everywhere, no more is reflected than came,
 * in any channel and at any wavelength. (Sodium is a single line. As a model's lengths scale with
 * the wavelength, lines at other wavelengths are other lengths and indices.) */

#include <gtest/gtest.h>

#include "models.h"

namespace icwafer::test {

/* The largest channel. */
struct Albedo {
  double mean, error;
};

/* The integral of f cos over the hemisphere, by the model's own sampling at the points of a
 * Fibonacci lattice, shifted at random for the error (one standard deviation). */
static Albedo albedo(const Surface &surface,
                     const LocalDirection o,
                     const int points,
                     const int generator,
                     Random &random)
{
  constexpr int shifts = 8;
  const std::unique_ptr<Sampler> sampler = surface.sampler(o);
  const auto wrapped = [](const double x) {
    return std::min(float(x - std::floor(x)), 1.0f - 0x1p-24f);
  };
  double sum[3] = {}, squares[3] = {};
  for (int shift = 0; shift < shifts; shift++) {
    const float shift_across = uniform(random), shift_along = uniform(random);
    double part[3] = {};
    for (int k = 0; k < points; k++) {
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
  const int largest = int(std::max_element(sum, sum + 3) - sum);
  const double mean = sum[largest] / shifts;
  const double variance = std::max(squares[largest] / shifts - mean * mean, 0.0);
  return {mean, std::sqrt(variance / (shifts - 1))};
}

static LocalDirection any_view(Random &random)
{
  if (random() % 3 != 0) {
    return random_direction(random);
  }
  const float r = std::sqrt(1.0f - square(uniform(random, 0.01f, 0.2f)));
  const float phi = uniform(random, 0.0f, two_pi);
  return direction(r * std::cos(phi), r * std::sin(phi));
}

constexpr int parts = 4;

class Furnace : public testing::TestWithParam<std::tuple<Model, int>> {};

TEST_P(Furnace, NoMoreOutThanIn)
{
  const auto &[model, part] = GetParam();
  if (!model.energy_bounded) {
    GTEST_SKIP() << "not claimed by " << model.name;
  }
  Random random(300 + part);
  double brightest = 0.0;
  for (int k = 0; k < 40; k++) {
    const std::unique_ptr<Surface> surface = k % 3 == 0 ? model.random(random) :
                                                          model.brightest(random);
    const LocalDirection o = any_view(random);
    Albedo a = albedo(*surface, o, 1597, 987, random);
    if (a.mean + 4.0 * a.error > 1.001) {
      a = albedo(*surface, o, 17711, 10946, random);
      EXPECT_LT(a.error, 3e-4) << surface->description();
    }
    EXPECT_LE(a.mean, 1.001) << "+- " << a.error << ", " << surface->description() << ", view "
                             << o.nu << " " << o.tau;
    brightest = std::max(brightest, a.mean);
  }
  /* The bound is not kept by being dark; wide lobes lose light below the horizon. */
  EXPECT_GT(brightest, 0.9);
}

INSTANTIATE_TEST_SUITE_P(Sets,
                         Furnace,
                         testing::Combine(testing::ValuesIn(models), testing::Range(0, parts)),
                         [](const auto &suite) {
                           return std::get<0>(suite.param).name +
                                  std::to_string(std::get<1>(suite.param));
                         });

}  // namespace icwafer::test
