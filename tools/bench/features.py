#!/usr/bin/python3
"""Renders small glTF files, one feature each, in Pluvia and in Blender's Cycles, and measures how they differ.

Usage: tools/bench/features.py FOLDER [FILE.gltf...] [--pluvia build/pluvia] [--spp 256] [--size 384x288]
Needs blender and Debian's python3-openimageio. Without files it makes its own: one material each on a sphere above a
floor, or a sheet in front of it. FOLDER gets NAME_pluvia/, NAME_cycles.exr and both side by side as NAME.png (left:
Pluvia); a table goes to stdout: bias and trimmed relMSE of Pluvia's background against Cycles', and what of the relMSE
is noise: that between two seeds of Pluvia and two of Cycles.
"""
import argparse
import base64
import json
import math
import os
import struct
import subprocess
import sys
import zlib

import references

HERE = os.path.dirname(os.path.abspath(__file__))
GREY = {"baseColorFactor": [0.5, 0.5, 0.5, 1], "metallicFactor": 0, "roughnessFactor": 1}


def material(base=None, **extensions):
    made = {"pbrMetallicRoughness": dict(GREY, **(base or {})), "doubleSided": True}
    for name in ("emissiveFactor", "alphaMode", "alphaCutoff"):
        if name in extensions:
            made[name] = extensions.pop(name)
    if extensions:
        made["extensions"] = {"KHR_materials_" + name: value for name, value in extensions.items()}
    return made


MATT = dict(material(specular={"specularFactor": 0}), name="lambert")
RED = {"baseColorFactor": [0.6, 0.05, 0.03, 1]}
SPHERES = {
    "plastic": material(dict(RED, roughnessFactor=0.4)),
    "metal": material({"baseColorFactor": [0.9, 0.6, 0.3, 1], "metallicFactor": 1, "roughnessFactor": 0.35}),
    "car_paint": material(dict(RED, metallicFactor=0.3, roughnessFactor=0.5),
                          clearcoat={"clearcoatFactor": 1, "clearcoatRoughnessFactor": 0.1}),
    "cloth": material({"baseColorFactor": [0.1, 0.1, 0.3, 1]},
                      sheen={"sheenColorFactor": [0.5, 0.5, 0.6], "sheenRoughnessFactor": 0.5}),
    "sign": material({"baseColorFactor": [0, 0, 0, 1]}, emissiveFactor=[1, 0.5, 0.1],
                     emissive_strength={"emissiveStrength": 4}, specular={"specularFactor": 0}),
    "glass_body": material({"baseColorFactor": [1, 1, 1, 1], "roughnessFactor": 0},
                           transmission={"transmissionFactor": 1}, volume={"thicknessFactor": 1}, ior={"ior": 1.5}),
}
SHEETS = {
    "window": material({"baseColorFactor": [0.9, 1, 0.95, 1], "roughnessFactor": 0}, transmission={"transmissionFactor": 1}),
    "frosted_window": material({"baseColorFactor": [1, 1, 1, 1], "roughnessFactor": 0.3},
                               transmission={"transmissionFactor": 1}),
    "veil": material({"baseColorFactor": [0.2, 0.5, 0.2, 0.5]}, alphaMode="BLEND"),
    "leaves": material({"baseColorTexture": {"index": 0}}, alphaMode="BLEND"),
    "cut_leaves": material({"baseColorTexture": {"index": 0}}, alphaMode="MASK", alphaCutoff=0.4),
    "neon": dict(material({"baseColorFactor": [0, 0, 0, 1]}, emissiveFactor=[1, 1, 1],
                          emissive_strength={"emissiveStrength": 3}), emissiveTexture={"index": 2}),
    "bumps": dict(material({"baseColorFactor": [0.6, 0.6, 0.6, 1], "roughnessFactor": 0.4}),
                  normalTexture={"index": 1, "scale": 0.8}),
    "second_uv": material({"baseColorTexture": {"index": 2, "texCoord": 1, "extensions": {
        "KHR_texture_transform": {"offset": [0.3, 0.1], "rotation": 0.5, "scale": [2, 1.5]}}}}),
    "painted": material({"baseColorFactor": [1, 1, 1, 1]}),
}
# How a sphere is placed: squeezed and turned inside out, as a mirrored copy of an asset is.
PLACES = {"mirrored": {"translation": [0, 0.75, 0], "rotation": [0, 0.38, 0, 0.92], "scale": [-0.9, 0.6, 0.5]}}
SPHERES["mirrored"] = SPHERES["plastic"]

# What is different in the two programs, where their difference is larger than the noise.
EXPLAINED = {
    "plastic": "the base of Blender 3.4's Principled BSDF is Disney's diffuse, brighter towards the rim",
    "car_paint": "Principled's clear coat reflects a quarter of what one of index 1.5 does; its base is Disney's diffuse",
    "cloth": "the sheen of Blender 3.4 is Disney's, without the roughness that the file states; likewise its base",
    "frosted_window": "Cycles takes the thin sheet of glTF for the surface of a body of glass and bends what is seen",
    "window": "likewise",
    "cut_leaves": "the importer leaves alpha as it is: Cycles blends what the mask would cut",
}


def leaf_texture(opaque=False, size=64):
    """Green blades on what is clear; alpha falls off towards the edge. Opaque for where glTF ignores alpha: Cycles does not."""
    rows = []
    for y in range(size):
        row = []
        for x in range(size):
            u, v = (x + 0.5) / size * 4 % 1 - 0.5, (y + 0.5) / size * 4 % 1 - 0.5
            alpha = max(0, min(255, round(255 * (1.25 - math.hypot(2.2 * u, 2.2 * v + u)))))
            row.append((60 + 3 * x, 190 - y, 50 + (u > v) * 150, 255) if opaque else (60 + 3 * x, 190 - y, 50, alpha))
        rows.append(row)
    return rows


def bump_texture(size=64):
    def texel(x, y):
        u, v = math.cos(2 * math.pi * 3 * x / size), math.cos(2 * math.pi * 3 * y / size)
        n = [0.5 * u, 0.5 * v, 1]
        return tuple(round(127.5 + 127.5 * c / math.hypot(*n)) for c in n) + (255,)
    return [[texel(x, y) for x in range(size)] for y in range(size)]


def png_uri(rows):
    """RGBA rows as a data URI."""
    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
    raw = b"".join(b"\0" + bytes(c for texel in row for c in texel) for row in rows)
    png = (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", len(rows[0]), len(rows), 8, 6, 0, 0, 0)) +
           chunk(b"IDAT", zlib.compress(raw)) + chunk(b"IEND", b""))
    return "data:image/png;base64," + base64.b64encode(png).decode()


class Draft:
    """A glTF file under construction, its one buffer as a data URI."""

    def __init__(self):
        self.bytes, self.root = b"", {"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": []}], "nodes": [],
                                      "meshes": [], "materials": [], "accessors": [], "bufferViews": [], "cameras": []}

    def accessor(self, rows, kind, code, component, bounds):
        data = struct.pack("<%d%s" % (len(rows) * len(rows[0]), code), *[x for row in rows for x in row])
        self.root["bufferViews"].append({"buffer": 0, "byteOffset": len(self.bytes), "byteLength": len(data)})
        self.bytes += data + b"\0" * (-len(data) % 4)
        entry = {"bufferView": len(self.root["bufferViews"]) - 1, "componentType": component, "count": len(rows), "type": kind}
        if bounds:
            entry.update(min=[min(c) for c in zip(*rows)], max=[max(c) for c in zip(*rows)])
        self.root["accessors"].append(entry)
        return len(self.root["accessors"]) - 1

    def mesh(self, positions, normals, triangles, made, place=None, **attributes):
        self.root["materials"].append(made)
        primitive = {"attributes": {"POSITION": self.accessor(positions, "VEC3", "f", 5126, True),
                                    "NORMAL": self.accessor(normals, "VEC3", "f", 5126, False)},
                     "indices": self.accessor([[i] for t in triangles for i in t], "SCALAR", "I", 5125, False),
                     "material": len(self.root["materials"]) - 1}
        for name, rows in attributes.items():
            primitive["attributes"][name] = self.accessor(rows, f"VEC{len(rows[0])}", "f", 5126, False)
        self.root["meshes"].append({"primitives": [primitive]})
        self.node(dict(place or {}, mesh=len(self.root["meshes"]) - 1))

    def node(self, entry):
        self.root["nodes"].append(entry)
        self.root["scenes"][0]["nodes"].append(len(self.root["nodes"]) - 1)

    def quad(self, corner, u, v, normal, made, **attributes):
        corners = [[corner[k] + a * u[k] + b * v[k] for k in range(3)] for a, b in ((0, 0), (1, 0), (1, 1), (0, 1))]
        self.mesh(corners, [normal] * 4, [(0, 1, 2), (0, 2, 3)], made, **attributes)

    def sphere(self, centre, radius, made, place=None, rings=48, segments=96):
        normals = [[math.sin(math.pi * i / rings) * math.cos(2 * math.pi * k / segments), math.cos(math.pi * i / rings),
                    math.sin(math.pi * i / rings) * math.sin(2 * math.pi * k / segments)]
                   for i in range(rings + 1) for k in range(segments + 1)]
        w = segments + 1
        triangles = [t for i in range(rings) for a in range(i * w, i * w + segments)
                     for t in ((a, a + 1, a + w), (a + 1, a + w + 1, a + w))]
        self.mesh([[centre[k] + radius * n[k] for k in range(3)] for n in normals], normals, triangles, made,
                  place)

    def save(self, path):
        self.root["cameras"].append({"type": "perspective", "perspective": {"yfov": 0.6, "znear": 0.01}})
        self.node({"camera": 0, "translation": [0, 1.6, 5], "rotation": [-math.sin(0.1), 0, 0, math.cos(0.1)]})
        used = {e for m in self.root["materials"] for e in m.get("extensions", {})}
        text = json.dumps(self.root["materials"])
        if "KHR_texture_transform" in text:
            used.add("KHR_texture_transform")
        if used:
            self.root["extensionsUsed"] = sorted(used)
        if '"index"' in text:
            self.root["images"] = [{"uri": png_uri(rows)} for rows in (leaf_texture(), bump_texture(), leaf_texture(True))]
            self.root["textures"] = [{"source": i} for i in range(3)]
        self.root = {key: value for key, value in self.root.items() if value != []}
        uri = "data:application/octet-stream;base64," + base64.b64encode(self.bytes).decode()
        self.root["buffers"] = [{"byteLength": len(self.bytes), "uri": uri}]
        with open(path, "w", encoding="utf-8") as file:
            json.dump(self.root, file)


def make_files(folder):
    files = []
    for name, made in list(SPHERES.items()) + list(SHEETS.items()):
        draft = Draft()
        # Around the feature there are Lambert surfaces, which both programs have alike.
        draft.quad([-4, 0, 4], [8, 0, 0], [0, 0, -8], [0, 1, 0], MATT)
        draft.quad([-4, 0, -2], [8, 0, 0], [0, 4, 0], [0, 0, 1],
                   dict(material({"baseColorFactor": [0.3, 0.4, 0.5, 1]}, specular={"specularFactor": 0}), name="lambert wall"))
        if name in PLACES:
            draft.sphere([0, 0, 0], 1, made, PLACES[name])
        else:
            draft.sphere([0, 0.75, 0], 0.75, made if name in SPHERES else MATT)
        if name in SHEETS:
            uv = [[0, 1], [1, 1], [1, 0], [0, 0]]
            more = {"COLOR_0": [[0.9, 0.1, 0.1], [0.1, 0.8, 0.1], [0.1, 0.1, 0.9], [1, 1, 1]]} if name == "painted" else {}
            draft.quad([-0.2, 0.1, 1.2], [1.4, 0, 0.4], [0, 1.5, 0], [-0.275, 0, 0.961], made, TEXCOORD_0=uv,
                       TEXCOORD_1=[[v, u] for u, v in uv], **more)
        files.append(f"{folder}/{name}.gltf")
        draft.save(files[-1])
    return files


def run(command):
    done = subprocess.run(command, capture_output=True, text=True)
    if done.returncode:
        sys.exit(f"features: {' '.join(command)}: failed\n{done.stdout[-1000:]}{done.stderr[-1000:]}")
    return done.stdout


def compare(options, a, b):
    """Bias and trimmed relMSE of a against b."""
    command = [options.pluvia, "validate", "compare", a, b, "--no-flip", "--json"]
    numbers = json.loads(run(command))["pairs"][0]["regions"]["all"]
    return numbers["bias"], numbers["relmse_trimmed"]


def side_by_side(options, ours, theirs, ev, path):
    """One PNG, exposed alike: a sensor is full at 1.2 * 2^EV cd/m2."""
    run(["oiiotool", f"{ours}/frame.exr", "--ch", "background.R=background.R,background.G,background.B", theirs,
         "--chnames", "R,G,B", "--mosaic:pad=4", "2x1", "--mulc", str(1 / (1.2 * 2**ev)), "--clamp:min=0:max=1", "--powc",
         str(1 / 2.2), "-d", "uint8", "-o", path])


def measure(options, path):
    name = os.path.splitext(os.path.basename(path))[0]
    ours, theirs = [[f"{options.folder}/{name}_{program}_{seed}" for seed in "01"] for program in ("pluvia", "cycles")]
    for seed in (0, 1):
        run([options.pluvia, "render", path, "-o", ours[seed], "--size", options.size, "--spp", options.spp, "--seed", str(seed),
             "--environment", options.environment, "--progress", "none", "--overwrite"])
        run(["blender", "-b", "--factory-startup", "-P", HERE + "/cycles.py", "--", path, theirs[seed] + ".exr",
             *options.size.split("x"), options.spp, options.environment, str(seed), ours[0] + "/frame.json"])
    with open(ours[0] + "/frame.json", encoding="utf-8") as file:
        ev = json.load(file)["exposure_ev100"]
    side_by_side(options, ours[0], theirs[0] + ".exr", ev, f"{options.folder}/{name}.png")
    bias, relmse = compare(options, ours[0] + "/frame.exr", theirs[0] + ".exr")
    # Two seeds differ by twice the noise of one; a picture of ours and one of theirs by the sum of both.
    noise = sum(compare(options, a, b)[1] / 2 for a, b in
                ((ours[1] + "/frame.exr", ours[0] + "/frame.exr"), (theirs[1] + ".exr", theirs[0] + ".exr")))
    why = EXPLAINED.get(name, "") if relmse > 2 * noise + 1e-4 else ""
    print(f"| {name} | {100 * bias:+.2f} % | {relmse:.5f} | {noise:.5f} | {why} |", flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder")
    parser.add_argument("files", nargs="*")
    parser.add_argument("--pluvia", default="build/pluvia")
    parser.add_argument("--spp", default="256")
    parser.add_argument("--size", default="384x288")
    parser.add_argument("--only", default="", help="of the files that it makes: names, separated by commas")
    options = parser.parse_args()
    os.makedirs(options.folder, exist_ok=True)
    options.environment = options.folder + "/environment.exr"
    references.write_exr(options.environment, references.environment(math.pi, 0.6), ["R", "G", "B"])
    print("| feature | bias | relMSE, trimmed | of that noise | why |\n| --- | --- | --- | --- | --- |", flush=True)
    made = [path for path in make_files(options.folder)
            if not options.only or os.path.basename(path)[:-5] in options.only.split(",")]
    for path in options.files or made:
        measure(options, path)


if __name__ == "__main__":
    main()
