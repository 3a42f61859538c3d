/* SPDX-License-Identifier: Apache-2.0 */

/* What the material needs from the place where it is compiled: a Cycles kernel (CPU or GPU), or
 * an ordinary C++ program. Everything else in this folder is plain C++17 on floats. */

#pragma once

#ifdef ccl_device_inline
#  define ICW_DEVICE ccl_device_inline
#  define ICW_DEVICE_METHOD ccl_device_inline_method
/* Functions that are kept as one: a kernel that has them inlined at every call takes long to
 * compile, and on a GPU many registers. */
#  ifdef __KERNEL_GPU__
#    define ICW_DEVICE_LARGE ccl_device_noinline
#    define ICW_DEVICE_LARGE_METHOD ccl_device_noinline
#  else
#    define ICW_DEVICE_LARGE static ccl_never_inline
#    define ICW_DEVICE_LARGE_METHOD ccl_never_inline
#  endif
#else
#  include <cmath>
#  define ICW_DEVICE inline
#  define ICW_DEVICE_METHOD inline
#  define ICW_DEVICE_LARGE inline
#  define ICW_DEVICE_LARGE_METHOD inline
#endif

namespace icwafer {

constexpr float pi = 3.14159265358979f;
constexpr float two_pi = 6.28318530717959f;

/* min and max that take the bound when x is not a number, so that no NaN enters the optics. */
ICW_DEVICE float clamped(const float x, const float low, const float high)
{
  return x > low ? (x < high ? x : high) : low;
}

/* Without the library's care for NaN, which costs a call. */
ICW_DEVICE float larger(const float a, const float b)
{
  return a > b ? a : b;
}

ICW_DEVICE float smaller(const float a, const float b)
{
  return a < b ? a : b;
}

ICW_DEVICE float square(const float x)
{
  return x * x;
}

/* Linear light in the working space, relative to a lamp of equal energy. */
struct Rgb {
  float r, g, b;
};

ICW_DEVICE Rgb operator+(const Rgb a, const Rgb b)
{
  return {a.r + b.r, a.g + b.g, a.b + b.b};
}

ICW_DEVICE Rgb operator*(const float s, const Rgb a)
{
  return {s * a.r, s * a.g, s * a.b};
}

}  // namespace icwafer
