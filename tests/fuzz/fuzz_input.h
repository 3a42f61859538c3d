/* SPDX-License-Identifier: GPL-2.0-or-later */

/* What the fuzzers share: parameters, directions and tables out of the bytes that libFuzzer makes
 * up, and a check that names itself when it fails. */

#pragma once

#include <cmath>
#include <cstdio>
#include <cstdlib>

#include <fuzzer/FuzzedDataProvider.h>

#include "../shaders/support.h"

#define FUZZ_EXPECT(condition) \
  do { \
    if (!(condition)) { \
      std::fprintf(stderr, "%s:%d: not true: %s\n", __FILE__, __LINE__, #condition); \
      std::abort(); \
    } \
  } while (false)

namespace icwafer::fuzz {

/* Reads what it needs from the bytes; when they are used up, everything is 0. */
class Input {
 public:
  Input(const uint8_t *bytes, const size_t count) : bytes_(bytes, count)
  {
  }

  bool flag()
  {
    return bytes_.ConsumeBool();
  }

  /* A whole number in [0, count). */
  int choice(const int count)
  {
    return bytes_.ConsumeIntegralInRange<int>(0, count - 1);
  }

  /* A socket's value: any bit pattern at all (a broken texture), or one in the range, linear or
   * by its logarithm, with its ends. */
  float socket(const float low, const float high)
  {
    switch (bytes_.ConsumeIntegralInRange<int>(0, 3)) {
      case 0: {
        const uint32_t bits = bytes_.ConsumeIntegral<uint32_t>();
        float value;
        static_assert(sizeof(value) == sizeof(bits));
        std::memcpy(&value, &bits, sizeof(value));
        return value;
      }
      case 1:
        return flag() ? low : high;
      case 2:
        return std::exp(std::log(std::fmax(low, 1e-4f)) +
                        part() * (std::log(high) - std::log(std::fmax(low, 1e-4f))));
      default:
        return low + part() * (high - low);
    }
  }

  /* A number in [0, 1), as the renderer's random numbers are. */
  float random()
  {
    return float(bytes_.ConsumeIntegral<uint32_t>() >> 8) * 0x1p-24f;
  }

  /* A unit vector on or above the surface. */
  LocalDirection direction()
  {
    float radius = std::sqrt(part());
    switch (choice(4)) {
      case 0:
        radius = 1.0f - 1e-7f * radius; /* Grazing. */
        break;
      case 1:
        radius *= 1e-5f; /* Along the normal. */
        break;
    }
    const float phi = flag() ? 0.5f * pi * float(choice(4)) : two_pi * part();
    return test::direction(radius * std::cos(phi), radius * std::sin(phi));
  }

  /* A direction that has something to do with another one: its mirror image, itself, the one at
   * which order `order` of some wavelength leaves; or none of these. */
  LocalDirection partner(const LocalDirection o, const float spacing_nm)
  {
    switch (choice(4)) {
      case 0:
        return {-o.nu, -o.tau, o.n};
      case 1:
        return o;
      case 2: {
        const float order = float(choice(41) - 20);
        const float nu = order * (380.0f + 400.0f * part()) / spacing_nm - o.nu;
        if (nu * nu + o.tau * o.tau < 1.0f) {
          return test::direction(nu, -o.tau);
        }
        break;
      }
    }
    return direction();
  }

 private:
  /* A number in [0, 1]. */
  float part()
  {
    return float(bytes_.ConsumeIntegral<uint32_t>()) * (1.0f / 4294967295.0f);
  }

  FuzzedDataProvider bytes_;
};

inline bool is_unit(const LocalDirection w)
{
  return std::fabs(w.nu * w.nu + w.tau * w.tau + w.n * w.n - 1.0f) < 1e-4f && w.n >= 0.0f;
}

inline bool is_light(const Rgb f)
{
  return std::isfinite(f.r) && std::isfinite(f.g) && std::isfinite(f.b) && f.r >= 0.0f &&
         f.g >= 0.0f && f.b >= 0.0f;
}

inline bool is_density(const float pdf)
{
  return std::isfinite(pdf) && pdf >= 0.0f;
}

}  // namespace icwafer::fuzz
