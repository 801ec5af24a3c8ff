#!/usr/bin/env python3
"""Copies the .glb file of a street with lamps hung over it in two rows.

Usage: tools/bench/lamps.py IN.glb OUT.glb COUNT
The street lies along -Z as in KayKit's street: lamps are 4.5 m high and 4 m left and right, from z = 3 to -76 m. Each is an
icosahedron that glows with 300 cd/m2 (times its colour). 60 of them have a radius of 0.12 m; more are so much smaller
that together they shine as much, so that what differs is their number alone.
"""
import math
import struct
import sys

from glb import read_glb, write_glb

GOLDEN = (1 + math.sqrt(5)) / 2
CORNERS = [(s, t * GOLDEN, 0) for s in (-1, 1) for t in (-1, 1)] + [(0, s, t * GOLDEN) for s in (-1, 1) for t in (-1, 1)] + \
          [(t * GOLDEN, 0, s) for s in (-1, 1) for t in (-1, 1)]
RADIUS_OF_60 = 0.12  # metres


def triangles():
    """Of the icosahedron, counter-clockwise from outside: corners that are 2 apart, which its edges are long."""
    near = lambda a, b: abs(math.dist(CORNERS[a], CORNERS[b]) - 2) < 1e-6
    found = []
    for a in range(12):
        for b in range(a + 1, 12):
            for c in range(b + 1, 12):
                if near(a, b) and near(b, c) and near(a, c):
                    p, q, r = CORNERS[a], CORNERS[b], CORNERS[c]
                    u, v = [y - x for x, y in zip(p, q)], [y - x for x, y in zip(p, r)]
                    n = (u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0])
                    found.append((a, b, c) if sum(x * y for x, y in zip(n, p)) > 0 else (a, c, b))
    return found


def places(count):
    """Left and right in turn, evenly along the street."""
    steps = max((count - 1) // 2, 1)
    return [[4.0 if i % 2 == 0 else -4.0, 4.5, 3 - 79 * (i // 2) / steps] for i in range(count)]


def add_accessor(scene, binary, data, entry):
    binary.extend(b"\0" * (-len(binary) % 4))
    scene.setdefault("bufferViews", []).append({"buffer": 0, "byteOffset": len(binary), "byteLength": len(data)})
    binary.extend(data)
    scene.setdefault("accessors", []).append(dict(entry, bufferView=len(scene["bufferViews"]) - 1))
    return len(scene["accessors"]) - 1


def add_lamps(scene, binary, count):
    radius = RADIUS_OF_60 * math.sqrt(60 / count)
    size = radius / math.hypot(1, GOLDEN)
    corners = [[c * size for c in corner] for corner in CORNERS]
    faces = triangles()
    position = add_accessor(scene, binary, struct.pack("<36f", *[c for p in corners for c in p]),
                            {"componentType": 5126, "type": "VEC3", "count": 12, "min": [min(c) for c in zip(*corners)],
                             "max": [max(c) for c in zip(*corners)]})
    indices = add_accessor(scene, binary, struct.pack("<60H", *[i for t in faces for i in t]),
                           {"componentType": 5123, "type": "SCALAR", "count": 60})
    scene.setdefault("materials", []).append(
        {"name": "lamp", "emissiveFactor": [1, 0.72, 0.42],
         "pbrMetallicRoughness": {"baseColorFactor": [0, 0, 0, 1], "metallicFactor": 0},
         "extensions": {"KHR_materials_emissive_strength": {"emissiveStrength": 300}}})
    scene.setdefault("meshes", []).append({"name": "lamp", "primitives": [
        {"attributes": {"POSITION": position}, "indices": indices, "material": len(scene["materials"]) - 1}]})
    roots = scene["scenes"][scene.get("scene", 0)].setdefault("nodes", [])
    for i, place in enumerate(places(count)):
        roots.append(len(scene["nodes"]))
        scene["nodes"].append({"name": f"lamp.{i:04d}", "mesh": len(scene["meshes"]) - 1, "translation": place})
    scene["extensionsUsed"] = sorted({*scene.get("extensionsUsed", []), "KHR_materials_emissive_strength"})


def main():
    if len(sys.argv) != 4 or not sys.argv[3].isdigit() or int(sys.argv[3]) < 1:
        sys.exit(__doc__)
    scene, binary = read_glb(sys.argv[1])
    add_lamps(scene, binary, int(sys.argv[3]))
    write_glb(sys.argv[2], scene, binary)


main()
