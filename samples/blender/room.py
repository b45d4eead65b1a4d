# SPDX-License-Identifier: Apache-2.0
"""A small room with two monitors, made by Blender: blender --background --factory-startup --python room.py -- FOLDER

Writes FOLDER/room.blend and FOLDER/room.glb. It does what docs/from-blender-to-three.md does by hand.
"""
import math
import os
import sys

import bpy

ROOM = (6.0, 5.0, 2.8)  # metres: x, y and height


def material(name, colour, roughness=0.8, radiance=0.0):
    """A Principled material; radiance (nits) > 0 makes it shine in its colour."""
    made = bpy.data.materials.new(name)
    made.use_nodes = True
    inputs = made.node_tree.nodes["Principled BSDF"].inputs
    inputs["Base Color"].default_value = (0, 0, 0, 1) if radiance > 0 else (*colour, 1)
    inputs["Roughness"].default_value = roughness
    if radiance > 0:
        inputs["Emission" if "Emission" in inputs else "Emission Color"].default_value = (*colour, 1)  # since 4.0
        inputs["Emission Strength"].default_value = radiance
    return made


def plane(name, size, place, turn, made):
    """A rectangle of size (x, y); its front, the side of its normal, is +Z before the turn (degrees)."""
    bpy.ops.mesh.primitive_plane_add(size=1, location=place, rotation=[math.radians(angle) for angle in turn])
    return finish(name, (*size, 1), made)


def box(name, size, place, turn, made):
    """A box of this size that stands with its bottom at `place`, turned about the vertical (degrees)."""
    x, y, z = place
    bpy.ops.mesh.primitive_cube_add(size=1, location=(x, y, z + size[2] / 2), rotation=(0, 0, math.radians(turn)))
    return finish(name, size, made)


def finish(name, scale, made):
    made_object = bpy.context.object
    made_object.name = made_object.data.name = name
    made_object.scale = scale
    made_object.data.materials.append(made)
    bpy.ops.object.transform_apply(location=False, rotation=False, scale=True)  # Ctrl+A, Scale
    return made_object


def build():
    x, y, z = ROOM
    wall = material("Wall", (0.7, 0.68, 0.64))
    floor = material("Floor", (0.4, 0.27, 0.16), 0.35)
    fabric = material("Fabric", (0.3, 0.33, 0.4))
    wood = material("Wood", (0.5, 0.35, 0.2), 0.5)
    plane("Floor", (x, y), (0, 0, 0), (0, 0, 0), floor)
    plane("Ceiling", (x, y), (0, 0, z), (180, 0, 0), wall)
    plane("Wall_Back", (x, z), (0, y / 2, z / 2), (90, 0, 0), wall)
    plane("Wall_Front", (x, z), (0, -y / 2, z / 2), (-90, 0, 0), wall)
    plane("Wall_Left", (z, y), (-x / 2, 0, z / 2), (0, 90, 0), wall)
    plane("Wall_Right", (z, y), (x / 2, 0, z / 2), (0, -90, 0), wall)
    box("Table", (1.4, 0.8, 0.45), (-0.4, 0.3, 0), 12, wood)
    box("Sofa", (2.0, 0.8, 0.7), (-0.4, -1.3, 0), 0, fabric)
    box("Shelf", (0.4, 1.2, 1.8), (1.5, -0.6, 0), 0, wood)
    box("Crate", (0.5, 0.5, 0.5), (1.6, 1.2, 0), 30, wood)

    # Screens: flat, 3 cm off the wall, their normals into the room.
    warm = material("Screen_Warm", (1.0, 0.75, 0.5), radiance=6)
    cold = material("Screen_Cold", (0.4, 0.7, 1.0), radiance=6)
    plane("Monitor_R", (1.8, 1.0), (-0.6, y / 2 - 0.03, 1.4), (90, 0, 0), warm)
    plane("Monitor_G", (1.4, 0.8), (x / 2 - 0.03, 0.3, 1.5), (90, 0, -90), cold)
    bpy.data.objects["Monitor_R"]["monitor"] = "R"  # custom properties: the channel, whatever the name becomes
    bpy.data.objects["Monitor_G"]["monitor"] = "G"

    bpy.ops.object.camera_add(location=(-2.7, -2.3, 1.9), rotation=(math.radians(72), 0, math.radians(-42)))
    bpy.context.object.name = "Camera"
    bpy.context.object.data.angle = math.radians(75)
    bpy.context.scene.camera = bpy.context.object


def main():
    folder = os.path.abspath(sys.argv[sys.argv.index("--") + 1])
    os.makedirs(folder, exist_ok=True)
    bpy.ops.wm.read_factory_settings(use_empty=True)
    build()
    bpy.ops.wm.save_as_mainfile(filepath=os.path.join(folder, "room.blend"))
    bpy.ops.export_scene.gltf(
        filepath=os.path.join(folder, "room.glb"),
        export_format="GLB",
        export_extras=True,  # Include > Custom Properties
        export_cameras=True,  # Include > Cameras
        export_apply=True,  # Mesh > Apply Modifiers
    )


main()
