/* SPDX-License-Identifier: Apache-2.0 */

/* The node IC Wafer BSDF in the shader virtual machine: reads its inputs and sets up three
 * closures, diffraction, mirror reflection and diffuse reflection. */

#pragma once

#include "kernel/closure/bsdf_ic_wafer.h"

CCL_NAMESPACE_BEGIN

/* `node` and `data_node` are those of every BSDF; `extra_node` is the third.
 *   node.z, node.w   values of Wire Spacing and Wire Width where they are not on the stack
 *   data_node.y      tangent, SVM_STACK_INVALID for the object's X axis
 *   data_node.z      Oxide Thickness, Oxide IOR, Direction, Diffraction
 *   data_node.w      Specular, Specular Roughness, Diffuse, Lobe Width
 *   extra_node.x     Anisotropy
 *   extra_node.y     effects */
ccl_device void svm_node_ic_wafer(KernelGlobals kg,
                                  ccl_private ShaderData *sd,
                                  ccl_private float *stack,
                                  const uint4 data_node,
                                  const uint4 extra_node,
                                  const float spacing_nm,
                                  const float width_nm,
                                  const float3 N,
                                  const float mix_weight,
                                  const uint32_t path_flag)
{
  uint oxide_thickness_offset, oxide_ior_offset, direction_offset, diffraction_offset;
  uint specular_offset, specular_roughness_offset, diffuse_offset, lobe_width_offset;
  svm_unpack_node_uchar4(data_node.z,
                         &oxide_thickness_offset,
                         &oxide_ior_offset,
                         &direction_offset,
                         &diffraction_offset);
  svm_unpack_node_uchar4(data_node.w,
                         &specular_offset,
                         &specular_roughness_offset,
                         &diffuse_offset,
                         &lobe_width_offset);

  const Spectrum weight = sd->svm_closure_weight * mix_weight;

  const float diffuse = saturatef(stack_load_float(stack, diffuse_offset));
  if (diffuse > CLOSURE_WEIGHT_CUTOFF) {
    ccl_private DiffuseBsdf *bsdf = (ccl_private DiffuseBsdf *)bsdf_alloc(
        sd, sizeof(DiffuseBsdf), weight * diffuse);
    if (bsdf) {
      bsdf->N = N;
      sd->flag |= bsdf_diffuse_setup(bsdf);
    }
  }

#ifdef __CAUSTICS_TRICKS__
  if (!kernel_data.integrator.caustics_reflective && (path_flag & PATH_RAY_DIFFUSE)) {
    return;
  }
#endif

  const float specular = saturatef(stack_load_float(stack, specular_offset));
  if (specular > CLOSURE_WEIGHT_CUTOFF) {
    ccl_private MicrofacetBsdf *bsdf = (ccl_private MicrofacetBsdf *)bsdf_alloc(
        sd, sizeof(MicrofacetBsdf), weight * specular);
    if (bsdf) {
      const float alpha = sqr(saturatef(stack_load_float(stack, specular_roughness_offset)));
      bsdf->N = N;
      bsdf->T = zero_float3();
      bsdf->ior = 1.0f;
      bsdf->alpha_x = alpha;
      bsdf->alpha_y = alpha;
      bsdf->extra = NULL;
      sd->flag |= bsdf_microfacet_ggx_setup(bsdf);
    }
  }

  const float diffraction = saturatef(stack_load_float(stack, diffraction_offset));
  if (diffraction > CLOSURE_WEIGHT_CUTOFF) {
    ccl_private IcWaferBsdf *bsdf = (ccl_private IcWaferBsdf *)bsdf_alloc(
        sd, sizeof(IcWaferBsdf), weight * diffraction);
    ccl_private IcWaferExtra *extra = bsdf ? (ccl_private IcWaferExtra *)closure_alloc_extra(
                                                 sd, sizeof(IcWaferExtra)) :
                                             NULL;
    if (bsdf && extra) {
      float3 tangent;
      if (stack_valid(data_node.y)) {
        tangent = stack_load_float3(stack, data_node.y);
      }
      else {
        tangent = make_float3(1.0f, 0.0f, 0.0f);
        object_dir_transform(kg, sd, &tangent);
      }
      bsdf->N = N;
      bsdf->T = bsdf_ic_wafer_tangent(N, tangent, stack_load_float(stack, direction_offset));
      bsdf->extra = extra;
      extra->params = icwafer::cs348b_params(spacing_nm,
                                             width_nm,
                                             stack_load_float(stack, oxide_thickness_offset),
                                             stack_load_float(stack, oxide_ior_offset),
                                             stack_load_float(stack, lobe_width_offset),
                                             stack_load_float(stack, extra_node.x),
                                             int(extra_node.y));
      sd->flag |= bsdf_ic_wafer_setup(bsdf, sd->I);
    }
  }
}

CCL_NAMESPACE_END
