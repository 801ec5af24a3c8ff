"""Renders a glTF file in Blender's Cycles with an equirectangular environment, as the partner of `pluvia render`.

Usage: blender -b --factory-startup -P tools/bench/cycles.py -- SCENE.glb OUT.exr WIDTH HEIGHT SPP ENVIRONMENT [SEED
       [FRAME.json]] [--lambert] [--conform OUT.exr] [--frame N]
ENVIRONMENT: an HDR or EXR file, or R,G,B. FRAME.json: of a frame that Pluvia has rendered, whose camera is taken
instead of the file's. --lambert: what does not glow reflects as Lambert's law has it; without, only materials named
"lambert..." do. --conform: a second picture with
materials as the glTF specification has them, by cycles_gltf.py. SEED: several, with commas between, where OUT.exr has a
%d. --frame: of an animation, at 24 a second. No denoising, clamping or adaptive sampling; 32 bounces; box filter of a pixel.
"""
import json
import os
import sys
import time

import numpy

numpy.bool = bool  # Blender 3.4's glTF importer uses the name that newer numpy has dropped
import bpy
from mathutils import Matrix

sys.path.append(os.path.dirname(os.path.abspath(__file__)))
import cycles_gltf

arguments = sys.argv[sys.argv.index("--") + 1 :]


def take(name):
    """The value of an option, taken out of the arguments; None without it."""
    if name not in arguments:
        return None
    at = arguments.index(name)
    value = arguments[at + 1]
    del arguments[at : at + 2]
    return value


conform, frame_number = take("--conform"), take("--frame")
lambert = "--lambert" in arguments
arguments = [a for a in arguments if a != "--lambert"]
scene_file, out, width, height, samples, environment = arguments[:6]
seeds = [int(s) for s in arguments[6].split(",")] if len(arguments) > 6 else [0]

bpy.ops.wm.read_factory_settings(use_empty=True)
bpy.ops.import_scene.gltf(filepath=scene_file)
scene = bpy.context.scene
if frame_number is not None:
    scene.render.fps = 24
    scene.frame_set(int(frame_number))
scene.render.engine = "CYCLES"
cycles = scene.cycles
cycles.device, cycles.samples = "CPU", int(samples)
cycles.use_adaptive_sampling = cycles.use_denoising = False
cycles.sample_clamp_direct = cycles.sample_clamp_indirect = cycles.blur_glossy = 0
for kind in ("max", "diffuse", "glossy", "transmission", "transparent_max"):
    setattr(cycles, kind + "_bounces", 32)
cycles.pixel_filter_type = "BOX"
scene.render.resolution_x, scene.render.resolution_y = int(width), int(height)
scene.render.resolution_percentage = 100
scene.render.image_settings.file_format = "OPEN_EXR"
scene.render.image_settings.color_depth = "32"
scene.render.image_settings.color_mode = "RGB"
scene.view_settings.view_transform = "Raw"
if len(arguments) > 7:
    with open(arguments[7], encoding="utf-8") as file:
        frame = json.load(file)["camera"]
    lens = bpy.data.cameras.new("frame")
    lens.sensor_fit, lens.sensor_width = "HORIZONTAL", 36
    lens.clip_start, lens.clip_end = 0.01, 1e5  # by themselves 0.1 and 100 m
    lens.lens = frame["intrinsics"][0][0] / int(width) * 36
    scene.camera = bpy.data.objects.new("frame", lens)
    scene.collection.objects.link(scene.camera)
    z_up = Matrix(((1, 0, 0, 0), (0, 0, -1, 0), (0, 1, 0, 0), (0, 0, 0, 1)))
    scene.camera.matrix_world = z_up @ Matrix(frame["world_from_camera"])
else:
    scene.camera = next(o for o in scene.objects if o.type == "CAMERA")

world = scene.world = bpy.data.worlds.new("world")
world.use_nodes = True
background = world.node_tree.nodes["Background"]
if "," in environment:
    background.inputs[0].default_value = (*map(float, environment.split(",")), 1)
else:
    picture = world.node_tree.nodes.new("ShaderNodeTexEnvironment")
    picture.image = bpy.data.images.load(environment)
    world.node_tree.links.new(picture.outputs[0], background.inputs[0])


def make_lambert(tree):
    for old in [n for n in tree.nodes if n.type == "BSDF_PRINCIPLED"]:
        glow, color = old.inputs["Emission"], old.inputs["Base Color"]
        if glow.links or max(glow.default_value[:3]) > 0:
            continue
        plain = tree.nodes.new("ShaderNodeBsdfDiffuse")
        plain.inputs["Color"].default_value = color.default_value
        for there, here in ((color, plain.inputs["Color"]), (old.inputs["Normal"], plain.inputs["Normal"])):
            for link in there.links:
                tree.links.new(link.from_socket, here)
        for link in list(old.outputs["BSDF"].links):
            tree.links.new(plain.outputs["BSDF"], link.to_socket)


for material in bpy.data.materials:
    if material.use_nodes and (lambert or material.name.startswith("lambert")):
        make_lambert(material.node_tree)

def render(path):
    for seed in seeds:
        cycles.seed = seed
        scene.render.filepath = path % seed if "%d" in path else path
        start = time.time()
        bpy.ops.render.render(write_still=True)
        print("cycles: %.2f s, %d samples per pixel" % (time.time() - start, int(samples)))


render(out)
if conform:
    cycles_gltf.make_all_conforming(scene_file)
    render(conform)
