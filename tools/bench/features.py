#!/usr/bin/python3
"""Renders small glTF files, one feature each, in Pluvia and in Blender's Cycles, and measures how they differ.

Usage: tools/bench/features.py FOLDER [FILE.gltf...] [--pluvia build/pluvia] [--spp 256] [--size 384x288]
Needs blender and Debian's python3-openimageio. Without files it makes its own: one material each on a sphere above a
floor, or a sheet in front of it, or a pipe that moves. FOLDER gets NAME_pluvia_SEED/, NAME_cycles_SEED.exr and the first
of each side by side as NAME.png (left: Pluvia); a table goes to stdout: means over the feature and over the rest, and how
they differ, with the noise of two seeds each.
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

import numpy
import OpenImageIO as oiio

import references

HERE = os.path.dirname(os.path.abspath(__file__))
GREY = {"baseColorFactor": [0.5, 0.5, 0.5, 1], "metallicFactor": 0, "roughnessFactor": 1}


def material(base=None, **extensions):
    made = {"name": "feature", "pbrMetallicRoughness": dict(GREY, **(base or {})), "doubleSided": True}
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
    "gloss": material(dict(RED, roughnessFactor=0.1)),
    "metal": material({"baseColorFactor": [0.9, 0.6, 0.3, 1], "metallicFactor": 1, "roughnessFactor": 0.35}),
    "car_paint": material(dict(RED, metallicFactor=0.3, roughnessFactor=0.5),
                          clearcoat={"clearcoatFactor": 1, "clearcoatRoughnessFactor": 0.1}),
    "cloth": material({"baseColorFactor": [0.1, 0.1, 0.3, 1]},
                      sheen={"sheenColorFactor": [0.5, 0.5, 0.6], "sheenRoughnessFactor": 0.5}),
    "sign": material({"baseColorFactor": [0, 0, 0, 1]}, emissiveFactor=[1, 0.5, 0.1],
                     emissive_strength={"emissiveStrength": 4}, specular={"specularFactor": 0}),
    "glass_body": material({"baseColorFactor": [1, 1, 1, 1], "roughnessFactor": 0},
                           transmission={"transmissionFactor": 1}, volume={"thicknessFactor": 1}, ior={"ior": 1.5}),
    "varnish": material(RED, clearcoat={"clearcoatFactor": 1, "clearcoatRoughnessFactor": 0.1},
                        specular={"specularFactor": 0}),
    # Reflects everything, so that what a model loses or makes shows.
    "white_metal": material({"baseColorFactor": [1, 1, 1, 1], "metallicFactor": 1, "roughnessFactor": 0.5}),
    "rough_metal": material({"baseColorFactor": [0.8, 0.8, 0.8, 1], "metallicFactor": 1, "roughnessFactor": 1}),
    "brushed": material({"baseColorFactor": [1, 1, 1, 1], "metallicFactor": 1, "roughnessFactor": 0.3},
                        anisotropy={"anisotropyStrength": 0.7, "anisotropyRotation": 0.4}),
}
SHEETS = {
    "poster": material({"baseColorFactor": [0.8, 0.6, 0.2, 1]}, unlit={}),
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
# Without reflection nothing is left of Disney's base in the conforming pictures.
SHEETS.update({"matt_" + name: dict(SHEETS[name], extensions=dict(SHEETS[name].get("extensions", {}),
                                                                  KHR_materials_specular={"specularFactor": 0}))
               for name in ("veil", "leaves", "cut_leaves", "second_uv", "painted")})
# How a sphere is placed: squeezed and turned inside out, as a mirrored copy of an asset is.
PLACES = {"mirrored": {"translation": [0, 0.75, 0], "rotation": [0, 0.38, 0, 0.92], "scale": [-0.9, 0.6, 0.5]}}
SPHERES["mirrored"] = SPHERES["gloss"]
MOVING = {"skinned": "skinned_pipe", "morphed": "morphed_pipe"}  # shown at half a second

# What is different in the two programs, where their difference is larger than the noise.
LOST = "what metal reflects more than once is lost"
# What is left with MULTI_GGX, by a random walk on the same microsurface: Kulla and Conty's lobe of Pluvia has 0.2 % too much
# on a white plate of roughness 1 in this light and 4 % at roughness 0.5, MULTI_GGX 0.2 % there and at roughness 1 10 % too
# little where Cycles samples the light and 4 % too much where it does not.
DISNEY = "the base of Blender 3.4's Principled BSDF is Disney's diffuse, from which reflection takes nothing"
BYTES = "Cycles interpolates the bytes of a picture and decodes them afterwards"
EXPLAINED = {
    "plastic": DISNEY,
    "gloss": DISNEY,
    "car_paint": "Principled's clear coat reflects a quarter of what one of index 1.5 does and takes nothing from the base",
    "varnish": "Principled's clear coat reflects a quarter of what one of index 1.5 does and takes nothing from the base",
    "metal": LOST,
    "white_metal": LOST,
    "rough_metal": LOST,
    "brushed": LOST + "; the importer knows no anisotropy",
    # By measure the picture in Cycles is that without sheen and a velvet's, added up, to 0.1 %; here the sheen takes 9 %
    # from the base and is 11 % darker than the velvet by quadrature of both formulas.
    "cloth": "the importer adds Ashikhmin's velvet to a base from which it takes nothing; glTF's sheen is Estevez and Kulla's; "
             + DISNEY,
    "poster": "Blender's unlit surface casts no shadow and is seen by the camera alone",
    "frosted_window": "Cycles takes the thin sheet of glTF for the surface of a body of glass and bends what is seen",
    "window": "Cycles takes the thin sheet of glTF for the surface of a body of glass and bends what is seen",
    "veil": DISNEY,
    "leaves": DISNEY,
    "second_uv": DISNEY + "; " + BYTES,
    "painted": DISNEY,
    # By itself the first takes 9 % of even light from the diffuse reflection of these bumps.
    "bumps": "Cycles darkens what a normal map turns away from its surface (Chiang, Li and Burley 2019); " + DISNEY,
    "mirrored": DISNEY,
    "cut_leaves": "the importer leaves alpha as it is: Cycles blends what the mask would cut; " + DISNEY,
    "matt_cut_leaves": "the importer leaves alpha as it is: Cycles blends what the mask would cut",
    # Alone it makes 1.6 % on this picture, and 5 % in blue.
    "neon": BYTES,
    "matt_second_uv": BYTES,
    # Khronos' files
    "01_alpha_blend": LOST,
    "01_alpha_mask": LOST + "; Cycles weighs colours by alpha where it interpolates, so that edges are brighter",
    "02_node_hierarchy": LOST,
    "03_animated_cube": LOST,
    "15_transmission": LOST,
    # Two black sheets seen at 73 degrees. By a walk on the microsurface with Fresnel's law they get -12.5 % (measured: -11.6 %
    # of MULTI_GGX), by one reflection -5.4 % (-3.6 % of what Blender imports).
    "13_texture_wrapping": "glTF's reflectance is Schlick's approximation, Cycles' is Fresnel's law",
    # By quadrature of both programs' formulas a single ball of its first material differs by 4.18 %, by measure by 4.22 %.
    "20_specular": DISNEY,
    "09_texture_transform": "Blender has one colour space for a picture, which is both colour and data here, and Cycles bends "
                            "normals until the surface mirrors nothing from below, here by some 50 degrees",
    "14_emission_strength": "the importer drops textures of a coloured emissiveFactor; " + LOST,
    "24_gpu_instancing": "Blender 3.4 does not know EXT_mesh_gpu_instancing",
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

    def mesh(self, positions, normals, triangles, made, place=None, more=None, **attributes):
        self.root["materials"].append(made)
        primitive = {"attributes": {"POSITION": self.accessor(positions, "VEC3", "f", 5126, True)},
                     "indices": self.accessor([[i] for t in triangles for i in t], "SCALAR", "I", 5125, False),
                     "material": len(self.root["materials"]) - 1}
        if normals:
            attributes["NORMAL"] = normals
        for name, rows in attributes.items():
            joints = name.startswith("JOINTS")
            primitive["attributes"][name] = self.accessor(rows, f"VEC{len(rows[0])}", "H" if joints else "f",
                                                          5123 if joints else 5126, False)
        self.root["meshes"].append(dict(more or {}, primitives=[primitive]))
        self.node(dict(place or {}, mesh=len(self.root["meshes"]) - 1, name=made["name"]))

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
        uv = [[1 - k / segments, i / rings] for i in range(rings + 1) for k in range(segments + 1)]
        self.mesh([[centre[k] + radius * n[k] for k in range(3)] for n in normals], normals, triangles, made, place,
                  TEXCOORD_0=uv)

    def pipe(self, rings=24, segments=48):
        """Positions, outward directions and triangles of one that stands upright, 1.5 m high.

        What moves has no normals in the file, so that both programs take those of the moved triangles: Blender keeps
        normals of its own relative to the surface, glTF moves those that are stored."""
        rows = [(1.5 * i / rings, 2 * math.pi * k / segments) for i in range(rings + 1) for k in range(segments + 1)]
        w = segments + 1
        triangles = [t for i in range(rings) for a in range(i * w, i * w + segments)
                     for t in ((a, a + 1, a + w), (a + 1, a + w + 1, a + w))]
        return [[0.3 * math.sin(a), y, 0.3 * math.cos(a)] for y, a in rows], \
               [[math.sin(a), 0, math.cos(a)] for _, a in rows], triangles

    def skinned_pipe(self, made):
        """Bent by a joint at half its height, which turns over a second: at 12 of 24 frames by half."""
        positions, _, triangles = self.pipe()
        shares = [min(max((p[1] - 0.5) / 0.5, 0), 1) for p in positions]
        self.mesh(positions, None, triangles, made, {"skin": 0}, JOINTS_0=[[0, 1, 0, 0]] * len(positions),
                  WEIGHTS_0=[[1 - s, s, 0, 0] for s in shares])
        first = len(self.root["nodes"])
        self.node({"name": "root", "children": [first + 1]})
        self.root["nodes"].append({"name": "knee", "translation": [0, 0.75, 0]})
        unbound = [[1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, -y, 0, 1] for y in (0, 0.75)]
        self.root["skins"] = [{"joints": [first, first + 1], "skeleton": first,
                               "inverseBindMatrices": self.accessor(unbound, "MAT4", "f", 5126, False)}]
        turn = math.radians(120) / 2
        self.animate(first + 1, "rotation", "VEC4", [[0, 0, 0, 1], [0, 0, -math.sin(turn), math.cos(turn)]])

    def morphed_pipe(self, made):
        """A pipe that bulges over a second."""
        positions, outward, triangles = self.pipe()
        bulge = [0.5 * math.sin(math.pi * p[1] / 1.5) for p in positions]
        self.mesh(positions, None, triangles, made, None, {"weights": [0]})
        moved = [[b * n[0], 0, b * n[2]] for b, n in zip(bulge, outward)]
        self.root["meshes"][-1]["primitives"][0]["targets"] = [{"POSITION": self.accessor(moved, "VEC3", "f", 5126, True)}]
        self.animate(len(self.root["nodes"]) - 1, "weights", "SCALAR", [[0], [1]])

    def animate(self, node, path, kind, values):
        sampler = {"input": self.accessor([[0], [1]], "SCALAR", "f", 5126, True),
                   "output": self.accessor(values, kind, "f", 5126, False), "interpolation": "LINEAR"}
        self.root["animations"] = [{"samplers": [sampler], "channels": [{"sampler": 0, "target": {"node": node, "path": path}}]}]

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
    lambert = material({"baseColorFactor": [0.6, 0.3, 0.2, 1]}, specular={"specularFactor": 0})
    moving = {name: dict(lambert, name="lambert feature") for name in MOVING}
    for name, made in list(SPHERES.items()) + list(SHEETS.items()) + list(moving.items()):
        draft = Draft()
        # Around the feature there are Lambert surfaces, which both programs have alike.
        draft.quad([-4, 0, 4], [8, 0, 0], [0, 0, -8], [0, 1, 0], MATT)
        draft.quad([-4, 0, -2], [8, 0, 0], [0, 4, 0], [0, 0, 1],
                   dict(material({"baseColorFactor": [0.3, 0.4, 0.5, 1]}, specular={"specularFactor": 0}), name="lambert wall"))
        if name in MOVING:
            getattr(draft, MOVING[name])(made)
        elif name in PLACES:
            draft.sphere([0, 0, 0], 1, made, PLACES[name])
        else:
            draft.sphere([0, 0.75, 0], 0.75, made if name in SPHERES else MATT)
        if name in SHEETS:
            uv = [[0, 1], [1, 1], [1, 0], [0, 0]]
            more = {"COLOR_0": [[0.9, 0.1, 0.1], [0.1, 0.8, 0.1], [0.1, 0.1, 0.9], [1, 1, 1]]} if name == "painted" else {}
            # To the last digit at right angles: Blender keeps normals as angles to its own, and loses a degree otherwise.
            width = math.hypot(1.4, 0.4)
            draft.quad([-0.2, 0.1, 1.2], [1.4, 0, 0.4], [0, 1.5, 0], [-0.4 / width, 0, 1.4 / width], made, TEXCOORD_0=uv,
                       TEXCOORD_1=[[v, u] for u, v in uv], **more)
        files.append(f"{folder}/{name}.gltf")
        draft.save(files[-1])
    return files


def run(command):
    done = subprocess.run(command, capture_output=True, text=True)
    if done.returncode:
        sys.exit(f"features: {' '.join(command)}: failed\n{done.stdout[-1000:]}{done.stderr[-1000:]}")
    return done.stdout


def read(path, names, kind="float"):
    file = oiio.ImageInput.open(path)
    channels = [file.spec().channelnames.index(n) for n in names]
    picture = [file.read_image(0, 0, c, c + 1, kind)[..., 0] for c in channels]
    file.close()
    return numpy.stack(picture, -1)


def side_by_side(options, ours, others, ev, path):
    """One PNG, exposed alike: a sensor is full at 1.2 * 2^EV cd/m2."""
    pictures = [f"{ours}/frame.exr", "--ch", "background.R=background.R,background.G,background.B", "--chnames", "R,G,B"]
    run(["oiiotool", *pictures, *others, "--mosaic:pad=4", f"{1 + len(others)}x1", "--mulc", str(1 / (1.2 * 2**ev)),
         "--clamp:min=0:max=1", "--powc", str(1 / 2.2), "-d", "uint8", "-o", path])


def feature_pixels(folder):
    """Where the feature is: its object in a file made here, all that is not sky in another."""
    ids = read(folder + "/frame.exr", ["instance.ID"], "uint")[..., 0]
    with open(folder + "/frame.json", encoding="utf-8") as file:
        objects = json.load(file)["objects"]
    own = [o["id"] for o in objects if o["name"].split("/")[-1] in ("feature", "lambert feature")]
    return numpy.isin(ids, own) if own else ids != 0


def measure(options, path):
    name = os.path.splitext(os.path.basename(path))[0]
    frame = 12 if name in MOVING else options.frame
    ours = [f"{options.folder}/{name}_pluvia_{seed}" for seed in (0, 1)]
    kinds = ["cycles"] + (["conform"] if options.conform else [])
    theirs = {kind: [f"{options.folder}/{name}_{kind}_{seed}.exr" for seed in (0, 1)] for kind in kinds}
    # White unlit paper has 1 cd/m2 at this exposure, as Blender's has.
    exposure = ["--exposure", str(-math.log2(1.2))] if name == "poster" else []
    for seed in (0, 1):
        run([options.pluvia, "render", path, "-o", ours[seed], "--size", options.size, "--spp", options.spp, "--seed", str(seed),
             "--environment", options.environment, "--layers", "instance", "--frame", str(frame), "--progress", "none",
             "--overwrite", *exposure])
    conform = ["--conform", f"{options.folder}/{name}_conform_%d.exr"] if options.conform else []
    run(["blender", "-b", "--factory-startup", "-P", HERE + "/cycles.py", "--", path, f"{options.folder}/{name}_cycles_%d.exr",
         *options.size.split("x"), options.spp, options.environment, "0,1", ours[0] + "/frame.json", "--frame", str(frame),
         *conform])
    with open(ours[0] + "/frame.json", encoding="utf-8") as file:
        ev = 2.1 if exposure else json.load(file)["exposure_ev100"]
    side_by_side(options, ours[0], [theirs[kind][0] for kind in kinds], ev, f"{options.folder}/{name}.png")
    feature = feature_pixels(ours[0])
    pictures = [numpy.stack([read(f"{o}/frame.exr", ["background.R", "background.G", "background.B"]) for o in ours])]
    pictures += [numpy.stack([read(path, ["R", "G", "B"]) for path in theirs[kind]]) for kind in kinds]
    for region, mask in (("feature", feature), ("around it", ~feature)):
        # Two seeds say how far a mean may be from the truth: by half of what they differ.
        means = [p[:, mask].mean(axis=(1, 2), dtype=float) for p in pictures]
        cells = [f"{means[0].mean():.4f}"]
        for m in means[1:]:
            error = math.hypot((means[0][0] - means[0][1]) / 2 / means[0].mean(), (m[0] - m[1]) / 2 / m.mean())
            cells += [f"{m.mean():.4f}", f"{100 * (means[0].mean() / m.mean() - 1):+.2f} ± {100 * error:.2f} %"]
        print(f"| {name} | {region} | " + " | ".join(cells) + f" | {EXPLAINED.get(name, '') if region == 'feature' else ''} |",
              flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder")
    parser.add_argument("files", nargs="*")
    parser.add_argument("--pluvia", default="build/pluvia")
    parser.add_argument("--spp", default="256")
    parser.add_argument("--size", default="384x288")
    parser.add_argument("--frame", type=int, default=0, help="of the given files, at 24 a second")
    parser.add_argument("--conform", action="store_true",
                        help="Cycles also with materials as the glTF specification has them (cycles_gltf.py)")
    parser.add_argument("--only", default="", help="of the files that it makes: names, separated by commas")
    options = parser.parse_args()
    os.makedirs(options.folder, exist_ok=True)
    options.environment = options.folder + "/environment.exr"
    references.write_exr(options.environment, references.environment(math.pi, 0.6), ["R", "G", "B"])
    columns = ["file", "region", "Pluvia", "Cycles", "difference"]
    columns += ["Cycles, as glTF has it", "difference"] if options.conform else []
    print(f"| {' | '.join(columns)} | why |\n|{' --- |' * (len(columns) + 1)}", flush=True)
    made = [path for path in make_files(options.folder)
            if not options.only or os.path.basename(path)[:-5] in options.only.split(",")]
    for path in options.files or made:
        measure(options, path)


if __name__ == "__main__":
    main()
