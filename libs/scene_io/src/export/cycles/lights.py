"""Lamps and the environment as Cycles has them."""
import math
import os

import bpy
from mathutils import Matrix

from shader_nodes import HERE, Nodes, scaled

TO_BLENDER = Matrix(((1, 0, 0, 0), (0, 0, -1, 0), (0, 1, 0, 0), (0, 0, 0, 1)))


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
