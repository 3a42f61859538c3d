/* SPDX-License-Identifier: Apache-2.0 */

/* What the closures of the IC Wafer BSDF share: the frame along the wires, and the scene's look-up
 * tables. */

#pragma once

#include "kernel/icwafer/grating.h"
#include "kernel/icwafer/tables.h"

CCL_NAMESPACE_BEGIN

/* Reads the scene's look-up table. Unnamed, so that what is instantiated with it stays in its
 * kernel: each is compiled for another instruction set. */
namespace {
struct IcWaferTableRead {
  KernelGlobals kg;
  int offset;

  ccl_device_inline_method ccl_global const float *operator()(const int i) const
  {
    return &kernel_data_fetch(lookup_table, offset + i);
  }
};
}  // namespace

ccl_device_inline icwafer::MaterialTables<IcWaferTableRead> ic_wafer_tables(KernelGlobals kg)
{
  return {{kg, kernel_data.tables.ic_wafer_offset}};
}

/* Direction of the wires: `tangent` in the plane of the surface, turned by `direction_rad`
 * counter-clockwise as seen from outside. */
ccl_device_inline float3 ic_wafer_tangent(const float3 N,
                                          const float3 tangent,
                                          const float direction_rad)
{
  float3 T = tangent - dot(tangent, N) * N;
  if (!(len_squared(T) > 1e-10f * len_squared(tangent)) || !isfinite_safe(T)) {
    /* No tangent, or one along the normal: any direction, but always the same one. */
    float3 bitangent;
    make_orthonormals(N, &T, &bitangent);
  }
  return rotate_around_axis(normalize(T), N, isfinite_safe(direction_rad) ? direction_rad : 0.0f);
}

/* T: unit vector along the wires. */
ccl_device_inline icwafer::LocalDirection ic_wafer_local(const float3 N,
                                                         const float3 T,
                                                         const float3 w)
{
  return {dot(cross(N, T), w), dot(T, w), dot(N, w)};
}

ccl_device_inline float3 ic_wafer_world(const float3 N,
                                        const float3 T,
                                        const icwafer::LocalDirection w)
{
  return normalize(w.nu * cross(N, T) + w.tau * T + w.n * N);
}

CCL_NAMESPACE_END
