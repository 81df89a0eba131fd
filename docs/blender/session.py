# Starts Blender's virtual reality session with the world behind its scene:   blender --python session.py
# Blender asks for the world by XR_FB_passthrough; the same is "Passthrough" in the add-on VR Scene Inspection.
import bpy


def start():
    window = bpy.context.window_manager.windows[0]
    settings = bpy.context.window_manager.xr_session_settings
    settings.base_pose_type = "CUSTOM"
    settings.base_pose_location = (0, -4, 0)  # four metres before the default cube, looking at it
    settings.shading.type = "SOLID"
    settings.show_floor = False
    settings.show_passthrough = True
    area = next(area for area in window.screen.areas if area.type == "VIEW_3D")
    region = next(region for region in area.regions if region.type == "WINDOW")
    with bpy.context.temp_override(window=window, area=area, region=region):
        bpy.ops.wm.xr_session_toggle()


bpy.app.timers.register(start, first_interval=1)
