/* SPDX-License-Identifier: Apache-2.0 */

/* Complex numbers over any real type, and the functions of that type that the optics needs. */

#pragma once

#include "lanes.h"

namespace icwafer {

ICW_DEVICE Lanes real_sqrt(const Lanes x)
{
  return lanes_sqrt(x);
}

#ifndef ccl_device_inline
/* double: for tests that need more digits. */
inline double real_sqrt(const double x)
{
  return std::sqrt(x);
}
#endif

template<typename Real>
struct Complex {
  Real re, im;
};

template<typename Real>
ICW_DEVICE Complex<Real> operator+(const Complex<Real> a, const Complex<Real> b)
{
  return {a.re + b.re, a.im + b.im};
}

template<typename Real>
ICW_DEVICE Complex<Real> operator-(const Complex<Real> a, const Complex<Real> b)
{
  return {a.re - b.re, a.im - b.im};
}

template<typename Real>
ICW_DEVICE Complex<Real> operator*(const Complex<Real> a, const Complex<Real> b)
{
  return {a.re * b.re - a.im * b.im, a.re * b.im + a.im * b.re};
}

template<typename Real>
ICW_DEVICE Complex<Real> operator*(const Real s, const Complex<Real> a)
{
  return {s * a.re, s * a.im};
}

template<typename Real>
ICW_DEVICE Real norm(const Complex<Real> a)
{
  return a.re * a.re + a.im * a.im;
}

/* The square root with a positive imaginary part, for im >= 0: the wave that decays into an
 * absorber. The larger part comes from the modulus, the other from it, so that neither cancels. */
template<typename Real>
ICW_DEVICE Complex<Real> decaying_sqrt(const Complex<Real> a)
{
  const Real modulus = real_sqrt(norm(a));
  const Real magnitude = a.re < 0.0f ? -a.re : a.re;
  const Real larger = real_sqrt(0.5f * (modulus + magnitude));
  const Real smaller = 0.5f * a.im / larger;
  return {a.re < 0.0f ? smaller : larger, a.re < 0.0f ? larger : smaller};
}

/* exp(2 pi i turns) */
ICW_DEVICE Complex<Lanes> unit_turns(const Lanes turns)
{
  Complex<Lanes> z;
  lanes_sincos_turns(turns, z.im, z.re);
  return z;
}

#ifndef ccl_device_inline
inline Complex<double> unit_turns(const double turns)
{
  return {std::cos(2.0 * M_PI * turns), std::sin(2.0 * M_PI * turns)};
}
#endif

}  // namespace icwafer
