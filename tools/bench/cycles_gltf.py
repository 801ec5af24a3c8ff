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


def value_of_removed(tree, socket):
    """What drives an input, which gets 0 instead."""
    value = value_of(socket)
    for link in list(socket.links):
        tree.links.remove(link)
    socket.default_value = 0
    return value


# What each of these returns lies over the shader that it is given, or stands for it; None where all is well.


def dielectric(tree, node, source):
    """Lambert's below a reflecting surface that takes from it; Principled has Disney's diffuse, whole.

    Fresnel's law for the surface's normal is that of microfacets only where these are nearly smooth."""
    extensions, rough = source.get("extensions", {}), value_of(node.inputs["Roughness"])
    matt = extensions.get("KHR_materials_specular", {}).get("specularFactor", 1) == 0
    smooth = isinstance(rough, float) and rough < 0.15 and "KHR_materials_specular" not in extensions
    others = {"KHR_materials_sheen", "KHR_materials_transmission"} & set(extensions)
    if value_of(node.inputs["Metallic"]) != 0 or not (matt or smooth) or others:
        return None
    diffuse = tree.nodes.new("ShaderNodeBsdfDiffuse")
    copy_input(tree, node.inputs["Base Color"], diffuse.inputs["Color"])
    copy_input(tree, node.inputs["Normal"], diffuse.inputs["Normal"])
    result = diffuse.outputs[0]
    if not matt:
        share = fresnel(tree, node.inputs["IOR"].default_value, node.inputs["Normal"])
        result = mix_shaders(tree, share, result, glossy(tree, rough, node.inputs["Normal"]))
    if node.inputs["Emission"].links or max(node.inputs["Emission"].default_value[:3]) > 0:
        glow = tree.nodes.new("ShaderNodeEmission")
        copy_input(tree, node.inputs["Emission"], glow.inputs["Color"])
        copy_input(tree, node.inputs["Emission Strength"], glow.inputs["Strength"])
        result = add_shaders(tree, result, glow.outputs[0])
    if source.get("alphaMode", "OPAQUE") != "OPAQUE":
        clear = tree.nodes.new("ShaderNodeBsdfTransparent")
        result = mix_shaders(tree, value_of(node.inputs["Alpha"]), clear.outputs[0], result)
    return lambda _: result


def thin_pane(tree, node, source):
    """What transmits without a volume is an infinitely thin sheet: it bends nothing, and 2R/(1+R) is reflected by both
    its faces. What is rough stays as it is: Cycles has no sheet that scatters without bending."""
    extensions, rough = source.get("extensions", {}), value_of(node.inputs["Roughness"])
    metallic = value_of(node.inputs["Metallic"])
    if "KHR_materials_transmission" not in extensions or "KHR_materials_volume" in extensions:
        return None
    if metallic != 1 and not (isinstance(rough, float) and rough < 0.05):
        return None
    passing = math_node(tree, "MULTIPLY", value_of_removed(tree, node.inputs["Transmission"]),
                        math_node(tree, "SUBTRACT", 1.0, metallic))
    once = fresnel(tree, node.inputs["IOR"].default_value, node.inputs["Normal"])
    both = math_node(tree, "DIVIDE", math_node(tree, "MULTIPLY", once, 2.0), math_node(tree, "ADD", once, 1.0))
    through = tree.nodes.new("ShaderNodeBsdfTransparent")
    copy_input(tree, node.inputs["Base Color"], through.inputs["Color"])
    pane = mix_shaders(tree, both, through.outputs[0], glossy(tree, rough, node.inputs["Normal"]))
    return lambda base: mix_shaders(tree, passing, base, pane)


def coat(tree, node, source):
    """Of index 1.5: reflects by Fresnel and leaves the rest to the base; Principled's reflects a quarter of it and takes
    nothing away."""
    if "KHR_materials_clearcoat" not in source.get("extensions", {}):
        return None
    normal = node.inputs["Clearcoat Normal"]
    share = math_node(tree, "MULTIPLY", fresnel(tree, 1.5, normal), value_of_removed(tree, node.inputs["Clearcoat"]))
    varnish = glossy(tree, value_of(node.inputs["Clearcoat Roughness"]), normal)
    return lambda base: mix_shaders(tree, share, base, varnish)


def brushed_metal(tree, node, source):
    """The importer knows no anisotropy. Strength s makes the roughness squared along the turned tangent
    r^2 + (1 - r^2) s^2; the node's own parameters are their geometric mean and the root of their ratio."""
    anisotropy = source.get("extensions", {}).get("KHR_materials_anisotropy")
    if anisotropy is None:
        return None
    across = source["pbrMetallicRoughness"].get("roughnessFactor", 1) ** 2
    along = across + (1 - across) * anisotropy.get("anisotropyStrength", 0) ** 2
    brushed = tree.nodes.new("ShaderNodeBsdfAnisotropic")
    brushed.distribution = "MULTI_GGX"
    brushed.inputs["Color"].default_value = node.inputs["Base Color"].default_value
    brushed.inputs["Roughness"].default_value = (along * across) ** 0.25
    brushed.inputs["Anisotropy"].default_value = (across / along) ** 0.5 - 1
    brushed.inputs["Rotation"].default_value = anisotropy.get("anisotropyRotation", 0) / (2 * math.pi)
    tangent = tree.nodes.new("ShaderNodeTangent")
    tangent.direction_type = "UV_MAP"
    tree.links.new(tangent.outputs[0], brushed.inputs["Tangent"])
    return lambda _: brushed.outputs[0]


def make_conforming(tree, source):
    # The importer takes the number that its node for a coloured emissiveFactor puts out, and not the colour.
    for node in [n for n in tree.nodes if n.label == "Emissive Factor"]:
        for link in list(node.outputs[0].links):
            tree.links.new(node.outputs[2], link.to_socket)
    # Of what the older workflow's specular colour reflects nothing is left to the diffuse part.
    old = source.get("extensions", {}).get("KHR_materials_pbrSpecularGlossiness")
    for node in [n for n in tree.nodes if old is not None and n.type in ("BSDF_DIFFUSE", "BSDF_GLOSSY")]:
        if node.type == "BSDF_GLOSSY":
            node.distribution = "MULTI_GGX"
        else:
            left = 1 - max(old.get("specularFactor", [1, 1, 1]))
            node.inputs["Color"].default_value = [left * c for c in node.inputs["Color"].default_value[:3]] + [1]
    for node in [n for n in tree.nodes if n.type == "BSDF_PRINCIPLED"]:
        node.distribution = "MULTI_GGX"  # light that a rough surface reflects more than once is not lost
        if source.get("alphaMode") == "MASK":  # cuts and does not blend
            limit = source.get("alphaCutoff", 0.5) - 1e-6
            connect(tree, math_node(tree, "GREATER_THAN", value_of(node.inputs["Alpha"]), limit), node.inputs["Alpha"])
        result, targets = node.outputs["BSDF"], [link.to_socket for link in node.outputs["BSDF"].links]
        for layer in (dielectric, thin_pane, coat, brushed_metal):
            over = layer(tree, node, source)
            result = over(result) if over else result
        for target in targets:
            tree.links.new(result, target)


def make_all_conforming(path):
    described = {m.get("name"): m for m in gltf_materials(path)}
    for material in bpy.data.materials:
        if material.use_nodes and material.name in described and not material.name.startswith("lambert"):
            make_conforming(material.node_tree, described[material.name])
