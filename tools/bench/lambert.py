#!/usr/bin/env python3
"""Copies a .glb file with all its materials made Lambert's: no metal, no coat. Partner of `cycles.py --lambert`.

Usage: tools/bench/lambert.py IN.glb OUT.glb
What differs between two programs that render OUT.glb is then not a model of reflection.
"""
import json
import struct
import sys

if len(sys.argv) != 3:
    sys.exit(__doc__)
with open(sys.argv[1], "rb") as file:
    data = file.read()
magic, version, _, length, kind = struct.unpack_from("<4sIIII", data)
if magic != b"glTF" or version != 2 or kind != 0x4E4F534A:
    sys.exit(f"lambert: {sys.argv[1]}: is no .glb file of version 2")
scene = json.loads(data[20 : 20 + length])
for material in scene.get("materials", []):
    metallic_roughness = material.setdefault("pbrMetallicRoughness", {})
    metallic_roughness["metallicFactor"] = 0
    material["extensions"] = {k: v for k, v in material.get("extensions", {}).items() if k == "KHR_materials_emissive_strength"}
    material["extensions"]["KHR_materials_specular"] = {"specularFactor": 0}
scene["extensionsUsed"] = sorted({*scene.get("extensionsUsed", []), "KHR_materials_specular"})
text = json.dumps(scene).encode()
text += b" " * (-len(text) % 4)
rest = data[20 + length :]
with open(sys.argv[2], "wb") as file:
    file.write(struct.pack("<4sIIII", b"glTF", 2, 20 + len(text) + len(rest), len(text), 0x4E4F534A) + text + rest)
