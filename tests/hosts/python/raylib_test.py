"""A window and a render texture of raylib have the same pixels after hair as before.

raylib asks for OpenGL 3.3 and gets the newest version that the driver has. raylib keeps no state of OpenGL
beyond its batch, which must be drawn before hair is.
"""

import os
import sys

import numpy as np

import guest

try:
    import raylib as rl
except ImportError:
    guest.missing("raylib")


def matrix(m):
    """Return a matrix of raylib for column vectors."""
    return np.array([[getattr(m, f"m{row + 4 * column}") for column in range(4)] for row in range(4)])


def draw_scene(hair, camera):
    """Draw a wall behind the hair, hair, and a quad in front of the left half."""
    rl.ClearBackground((25, 50, 75, 255))
    rl.BeginMode3D(camera)
    rl.DrawCube((0, 1.5, -0.6), 0.9, 3, 0.02, (25, 75, 50, 255))
    rl.DrawCube((-0.25, 1.5, 0.4), 0.5, 3, 0.02, (200, 100, 25, 255))
    if hair:
        rl.rlDrawRenderBatchActive()
        hair.draw(matrix(rl.rlGetMatrixModelview()), matrix(rl.rlGetMatrixProjection()))
    rl.DrawSphereWires((-0.1, 1.5, 0.6), 0.02, 6, 6, (255, 255, 255, 255))  # It would show lost state.
    rl.EndMode3D()


def to_array(image):
    rl.ImageFormat(image, rl.PIXELFORMAT_UNCOMPRESSED_R8G8B8A8)
    size = image.width * image.height * 4
    out = np.frombuffer(rl.ffi.buffer(image.data, size), np.uint8).reshape(image.height, image.width, 4).copy()
    rl.UnloadImage(image[0])
    return out


def draw_window(hair, camera, _texture):
    """Draw a frame into the window, and return its pixels."""
    rl.BeginDrawing()
    draw_scene(hair, camera)
    rl.rlDrawRenderBatchActive()
    out = to_array(rl.ffi.new("Image*", rl.LoadImageFromScreen()))
    rl.EndDrawing()
    return out


def draw_texture(hair, camera, texture):
    """Draw into a framebuffer of raylib, and return its pixels."""
    rl.BeginTextureMode(texture)
    draw_scene(hair, camera)
    rl.EndTextureMode()
    return to_array(rl.ffi.new("Image*", rl.LoadImageFromTexture(texture.texture)))


def main():
    """Draw without hair, with hair in several frames, and without hair again."""
    rl.SetTraceLogLevel(rl.LOG_WARNING)
    rl.SetConfigFlags(rl.FLAG_WINDOW_HIDDEN)
    rl.InitWindow(guest.SIZE, guest.SIZE, b"host")
    if not rl.IsWindowReady():
        sys.exit("raylib opens no window: raylib_test.py needs a display, such as that of xvfb-run.")
    if os.environ.get("MESA_GL_VERSION_OVERRIDE") == "3.3":
        guest.check_refusal()
        print("raylib: a context of OpenGL 3.3 is refused")
        return
    camera = rl.ffi.new("Camera3D*", {"position": (0, 1.52, 1.1), "target": (0, 1.52, 0), "up": (0, 1, 0),
                                      "fovy": 32, "projection": rl.CAMERA_PERSPECTIVE})[0]  # fmt: skip
    texture = rl.LoadRenderTexture(guest.SIZE, guest.SIZE)
    for name, draw in (("window", draw_window), ("render texture", draw_texture)):
        before = draw(None, camera, texture)
        hair = guest.Guest()
        with_hair = [draw(hair, camera, texture) for _ in range(4)]
        after = [draw(None, camera, texture)]
        error = hair.get_error()
        hair.stop()
        after.append(draw(None, camera, texture))
        count = guest.check(hair, before, with_hair, after)
        assert error == 0, f"OpenGL error {error:#x}"
        print(f"raylib, {name}: 0 pixels of the host differ, hair covers {count}")
        if len(sys.argv) > 1:
            guest.libhair.write_png(f"{sys.argv[1]}_{name.replace(' ', '_')}.png", with_hair[-1])
    rl.UnloadRenderTexture(texture)
    rl.CloseWindow()


if __name__ == "__main__":
    main()
