"""Blender's shader nodes in few words: trees, textures, images."""
import os

import bpy

HERE = os.path.dirname(os.path.abspath(__file__))


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
