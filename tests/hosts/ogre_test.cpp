// ogre_test.cpp - a scene of OGRE 1.12 has the same pixels after hair as before. OGRE caches the
// state of OpenGL, and draws a rectangle in front of the left half of the hair.
#include <Ogre.h> // before cmocka, whose macros are names in OGRE
#include <OgreRectangle2D.h>
#include <vector>

#include "tests/hosts/guest.hpp"

// This declaration avoids GL/glx.h, whose macros are names in OGRE.
extern "C" void (*glXGetProcAddressARB(const unsigned char* name))();

namespace
{
void* get_proc(const char* name, void*)
{
    return reinterpret_cast<void*>(glXGetProcAddressARB(reinterpret_cast<const unsigned char*>(name)));
}

// Draw hair after the main queue, and before the rectangle in front.
class hair_listener : public Ogre::RenderQueueListener
{
  public:
    guest hair;
    void renderQueueEnded(Ogre::uint8 queue, const Ogre::String&, bool&) override
    {
        if (queue == Ogre::RENDER_QUEUE_MAIN && hair.is_there()) hair.draw();
    }
};

void make_program(const char* name, Ogre::GpuProgramType type, const char* text)
{
    Ogre::HighLevelGpuProgramPtr program =
        Ogre::HighLevelGpuProgramManager::getSingleton().createProgram(name, Ogre::RGN_DEFAULT, "glsl", type);
    program->setSource(text);
    program->load();
    assert_false(program->hasCompileError());
}

void add_rectangle(Ogre::SceneManager* scene, const char* name, const Ogre::Vector4& color, float right,
                   Ogre::uint8 queue)
{
    Ogre::MaterialPtr material = Ogre::MaterialManager::getSingleton().create(name, Ogre::RGN_DEFAULT);
    Ogre::Pass* pass = material->getTechnique(0)->getPass(0);
    pass->setVertexProgram("host_vertex");
    pass->setFragmentProgram("host_fragment");
    pass->getFragmentProgramParameters()->setNamedConstant("tint", color);
    pass->setDepthCheckEnabled(false);
    pass->setDepthWriteEnabled(false);
    material->load();
    auto* rectangle = new Ogre::Rectangle2D();
    rectangle->setCorners(-1, 1, right, -1);
    rectangle->setBoundingBox(Ogre::AxisAlignedBox(Ogre::AxisAlignedBox::EXTENT_INFINITE));
    rectangle->setRenderQueueGroup(queue);
    rectangle->setMaterial(material);
    scene->getRootSceneNode()->createChildSceneNode()->attachObject(rectangle);
}

using pixels = std::vector<Ogre::uint32>;

pixels draw_frame(Ogre::RenderWindow* window)
{
    pixels out(HOST_SIZE * HOST_SIZE);
    Ogre::Root::getSingleton().renderOneFrame();
    const Ogre::Box all(0, 0, HOST_SIZE, HOST_SIZE);
    window->copyContentsToMemory(all, Ogre::PixelBox(all, Ogre::PF_BYTE_RGBA, out.data()),
                                 Ogre::RenderTarget::FB_BACK);
    return out;
}

unsigned count_changes(const pixels& a, const pixels& b, size_t first, size_t end)
{
    unsigned out = 0;
    for (size_t y = 0; y < HOST_SIZE; ++y)
        for (size_t x = first; x < end; ++x) out += a[y * HOST_SIZE + x] != b[y * HOST_SIZE + x];
    return out;
}

void pixels_of_the_scene_stay(void**)
{
    Ogre::LogManager logs;
    logs.createLog("host", true, false, true);
    Ogre::Root root("", "", "");
    hair_listener listener;
    root.loadPlugin(HAIR_OGRE_PLUGINS "/RenderSystem_GL3Plus");
    root.setRenderSystem(root.getAvailableRenderers().front());
    root.initialise(false);
    Ogre::RenderWindow* window = root.createRenderWindow("host", HOST_SIZE, HOST_SIZE, false);
    Ogre::SceneManager* scene = root.createSceneManager();
    Ogre::Camera* camera = scene->createCamera("eye");
    scene->getRootSceneNode()->createChildSceneNode()->attachObject(camera);
    window->addViewport(camera)->setBackgroundColour(Ogre::ColourValue(0.1f, 0.2f, 0.3f));
    make_program(
        "host_vertex", Ogre::GPT_VERTEX_PROGRAM,
        "#version 330 core\nin vec4 vertex;\nvoid main() { gl_Position = vec4(vertex.xy, 0.0, 1.0); }\n");
    make_program("host_fragment", Ogre::GPT_FRAGMENT_PROGRAM,
                 "#version 330 core\nuniform vec4 tint;\nout vec4 color;\nvoid main() { color = tint; }\n");
    add_rectangle(scene, "wall", Ogre::Vector4(0.1f, 0.3f, 0.2f, 1), 0.8f, Ogre::RENDER_QUEUE_MAIN);
    add_rectangle(scene, "front", Ogre::Vector4(0.8f, 0.4f, 0.1f, 1), 0, Ogre::RENDER_QUEUE_9);
    scene->addRenderQueueListener(&listener);
    const pixels before = draw_frame(window);
    assert_true(before[0] != before[HOST_SIZE - 1] && before[HOST_SIZE - 1] != before[HOST_SIZE / 2 + 4]);
    listener.hair.start(get_proc);
    const pixels with = draw_frame(window);
    assert_int_equal(count_changes(before, with, 0, HOST_SIZE / 2), 0);
    assert_true(count_changes(before, with, HOST_SIZE / 2, HOST_SIZE) > HOST_SIZE * HOST_SIZE / 20);
    assert_int_equal(count_changes(with, draw_frame(window), 0, HOST_SIZE / 2), 0);
    listener.hair.stop();
    assert_int_equal(count_changes(before, draw_frame(window), 0, HOST_SIZE), 0);
    assert_int_equal(listener.hair.sentences, 0);
}
} // namespace

int main(int, char** argv)
{
    host_need_display(argv);
    const CMUnitTest tests[] = {cmocka_unit_test(pixels_of_the_scene_stay)};
    return cmocka_run_group_tests(tests, nullptr, nullptr);
}
