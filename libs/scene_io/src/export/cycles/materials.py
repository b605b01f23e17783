"""Materials of ssphh as nodes of Cycles (docs/methods/materials.md, docs/export.md)."""
import bpy
import numpy as np

import specular_albedo
from shader_nodes import Nodes, scaled, texture_node


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
        if m["transmission"] > 0:
            surface = nodes.mix(glass_share(nodes, m, scene), surface, glass(nodes, m, scene, base, normal))
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
    output = nodes.add("ShaderNodeOutputMaterial", {"Surface": surface})
    if m["transmission"] > 0 and not m["sheet"] and m["attenuation_distance"] > 0:
        nodes.put(output.inputs["Volume"], absorption(nodes, m))
    return material


def glass_share(nodes, m, scene):
    share = m["transmission"]
    if m["transmission_texture"]:
        texture = texture_node(nodes, m["transmission_texture"], scene, False)
        share = nodes.math("MULTIPLY", nodes.add("ShaderNodeSeparateColor", {0: texture.outputs["Color"]}).outputs[0],
                           share)
    return nodes.math("MULTIPLY", share, nodes.math("SUBTRACT", 1.0, roughness_metallic(nodes, m, scene)[1]))


def glass(nodes, m, scene, tint, normal):
    """A body by Cycles' own refraction; of a sheet r + r t tau and t = (1 - r)^2 tau / (1 - r^2 tau^2) straight through."""
    shading = {"Normal": normal} if normal is not None else {}
    roughness = roughness_metallic(nodes, m, scene)[0]
    r = nodes.add("ShaderNodeFresnel", {"IOR": m["ior"], **shading}).outputs[0]
    if m["specular"] < 1:
        total = nodes.math("GREATER_THAN", r, 0.9999)
        r = nodes.math("MULTIPLY", r, nodes.math("MAXIMUM", total, m["specular"]))
    if not m["sheet"]:
        mirror = nodes.add("ShaderNodeBsdfGlossy", {"Color": (1.0, 1.0, 1.0), "Roughness": roughness, **shading},
                           distribution="GGX").outputs[0]
        through = nodes.add("ShaderNodeBsdfRefraction", {"Color": tint, "Roughness": roughness, "IOR": m["ior"],
                                                         **shading}, distribution="GGX").outputs[0]
        return nodes.mix(r, through, mirror)
    kept = nodes.math("SUBTRACT", 1.0, r)
    passes = nodes.vector_math("MULTIPLY", tint, nodes.math("MULTIPLY", kept, kept))
    once = nodes.vector_math("MULTIPLY", tint, r)
    between = nodes.vector_math("SUBTRACT", (1.0, 1.0, 1.0), nodes.vector_math("MULTIPLY", once, once))
    transmitted = nodes.vector_math("DIVIDE", passes, between)
    reflected = nodes.vector_math("ADD", nodes.vector_math("MULTIPLY", once, transmitted), r)
    mirror = nodes.add("ShaderNodeBsdfGlossy", {"Color": reflected, "Roughness": roughness, **shading},
                       distribution="GGX").outputs[0]
    return nodes.sum(nodes.add("ShaderNodeBsdfTransparent", {"Color": transmitted}).outputs[0], mirror)


def absorption(nodes, m):
    """Cycles absorbs (1 - color) density; the colour left after a distance d is exp(-sigma d)."""
    sigma = [-np.log(max(c, 1e-30)) / m["attenuation_distance"] for c in m["attenuation_color"]]
    density = max(max(sigma), 1e-9)
    color = tuple(1.0 - s / density for s in sigma)
    return nodes.add("ShaderNodeVolumeAbsorption", {"Color": color, "Density": density}).outputs[0]


def roughness_metallic(nodes, m, scene):
    roughness, metallic = abs(m["specular_roughness"]), m["metallic"]
    if m["metallic_roughness_texture"]:
        texture = texture_node(nodes, m["metallic_roughness_texture"], scene, False)
        channels = nodes.add("ShaderNodeSeparateColor", {0: texture.outputs["Color"]}).outputs
        roughness = nodes.math("MULTIPLY", channels[1], roughness)
        metallic = nodes.math("MULTIPLY", channels[2], metallic)
    return roughness, metallic


def reflection(nodes, m, scene, base, normal):
    shading = {"Normal": normal} if normal is not None else {}
    sigma = -m["diffuse_roughness"] if m["diffuse_roughness"] < 0 else 0.0
    if m["f0"] == 0 and m["metallic"] == 0:
        return nodes.add("ShaderNodeBsdfDiffuse", {"Color": base, "Roughness": sigma, **shading}).outputs[0]

    roughness, metallic = roughness_metallic(nodes, m, scene)
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
