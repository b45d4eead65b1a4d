# SPDX-License-Identifier: Apache-2.0
# Import script of a baked glb: choose it under Import > Import Script > Path.
@tool
extends EditorScenePostImport

const Surimi := preload("surimi_apply.gd")


func _post_import(scene: Node) -> Object:
	var list := get_source_file().trim_suffix(".baked.glb") + ".surimi.json"
	print("surimi: %d surfaces read the map" % Surimi.apply(scene, list))
	return scene
