/* SPDX-License-Identifier: Apache-2.0 */

/* The node IC Wafer BSDF in the shader virtual machine: reads its inputs and sets up closures. For
 * the model PHYSICAL one; for CS348B three: diffraction, mirror reflection, diffuse reflection. */

#pragma once

#include "kernel/closure/bsdf_ic_wafer.h"
#include "kernel/closure/bsdf_ic_wafer_physical.h"

CCL_NAMESPACE_BEGIN

/* The wires' direction; `tangent_offset` is SVM_STACK_INVALID for the object's X axis. */
ccl_device_inline float3 svm_ic_wafer_tangent(KernelGlobals kg,
                                              ccl_private ShaderData *sd,
                                              ccl_private float *stack,
                                              const uint tangent_offset,
                                              const uint direction_offset,
                                              const float3 N)
{
  float3 tangent;
  if (stack_valid(tangent_offset)) {
    tangent = stack_load_float3(stack, tangent_offset);
  }
  else {
    tangent = make_float3(1.0f, 0.0f, 0.0f);
    object_dir_transform(kg, sd, &tangent);
  }
  return ic_wafer_tangent(N, tangent, stack_load_float(stack, direction_offset));
}

/* `node` and `data_node` are those of every BSDF; `extra_node` is the third.
 *   node.z, node.w   values of Wire Spacing and Wire Width where they are not on the stack
 *   data_node.y      tangent, SVM_STACK_INVALID for the object's X axis
 *   data_node.z      Oxide Thickness, Oxide IOR, Direction, Diffraction
 *   data_node.w      Specular, Specular Roughness, Diffuse, Lobe Width
 *   extra_node.x     Anisotropy
 *   extra_node.y     effects */
ccl_device void svm_node_ic_wafer_cs348b(KernelGlobals kg,
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
      bsdf->N = N;
      bsdf->T = svm_ic_wafer_tangent(kg, sd, stack, data_node.y, direction_offset, N);
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

/* As above, but for
 *   data_node.z      Oxide Thickness, Oxide IOR, Direction, Groove Depth
 *   data_node.w      Cross Spacing, Cross Width, Spacing Variation, Coherence Width
 *   extra_node.x     Roughness, Wire Length
 *   extra_node.y     metal, oxide, illuminant: one byte each
 *   extra_node.z, w  Metal n, Metal k */
ccl_device void svm_node_ic_wafer_physical(KernelGlobals kg,
                                           ccl_private ShaderData *sd,
                                           ccl_private float *stack,
                                           const uint4 data_node,
                                           const uint4 extra_node,
                                           const float spacing_nm,
                                           const float width_nm,
                                           const float3 N,
                                           const float mix_weight)
{
  uint oxide_thickness_offset, oxide_ior_offset, direction_offset, groove_offset;
  uint cross_spacing_offset, cross_width_offset, variation_offset, coherence_offset;
  uint roughness_offset, length_offset, metal, oxide, illuminant, unused;
  svm_unpack_node_uchar4(
      data_node.z, &oxide_thickness_offset, &oxide_ior_offset, &direction_offset, &groove_offset);
  svm_unpack_node_uchar4(data_node.w,
                         &cross_spacing_offset,
                         &cross_width_offset,
                         &variation_offset,
                         &coherence_offset);
  svm_unpack_node_uchar2(extra_node.x, &roughness_offset, &length_offset);
  svm_unpack_node_uchar4(extra_node.y, &metal, &oxide, &illuminant, &unused);

  ccl_private IcWaferPhysicalBsdf *bsdf = (ccl_private IcWaferPhysicalBsdf *)bsdf_alloc(
      sd, sizeof(IcWaferPhysicalBsdf), sd->svm_closure_weight * mix_weight);
  ccl_private IcWaferPhysicalExtra *extra = bsdf ? (ccl_private IcWaferPhysicalExtra *)
                                                       closure_alloc_extra(
                                                           sd, sizeof(IcWaferPhysicalExtra)) :
                                                   NULL;
  if (!bsdf || !extra) {
    return;
  }
  bsdf->N = N;
  bsdf->T = svm_ic_wafer_tangent(kg, sd, stack, data_node.y, direction_offset, N);
  bsdf->extra = extra;
  extra->params = icwafer::physical_params(
      icwafer::physical_lattice(spacing_nm, width_nm, stack_load_float(stack, coherence_offset)),
      icwafer::physical_lattice(stack_load_float(stack, cross_spacing_offset),
                                stack_load_float(stack, cross_width_offset),
                                stack_load_float(stack, length_offset)),
      stack_load_float(stack, oxide_thickness_offset),
      stack_load_float(stack, groove_offset),
      stack_load_float(stack, roughness_offset),
      stack_load_float(stack, variation_offset),
      icwafer::Oxide(oxide),
      stack_load_float(stack, oxide_ior_offset),
      icwafer::Metal(metal),
      icwafer::Illuminant(illuminant));
  if (metal == icwafer::metal_custom) {
    const float3 n = stack_load_float3(stack, extra_node.z);
    const float3 k = stack_load_float3(stack, extra_node.w);
    icwafer::physical_set_custom_metal(extra->params, n.x, n.y, n.z, k.x, k.y, k.z);
  }
  sd->flag |= bsdf_ic_wafer_physical_setup(kg, bsdf, sd->I);
}

ccl_device void svm_node_ic_wafer(KernelGlobals kg,
                                  ccl_private ShaderData *sd,
                                  ccl_private float *stack,
                                  const uint type,
                                  const uint4 data_node,
                                  const uint4 extra_node,
                                  const float spacing_nm,
                                  const float width_nm,
                                  const float3 N,
                                  const float mix_weight,
                                  const uint32_t path_flag)
{
  if (type == CLOSURE_BSDF_IC_WAFER_ID) {
    svm_node_ic_wafer_cs348b(
        kg, sd, stack, data_node, extra_node, spacing_nm, width_nm, N, mix_weight, path_flag);
    return;
  }
#ifdef __CAUSTICS_TRICKS__
  if (!kernel_data.integrator.caustics_reflective && (path_flag & PATH_RAY_DIFFUSE)) {
    return;
  }
#endif
  svm_node_ic_wafer_physical(
      kg, sd, stack, data_node, extra_node, spacing_nm, width_nm, N, mix_weight);
}

CCL_NAMESPACE_END
