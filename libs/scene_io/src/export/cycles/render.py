"""Renders scene.json and scene.bin, which stand beside this file, with Blender's Cycles (written for Blender 3.4):

  blender --background --factory-startup --python render.py -- --output picture.exr [--seed N] [--spp N] [--threads N]
          [--projection camera|equirect]
  blender --background --factory-startup --python render.py -- --cube cube.json --output FOLDER ...

The picture is scene-linear radiance, 32-bit OpenEXR. World: y up there, z up in Blender. With --cube it is one of 90
degrees for each camera of the file, a list of matrices to the world, in three files: FOLDER/emitted0000.exr, lamps and
sky seen directly, FOLDER/reflected0000.exr, the rest, and FOLDER/all0000.exr, both.
"""
import argparse
import json
import math
import os
import sys

import bpy
from mathutils import Matrix

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, HERE)
sys.dont_write_bytecode = True
try:
    import numpy as np

    from lights import TO_BLENDER, build_light, build_world
    from materials import build_material
except ImportError as error:  # Blender itself would go on and exit with 0
    print("render.py: %s. Blender's Python is %s, %s; it looked in\n  %s\n"
          "The numpy that belongs to Blender is missing, or another Python stands before its own on PATH (as those of\n"
          "pyenv and virtual environments do): run it as PATH=/usr/bin:$PATH blender ..., or a file beside this one is "
          "missing." % (error, sys.version.split()[0], sys.executable, "\n  ".join(sys.path)), file=sys.stderr)
    sys.exit(1)


def arguments():
    parser = argparse.ArgumentParser(prog="render.py", description=__doc__)
    parser.add_argument("--output", required=True, help="picture to write (.exr)")
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--spp", type=int, default=0, help="samples per pixel; 0: as exported")
    parser.add_argument("--max-depth", type=int, default=-1, help="scattering events; -1: as exported")
    parser.add_argument("--threads", type=int, default=0, help="0: all")
    parser.add_argument("--projection", choices=("camera", "equirect"), default="camera",
                        help="equirect: all around the camera's place, the centre looking to the world's +x")
    parser.add_argument("--cube", help="JSON file of cameras' matrices, for pictures of 90 degrees and their parts")
    return parser.parse_args(sys.argv[sys.argv.index("--") + 1:] if "--" in sys.argv else [])


def array(binary, offset, dtype, count, width):
    return np.frombuffer(binary, dtype, count * width, offset).reshape(count, width)


def build_mesh(m, binary, material):
    mesh = bpy.data.meshes.new(m["name"])
    points = array(binary, m["positions"], np.float32, m["vertices"], 3)
    points = np.stack([points[:, 0], -points[:, 2], points[:, 1]], axis=1)
    corners = array(binary, m["indices"], np.uint32, m["triangles"], 3).reshape(-1).astype(np.int32)
    mesh.vertices.add(m["vertices"])
    mesh.vertices.foreach_set("co", np.ascontiguousarray(points).reshape(-1))
    mesh.loops.add(len(corners))
    mesh.loops.foreach_set("vertex_index", corners)
    mesh.polygons.add(m["triangles"])
    mesh.polygons.foreach_set("loop_start", np.arange(0, len(corners), 3, dtype=np.int32))
    mesh.polygons.foreach_set("loop_total", np.full(m["triangles"], 3, dtype=np.int32))
    for name in ("uv0", "uv1"):
        if name in m:
            uv = array(binary, m[name], np.float32, m["vertices"], 2)
            mesh.uv_layers.new(name=name).data.foreach_set("uv", np.ascontiguousarray(uv[corners]).reshape(-1))
    if "colors" in m:
        colors = array(binary, m["colors"], np.float32, m["vertices"], 4)
        mesh.attributes.new("colors", "FLOAT_COLOR", "POINT").data.foreach_set("color", colors.reshape(-1))
    mesh.update()
    if "normals" in m:
        normals = array(binary, m["normals"], np.float32, m["vertices"], 3)
        normals = np.stack([normals[:, 0], -normals[:, 2], normals[:, 1]], axis=1)
        mesh.polygons.foreach_set("use_smooth", np.ones(m["triangles"], dtype=bool))
        mesh.use_auto_smooth = True
        mesh.normals_split_custom_set_from_vertices(normals.tolist())
    mesh.materials.append(material)
    bpy.context.scene.collection.objects.link(bpy.data.objects.new(m["name"], mesh))


def build_camera(c, render, projection):
    data = bpy.data.cameras.new("camera")
    camera = bpy.data.objects.new("camera", data)
    bpy.context.scene.collection.objects.link(camera)
    world = Matrix(c["world"])
    if projection == "equirect":
        # Forward to +x, up to +y: the right hand to +z.
        axes = Matrix(((0, 0, -1, 0), (0, 1, 0, 0), (1, 0, 0, 0), (0, 0, 0, 1)))
        world = Matrix.Translation(world.translation) @ axes
    camera.matrix_world = TO_BLENDER @ world
    aspect = render.resolution_x / render.resolution_y
    if projection == "equirect":
        data.type = "PANO"
        data.cycles.panorama_type = "EQUIRECTANGULAR"
    elif c["orthographic"]:
        data.type = "ORTHO"
        data.ortho_scale = c["yheight"] * max(1.0, aspect)  # of the longer side
    else:
        data.sensor_fit = "VERTICAL"
        data.angle_y = c["yfov"]
    data.clip_start, data.clip_end = 1e-4, 1e6
    bpy.context.scene.camera = camera


def choose_settings(scene, options):
    s = bpy.context.scene
    render, cycles = s.render, s.cycles
    render.engine = "CYCLES"
    render.resolution_x, render.resolution_y = scene["width"], scene["height"]
    render.resolution_percentage = 100
    render.film_transparent = False
    render.image_settings.file_format = "OPEN_EXR"
    render.image_settings.color_mode = "RGB"
    render.image_settings.color_depth = "32"
    render.image_settings.exr_codec = "ZIP"
    render.use_persistent_data = False
    if options.threads > 0:
        render.threads_mode, render.threads = "FIXED", options.threads
    s.view_settings.view_transform = "Raw"
    cycles.device = "CPU"
    cycles.samples = options.spp or scene["spp"]
    cycles.seed = options.seed
    cycles.use_adaptive_sampling = False
    cycles.use_denoising = False
    cycles.pixel_filter_type = "BOX"
    cycles.filter_width = 1.0
    cycles.sample_clamp_direct = cycles.sample_clamp_indirect = 0
    cycles.light_sampling_threshold = 0
    cycles.blur_glossy = 0
    cycles.caustics_reflective = cycles.caustics_refractive = True
    depth = scene["max_depth"] if options.max_depth < 0 else options.max_depth
    # Cycles counts bounces after the first surface; depth 0 (emitters alone) is its emission pass.
    bounces = max(0, depth - 1)
    cycles.max_bounces = cycles.diffuse_bounces = cycles.glossy_bounces = bounces
    cycles.transmission_bounces = bounces
    cycles.volume_bounces = 0
    cycles.transparent_max_bounces = 256
    return depth


def compositor_of_parts():
    """An empty compositor, and its node of a picture's passes, emission and environment among them."""
    s = bpy.context.scene
    layer = s.view_layers[0]
    layer.use_pass_emit = layer.use_pass_environment = True
    s.use_nodes = True
    s.node_tree.nodes.clear()
    return s.node_tree, s.node_tree.nodes.new("CompositorNodeRLayers")


def emitters_alone(scene):
    """The picture of depth 0: emission pass plus environment pass."""
    tree, layers = compositor_of_parts()
    add = tree.nodes.new("CompositorNodeMixRGB")
    add.blend_type = "ADD"
    tree.links.new(layers.outputs["Emit"], add.inputs[1])
    tree.links.new(layers.outputs["Env"], add.inputs[2])
    out = tree.nodes.new("CompositorNodeComposite")
    tree.links.new(add.outputs[0], out.inputs[0])


def split_pictures(folder, with_reflected):
    """Has the parts of each picture written, with the frame's number in their names."""
    tree, layers = compositor_of_parts()

    def mix(blend, first, second):
        node = tree.nodes.new("CompositorNodeMixRGB")
        node.blend_type = blend
        tree.links.new(first, node.inputs[1])
        tree.links.new(second, node.inputs[2])
        return node.outputs[0]

    def write(name, part):
        out = tree.nodes.new("CompositorNodeOutputFile")
        out.base_path = os.path.abspath(folder)
        out.format.file_format, out.format.color_mode = "OPEN_EXR", "RGB"
        out.format.color_depth, out.format.exr_codec = "32", "ZIP"
        out.file_slots[0].path = name
        tree.links.new(part, out.inputs[0])

    emitted = mix("ADD", layers.outputs["Emit"], layers.outputs["Env"])
    write("emitted", emitted)
    write("all", layers.outputs["Image"])
    if with_reflected:
        write("reflected", mix("SUBTRACT", layers.outputs["Image"], emitted))


def render_cube(scene, options, depth):
    s = bpy.context.scene
    s.render.use_persistent_data = True
    s.render.resolution_x = s.render.resolution_y = scene["width"]
    split_pictures(options.output, depth > 0)
    with open(options.cube) as file:
        cameras = json.load(file)
    build_camera(dict(scene["camera"], orthographic=False, yfov=math.pi / 2), s.render, "camera")
    for frame, world in enumerate(cameras):
        s.frame_set(frame)
        s.camera.matrix_world = TO_BLENDER @ Matrix(world)
        bpy.ops.render.render()


def main():
    options = arguments()
    with open(os.path.join(HERE, "scene.json")) as file:
        scene = json.load(file)
    with open(os.path.join(HERE, "scene.bin"), "rb") as file:
        binary = file.read()
    for item in list(bpy.data.objects):
        bpy.data.objects.remove(item)
    materials = {}
    for mesh in scene["meshes"]:
        key = (mesh["material"], "colors" in mesh)
        if key not in materials:
            m = scene["default_material"] if key[0] < 0 else scene["materials"][key[0]]
            materials[key] = build_material(m, scene, key[1])
        build_mesh(mesh, binary, materials[key])
    for light in scene["lights"]:
        build_light(light)
    build_world(scene.get("environment"))
    depth = choose_settings(scene, options)
    if options.cube:
        render_cube(scene, options, depth)
        return
    build_camera(scene["camera"], bpy.context.scene.render, options.projection)
    if depth == 0:
        emitters_alone(scene)
    bpy.context.scene.render.filepath = os.path.abspath(options.output)
    bpy.ops.render.render(write_still=True)


try:
    main()
except Exception as error:  # Blender itself would go on and exit with 0
    import traceback
    traceback.print_exc()
    print("render.py: failed: %s" % error, file=sys.stderr)
    sys.exit(1)
