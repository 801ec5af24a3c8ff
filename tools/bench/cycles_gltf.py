"""Materials in Blender as the glTF 2.0 specification has them, where Blender 3.4's importer makes something else of them.

For cycles.py --conform: what remains of a difference to Cycles then is not the importer's. Each change says its reason.
"""
import json
import math
import struct

import bpy


def gltf_materials(path):
    """As the file has them."""
    with open(path, "rb") as file:
        data = file.read()
    if data[:4] == b"glTF":
        data = data[20 : 20 + struct.unpack("<I", data[12:16])[0]]
    return json.loads(data).get("materials", [])


def connect(tree, source, target):
    if isinstance(source, (int, float)):
        target.default_value = source
    else:
        tree.links.new(source, target)


def math_node(tree, operation, a, b):
    node = tree.nodes.new("ShaderNodeMath")
    node.operation = operation
    connect(tree, a, node.inputs[0])
    connect(tree, b, node.inputs[1])
    return node.outputs[0]


def value_of(socket):
    """What drives an input: another's output, or its number."""
    return socket.links[0].from_socket if socket.links else socket.default_value


def copy_input(tree, source, target):
    target.default_value = source.default_value
    if source.links:
        tree.links.new(source.links[0].from_socket, target)


def fresnel(tree, ior, normal):
    """Reflectance from outside on both sides: the node's own turns the ratio around at the back."""
    node = tree.nodes.new("ShaderNodeFresnel")
    back = tree.nodes.new("ShaderNodeNewGeometry").outputs["Backfacing"]
    connect(tree, math_node(tree, "POWER", ior, math_node(tree, "SUBTRACT", 1.0, math_node(tree, "MULTIPLY", back, 2.0))),
            node.inputs["IOR"])
    copy_input(tree, normal, node.inputs["Normal"])
    return node.outputs[0]


def mix_shaders(tree, share, first, second):
    node = tree.nodes.new("ShaderNodeMixShader")
    connect(tree, share, node.inputs[0])
    tree.links.new(first, node.inputs[1])
    tree.links.new(second, node.inputs[2])
    return node.outputs[0]


def add_shaders(tree, first, second):
    node = tree.nodes.new("ShaderNodeAddShader")
    tree.links.new(first, node.inputs[0])
    tree.links.new(second, node.inputs[1])
    return node.outputs[0]


def glossy(tree, roughness, normal):
    """White GGX that loses nothing."""
    node = tree.nodes.new("ShaderNodeBsdfGlossy")
    node.distribution = "MULTI_GGX"
    node.inputs["Color"].default_value = (1, 1, 1, 1)
    connect(tree, roughness, node.inputs["Roughness"])
    copy_input(tree, normal, node.inputs["Normal"])
    return node.outputs[0]


def make_conforming(material, source):
    """What changes, and why, from the importer's Principled BSDF to the glTF specification's material."""
    tree = material.node_tree
    # The importer takes the number that its node for a coloured emissiveFactor puts out, and not the colour.
    for node in [n for n in tree.nodes if n.label == "Emissive Factor"]:
        for link in list(node.outputs[0].links):
            tree.links.new(node.outputs[2], link.to_socket)
    extensions = source.get("extensions", {})
    # Of what the older workflow's specular colour reflects nothing is left to the diffuse part.
    old = extensions.get("KHR_materials_pbrSpecularGlossiness")
    for node in [n for n in tree.nodes if old is not None and n.type in ("BSDF_DIFFUSE", "BSDF_GLOSSY")]:
        if node.type == "BSDF_GLOSSY":
            node.distribution = "MULTI_GGX"
        else:
            left = 1 - max(old.get("specularFactor", [1, 1, 1]))
            node.inputs["Color"].default_value = [left * c for c in node.inputs["Color"].default_value[:3]] + [1]
    for node in [n for n in tree.nodes if n.type == "BSDF_PRINCIPLED"]:
        made = []
        metallic = value_of(node.inputs["Metallic"])
        # A dielectric is Lambert's below a reflecting surface that takes from it; Principled has Disney's diffuse, whole.
        if metallic == 0 and source.get("alphaMode", "OPAQUE") == "OPAQUE" and not (
                {"KHR_materials_specular", "KHR_materials_sheen", "KHR_materials_transmission"} & set(extensions)):
            matt = tree.nodes.new("ShaderNodeBsdfDiffuse")
            copy_input(tree, node.inputs["Base Color"], matt.inputs["Color"])
            copy_input(tree, node.inputs["Normal"], matt.inputs["Normal"])
            share = fresnel(tree, node.inputs["IOR"].default_value, node.inputs["Normal"])
            lobe = glossy(tree, value_of(node.inputs["Roughness"]), node.inputs["Normal"])
            made.append(lambda base, matt=matt, lobe=lobe, share=share: mix_shaders(tree, share, matt.outputs[0], lobe))
            if node.inputs["Emission"].links or max(node.inputs["Emission"].default_value[:3]) > 0:
                glow = tree.nodes.new("ShaderNodeEmission")
                copy_input(tree, node.inputs["Emission"], glow.inputs["Color"])
                copy_input(tree, node.inputs["Emission Strength"], glow.inputs["Strength"])
                made.append(lambda base, glow=glow: add_shaders(tree, base, glow.outputs[0]))
        # Light that a rough surface reflects more than once is not lost.
        node.distribution = "MULTI_GGX"
        # A mask cuts, it does not blend.
        if source.get("alphaMode") == "MASK":
            connect(tree, math_node(tree, "GREATER_THAN", value_of(node.inputs["Alpha"]), source.get("alphaCutoff", 0.5) - 1e-6),
                    node.inputs["Alpha"])
        # What transmits without a volume is an infinitely thin sheet: it bends nothing. Of both its faces 2R/(1+R) is
        # reflected.
        # What is rough and transmits stays as it is: Cycles has no sheet that scatters without bending.
        rough = value_of(node.inputs["Roughness"])
        if extensions.get("KHR_materials_transmission") and not extensions.get("KHR_materials_volume") and (
                metallic == 1 or isinstance(rough, float) and rough < 0.05):
            share = value_of(node.inputs["Transmission"])
            node.inputs["Transmission"].default_value = 0
            for link in list(node.inputs["Transmission"].links):
                tree.links.remove(link)
            share = math_node(tree, "MULTIPLY", share, math_node(tree, "SUBTRACT", 1.0, metallic))
            once = fresnel(tree, node.inputs["IOR"].default_value, node.inputs["Normal"])
            both = math_node(tree, "DIVIDE", math_node(tree, "MULTIPLY", once, 2.0), math_node(tree, "ADD", once, 1.0))
            through = tree.nodes.new("ShaderNodeBsdfTransparent")
            copy_input(tree, node.inputs["Base Color"], through.inputs["Color"])
            pane = mix_shaders(tree, both, through.outputs[0],
                               glossy(tree, value_of(node.inputs["Roughness"]), node.inputs["Normal"]))
            made.append(lambda base, pane=pane, share=share: mix_shaders(tree, share, base, pane))
        # A coat of index 1.5 reflects by Fresnel and leaves the rest to the base; Principled's reflects a quarter of it
        # and takes nothing away.
        coat = extensions.get("KHR_materials_clearcoat")
        if coat:
            share = math_node(tree, "MULTIPLY", fresnel(tree, 1.5, node.inputs["Clearcoat Normal"]),
                              value_of(node.inputs["Clearcoat"]))
            lobe = glossy(tree, value_of(node.inputs["Clearcoat Roughness"]), node.inputs["Clearcoat Normal"])
            node.inputs["Clearcoat"].default_value = 0
            for link in list(node.inputs["Clearcoat"].links):
                tree.links.remove(link)
            made.append(lambda base, share=share, lobe=lobe: mix_shaders(tree, share, base, lobe))
        # The importer knows no anisotropy. Strength s makes the roughness squared along the turned tangent
        # r^2 + (1 - r^2) s^2; the node's own parameters are their geometric mean and the root of their ratio.
        aniso = extensions.get("KHR_materials_anisotropy")
        if aniso:
            across = source["pbrMetallicRoughness"].get("roughnessFactor", 1) ** 2
            along = across + (1 - across) * aniso.get("anisotropyStrength", 0) ** 2
            lobe = tree.nodes.new("ShaderNodeBsdfAnisotropic")
            lobe.distribution = "MULTI_GGX"
            lobe.inputs["Color"].default_value = node.inputs["Base Color"].default_value
            lobe.inputs["Roughness"].default_value = (along * across) ** 0.25
            lobe.inputs["Anisotropy"].default_value = (across / along) ** 0.5 - 1
            lobe.inputs["Rotation"].default_value = aniso.get("anisotropyRotation", 0) / (2 * math.pi)
            tangent = tree.nodes.new("ShaderNodeTangent")
            tangent.direction_type = "UV_MAP"
            tree.links.new(tangent.outputs[0], lobe.inputs["Tangent"])
            made.append(lambda base, lobe=lobe: lobe.outputs[0])
        result, targets = node.outputs["BSDF"], [link.to_socket for link in node.outputs["BSDF"].links]
        for layer in made:
            result = layer(result)
        for target in targets:
            tree.links.new(result, target)


def make_all_conforming(path):
    described = {m.get("name"): m for m in gltf_materials(path)}
    for material in bpy.data.materials:
        if material.use_nodes and material.name in described and not material.name.startswith("lambert"):
            make_conforming(material, described[material.name])
