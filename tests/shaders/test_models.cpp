/* SPDX-License-Identifier: GPL-2.0-or-later */

/* What every model must hold to: its density describes its sampling, light may be followed either
 * way, and any input gives a finite result. Energy is in test_energy.cpp. */

#include <gtest/gtest.h>

#include <boost/math/distributions/chi_squared.hpp>

#include "models.h"

namespace icwafer::test {

/* ---- Sampling follows the density ---- */

/* Pearson's chi-squared test in the unit disc of direction cosines, in bins finer than a lobe. */
constexpr int sample_count = 1000000;

/* Gauss-Legendre nodes of two points on [0, 1]; each has half of the weight. */
constexpr double nodes[2] = {0.2113248654051871, 0.7886751345948129};

struct SamplingCase {
  Model model;
  int set;
};

static void PrintTo(const SamplingCase &sampling_case, std::ostream *out)
{
  *out << sampling_case.model.name << " " << sampling_case.set;
}

static size_t bin_of(const std::vector<double> &edges, const double x)
{
  const auto above = std::upper_bound(edges.begin() + 1, edges.end() - 1, x);
  return size_t(above - edges.begin()) - 1;
}

/* Integral of the density over the part of a bin that is above the horizon. The density over
 * solid angle is one over the tangential components when divided by the cosine. */
static double expected_part(const Sampler &sampler,
                            const double across_begin,
                            const double across_end,
                            const double along_begin,
                            const double along_end)
{
  const auto above = [](const double s, const double t) { return s * s + t * t < 1.0; };
  const bool whole = above(across_begin, along_begin) && above(across_begin, along_end) &&
                     above(across_end, along_begin) && above(across_end, along_end);
  const int strips = whole ? 1 : 16;
  const double width = (across_end - across_begin) / strips;
  double sum = 0.0;
  for (int strip = 0; strip < strips; strip++) {
    for (const double x : nodes) {
      const double s = across_begin + (strip + x) * width;
      const double half = std::sqrt(1.0 - s * s);
      const double begin = std::max(along_begin, -half);
      const double length = std::min(along_end, half) - begin;
      for (const double y : nodes) {
        if (length > 0.0) {
          const LocalDirection i = direction(float(s), float(begin + y * length));
          sum += i.n > 0.0f ? 0.25 * width * length * double(sampler.pdf(i)) / i.n : 0.0;
        }
      }
    }
  }
  return sum;
}

/* The part of the samples that belongs into each bin, the last number those without a direction.
 */
static std::vector<double> expected_parts(const Sampler &sampler, const Bins &bins)
{
  std::vector<double> parts;
  double left = 1.0;
  for (size_t a = 0; a + 1 < bins.across.size(); a++) {
    for (size_t b = 0; b + 1 < bins.along.size(); b++) {
      parts.push_back(expected_part(
          sampler, bins.across[a], bins.across[a + 1], bins.along[b], bins.along[b + 1]));
      left -= parts.back();
    }
  }
  EXPECT_GT(left, -0.002);
  parts.push_back(std::max(left, 0.0));
  return parts;
}

class Sampling : public testing::TestWithParam<SamplingCase> {};

TEST_P(Sampling, FollowsThePdf)
{
  const auto &[model, set] = GetParam();
  Random random(100 + set);
  const std::unique_ptr<Surface> surface = model.random(random);
  const LocalDirection o = random_direction(random);
  const std::unique_ptr<Sampler> sampler = surface->sampler(o);
  const Bins bins = surface->bins(o);
  const std::vector<double> parts = expected_parts(*sampler, bins);

  std::vector<int> observed(parts.size(), 0);
  for (int k = 0; k < sample_count; k++) {
    const LocalDirection i = sampler->sample(uniform(random), uniform(random));
    if (!(i.n > 0.0f)) {
      observed.back()++;
      continue;
    }
    if (k % 8 == 0) {
      ASSERT_GT(sampler->pdf(i), 0.0f) << surface->description();
    }
    observed[bin_of(bins.across, i.nu) * (bins.along.size() - 1) + bin_of(bins.along, i.tau)]++;
  }

  /* Bins with few expected counts are pooled, as the test requires. */
  double statistic = 0.0, pooled_expected = 0.0, pooled_observed = 0.0;
  int count = 0;
  for (size_t k = 0; k < parts.size(); k++) {
    pooled_expected += parts[k] * sample_count;
    pooled_observed += observed[k];
    if (pooled_expected >= 10.0 || k + 1 == parts.size()) {
      const double difference = pooled_observed - pooled_expected;
      statistic += difference * difference / std::max(pooled_expected, 1.0);
      count++;
      pooled_expected = pooled_observed = 0.0;
    }
  }
  ASSERT_GT(count, 20);
  const boost::math::chi_squared distribution(count - 1);
  const double probability = boost::math::cdf(boost::math::complement(distribution, statistic));
  /* Sidak: together the sets reject a correct sampler once in a hundred times. */
  const double threshold = 1.0 - std::pow(1.0 - 0.01, 1.0 / model.chi_squared_sets);
  EXPECT_GT(probability, threshold)
      << surface->description() << ", view " << o.nu << " " << o.tau << ", bins " << count
      << ", statistic " << statistic;
}

static std::vector<SamplingCase> sampling_cases()
{
  std::vector<SamplingCase> cases;
  for (const Model &model : models) {
    for (int set = 0; set < model.chi_squared_sets; set++) {
      cases.push_back({model, set});
    }
  }
  return cases;
}

INSTANTIATE_TEST_SUITE_P(Sets,
                         Sampling,
                         testing::ValuesIn(sampling_cases()),
                         [](const auto &suite) {
                           return suite.param.model.name + std::to_string(suite.param.set);
                         });

/* ---- Reciprocity ---- */

class Reciprocity : public testing::TestWithParam<Model> {};

/* f(i, o) = f(o, i), to the rounding of float. Directions are drawn by the model, so that most
 * pairs have light. */
TEST_P(Reciprocity, Holds)
{
  const Model model = GetParam();
  if (!model.reciprocal) {
    GTEST_SKIP() << "not claimed by " << model.name;
  }
  Random random(2);
  int lit = 0;
  for (int k = 0; k < 20000; k++) {
    const std::unique_ptr<Surface> surface = model.random(random);
    const LocalDirection o = random_direction(random);
    const LocalDirection i = surface->sampler(o)->sample(uniform(random), uniform(random));
    if (!(i.n > 0.0f)) {
      continue;
    }
    const Rgb there = surface->eval(i, o), back = surface->eval(o, i);
    const float largest = std::max({there.r, there.g, there.b});
    lit += largest > 0.0f;
    for (const float difference : {there.r - back.r, there.g - back.g, there.b - back.b}) {
      ASSERT_LE(std::fabs(difference), 1e-5f * largest)
          << surface->description() << ", i " << i.nu << " " << i.tau << ", o " << o.nu << " "
          << o.tau;
    }
  }
  EXPECT_GT(lit, 10000);
}

INSTANTIATE_TEST_SUITE_P(Models,
                         Reciprocity,
                         testing::ValuesIn(models),
                         [](const auto &suite) { return suite.param.name; });

/* ---- Robustness ---- */

static LocalDirection any_direction(Random &random)
{
  switch (random() % 8) {
    case 0:
      return {0.0f, 0.0f, 1.0f};
    case 1:
      return {1.0f, 0.0f, 1e-7f};
    case 2:
      return {0.0f, -1.0f, 1e-7f};
    default:
      return random_direction(random);
  }
}

/* 10^7 evaluations, samples and densities of each model at any input: finite and never negative.
 * Split so that test runners can share the work. */
constexpr int any_input_parts = 8;

class AnyInput : public testing::TestWithParam<std::tuple<Model, int>> {};

TEST_P(AnyInput, IsFiniteAndNotNegative)
{
  const auto &[model, part] = GetParam();
  Random random(1000 + part);
  for (int k = 0; k < 10000000 / any_input_parts; k++) {
    const std::unique_ptr<Surface> surface = model.any(random);
    const LocalDirection o = any_direction(random);
    const std::unique_ptr<Sampler> sampler = surface->sampler(o);
    LocalDirection i = any_direction(random);
    if (k % 2 == 0) {
      const LocalDirection sample = sampler->sample(uniform(random), uniform(random));
      ASSERT_LE(sample.nu * sample.nu + sample.tau * sample.tau, 1.0001f);
      ASSERT_TRUE(sample.n >= 0.0f && sample.n <= 1.0f);
      i = sample.n > 0.0f ? sample : i;
    }
    const float pdf = sampler->pdf(i);
    ASSERT_TRUE(std::isfinite(pdf) && pdf >= 0.0f) << surface->description();
    const Rgb f = surface->eval(i, o);
    for (const float channel : {f.r, f.g, f.b}) {
      ASSERT_TRUE(std::isfinite(channel) && channel >= 0.0f)
          << surface->description() << ", i " << i.nu << " " << i.tau << ", o " << o.nu << " "
          << o.tau;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(TenMillion,
                         AnyInput,
                         testing::Combine(testing::ValuesIn(models),
                                          testing::Range(0, any_input_parts)),
                         [](const auto &suite) {
                           return std::get<0>(suite.param).name +
                                  std::to_string(std::get<1>(suite.param));
                         });

}  // namespace icwafer::test
