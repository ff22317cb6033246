"""A scene of Panda3D has the same pixels after hair as before.

    panda3d_test.py compatibility|core [PICTURE.png]

By default Panda3D gets a context of the compatibility profile, of the newest version that the driver has. The
first run draws so, by EGL without a display. The second run asks for 4.5 by the setting gl-version, and gets
a context of the core profile by GLX. Panda3D caches the state of OpenGL, so lost state shows.
"""

import os
import sys

import numpy as np

import guest

try:
    from panda3d import core
except ImportError:
    guest.missing("panda3d")

# Panda3D has z up, and libhair has y up.
TO_PANDA = core.LMatrix4f.convert_mat(core.CS_yup_right, core.CS_zup_right)
FROM_PANDA = core.LMatrix4f.convert_mat(core.CS_zup_right, core.CS_yup_right)
VERTEX = """#version 330 core
uniform mat4 p3d_ModelViewProjectionMatrix;
in vec4 p3d_Vertex;
void main() { gl_Position = p3d_ModelViewProjectionMatrix * p3d_Vertex; }
"""
FRAGMENT = """#version 330 core
uniform vec4 p3d_ColorScale;
out vec4 color;
void main() { color = p3d_ColorScale; }
"""


def matrix(m):
    """Return a matrix of Panda3D, which multiplies rows, for column vectors."""
    return np.array([[m.get_cell(column, row) for column in range(4)] for row in range(4)])


class Scene:
    """A wall behind the hair, a node that draws hair, and a quad in front of the left half."""

    def __init__(self, is_core):
        settings = ["audio-library-name null", "notify-level error"]
        settings += ["load-display pandagl", "gl-version 4 5"] if is_core else ["load-display p3headlessgl"]
        core.load_prc_file_data("", "\n".join(settings))
        self.engine = core.GraphicsEngine.get_global_ptr()
        pipe = core.GraphicsPipeSelection.get_global_ptr().make_default_pipe()
        properties = core.FrameBufferProperties()
        properties.set_rgba_bits(8, 8, 8, 8)
        properties.set_depth_bits(24)
        size = core.WindowProperties(size=(guest.SIZE, guest.SIZE))
        self.buffer = pipe and self.engine.make_output(pipe, "host", 0, properties, size,
                                                       core.GraphicsPipe.BF_refuse_window)  # fmt: skip
        if not self.buffer:
            sys.exit("Panda3D makes no buffer: core needs a display, such as that of xvfb-run.")
        self.texture = core.Texture()
        self.buffer.add_render_texture(self.texture, core.GraphicsOutput.RTM_copy_ram)
        self.buffer.set_clear_color((0.1, 0.2, 0.3, 1))
        self.root = core.NodePath("root")
        self.shader = core.Shader.make(core.Shader.SL_GLSL, VERTEX, FRAGMENT) if is_core else None
        self.lens = core.PerspectiveLens()
        self.lens.set_fov(32)
        self.lens.set_near_far(0.2, 5)
        self.camera = self.root.attach_new_node(core.Camera("eye", self.lens))
        self.camera.set_pos(0, -1.1, 1.52)
        self.buffer.make_display_region().set_camera(self.camera)
        self.add_quad((-0.45, 0.45, 0, 3), 0.6, (0.1, 0.3, 0.2, 1), 0)
        self.task = None
        node = core.CallbackNode("hair")
        node.set_draw_callback(core.PythonCallbackObject(self.draw_hair))
        self.add(self.root.attach_new_node(node), 1)
        self.add_quad((-0.5, 0, 0, 3), -0.4, (0.8, 0.4, 0.1, 1), 2)

    def add(self, path, order):
        """Draw a node at its turn."""
        path.set_bin("fixed", order)
        path.node().set_bounds(core.OmniBoundingVolume())
        path.node().set_final(True)
        return path

    def add_quad(self, frame, depth, color, order):
        """Add a quad, by the left, right, lower and upper end, and by its distance behind the middle."""
        maker = core.CardMaker("quad")
        maker.set_frame(*frame)
        path = self.add(self.root.attach_new_node(maker.generate()), order)
        path.set_y(depth)
        path.set_color_scale(color)
        if self.shader:
            path.set_shader(self.shader)

    def draw_hair(self, data):
        """Run the task while the framebuffer is bound. Panda3D believes that its state stays."""
        data.set_lost_state(False)
        if self.task:
            self.task()

    def view(self):
        """Return the matrix from the world of the hair to the view, and the projection."""
        view = TO_PANDA * self.root.get_mat(self.camera) * FROM_PANDA
        return matrix(view), matrix(TO_PANDA * self.lens.get_projection_mat())

    def draw(self, task=None):
        """Draw a frame, with a task between the wall and the quad, and return its pixels."""
        self.task = task
        self.engine.render_frame()
        pixels = self.texture.get_ram_image_as("RGBA").get_data()
        return np.frombuffer(pixels, np.uint8).reshape(guest.SIZE, guest.SIZE, 4)[::-1].copy()


def main():
    """Draw without hair, with hair in several frames, and without hair again."""
    scene = Scene(sys.argv[1] == "core")
    if os.environ.get("MESA_GL_VERSION_OVERRIDE", "").startswith("3.3"):
        scene.draw(guest.check_refusal)
        print("Panda3D: a context of OpenGL 3.3 is refused")
        return
    before, started, errors = scene.draw(), [], []
    scene.draw(lambda: started.append(guest.Guest()))
    hair = started[0]

    def draw_hair():
        hair.draw(*scene.view())
        errors.append(hair.get_error())

    with_hair = [scene.draw(draw_hair) for _ in range(4)]
    count = guest.check(hair, before, with_hair, [scene.draw(), scene.draw(hair.stop), scene.draw()])
    assert errors == [0] * 4, errors
    print(f"Panda3D, {scene.buffer.get_gsg().driver_version}: 0 pixels of the host differ, hair covers {count}")
    if len(sys.argv) > 2:
        guest.libhair.write_png(sys.argv[2], with_hair[-1])


if __name__ == "__main__":
    main()
