#!/usr/bin/env python3
"""Copies a .glb file with all its materials made Lambert's: no metal, no coat. Partner of `cycles.py --lambert`.

Usage: tools/bench/lambert.py IN.glb OUT.glb [--grey]
What differs between two programs that render OUT.glb is then not a model of reflection. --grey: all of albedo 0.5,
opaque and without textures or glow, so that what remains of a program's work is tracing rays.
"""
import sys

from glb import read_glb, write_glb

EMISSIVE = "KHR_materials_emissive_strength"


def make_lambert(material):
    metallic_roughness = material.setdefault("pbrMetallicRoughness", {})
    metallic_roughness["metallicFactor"] = 0
    material["extensions"] = {k: v for k, v in material.get("extensions", {}).items() if k == EMISSIVE}
    material["extensions"]["KHR_materials_specular"] = {"specularFactor": 0}


def grey_material():
    return {"pbrMetallicRoughness": {"baseColorFactor": [0.5, 0.5, 0.5, 1], "metallicFactor": 0}, "doubleSided": True,
            "extensions": {"KHR_materials_specular": {"specularFactor": 0}}}


def make_grey(scene):
    """Pictures stay in the file, but nothing uses them."""
    scene["materials"] = [grey_material()]
    for mesh in scene.get("meshes", []):
        for primitive in mesh["primitives"]:
            primitive["material"] = 0
            primitive["attributes"].pop("COLOR_0", None)
            primitive.get("extensions", {}).pop("KHR_materials_variants", None)


def main():
    grey = "--grey" in sys.argv
    paths = [a for a in sys.argv[1:] if a != "--grey"]
    if len(paths) != 2:
        sys.exit(__doc__)
    scene, binary = read_glb(paths[0])
    if grey:
        make_grey(scene)
    for material in scene.get("materials", []):
        make_lambert(material)
    scene["extensionsUsed"] = sorted({*scene.get("extensionsUsed", []), "KHR_materials_specular"})
    write_glb(paths[1], scene, binary)


main()
