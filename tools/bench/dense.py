#!/usr/bin/python3
"""Copies the .glb file of a street with much finer geometry: what a hierarchy of millions of triangles costs.

Usage: tools/bench/dense.py IN.glb OUT.glb [PIECES, 8] [LEAVES, 50000]
Each triangle is split into PIECES x PIECES, moved by up to 4 mm, the same where places are the same; 40 crowns of trees,
of LEAVES triangles each, hang in two rows over the street, which lies along -Z as KayKit's does. KayKit's street of 26 thousand
triangles becomes one of 3.7 million. Needs numpy.
"""
import sys

import numpy

from glb import read_glb, write_glb

COMPONENTS = {5121: "u1", 5123: "<u2", 5125: "<u4", 5126: "<f4"}
WIDTHS = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4}
CROWNS = 40
CROWN_RADIUS, LEAF = 1.5, 0.06  # metres


def read(scene, binary, index):
    """Rows of an accessor as floats, or its indices."""
    accessor = scene["accessors"][index]
    view = scene["bufferViews"][accessor["bufferView"]]
    kind, width = numpy.dtype(COMPONENTS[accessor["componentType"]]), WIDTHS[accessor["type"]]
    start = view.get("byteOffset", 0) + accessor.get("byteOffset", 0)
    stride = view.get("byteStride", kind.itemsize * width)
    raw = numpy.frombuffer(binary, "u1", stride * (accessor["count"] - 1) + kind.itemsize * width, start)
    rows = numpy.lib.stride_tricks.as_strided(raw, (accessor["count"], kind.itemsize * width), (stride, 1))
    return numpy.ascontiguousarray(rows).view(kind).reshape(accessor["count"], width)


def add(scene, binary, values):
    binary.extend(b"\0" * (-len(binary) % 4))
    scene["bufferViews"].append({"buffer": 0, "byteOffset": len(binary), "byteLength": values.nbytes})
    entry = {"bufferView": len(scene["bufferViews"]) - 1, "count": len(values)}
    if values.ndim == 1:
        entry |= {"componentType": 5125, "type": "SCALAR"}
    else:
        entry |= {"componentType": 5126, "type": f"VEC{values.shape[1]}"}
        entry |= {"min": values.min(0).tolist(), "max": values.max(0).tolist()}
    binary.extend(values.tobytes())
    scene["accessors"].append(entry)
    return len(scene["accessors"]) - 1


def pattern(pieces):
    """Barycentric weights of the corners that a split triangle has, and its small triangles."""
    places = [(i, k) for i in range(pieces + 1) for k in range(pieces + 1 - i)]
    number = {p: n for n, p in enumerate(places)}
    weights = numpy.array([(pieces - i - k, i, k) for i, k in places], "f8") / pieces
    small = [(number[i, k], number[i + 1, k], number[i, k + 1]) for i, k in places if i + k < pieces]
    small += [(number[i + 1, k], number[i + 1, k + 1], number[i, k + 1]) for i, k in places if i + k < pieces - 1]
    return weights, numpy.array(small, "u4")


def moved(positions):
    """By up to 4 mm, continuously."""
    waves = numpy.sin(positions[:, [1, 2, 0]] * 37 + numpy.sin(positions[:, [2, 0, 1]] * 23) * 2)
    return positions + 0.004 / 3**0.5 * waves


def split(scene, binary, primitive, pieces):
    weights, small = pattern(pieces)
    corners = read(scene, binary, primitive["indices"]).reshape(-1, 3).astype("i8")
    for name, index in list(primitive["attributes"].items()):
        if name not in ("POSITION", "NORMAL", "TEXCOORD_0"):
            del primitive["attributes"][name]
            continue
        values = numpy.einsum("wc,tcx->twx", weights, read(scene, binary, index)[corners].astype("f8"))
        values = values.reshape(-1, values.shape[-1])
        values = moved(values) if name == "POSITION" else values
        if name == "NORMAL":
            values = values / numpy.maximum(numpy.linalg.norm(values, axis=1, keepdims=True), 1e-9)
        primitive["attributes"][name] = add(scene, binary, values.astype("<f4"))
    starts = numpy.arange(len(corners), dtype="<u4") * len(weights)
    primitive["indices"] = add(scene, binary, (starts[:, None, None] + small).astype("<u4").ravel())


def add_crowns(scene, binary, leaves, rng):
    scene["materials"].append({"name": "leaf", "doubleSided": True, "pbrMetallicRoughness":
                               {"baseColorFactor": [0.1, 0.3, 0.05, 1], "metallicFactor": 0}})
    for i in range(CROWNS):
        middle = rng.normal(size=(leaves, 1, 3))
        middle *= CROWN_RADIUS * rng.random((leaves, 1, 1)) ** (1 / 3) / numpy.linalg.norm(middle, axis=2, keepdims=True)
        corners = (middle + rng.uniform(-LEAF, LEAF, (leaves, 3, 3))).reshape(-1, 3).astype("<f4")
        primitive = {"attributes": {"POSITION": add(scene, binary, corners)}, "material": len(scene["materials"]) - 1,
                     "indices": add(scene, binary, numpy.arange(3 * leaves, dtype="<u4"))}
        scene["meshes"].append({"primitives": [primitive]})
        scene["scenes"][0]["nodes"].append(len(scene["nodes"]))
        scene["nodes"].append({"name": f"crown.{i:02d}", "mesh": len(scene["meshes"]) - 1,
                               "translation": [4 if i % 2 else -4, 4.5, 1 - 4 * (i // 2)]})


def main():
    if not 3 <= len(sys.argv) <= 5 or not all(a.isdigit() and int(a) > 0 for a in sys.argv[3:]):
        sys.exit(__doc__)
    pieces, leaves = (int(a) for a in (sys.argv[3:] + ["8", "50000"][len(sys.argv) - 3 :]))
    scene, binary = read_glb(sys.argv[1])
    for mesh in scene["meshes"]:
        for primitive in mesh["primitives"]:
            split(scene, binary, primitive, pieces)
    add_crowns(scene, binary, leaves, numpy.random.default_rng(1))
    write_glb(sys.argv[2], scene, binary)


main()
