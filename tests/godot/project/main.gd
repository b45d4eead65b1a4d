# SPDX-License-Identifier: Apache-2.0
# Shows the room of view.json, an export of surimi, by the import script that came with it; hands the picture to the page.
extends Node3D

const Import := preload("res://room/surimi_import.gd")
const Surimi := preload("res://room/surimi_apply.gd")


func _ready() -> void:
	var view: Dictionary = JSON.parse_string(FileAccess.get_file_as_string("res://view.json"))
	var document := GLTFDocument.new()
	var state := GLTFState.new()
	if document.append_from_file("res://room/%s.baked.glb" % view["name"], state) != OK:
		push_error("the glb cannot be read")
	var room: Node = Import.new()._post_import(document.generate_scene(state))
	add_child(room)
	Surimi.set_radiance(room, 0, _vector(view["radiance"]))
	var camera := Camera3D.new()
	add_child(camera)
	camera.fov = view["fov"]
	camera.look_at_from_position(_vector(view["eye"]), _vector(view["target"]))
	var world := WorldEnvironment.new()
	world.environment = Environment.new()
	world.environment.background_mode = Environment.BG_COLOR
	world.environment.background_color = Color.BLACK
	world.environment.ambient_light_source = Environment.AMBIENT_SOURCE_DISABLED
	world.environment.reflected_light_source = Environment.REFLECTION_SOURCE_DISABLED
	add_child(world)
	for frame in 4:
		await RenderingServer.frame_post_draw
	var picture := get_viewport().get_texture().get_image().save_png_to_buffer()
	JavaScriptBridge.eval("window.picture = '%s'" % Marshalls.raw_to_base64(picture), true)


func _vector(numbers: Array) -> Vector3:
	return Vector3(numbers[0], numbers[1], numbers[2])
