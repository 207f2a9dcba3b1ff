# The scene of pipelines/gltf_scene.mk, as it was made and exported by Blender 3.4:
# blender -b --python scene.py -- scene.glb
# SPDX-License-Identifier: GPL-3.0-or-later
import bpy, math, mathutils, sys

bpy.ops.wm.read_factory_settings(use_empty=True)
bpy.ops.preferences.addon_enable(module="io_scene_gltf2")
scene = bpy.context.scene

# What the exporter takes a thickness from, for KHR_materials_volume.
settings = bpy.data.node_groups.new("glTF Material Output", "ShaderNodeTree")
settings.inputs.new("NodeSocketFloat", "Thickness")


def material(name, volume=None, **inputs):
    made = bpy.data.materials.new(name)
    made.use_nodes = True
    nodes, links = made.node_tree.nodes, made.node_tree.links
    shader = nodes["Principled BSDF"]
    for key, value in inputs.items():
        shader.inputs[key.replace("_", " ")].default_value = value
    if volume:
        colour, distance = volume
        absorption = nodes.new("ShaderNodeVolumeAbsorption")
        absorption.inputs["Color"].default_value = (*colour, 1)
        absorption.inputs["Density"].default_value = 1 / distance
        links.new(absorption.outputs[0], nodes["Material Output"].inputs["Volume"])
        group = nodes.new("ShaderNodeGroup")
        group.node_tree = settings
        group.inputs["Thickness"].default_value = 1
    return made


def keep(name, made, smooth=True):
    thing = bpy.context.object
    thing.name = thing.data.name = name
    thing.data.materials.append(made)
    if smooth:
        bpy.ops.object.shade_smooth()
    return thing


def turned(name, profile, made, steps=96):
    """A closed profile (radius, height), from the axis to the axis, turned round Z."""
    points, faces, rings = [], [], []
    for radius, height in profile:
        if radius == 0:
            rings.append([len(points)] * steps)
            points.append((0, 0, height))
            continue
        rings.append([len(points) + i for i in range(steps)])
        for i in range(steps):
            angle = 2 * math.pi * i / steps
            points.append((radius * math.cos(angle), radius * math.sin(angle), height))
    for low, high in zip(rings, rings[1:]):
        for i in range(steps):
            j = (i + 1) % steps
            faces.append([c for k, c in enumerate((low[i], low[j], high[j], high[i]))
                          if c not in (low[i], low[j], high[j], high[i])[:k]])
    mesh = bpy.data.meshes.new(name)
    mesh.from_pydata(points, [], faces)
    mesh.materials.append(made)
    for polygon in mesh.polygons:
        polygon.use_smooth = True
    mesh.use_auto_smooth, mesh.auto_smooth_angle = True, math.radians(40)
    thing = bpy.data.objects.new(name, mesh)
    scene.collection.objects.link(thing)
    return thing


def rounded(corner, towards, away, radius, steps=6):
    """Points that round a corner off between the ways to two others."""
    corner, towards, away = map(mathutils.Vector, (corner, towards, away))
    start = corner + radius * (towards - corner).normalized()
    end = corner + radius * (away - corner).normalized()
    bend = []
    for i in range(steps + 1):
        t = i / steps
        bend.append(tuple((1 - t) ** 2 * start + 2 * t * (1 - t) * corner + t ** 2 * end))
    return bend


glass = material("Glass", Base_Color=(1, 1, 1, 1), Transmission=1, IOR=1.5, Roughness=0)
tea = material("Tea", Base_Color=(1, 1, 1, 1), Transmission=1, IOR=1.333, Roughness=0,
               volume=((0.85, 0.38, 0.08), 0.35))
blue = material("Blue", Base_Color=(1, 1, 1, 1), Transmission=1, IOR=1.6, Roughness=0,
                volume=((0.25, 0.55, 0.95), 0.3))
gold = material("Gold", Base_Color=(1, 0.77, 0.34, 1), Metallic=1, Roughness=0)
table = material("Table", Base_Color=(0.62, 0.58, 0.52, 1), Roughness=0.9)

# What is in the glass reaches into its wall; the glass comes later, and is there.
turned("Tea", [(0, 0.12), (0.37, 0.12), (0.37, 0.62), (0, 0.62)], tea)
outer, inner, foot, rim = 0.43, 0.34, 0.0, 0.95
turned("Tumbler",
       [(0, foot)] + rounded((outer, foot), (0, foot), (outer, rim), 0.06)
       + rounded((outer, rim), (outer, foot), (inner, rim), 0.044)
       + rounded((inner, rim), (outer, rim), (inner, 0.14), 0.044)
       + rounded((inner, 0.14), (inner, rim), (0, 0.14), 0.08) + [(0, 0.14)], glass)
mesh = bpy.ops.mesh
mesh.primitive_uv_sphere_add(radius=0.22, location=(0.72, -0.28, 0.22), segments=64, ring_count=32)
keep("Marble", blue)
mesh.primitive_torus_add(major_radius=0.24, minor_radius=0.06, location=(-0.7, -0.3, 0.06),
                         major_segments=72, minor_segments=24)
keep("Ring", gold)
mesh.primitive_plane_add(size=2.6, location=(0, 0.1, 0))
keep("Table", table, smooth=False)


def place(name, data, location, target):
    thing = bpy.data.objects.new(name, data)
    scene.collection.objects.link(thing)
    thing.location = location
    thing.rotation_euler = (mathutils.Vector(target) - thing.location).to_track_quat("-Z", "Y").to_euler()
    return thing


key = bpy.data.lights.new("Key", "SPOT")
key.energy, key.spot_size, key.spot_blend = 260, math.radians(55), 0.5
place("Key", key, (1.5, 2.2, 2.4), (0, 0, 0.2))
sun = bpy.data.lights.new("Sun", "SUN")
sun.energy, sun.color = 0.9, (0.75, 0.85, 1)
place("Sun", sun, (-2, -2, 4), (0, 0, 0))
camera = bpy.data.cameras.new("Camera")
camera.lens = 48
scene.camera = place("Camera", camera, (-0.35, -3.3, 1.75), (0, 0, 0.28))
scene.render.resolution_x, scene.render.resolution_y = 640, 480

bpy.ops.export_scene.gltf(filepath=sys.argv[sys.argv.index("--") + 1], export_cameras=True,
                          export_lights=True, export_texcoords=False)
