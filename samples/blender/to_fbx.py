# SPDX-License-Identifier: Apache-2.0
"""The model of a bake for Unity: blender --background --factory-startup --python to_fbx.py -- room.baked.glb room.fbx

Stops where a mesh has lost the second UV layer, which is the map's. See docs/from-blender-to-vrchat.md.
"""
import os
import sys

import bpy
import numpy

if "bool" not in vars(numpy):
    numpy.bool = bool  # the importer of Blender 3.4 asks for it; numpy 1.24 of Debian 12 has it no longer


def main():
    glb, fbx = (os.path.abspath(name) for name in sys.argv[sys.argv.index("--") + 1 :])
    bpy.ops.wm.read_factory_settings(use_empty=True)
    bpy.ops.import_scene.gltf(filepath=glb)
    meshes = [one for one in bpy.data.objects if one.type == "MESH"]
    for one in meshes:
        layers = [layer.name for layer in one.data.uv_layers]
        print(one.name, layers, [made.name for made in one.data.materials])
        if len(layers) < 2:
            sys.exit(f"{one.name}: has no second UV layer; is {glb} the room.baked.glb of a bake?")
    bpy.ops.export_scene.fbx(
        filepath=fbx,
        object_types={"MESH", "EMPTY"},
        apply_scale_options="FBX_SCALE_ALL",  # Transform > Apply Scalings: FBX All; scale 1 in Unity
        bake_anim=False,
    )
    print(f"{fbx}: {len(meshes)} meshes")


main()
