def basis(x, y, z):
    """What E/pi sums with the first nine coefficients of radiance; x, y and z are ssphh's."""
    return (0.282095, 0.325735 * y, 0.325735 * z, 0.325735 * x, 0.273137 * x * y, 0.273137 * y * z,
            0.0788479 * (3 * z * z - 1), 0.273137 * x * z, 0.136569 * (x * x - y * y))


def ball(bpy, probe, light):
    """A sphere that shows E/pi of each normal, as a white surface would."""
    import bmesh
    mesh = bpy.data.meshes.new(probe["name"])
    shape = bmesh.new()
    bmesh.ops.create_icosphere(shape, subdivisions=3, radius=probe["radius"])
    shape.to_mesh(mesh)
    shape.free()
    colors = mesh.color_attributes.new("irradiance over pi", "FLOAT_COLOR", "POINT")
    for vertex, color in zip(mesh.vertices, colors.data):
        x, y, z = vertex.co.normalized()
        shares = basis(x, z, -y)  # Blender's z is up
        rgb = [sum(s * c[channel] for s, c in zip(shares, light)) for channel in range(3)]
        color.color = (*[max(0, value) for value in rgb], 1)
    for face in mesh.polygons:
        face.use_smooth = True
    return mesh


def glow(bpy):
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


def add_probes(data):
    """A collection with an empty for each probe, which holds its light as custom properties, and a ball that shows it."""
    import bpy
    collection = bpy.data.collections.new("ssphh light probes")
    bpy.context.scene.collection.children.link(collection)
    material = glow(bpy)
    for probe in data["probes"]:
        light = [probe["radiance"][i:i + 3] for i in range(0, len(probe["radiance"]), 3)]
        empty = bpy.data.objects.new(probe["name"], None)
        empty.empty_display_type, empty.empty_display_size = "SPHERE", probe["radius"]
        x, y, z = probe["position"]
        empty.location = (x, -z, y)
        empty["degree"], empty["radiance"] = data["degree"], probe["radiance"]
        mesh = ball(bpy, probe, light)
        mesh.materials.append(material)
        shown = bpy.data.objects.new(probe["name"] + " ball", mesh)
        shown.parent = empty
        shown.visible_shadow = False
        collection.objects.link(empty)
        collection.objects.link(shown)
    return collection


add_probes(DATA)
