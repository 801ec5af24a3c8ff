"""What Blender scripts here set up alike: a glTF scene in Cycles, its camera and environment. Runs inside Blender 3.4."""
import json
import time

import numpy

numpy.bool = bool  # Blender 3.4's glTF importer uses the name that newer numpy has dropped
import bpy
from mathutils import Matrix


def open_scene(path, width, height, samples, frame=None):
    """Imports a file. No denoising, clamping or adaptive sampling; 32 bounces; a pixel's filter is its box."""
    bpy.ops.wm.read_factory_settings(use_empty=True)
    bpy.ops.import_scene.gltf(filepath=path)
    scene = bpy.context.scene
    if frame is not None:
        scene.render.fps = 24
        scene.frame_set(frame)
    scene.render.engine = "CYCLES"
    cycles = scene.cycles
    cycles.device, cycles.samples = "CPU", samples
    cycles.use_adaptive_sampling = cycles.use_denoising = False
    cycles.sample_clamp_direct = cycles.sample_clamp_indirect = cycles.blur_glossy = 0
    for kind in ("max", "diffuse", "glossy", "transmission", "transparent_max"):
        setattr(cycles, kind + "_bounces", 32)
    cycles.pixel_filter_type = "BOX"
    scene.render.resolution_x, scene.render.resolution_y = width, height
    scene.render.resolution_percentage = 100
    scene.render.image_settings.file_format = "OPEN_EXR"
    scene.render.image_settings.color_depth = "32"
    scene.render.image_settings.color_mode = "RGB"
    scene.view_settings.view_transform = "Raw"
    scene.camera = next((o for o in scene.objects if o.type == "CAMERA"), None)
    return scene


def take_camera(scene, path):
    """Of a frame that Pluvia has rendered, described by its frame.json."""
    with open(path, encoding="utf-8") as file:
        frame = json.load(file)["camera"]
    lens = bpy.data.cameras.new("frame")
    lens.sensor_fit, lens.sensor_width = "HORIZONTAL", 36
    lens.clip_start, lens.clip_end = 0.01, 1e5  # by themselves 0.1 and 100 m
    lens.lens = frame["intrinsics"][0][0] / scene.render.resolution_x * 36
    scene.camera = bpy.data.objects.new("frame", lens)
    scene.collection.objects.link(scene.camera)
    z_up = Matrix(((1, 0, 0, 0), (0, 0, -1, 0), (0, 1, 0, 0), (0, 0, 0, 1)))
    scene.camera.matrix_world = z_up @ Matrix(frame["world_from_camera"])


def set_environment(scene, environment):
    """An equirectangular HDR or EXR file, or R,G,B."""
    world = scene.world = bpy.data.worlds.new("world")
    world.use_nodes = True
    background = world.node_tree.nodes["Background"]
    if "," in environment:
        background.inputs[0].default_value = (*map(float, environment.split(",")), 1)
    else:
        picture = world.node_tree.nodes.new("ShaderNodeTexEnvironment")
        picture.image = bpy.data.images.load(environment)
        world.node_tree.links.new(picture.outputs[0], background.inputs[0])


def render(what, samples, **options):
    """Renders, and prints the seconds and the processor's seconds that the call took."""
    wall, processor = time.time(), time.process_time()
    bpy.ops.render.render(**options)
    print("cycles: %.2f s, %.2f s of processor, %d samples per pixel, %s" %
          (time.time() - wall, time.process_time() - processor, samples, what), flush=True)
