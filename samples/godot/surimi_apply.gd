# SPDX-License-Identifier: Apache-2.0
# Gives the surfaces of a baked scene the shader that reads the map. At import (surimi_import.gd) or at run time:
#     const Surimi := preload("surimi_apply.gd")
#     Surimi.apply($Room, "res://room/room.surimi.json")
#     Surimi.set_radiance($Room, 0, Vector3(5, 4, 3))
extends RefCounted


# `list_path`: NAME.surimi.json beside the other files of the export. Returns how many surfaces it changed.
static func apply(scene: Node, list_path: String) -> int:
	var folder := list_path.get_base_dir()
	var list: Dictionary = JSON.parse_string(FileAccess.get_file_as_string(list_path))
	var lights := _lights_of(list, scene)
	var lobes := FileAccess.get_file_as_bytes(folder.path_join("surimi_lobes.bin"))
	lights["lobes"] = ImageTexture.create_from_image(Image.create_from_data(64, 192, false, Image.FORMAT_RGBAF, lobes))
	var maps: Array[Texture2D] = []
	for file: String in list["maps"]:
		maps.append(_texture(folder.path_join(file)))
	var done := {}  # material and map -> ShaderMaterial: surfaces that shared one do so again
	var count := 0
	for mesh: MeshInstance3D in _meshes(scene):
		for surface in mesh.mesh.get_surface_count():
			var map := _map_of(mesh, surface, list)
			var source := mesh.get_active_material(surface) as BaseMaterial3D
			if map < 0 or not mesh.mesh.surface_get_format(surface) & Mesh.ARRAY_FORMAT_TEX_UV2:
				continue
			if source != null and source.transparency != BaseMaterial3D.TRANSPARENCY_DISABLED:
				push_warning("surimi: %s is transparent and stays as it is" % mesh.name)
				continue
			var key := [source, map]
			if not done.has(key):
				done[key] = _material(source, folder)
				for parameter: String in lights:
					done[key].set_shader_parameter(parameter, lights[parameter])
				done[key].set_shader_parameter("visibility_map", maps[map])
			mesh.set_surface_override_material(surface, done[key])
			count += 1
	return count


# Colour times brightness of the monitor of a channel (0, 1, 2), linear. The map stays right.
static func set_radiance(scene: Node, channel: int, radiance: Vector3) -> void:
	for mesh: MeshInstance3D in _meshes(scene):
		for surface in mesh.get_surface_override_material_count():
			var material := mesh.get_surface_override_material(surface) as ShaderMaterial
			if material == null or material.get_shader_parameter("monitor_radiance") == null:
				continue
			var all: PackedVector3Array = material.get_shader_parameter("monitor_radiance")
			all[channel] = radiance
			material.set_shader_parameter("monitor_radiance", all)


static func _meshes(node: Node) -> Array[MeshInstance3D]:
	var found: Array[MeshInstance3D] = []
	var mesh := node as MeshInstance3D
	if mesh != null and mesh.mesh != null:
		found.append(mesh)
	for child in node.get_children():
		found.append_array(_meshes(child))
	return found


static func _lights_of(list: Dictionary, scene: Node) -> Dictionary:
	var place := Transform3D.IDENTITY
	if scene is Node3D and scene.is_inside_tree():
		place = scene.global_transform
	var corners := PackedVector3Array()
	var channels := PackedInt32Array()
	for quad: Dictionary in list["quads"]:
		var numbers: Array = quad["corners"]
		for i in range(0, 12, 3):
			corners.append(place * Vector3(numbers[i], numbers[i + 1], numbers[i + 2]))
		channels.append(int(quad["channel"]) + (4 if quad["twoSided"] else 0))
	var count := channels.size()
	corners.resize(64)
	channels.resize(16)
	var radiance := PackedVector3Array([Vector3.ZERO, Vector3.ZERO, Vector3.ZERO])
	for monitor: Dictionary in list["monitors"]:
		var rgb: Array = monitor["radiance"]
		radiance[int(monitor["channel"])] = Vector3(rgb[0], rgb[1], rgb[2])
	return {
		"quad_count": count,
		"quad_corners": corners,
		"quad_channels": channels,
		"monitor_radiance": radiance,
	}


# The map that a surface reads, -1: none. Godot replaces some letters in names and adds numbers to equal ones.
static func _map_of(mesh: MeshInstance3D, surface: int, list: Dictionary) -> int:
	var own := String(mesh.name)
	for monitor: Dictionary in list["monitors"]:
		if own == _godot_name(monitor):
			return -1
	for is_exact: bool in [true, false]:
		for object: Dictionary in list["objects"]:
			var name := _godot_name(object)
			var is_same := own == name if is_exact else own.begins_with(name) and own.substr(name.length()).is_valid_int()
			var primitives: Array = object["primitives"]
			if is_same and (primitives.is_empty() or primitives.has(float(surface))):
				return int(object["map"])
	return -1


static func _godot_name(entry: Dictionary) -> String:
	var name: String = entry["name"]
	return name.validate_node_name()


# From the raw file, since the import of textures may compress what is used in 3D. Only the editor reads EXR; a running
# game takes the PNG beside it.
static func _texture(path: String) -> Texture2D:
	var file := path if Engine.is_editor_hint() else path.get_basename() + ".png"
	var image := Image.load_from_file(file)
	if image == null:
		push_error("surimi: %s is not beside the list" % file)
		return null
	if file.ends_with(".png"):
		image = _decoded(image)
	return ImageTexture.create_from_image(image)


# 8-bit sRGB as linear half floats, so that what is between texels is right in every renderer.
static func _decoded(image: Image) -> Image:
	var table := PackedFloat32Array()
	for code in 256:
		table.append(Color8(code, 0, 0).srgb_to_linear().r)
	image.convert(Image.FORMAT_RGB8)
	var codes := image.get_data()
	var values := PackedFloat32Array()
	values.resize(codes.size())
	for i in codes.size():
		values[i] = table[codes[i]]
	var size := image.get_size()
	var linear := Image.create_from_data(size.x, size.y, false, Image.FORMAT_RGBF, values.to_byte_array())
	linear.convert(Image.FORMAT_RGBH)
	return linear


static func _material(source: BaseMaterial3D, folder: String) -> ShaderMaterial:
	var shader := Shader.new()
	var code := FileAccess.get_file_as_string(folder.path_join("surimi.gdshader"))
	code = code.replace("#include \"", "#include \"" + folder.path_join(""))
	var is_double_sided := source != null and source.cull_mode == BaseMaterial3D.CULL_DISABLED
	shader.code = code.replace("cull_back", "cull_disabled") if is_double_sided else code
	var material := ShaderMaterial.new()
	material.shader = shader
	if source == null:
		return material
	material.resource_name = source.resource_name
	var parameters := {
		"albedo": source.albedo_color,
		"texture_albedo": source.albedo_texture,
		"roughness": source.roughness,
		"metallic": source.metallic,
		"texture_orm": source.roughness_texture if source.roughness_texture != null else source.metallic_texture,
		"has_normal_map": source.normal_enabled and source.normal_texture != null,
		"texture_normal": source.normal_texture,
		"normal_scale": source.normal_scale,
		"emission": source.emission if source.emission_enabled else Color.BLACK,
		"emission_energy": source.emission_energy_multiplier,
		"texture_emission": source.emission_texture,
	}
	for parameter: String in parameters:
		if parameters[parameter] != null:
			material.set_shader_parameter(parameter, parameters[parameter])
	return material
