/* SPDX-License-Identifier: Apache-2.0 */

#include "scene/ic_wafer_node.h"

#include "kernel/icwafer/cs348b.h"
#include "kernel/icwafer/material_tables.h"
#include "scene/shader.h"
#include "scene/svm.h"

#include "util/thread.h"

CCL_NAMESPACE_BEGIN

NODE_DEFINE(ICWaferBsdfNode)
{
  NodeType *type = NodeType::add("ic_wafer_bsdf", create, NodeType::SHADER);

  SOCKET_IN_COLOR(color, "Color", one_float3());
  SOCKET_IN_NORMAL(normal, "Normal", zero_float3(), SocketType::LINK_NORMAL);
  SOCKET_IN_FLOAT(surface_mix_weight, "SurfaceMixWeight", 0.0f, SocketType::SVM_INTERNAL);

#define ICWAFER_SOCKET(identifier, name, initial, ...) SOCKET_IN_FLOAT(identifier, name, initial);
  ICWAFER_NODE_FLOATS(ICWAFER_SOCKET)
#undef ICWAFER_SOCKET
  SOCKET_IN_VECTOR(metal_n, "Metal n", make_float3(0.27f, 0.68f, 1.3f));
  SOCKET_IN_VECTOR(metal_k, "Metal k", make_float3(3.4f, 2.62f, 2.4f));
  SOCKET_IN_VECTOR(tangent, "Tangent", zero_float3());

  static NodeEnum model_enum;
  model_enum.insert("CS348B", IC_WAFER_CS348B);
  model_enum.insert("PHYSICAL", IC_WAFER_PHYSICAL);
  SOCKET_ENUM(model, "Model", model_enum, IC_WAFER_PHYSICAL);

  static NodeEnum metal_enum;
  metal_enum.insert("COPPER", icwafer::metal_copper);
  metal_enum.insert("ALUMINIUM", icwafer::metal_aluminium);
  metal_enum.insert("TUNGSTEN", icwafer::metal_tungsten);
  metal_enum.insert("SILICON", icwafer::metal_silicon);
  metal_enum.insert("CUSTOM", icwafer::metal_custom);
  SOCKET_ENUM(metal, "Metal", metal_enum, icwafer::metal_copper);

  static NodeEnum oxide_enum;
  oxide_enum.insert("SIO2", icwafer::oxide_sio2);
  oxide_enum.insert("SI3N4", icwafer::oxide_si3n4);
  oxide_enum.insert("CUSTOM", icwafer::oxide_custom);
  SOCKET_ENUM(oxide, "Oxide", oxide_enum, icwafer::oxide_sio2);

  static NodeEnum illuminant_enum;
  illuminant_enum.insert("EQUAL_ENERGY", icwafer::illuminant_equal_energy);
  illuminant_enum.insert("D65", icwafer::illuminant_d65);
  illuminant_enum.insert("A", icwafer::illuminant_a);
  illuminant_enum.insert("F2", icwafer::illuminant_f2);
  illuminant_enum.insert("F11", icwafer::illuminant_f11);
  illuminant_enum.insert("WHITE_LED", icwafer::illuminant_white_led);
  illuminant_enum.insert("SODIUM", icwafer::illuminant_sodium);
  SOCKET_ENUM(illuminant, "Illuminant", illuminant_enum, icwafer::illuminant_equal_energy);

  SOCKET_BOOLEAN(use_wire_diffraction, "Use Wire Diffraction", true);
  SOCKET_BOOLEAN(use_grating, "Use Grating", true);
  SOCKET_BOOLEAN(use_thin_film, "Use Thin Film", true);

  SOCKET_OUT_CLOSURE(BSDF, "BSDF");

  return type;
}

ICWaferBsdfNode::ICWaferBsdfNode() : BsdfNode(get_node_type())
{
  /* Either closure; ShaderGraph::get_num_closures asks. */
  closure = CLOSURE_BSDF_IC_WAFER_ID;
}

void ICWaferBsdfNode::compile(SVMCompiler &compiler)
{
  if (model == IC_WAFER_PHYSICAL) {
    compile_physical(compiler);
  }
  else {
    compile_cs348b(compiler);
  }
}

/* The three nodes that svm_node_ic_wafer reads. */
void ICWaferBsdfNode::compile_closure(SVMCompiler &compiler,
                                      const ClosureType type,
                                      const uint inputs,
                                      const uint more_inputs,
                                      const int4 extra)
{
  ShaderInput *color_in = input("Color");
  if (color_in->link) {
    compiler.add_node(NODE_CLOSURE_WEIGHT, compiler.stack_assign(color_in));
  }
  else {
    compiler.add_node(NODE_CLOSURE_SET_WEIGHT, color);
  }
  const int normal_offset = compiler.stack_assign_if_linked(input("Normal"));
  const int tangent_offset = compiler.stack_assign_if_linked(input("Tangent"));
  compiler.add_node(NODE_CLOSURE_BSDF,
                    compiler.encode_uchar4(type,
                                           compiler.stack_assign(input("Wire Spacing")),
                                           compiler.stack_assign(input("Wire Width")),
                                           compiler.closure_mix_weight_offset()),
                    __float_as_int(wire_spacing),
                    __float_as_int(wire_width));
  compiler.add_node(normal_offset, tangent_offset, inputs, more_inputs);
  compiler.add_node(extra.x, extra.y, extra.z, extra.w);
}

void ICWaferBsdfNode::compile_cs348b(SVMCompiler &compiler)
{
  const auto offset = [&](const char *name) { return compiler.stack_assign(input(name)); };
  const int effects = (use_wire_diffraction ? icwafer::cs348b_wire_diffraction : 0) |
                      (use_grating ? icwafer::cs348b_grating : 0) |
                      (use_thin_film ? icwafer::cs348b_thin_film : 0);
  compile_closure(compiler,
                  CLOSURE_BSDF_IC_WAFER_ID,
                  compiler.encode_uchar4(offset("Oxide Thickness"),
                                         offset("Oxide IOR"),
                                         offset("Direction"),
                                         offset("Diffraction")),
                  compiler.encode_uchar4(offset("Specular"),
                                         offset("Specular Roughness"),
                                         offset("Diffuse"),
                                         offset("Lobe Width")),
                  make_int4(offset("Anisotropy"), effects, SVM_STACK_INVALID, SVM_STACK_INVALID));
}

void ICWaferBsdfNode::compile_physical(SVMCompiler &compiler)
{
  const auto offset = [&](const char *name) { return compiler.stack_assign(input(name)); };
  compile_closure(compiler,
                  CLOSURE_BSDF_IC_WAFER_PHYSICAL_ID,
                  compiler.encode_uchar4(offset("Oxide Thickness"),
                                         offset("Oxide IOR"),
                                         offset("Direction"),
                                         offset("Groove Depth")),
                  compiler.encode_uchar4(offset("Cross Spacing"),
                                         offset("Cross Width"),
                                         offset("Spacing Variation"),
                                         offset("Coherence Width")),
                  make_int4(compiler.encode_uchar4(offset("Roughness"), offset("Wire Length")),
                            compiler.encode_uchar4(metal, oxide, illuminant),
                            offset("Metal n"),
                            offset("Metal k")));
}

void ICWaferBsdfNode::compile(OSLCompiler & /*compiler*/)
{
  /* Closures of OSL are a fixed list in the host; materials with this node need SVM. */
}

bool has_ic_wafer(const vector<Shader *> &shaders)
{
  const NodeType *const type = ICWaferBsdfNode::get_node_type();
  for (const Shader *shader : shaders) {
    if (shader->graph) {
      for (const ShaderNode *node : shader->graph->nodes) {
        if (node->type == type) {
          return true;
        }
      }
    }
  }
  return false;
}

vector<float> ic_wafer_tables(const float3 xyz_to_r, const float3 xyz_to_g, const float3 xyz_to_b)
{
  /* Kept, because a viewport asks at each change of any shader. */
  static thread_mutex mutex;
  static icwafer::XyzToRgb kept_for;
  static std::vector<float> kept;

  const icwafer::XyzToRgb matrix = {{{xyz_to_r.x, xyz_to_r.y, xyz_to_r.z},
                                     {xyz_to_g.x, xyz_to_g.y, xyz_to_g.z},
                                     {xyz_to_b.x, xyz_to_b.y, xyz_to_b.z}}};
  thread_scoped_lock lock(mutex);
  if (kept.empty() || kept_for != matrix) {
    kept = icwafer::material_tables(matrix);
    kept_for = matrix;
  }
  return vector<float>(kept.begin(), kept.end());
}

CCL_NAMESPACE_END
