"""Rainy pictures the usual way, as the partner of `pluvia render --rain`: Blender's Cycles renders the street, then once
more per intensity with the rain's streaks in it as quads that take its light, and the pictures are composed.

Usage: blender -b --factory-startup -P tools/bench/cycles_rain.py -- SCENE.glb FOLDER WIDTH HEIGHT SPP ENVIRONMENT
       INTENSITIES SEED
INTENSITIES: mm/h, with commas between. FOLDER gets background and depth (EXR), and per intensity the rainy picture (EXR, PNG)
and its mask. Drops: sizes after Marshall and Palmer 1948, fall speeds after Atlas, Srivastava and Sekhon 1973, those that
are at least a pixel wide, falling for 1/60 s. Each pixel of a streak before the background's depth is a white quad
that covers the pixel at the drop's depth; its weight is the share of the exposure that the drop is there.
"""
import json
import math
import os
import sys

import numpy

sys.path.append(os.path.dirname(os.path.abspath(__file__)))
import cycles_scene  # before bpy: mends numpy for it
import bpy

SHUTTER = 1 / 60              # seconds
NEAREST = 0.1                 # metres
DIAMETERS = numpy.arange(0.525, 6, 0.05)  # mm, middles of classes


def fall_speed(diameter):
    return 9.65 - 10.3 * numpy.exp(-0.6 * diameter)  # m/s


class Picture:
    """What turns pixels into places: camera axes in the world, and the focal length in pixels."""

    def __init__(self, scene, width, height):
        world = numpy.array(scene.camera.matrix_world)
        self.width, self.height = width, height
        self.right, self.up, self.ahead, self.eye = world[:3, 0], world[:3, 1], -world[:3, 2], world[:3, 3]
        frame = scene.camera.data.view_frame(scene=scene)
        self.focal = width / 2 * abs(frame[0].z) / max(abs(corner.x) for corner in frame)

    def point(self, x, y, z):
        """Of pixel coordinates from the lower left corner, at depth z."""
        sideways, upwards = (x - self.width / 2) / self.focal * z, (y - self.height / 2) / self.focal * z
        return self.eye + numpy.outer(sideways, self.right) + numpy.outer(upwards, self.up) + z * self.ahead


def drops(picture, intensity, rng):
    """Pixel coordinates, depth in metres and diameter in mm of the drops in view that are a pixel wide or more."""
    density = 8000 * numpy.exp(-4.1 * intensity**-0.21 * DIAMETERS) * 0.05  # per cubic metre
    farthest = numpy.maximum(DIAMETERS * 1e-3 * picture.focal, NEAREST)
    volume = picture.width * picture.height / picture.focal**2 * (farthest**3 - NEAREST**3) / 3
    counts = rng.poisson(density * volume)
    diameter, far = numpy.repeat(DIAMETERS, counts), numpy.repeat(farthest, counts)
    z = numpy.cbrt(NEAREST**3 + rng.random(len(far)) * (far**3 - NEAREST**3))
    return rng.random(len(far)) * picture.width, rng.random(len(far)) * picture.height, z, diameter


def draw_streaks(picture, intensity, depth, rng):
    """Weight of the rain in each pixel, and the corners of a quad for each pixel of each streak."""
    weight, quads = numpy.zeros(depth.shape, numpy.float32), []
    for x, y, z, diameter in zip(*drops(picture, intensity, rng)):
        metres = fall_speed(diameter) * SHUTTER
        wide, long_ = diameter * 1e-3 / z * picture.focal, metres / z * picture.focal
        columns = numpy.arange(max(0, int(x - wide / 2)), min(picture.width, int(x + wide / 2) + 1))
        lines = numpy.arange(max(0, int(y - long_ / 2)), min(picture.height, int(y + long_ / 2) + 1))
        there = depth[lines[:, None], columns] > z
        if not there.any():
            continue
        at_y, at_x = lines[numpy.nonzero(there)[0]], columns[numpy.nonzero(there)[1]]
        covered = diameter * 1e-3 / (diameter * 1e-3 + metres)
        weight[at_y, at_x] = 1 - (1 - weight[at_y, at_x]) * (1 - covered)
        corner = [picture.point(at_x + i, at_y + k, z) for i, k in ((0, 0), (1, 0), (1, 1), (0, 1))]
        quads.append(numpy.stack(corner, 1))
    return weight, numpy.concatenate(quads).astype(numpy.float32) if quads else numpy.zeros((0, 4, 3), numpy.float32)


def add_quads(scene, quads, material):
    mesh, count = bpy.data.meshes.new("rain"), len(quads)
    mesh.vertices.add(4 * count)
    mesh.vertices.foreach_set("co", quads.reshape(-1))
    mesh.loops.add(4 * count)
    mesh.loops.foreach_set("vertex_index", numpy.arange(4 * count, dtype=numpy.int32))
    mesh.polygons.add(count)
    mesh.polygons.foreach_set("loop_start", numpy.arange(0, 4 * count, 4, dtype=numpy.int32))
    mesh.polygons.foreach_set("loop_total", numpy.full(count, 4, numpy.int32))
    mesh.update()
    mesh.materials.append(material)
    rain = bpy.data.objects.new("rain", mesh)
    scene.collection.objects.link(rain)
    return rain


def white():
    material = bpy.data.materials.new("rain")
    material.use_nodes = True
    tree = material.node_tree
    diffuse = tree.nodes.new("ShaderNodeBsdfDiffuse")
    diffuse.inputs["Color"].default_value = (1, 1, 1, 1)
    tree.links.new(diffuse.outputs["BSDF"], tree.nodes["Material Output"].inputs["Surface"])
    return material


def write_layers(scene, folder):
    """Every render writes its light and its depth into the folder."""
    scene.view_layers[0].use_pass_z = True
    scene.use_nodes = True
    tree = scene.node_tree
    tree.nodes.clear()
    layers, files = tree.nodes.new("CompositorNodeRLayers"), tree.nodes.new("CompositorNodeOutputFile")
    composite = tree.nodes.new("CompositorNodeComposite")
    tree.links.new(layers.outputs["Image"], composite.inputs[0])
    files.base_path, files.format.file_format, files.format.color_depth = folder, "OPEN_EXR", "32"
    files.file_slots.clear()
    for name, output in (("light", "Image"), ("depth", "Depth")):
        files.file_slots.new(name)
        tree.links.new(layers.outputs[output], files.inputs[-1])


def read(scene, folder, name, width, height):
    """Rows from the bottom, as Blender has them."""
    image = bpy.data.images.load(f"{folder}/{name}{scene.frame_current:04d}.exr")
    image.colorspace_settings.name = "Non-Color"
    values = numpy.empty(width * height * 4, numpy.float32)
    image.pixels.foreach_get(values)
    bpy.data.images.remove(image)
    return values.reshape(height, width, 4)[..., :3]


def write(path, values, kind):
    """values: rows from the bottom; OPEN_EXR as they are, PNG for display."""
    height, width = values.shape[:2]
    image = bpy.data.images.new("out", width, height, float_buffer=kind == "OPEN_EXR")
    if kind == "PNG":
        values = numpy.clip(values, 0, 1) ** (1 / 2.2)
    image.pixels.foreach_set(numpy.concatenate([values, numpy.ones((height, width, 1))], 2, dtype=numpy.float32).ravel())
    image.filepath_raw, image.file_format = path, kind
    image.save()
    bpy.data.images.remove(image)


def main():
    path, folder, width, height, spp, environment, intensities, seed = sys.argv[sys.argv.index("--") + 1 :]
    width, height, spp, rng = int(width), int(height), int(spp), numpy.random.default_rng(int(seed))
    os.makedirs(folder, exist_ok=True)
    scene = cycles_scene.open_scene(path, width, height, spp)
    cycles_scene.set_environment(scene, environment)
    scene.cycles.seed = int(seed)
    write_layers(scene, folder)
    cycles_scene.render("background", spp)
    background = read(scene, folder, "light", width, height)
    depth = read(scene, folder, "depth", width, height)[..., 0]
    write(folder + "/background.exr", background, "OPEN_EXR")
    write(folder + "/depth.exr", numpy.repeat(depth[..., None], 3, 2), "OPEN_EXR")
    picture, material, counts = Picture(scene, width, height), white(), []
    for name in intensities.split(","):
        weight, quads = draw_streaks(picture, float(name), depth, rng)
        rain = add_quads(scene, quads, material)
        cycles_scene.render(f"rain of {name} mm/h", spp)
        bpy.data.meshes.remove(rain.data)  # and its object
        share = weight[..., None]
        rainy = background * (1 - share) + read(scene, folder, "light", width, height) * share
        write(f"{folder}/rainy_{name}.exr", rainy, "OPEN_EXR")
        write(f"{folder}/rainy_{name}.png", rainy, "PNG")
        write(f"{folder}/mask_{name}.png", numpy.repeat(share > 0.01, 3, 2), "PNG")
        counts.append(len(quads))
    print("rain: " + json.dumps({"quads": counts}), flush=True)


main()
