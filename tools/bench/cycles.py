"""Renders a glTF file in Blender's Cycles with an equirectangular environment, as the partner of `pluvia render`.

Usage: blender -b --factory-startup -P tools/bench/cycles.py -- SCENE.glb OUT.exr WIDTH HEIGHT SPP ENVIRONMENT [SEED
       [FRAME.json]] [--lambert] [--conform OUT.exr] [--frame N]
ENVIRONMENT: an HDR or EXR file, or R,G,B. FRAME.json: of a frame that Pluvia has rendered, whose camera is taken
instead of the file's. --lambert: what does not glow reflects as Lambert's law has it; without, only materials named
"lambert..." do. --conform: a second picture with materials as the glTF specification has them, by cycles_gltf.py. SEED:
several, with commas between, where OUT.exr has a %d. --frame: of an animation, at 24 a second. No denoising, clamping or
adaptive sampling; 32 bounces; box filter of a pixel.
"""
import os
import sys

import bpy

sys.path.append(os.path.dirname(os.path.abspath(__file__)))
import cycles_gltf
import cycles_scene

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

scene = cycles_scene.open_scene(scene_file, int(width), int(height), int(samples),
                                None if frame_number is None else int(frame_number))
if len(arguments) > 7:
    cycles_scene.take_camera(scene, arguments[7])
if not scene.camera:
    sys.exit(f"cycles: {scene_file}: has no camera (expected one, or the frame.json of a frame)")
cycles_scene.set_environment(scene, environment)


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
        scene.cycles.seed = seed
        scene.render.filepath = path % seed if "%d" in path else path
        cycles_scene.render(f"seed {seed}", int(samples), write_still=True)


render(out)
if conform:
    cycles_gltf.make_all_conforming(scene_file)
    render(conform)
