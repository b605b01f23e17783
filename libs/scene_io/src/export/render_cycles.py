"""Renders scene.json and scene.bin, which stand beside this file, with Blender's Cycles (written for Blender 3.4):

  blender --background --factory-startup --python render.py -- --output picture.exr [--seed N] [--spp N] [--threads N]
          [--projection camera|equirect]

The picture is scene-linear radiance, 32-bit OpenEXR. World: y up there, z up in Blender.
"""
import argparse
import json
import math
import os
import sys

import bpy
from mathutils import Matrix

try:
    import numpy as np
except ImportError as error:  # Blender itself would go on and exit with 0
    print("render.py: %s: Blender's Python finds no numpy; is another Python first on PATH?" % error, file=sys.stderr)
    sys.exit(1)

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, HERE)
sys.dont_write_bytecode = True
import specular_albedo  # noqa: E402

TO_BLENDER = Matrix(((1, 0, 0, 0), (0, 0, -1, 0), (0, 1, 0, 0), (0, 0, 0, 1)))


def arguments():
    parser = argparse.ArgumentParser(prog="render.py", description=__doc__)
    parser.add_argument("--output", required=True, help="picture to write (.exr)")
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--spp", type=int, default=0, help="samples per pixel; 0: as exported")
    parser.add_argument("--max-depth", type=int, default=-1, help="scattering events; -1: as exported")
    parser.add_argument("--threads", type=int, default=0, help="0: all")
    parser.add_argument("--projection", choices=("camera", "equirect"), default="camera",
                        help="equirect: all around the camera's place, the centre looking to the world's +x")
    return parser.parse_args(sys.argv[sys.argv.index("--") + 1:] if "--" in sys.argv else [])


class Nodes:
    """A shader node tree under construction. Inputs are numbers, colours or sockets."""

    def __init__(self, tree):
        self.tree = tree
        tree.nodes.clear()

    def add(self, kind, inputs=None, **settings):
        node = self.tree.nodes.new(kind)
        for name, value in settings.items():
            setattr(node, name, value)
        for key, value in (inputs or {}).items():
            self.put(node.inputs[key], value)
        return node

    def put(self, socket, value):
        if isinstance(value, bpy.types.NodeSocket):
            self.tree.links.new(value, socket)
        elif hasattr(value, "__len__") and socket.type == "RGBA":
            socket.default_value = tuple(value)[:3] + (1.0,)
        else:
            socket.default_value = value

    def math(self, operation, a, b=0.0, c=0.0, clamp=False):
        node = self.add("ShaderNodeMath", {0: a, 1: b, 2: c}, operation=operation, use_clamp=clamp)
        return node.outputs[0]

    def vector_math(self, operation, a, b):
        return self.add("ShaderNodeVectorMath", {0: a, 1: b}, operation=operation).outputs[0]

    def mix(self, factor, first, second):
        return self.add("ShaderNodeMixShader", {0: factor, 1: first, 2: second}).outputs[0]

    def sum(self, first, second):
        return self.add("ShaderNodeAddShader", {0: first, 1: second}).outputs[0]


def load_textures(scene):
    return [os.path.join(HERE, t["file"]) for t in scene["textures"]]


def image_of(path, color):
    """One Blender image per file and reading: a file may be used as colour and as data."""
    name = os.path.basename(path) + ("" if color else ".data")
    image = bpy.data.images.get(name)
    if image is None:
        image = bpy.data.images.load(path)
        image.name = name
        image.colorspace_settings.name = "sRGB" if color else "Non-Color"
        image.alpha_mode = "CHANNEL_PACKED"
    return image


def texture_node(nodes, use, scene, color):
    """Texture coordinates have v downwards until the last step."""
    uv = nodes.add("ShaderNodeUVMap", uv_map="uv%d" % use["uv_set"]).outputs[0]
    uv = nodes.add("ShaderNodeMapping", {0: uv, "Location": (*use["offset"], 0), "Rotation": (0, 0, -use["rotation"]),
                                         "Scale": (*use["scale"], 1)}, vector_type="POINT").outputs[0]
    split = nodes.add("ShaderNodeSeparateXYZ", {0: uv})
    info = scene["textures"][use["texture"]]
    axes = []
    for axis, size in enumerate((info["width"], info["height"])):
        value = split.outputs[axis]
        if use["wrap"][axis] == "mirror":
            value = nodes.math("PINGPONG", value, 1.0)
        if use["wrap"][axis] != "repeat":
            value = nodes.math("MINIMUM", nodes.math("MAXIMUM", value, 0.5 / size), 1 - 0.5 / size)
        axes.append(value)
    uv = nodes.add("ShaderNodeCombineXYZ", {0: axes[0], 1: nodes.math("SUBTRACT", 1.0, axes[1]), 2: 0.0}).outputs[0]
    return nodes.add("ShaderNodeTexImage", {0: uv}, image=image_of(load_textures(scene)[use["texture"]], color),
                     interpolation="Closest" if use["nearest"] else "Linear", extension="REPEAT")


def scaled(nodes, color, factor):
    """color (three numbers) times factor (a socket or None)."""
    if factor is None:
        return color
    return nodes.vector_math("MULTIPLY", factor, tuple(color))


def build_material(m, scene, vertex_colors):
    material = bpy.data.materials.new(m["name"] or "material")
    material.use_nodes = True
    nodes = Nodes(material.node_tree)
    backfacing = nodes.add("ShaderNodeNewGeometry").outputs["Backfacing"]

    base, coverage = tuple(m["base_color"]), m["alpha"]
    if m["base_color_texture"]:
        texture = texture_node(nodes, m["base_color_texture"], scene, True)
        base = scaled(nodes, base, texture.outputs["Color"])
        coverage = nodes.math("MULTIPLY", texture.outputs["Alpha"], coverage)
    if vertex_colors:
        colors = nodes.add("ShaderNodeAttribute", attribute_name="colors")
        base = nodes.vector_math("MULTIPLY", base, colors.outputs["Color"])
        coverage = nodes.math("MULTIPLY", coverage, colors.outputs["Alpha"])

    normal = None
    if m["normal_texture"]:
        texture = texture_node(nodes, m["normal_texture"], scene, False)
        normal = nodes.add("ShaderNodeNormalMap", {"Color": texture.outputs["Color"], "Strength": m["normal_scale"]},
                           uv_map="uv%d" % m["normal_texture"]["uv_set"]).outputs[0]

    emission = tuple(m["emission"])
    if m["emission_texture"]:
        emission = scaled(nodes, emission, texture_node(nodes, m["emission_texture"], scene, True).outputs["Color"])
    if m["unlit"]:
        # Shown to the camera alone; black for all other light.
        surface = nodes.add("ShaderNodeEmission", {"Color": base,
                                                   "Strength": nodes.add("ShaderNodeLightPath").outputs["Is Camera Ray"]}
                            ).outputs[0]
    else:
        surface = reflection(nodes, m, scene, base, normal)
        if any(e > 0 for e in m["emission"]):
            strength = 1.0 if m["double_sided"] else nodes.math("SUBTRACT", 1.0, backfacing)
            # The colour input clamps nothing, so that radiance stands in it as it is.
            glow = nodes.add("ShaderNodeEmission", {"Color": emission, "Strength": strength}).outputs[0]
            surface = nodes.sum(surface, glow)
    if m["alpha_mode"] != "opaque":
        if m["alpha_mode"] == "mask":
            coverage = nodes.math("SUBTRACT", 1.0, nodes.math("LESS_THAN", coverage, m["alpha_cutoff"]))
        clear = nodes.add("ShaderNodeBsdfTransparent").outputs[0]
        surface = nodes.mix(coverage, clear, surface)
    nodes.add("ShaderNodeOutputMaterial", {"Surface": surface})
    return material


def reflection(nodes, m, scene, base, normal):
    shading = {"Normal": normal} if normal is not None else {}
    sigma = -m["diffuse_roughness"] if m["diffuse_roughness"] < 0 else 0.0
    if m["f0"] == 0 and m["metallic"] == 0:
        return nodes.add("ShaderNodeBsdfDiffuse", {"Color": base, "Roughness": sigma, **shading}).outputs[0]

    roughness, metallic = abs(m["specular_roughness"]), m["metallic"]
    if m["metallic_roughness_texture"]:
        texture = texture_node(nodes, m["metallic_roughness_texture"], scene, False)
        channels = nodes.add("ShaderNodeSeparateColor", {0: texture.outputs["Color"]}).outputs
        roughness = nodes.math("MULTIPLY", channels[1], roughness)
        metallic = nodes.math("MULTIPLY", channels[2], metallic)
    f0 = nodes.add("ShaderNodeMixRGB", {"Fac": metallic, "Color1": (m["f0"],) * 3, "Color2": base}).outputs[0]
    phong = m["specular_roughness"] < 0
    ours, theirs = (albedo_node(nodes, name, roughness, shading) for name in albedo_images(phong))
    parts = nodes.add("ShaderNodeSeparateXYZ", {0: f0}).outputs
    f90 = nodes.math("MULTIPLY", nodes.math("MAXIMUM", nodes.math("MAXIMUM", parts[0], parts[1]), parts[2]), 50.0,
                     clamp=True)
    grazing = nodes.math("MULTIPLY", f90, ours[1])
    albedo = nodes.vector_math("ADD", nodes.vector_math("MULTIPLY", f0, ours[0]), grazing)
    if phong:
        color = nodes.vector_math("DIVIDE", albedo, theirs[0])
        glossy = nodes.add("ShaderNodeBsdfGlossy", {"Color": color, "Roughness": roughness, **shading},
                           distribution="BECKMANN").outputs[0]
    else:
        glossy = ggx_lobe(nodes, f0, parts, roughness, shading, ours, theirs, grazing)
    # The diffuse layer gets what the lobe leaves, so that white stays white.
    left = nodes.vector_math("MAXIMUM", nodes.vector_math("SUBTRACT", (1.0, 1.0, 1.0), albedo), (0.0, 0.0, 0.0))
    dielectric = nodes.math("SUBTRACT", 1.0, metallic)
    diffuse_color = nodes.vector_math("MULTIPLY", nodes.vector_math("MULTIPLY", base, left), dielectric)
    diffuse = nodes.add("ShaderNodeBsdfDiffuse", {"Color": diffuse_color, "Roughness": sigma, **shading}).outputs[0]
    return nodes.sum(diffuse, glossy)


def albedo_images(phong):
    """Names of the images of specular_albedo.tables: view cosine to the right, roughness upwards."""
    names = [kind + (" Blinn-Phong" if phong else " GGX") for kind in ("ours", "Cycles'")]
    if names[0] not in bpy.data.images:
        for name, table in zip(names, specular_albedo.tables(phong)):
            size = table.shape[0]
            image = bpy.data.images.new(name, size, size, float_buffer=True, is_data=True)
            pixels = np.ones((size, size, 4), np.float32)
            pixels[..., :2] = table
            image.pixels.foreach_set(pixels.ravel())
            image.pack()
    return names


def albedo_node(nodes, name, roughness, shading):
    """(A, B) of a table at this point's view angle. Layer Weight's Facing at blend 0.5 is 1 - cos."""
    facing = nodes.add("ShaderNodeLayerWeight", {"Blend": 0.5, **shading}).outputs["Facing"]
    # Nodes stand at the centres of texels.
    last, size = specular_albedo.SIZE - 1, specular_albedo.SIZE
    place = [nodes.math("MULTIPLY_ADD", value, last / size, 0.5 / size)
             for value in (nodes.math("SUBTRACT", 1.0, facing), roughness)]
    uv = nodes.add("ShaderNodeCombineXYZ", {0: place[0], 1: place[1]}).outputs[0]
    image = nodes.add("ShaderNodeTexImage", {0: uv}, image=bpy.data.images[name], interpolation="Linear",
                      extension="EXTEND")
    return nodes.add("ShaderNodeSeparateXYZ", {0: image.outputs["Color"]}).outputs


def ggx_lobe(nodes, f0, parts, roughness, shading, ours, theirs, grazing):
    """The Principled BSDF's lobe alone, whose Fresnel term is of the half vector, times the ratio of the albedos."""
    lobe = nodes.add("ShaderNodeBsdfPrincipled", {"Base Color": f0, "Metallic": 1.0, "Specular": 0.5,
                                                  "Roughness": roughness, **shading}, distribution="GGX").outputs[0]
    mean = nodes.math("DIVIDE", nodes.math("ADD", nodes.math("ADD", parts[0], parts[1]), parts[2]), 3.0)
    wanted = nodes.math("MULTIPLY_ADD", mean, ours[0], grazing)
    given = nodes.math("MULTIPLY_ADD", mean, theirs[0], theirs[1])
    # A mix takes factors up to 1, and the ratio may be larger: half of it, of twice the lobe.
    half = nodes.math("MULTIPLY", nodes.math("DIVIDE", wanted, given), 0.5)
    return nodes.add("ShaderNodeMixShader", {0: half, 2: nodes.sum(lobe, lobe)}).outputs[0]


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


def light_object(name, kind, matrix):
    data = bpy.data.lights.new(name, kind)
    data.use_nodes = True
    light = bpy.data.objects.new(name, data)
    light.matrix_world = matrix
    bpy.context.scene.collection.objects.link(light)
    return data


def build_light(l):
    color = [l["intensity"] * c for c in l["color"]]
    world = TO_BLENDER @ Matrix(l["world"])
    if l["type"] == "sphere":
        return build_sphere_light(l, color, world.translation)
    # A unit light; its colour and strength stand in the nodes, unclamped.
    place = Matrix.Translation(world.translation) @ world.to_quaternion().to_matrix().to_4x4()
    if l["type"] == "directional":
        data = light_object(l["name"], "SUN", place)
        data.energy = 1.0
        data.angle = 2 * l["angular_radius"]
    else:
        data = light_object(l["name"], "POINT", place)
        data.energy = 4 * math.pi  # radiant intensity 1
        data.shadow_soft_size = 0.0
    data.color = (1, 1, 1)
    data.cycles.cast_shadow = True
    data.cycles.max_bounces = 1024
    nodes = Nodes(data.node_tree)
    strength = 1.0
    if l["type"] == "spot":
        # KHR_lights_punctual's cone: the square of a ramp in the cosine. The normal is the direction from the light.
        z = nodes.add("ShaderNodeSeparateXYZ", {0: nodes.add("ShaderNodeTexCoord").outputs["Normal"]}).outputs[2]
        cosine = nodes.math("MULTIPLY", z, -1.0)
        width = max(1e-4, l["cos_inner"] - l["cos_outer"])
        ramp = nodes.math("DIVIDE", nodes.math("SUBTRACT", cosine, l["cos_outer"]), width, clamp=True)
        strength = nodes.math("MULTIPLY", ramp, ramp)
    emission = nodes.add("ShaderNodeEmission", {"Color": color, "Strength": strength})
    nodes.add("ShaderNodeOutputLight", {"Surface": emission.outputs[0]})


def build_sphere_light(l, color, center):
    """Seen, never blocking: an emitting mesh that lets everything through. Its front alone glows, or the far side
    would count as well."""
    material = bpy.data.materials.new(l["name"])
    material.use_nodes = True
    nodes = Nodes(material.node_tree)
    front = nodes.math("SUBTRACT", 1.0, nodes.add("ShaderNodeNewGeometry").outputs["Backfacing"])
    glow = nodes.add("ShaderNodeEmission", {"Color": color, "Strength": front}).outputs[0]
    nodes.add("ShaderNodeOutputMaterial", {"Surface": nodes.sum(glow, nodes.add("ShaderNodeBsdfTransparent").outputs[0])})
    bpy.ops.mesh.primitive_ico_sphere_add(subdivisions=5, radius=l["radius"], location=center)
    sphere = bpy.context.object
    # The polyhedron lies inside the sphere: it is enlarged to the sphere's mean projected area, a quarter of its surface.
    area = sum(p.area for p in sphere.data.polygons)
    grow = math.sqrt(4 * math.pi * l["radius"] ** 2 / area)
    sphere.scale = (grow, grow, grow)
    sphere.data.materials.clear()
    sphere.data.materials.append(material)


def build_world(environment):
    world = bpy.data.worlds.new("environment")
    bpy.context.scene.world = world
    world.use_nodes = True
    nodes = Nodes(world.node_tree)
    color = (0, 0, 0)
    if environment:
        color = tuple(environment["color"])
        if "file" in environment:
            direction = nodes.add("ShaderNodeTexCoord").outputs["Generated"]
            direction = nodes.add("ShaderNodeMapping", {0: direction, "Rotation": (0, 0, -environment["rotation"])},
                                  vector_type="POINT").outputs[0]
            image = bpy.data.images.load(os.path.join(HERE, environment["file"]))
            image.colorspace_settings.name = "Linear"
            texture = nodes.add("ShaderNodeTexEnvironment", {0: direction}, image=image)
            color = scaled(nodes, color, texture.outputs["Color"])
            world.cycles.sampling_method = "MANUAL"
            world.cycles.sample_map_resolution = max(image.size[0], 256)
    background = nodes.add("ShaderNodeBackground", {"Color": color, "Strength": 1.0})
    nodes.add("ShaderNodeOutputWorld", {"Surface": background.outputs[0]})


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
    cycles.transmission_bounces = cycles.volume_bounces = 0
    cycles.transparent_max_bounces = 256
    return depth


def emitters_alone(scene):
    """The picture of depth 0: emission pass plus environment pass."""
    s = bpy.context.scene
    layer = s.view_layers[0]
    layer.use_pass_emit = layer.use_pass_environment = True
    s.use_nodes = True
    tree = s.node_tree
    tree.nodes.clear()
    layers = tree.nodes.new("CompositorNodeRLayers")
    add = tree.nodes.new("CompositorNodeMixRGB")
    add.blend_type = "ADD"
    tree.links.new(layers.outputs["Emit"], add.inputs[1])
    tree.links.new(layers.outputs["Env"], add.inputs[2])
    out = tree.nodes.new("CompositorNodeComposite")
    tree.links.new(add.outputs[0], out.inputs[0])


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
