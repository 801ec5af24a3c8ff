#!/usr/bin/python3
"""Writes a street that is large: 4 million triangles, 500 MB of decoded textures and 10,000 copies of a tree.

usage: large_street.py OUT.glb [--triangles N] [--textures N] [--copies N]

Every picture is noise of 2048 x 2048, 17 MB decoded; needs numpy and oiiotool.
"""
import argparse
import json
import os
import struct
import subprocess
import tempfile

import numpy as np


def grid(side, rng):
    """A patch of ground with side x side quads: positions, normals, texture coordinates, triangles."""
    x, z = np.meshgrid(np.linspace(0, 10, side + 1), np.linspace(0, 10, side + 1))
    y = rng.normal(0, 0.01, x.shape)
    position = np.stack([x, y, z], -1).reshape(-1, 3).astype("<f4")
    normal = np.tile(np.array([0, 1, 0], "<f4"), (len(position), 1))
    uv = np.stack([x, z], -1).reshape(-1, 2).astype("<f4") / 10
    a = (np.arange(side)[:, None] * (side + 1) + np.arange(side)).reshape(-1)
    triangles = np.stack([a, a + side + 1, a + 1, a + 1, a + side + 1, a + side + 2], -1).astype("<u4")
    return position, normal, uv, triangles


def jpeg(seed):
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "t.jpg")
        noise = f"uniform:min=0.2,0.2,0.2:max=0.8,0.8,0.8:mono=0:seed={seed}"
        subprocess.run(["oiiotool", "--create", "512x512", "3", "--noise:type=" + noise, "--resize", "2048x2048",
                        "-d", "uint8", "--compression", "jpeg:90", "-o", path], check=True)
        with open(path, "rb") as file:
            return file.read()


class Glb:
    def __init__(self):
        self.bytes = bytearray()
        self.root = {"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": []}], "nodes": [], "meshes": [],
                     "materials": [], "textures": [], "images": [], "accessors": [], "bufferViews": []}

    def add(self, array, entry):
        self.root.setdefault(array, []).append(entry)
        return len(self.root[array]) - 1

    def view(self, data):
        self.bytes.extend(b"\0" * (-len(self.bytes) % 4))
        self.bytes.extend(data)
        return self.add("bufferViews", {"buffer": 0, "byteOffset": len(self.bytes) - len(data), "byteLength": len(data)})

    def accessor(self, values, component, kind):
        entry = {"bufferView": self.view(values.tobytes()), "componentType": component, "type": kind,
                 "count": values.size if kind == "SCALAR" else len(values)}
        if kind == "VEC3":
            entry["min"], entry["max"] = values.min(0).tolist(), values.max(0).tolist()
        return self.add("accessors", entry)

    def mesh(self, shape, material):
        position, normal, uv, triangles = shape
        return self.add("meshes", {"primitives": [{
            "attributes": {"POSITION": self.accessor(position, 5126, "VEC3"),
                           "NORMAL": self.accessor(normal, 5126, "VEC3"),
                           "TEXCOORD_0": self.accessor(uv, 5126, "VEC2")},
            "indices": self.accessor(triangles.reshape(-1), 5125, "SCALAR"), "material": material}]})

    def save(self, path):
        self.root["buffers"] = [{"byteLength": len(self.bytes)}]
        self.bytes.extend(b"\0" * (-len(self.bytes) % 4))
        text = json.dumps({key: value for key, value in self.root.items() if value != []}).encode()
        text += b" " * (-len(text) % 4)
        with open(path, "wb") as file:
            file.write(b"glTF" + struct.pack("<II", 2, 28 + len(text) + len(self.bytes)))
            file.write(struct.pack("<I", len(text)) + b"JSON" + text)
            file.write(struct.pack("<I", len(self.bytes)) + b"BIN\0" + self.bytes)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("out")
    parser.add_argument("--triangles", type=int, default=4000000)
    parser.add_argument("--textures", type=int, default=30)
    parser.add_argument("--copies", type=int, default=10000)
    options = parser.parse_args()
    rng = np.random.default_rng(1)
    glb = Glb()
    for i in range(options.textures):
        image = glb.add("images", {"bufferView": glb.view(jpeg(i)), "mimeType": "image/jpeg"})
        texture = glb.add("textures", {"source": image})
        glb.add("materials", {"pbrMetallicRoughness": {"baseColorTexture": {"index": texture}, "metallicFactor": 0}})
    if not options.textures:
        glb.add("materials", {})
    side = 200
    patches = round(options.triangles / (2 * side * side))
    for i in range(patches):
        mesh = glb.mesh(grid(side, rng), i % max(options.textures, 1))
        node = glb.add("nodes", {"mesh": mesh, "translation": [10 * (i % 8), 0, -10 * (i // 8)]})
        glb.root["scenes"][0]["nodes"].append(node)
    if options.copies:
        tree = glb.mesh(grid(70, rng), 0)
        places = rng.uniform([0, 0, -60], [80, 0, 0], (options.copies, 3)).astype("<f4")
        glb.root["extensionsUsed"] = ["EXT_mesh_gpu_instancing"]
        attributes = {"TRANSLATION": glb.accessor(places, 5126, "VEC3")}
        node = glb.add("nodes", {"mesh": tree, "name": "trees",
                                 "extensions": {"EXT_mesh_gpu_instancing": {"attributes": attributes}}})
        glb.root["scenes"][0]["nodes"].append(node)
    glb.save(options.out)


main()
