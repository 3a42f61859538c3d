/* SPDX-License-Identifier: Apache-2.0 */

#include "scene/ic_wafer_node.h"

#include "kernel/icwafer/colour_table.h"
#include "kernel/icwafer/cs348b.h"
#include "scene/svm.h"

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
  SOCKET_IN_VECTOR(tangent, "Tangent", zero_float3());

  static NodeEnum model_enum;
  model_enum.insert("CS348B", IC_WAFER_CS348B);
  SOCKET_ENUM(model, "Model", model_enum, IC_WAFER_CS348B);
  SOCKET_BOOLEAN(use_wire_diffraction, "Use Wire Diffraction", true);
  SOCKET_BOOLEAN(use_grating, "Use Grating", true);
  SOCKET_BOOLEAN(use_thin_film, "Use Thin Film", true);

  SOCKET_OUT_CLOSURE(BSDF, "BSDF");

  return type;
}

ICWaferBsdfNode::ICWaferBsdfNode() : BsdfNode(get_node_type())
{
  closure = CLOSURE_BSDF_IC_WAFER_ID;
}

void ICWaferBsdfNode::compile(SVMCompiler &compiler)
{
  const auto offset = [&](const char *name) { return compiler.stack_assign(input(name)); };

  ShaderInput *color_in = input("Color");
  if (color_in->link) {
    compiler.add_node(NODE_CLOSURE_WEIGHT, compiler.stack_assign(color_in));
  }
  else {
    compiler.add_node(NODE_CLOSURE_SET_WEIGHT, color);
  }

  const int normal_offset = compiler.stack_assign_if_linked(input("Normal"));
  const int tangent_offset = compiler.stack_assign_if_linked(input("Tangent"));
  const int spacing_offset = offset("Wire Spacing");
  const int width_offset = offset("Wire Width");
  const uint film_offsets = compiler.encode_uchar4(
      offset("Oxide Thickness"), offset("Oxide IOR"), offset("Direction"), offset("Diffraction"));
  const uint lobe_offsets = compiler.encode_uchar4(
      offset("Specular"), offset("Specular Roughness"), offset("Diffuse"), offset("Lobe Width"));
  const int anisotropy_offset = offset("Anisotropy");
  const int effects = (use_wire_diffraction ? icwafer::cs348b_wire_diffraction : 0) |
                      (use_grating ? icwafer::cs348b_grating : 0) |
                      (use_thin_film ? icwafer::cs348b_thin_film : 0);

  compiler.add_node(
      NODE_CLOSURE_BSDF,
      compiler.encode_uchar4(
          closure, spacing_offset, width_offset, compiler.closure_mix_weight_offset()),
      __float_as_int(wire_spacing),
      __float_as_int(wire_width));
  compiler.add_node(normal_offset, tangent_offset, film_offsets, lobe_offsets);
  compiler.add_node(anisotropy_offset, effects, SVM_STACK_INVALID, SVM_STACK_INVALID);
}

void ICWaferBsdfNode::compile(OSLCompiler & /*compiler*/)
{
  /* Closures of OSL are a fixed list in the host; materials with this node need SVM. */
}

vector<float> ic_wafer_sensitivities(const float3 xyz_to_r,
                                     const float3 xyz_to_g,
                                     const float3 xyz_to_b)
{
  const icwafer::ColourTable table = icwafer::colour_table(
      {{{xyz_to_r.x, xyz_to_r.y, xyz_to_r.z},
        {xyz_to_g.x, xyz_to_g.y, xyz_to_g.z},
        {xyz_to_b.x, xyz_to_b.y, xyz_to_b.z}}});
  vector<float> flat;
  for (const auto &rgb : table) {
    for (const double channel : rgb) {
      flat.push_back(float(channel));
    }
  }
  return flat;
}

CCL_NAMESPACE_END
