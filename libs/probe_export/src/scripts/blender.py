import bmesh
import bpy
import numpy


def shares(normals):
    """What E/pi of each of Blender's normals sums of the first nine coefficients of radiance."""
    x, y, z = normals[:, 0], normals[:, 2], -normals[:, 1]  # Blender's z is up
    return numpy.stack((numpy.full(len(x), 0.282095), 0.325735 * y, 0.325735 * z, 0.325735 * x, 0.273137 * x * y,
                        0.273137 * y * z, 0.0788479 * (3 * z * z - 1), 0.273137 * x * z, 0.136569 * (x * x - y * y)), 1)


def glow():
    """A material that emits the balls' colours as they are."""
    material = bpy.data.materials.new("ssphh light probe")
    material.use_nodes = True
    nodes = material.node_tree.nodes
    nodes.clear()
    colors, emission, output = (nodes.new("ShaderNode" + name) for name in ("VertexColor", "Emission", "OutputMaterial"))
    colors.layer_name = "irradiance over pi"
    material.node_tree.links.new(colors.outputs["Color"], emission.inputs["Color"])
    material.node_tree.links.new(emission.outputs["Emission"], output.inputs["Surface"])
    return material


def unit_ball():
    mesh = bpy.data.meshes.new("ssphh light probe")
    shape = bmesh.new()
    bmesh.ops.create_icosphere(shape, subdivisions=3, radius=1)
    shape.to_mesh(mesh)
    shape.free()
    mesh.color_attributes.new("irradiance over pi", "FLOAT_COLOR", "POINT")
    mesh.materials.append(glow())
    for face in mesh.polygons:
        face.use_smooth = True
    return mesh


def add_probes(data):
    """A collection with an empty for each probe, which holds its light as custom properties, and a ball on it that shows E/pi of
    each normal, as a white surface would."""
    collection = bpy.data.collections.new("ssphh light probes")
    bpy.context.scene.collection.children.link(collection)
    ball = unit_ball()
    of_normals = shares(numpy.array([vertex.co for vertex in ball.vertices]))
    for probe in data["probes"]:
        empty = bpy.data.objects.new(probe["name"], None)
        empty.empty_display_type, empty.empty_display_size = "SPHERE", probe["radius"]
        x, y, z = probe["position"]
        empty.location = (x, -z, y)
        empty["degree"], empty["radiance"] = data["degree"], probe["radiance"]
        light = numpy.reshape(probe["radiance"], (-1, 3))[:9]
        colors = numpy.ones((len(of_normals), 4), numpy.float32)
        colors[:, :3] = numpy.maximum(of_normals[:, :len(light)] @ light, 0)
        mesh = ball.copy()
        mesh.color_attributes[0].data.foreach_set("color", colors.ravel())
        shown = bpy.data.objects.new(probe["name"] + " ball", mesh)
        shown.parent, shown.scale, shown.visible_shadow = empty, [probe["radius"]] * 3, False
        collection.objects.link(empty)
        collection.objects.link(shown)


add_probes(DATA)
