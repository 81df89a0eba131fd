extends Node3D

@onready var box: MeshInstance3D = $Box

func _ready() -> void:
	var xr := XRServer.find_interface("OpenXR")
	if xr == null or not (xr.is_initialized() or xr.initialize()):
		push_error("no OpenXR runtime")
		get_tree().quit(1)
		return
	get_viewport().use_xr = true
	# Pixels that nothing is drawn at stay transparent: there the cameras are seen.
	get_viewport().transparent_bg = true
	DisplayServer.window_set_vsync_mode(DisplayServer.VSYNC_DISABLED)
	print("blend mode ", xr.environment_blend_mode, " of ", xr.get_supported_environment_blend_modes())

func _process(seconds: float) -> void:
	box.rotate_y(seconds)
