// qt_test.cpp - a QOpenGLWidget of Qt 6 paints the same pixels after hair as before. QPainter draws
// behind the hair and in front of its left half, in the state that OpenGL has after hair.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
extern "C" {
#include <cmocka.h>
}

#include <QApplication>
#include <QOpenGLContext>
#include <QOpenGLFunctions>
#include <QOpenGLWidget>
#include <QPainter>
#include <QSurfaceFormat>
#include <hair/hair.h>
#include <hair/hair_asset.h>
#include <cstring>
#include <unistd.h>
namespace
{
constexpr int SIZE = 96;

void* get_proc(const char* name, void*)
{
    return reinterpret_cast<void*>(QOpenGLContext::currentContext()->getProcAddress(name));
}

// Count warnings and errors.
void count_sentence(hair_log_level level, const char* sentence, void* user)
{
    if (level == HAIR_LOG_INFO) return;
    print_message("%s\n", sentence);
    ++*static_cast<unsigned*>(user);
}

// Look at the head from 1.1 m in front of it.
hair_view make_view()
{
    hair_view view = hair_view_default();
    view.view[13] = -1.52f, view.view[14] = -1.1f;
    std::memset(view.projection, 0, sizeof view.projection);
    view.projection[0] = view.projection[5] = 3.5f;
    view.encode = HAIR_ENCODING_SRGB;
    view.projection[10] = -1.2f, view.projection[11] = -1, view.projection[14] = -0.44f;
    return view;
}

class window : public QOpenGLWidget
{
  public:
    unsigned sentences = 0, errors = 0;

    void start_hair()
    {
        hair_asset* asset = nullptr;
        hair_groom* groom = nullptr;
        hair_host host = {nullptr, nullptr, count_sentence, &sentences};
        hair_context_desc context_desc = hair_context_desc_default();
        hair_style_desc style = hair_style_desc_default();
        hair_groom_desc groom_desc = hair_groom_desc_default();
        hair_look look = hair_look_default();
        hair_desc desc = hair_desc_default();
        makeCurrent();
        context_desc.host = groom_desc.host = &host;
        context_desc.get_proc = get_proc;
        look.strand.radius = 4e-4f;
        desc.look = &look;
        assert_int_equal(hair_context_create(&context_desc, &context), HAIR_OK);
        assert_int_equal(hair_asset_generate(&style, &asset), HAIR_OK);
        assert_int_equal(hair_asset_to_groom_desc(asset, &groom_desc), HAIR_OK);
        groom_desc.follower_count = 4000;
        assert_int_equal(hair_groom_create(&groom_desc, &groom), HAIR_OK);
        assert_int_equal(hair_create(context, groom, &desc, &hair), HAIR_OK);
        hair_groom_destroy(groom);
        hair_asset_destroy(asset);
    }

    void stop_hair()
    {
        makeCurrent();
        hair_destroy(hair);
        hair_context_destroy(context);
        hair = nullptr;
    }

  protected:
    void paintGL() override
    {
        QOpenGLFunctions* gl = QOpenGLContext::currentContext()->functions();
        QPainter painter(this);
        QLinearGradient gradient(0, 0, SIZE, SIZE);
        gradient.setColorAt(0, Qt::darkBlue), gradient.setColorAt(1, Qt::darkGreen);
        painter.fillRect(0, 0, SIZE, SIZE, gradient);
        if (hair) {
            painter.beginNativePainting();
            const hair_view view = make_view();
            gl->glEnable(GL_DEPTH_TEST);
            gl->glClear(GL_DEPTH_BUFFER_BIT);
            assert_int_equal(hair_step(hair, 1.0f / 60), HAIR_OK);
            assert_int_equal(hair_draw(hair, &view), HAIR_OK);
            errors += gl->glGetError() != GL_NO_ERROR;
            painter.endNativePainting();
        }
        painter.fillRect(0, 0, SIZE / 2, SIZE, QColor(200, 120, 40));
    }

  private:
    hair_context* context;
    hair_instance* hair = nullptr;
};

unsigned count_changes(const QImage& a, const QImage& b, int first, int end)
{
    unsigned out = 0;
    for (int y = 0; y < SIZE; ++y)
        for (int x = first; x < end; ++x) out += a.pixel(x, y) != b.pixel(x, y);
    return out;
}

void pixels_of_the_widget_stay(void**)
{
    window host;
    host.resize(SIZE, SIZE), host.show(), QApplication::processEvents();
    assert_true(host.isValid());
    const QImage before = host.grabFramebuffer();
    assert_true(before.pixel(SIZE - 1, 0) != before.pixel(SIZE - 1, SIZE - 1));
    host.start_hair();
    const QImage with = host.grabFramebuffer();
    assert_int_equal(count_changes(before, with, 0, SIZE / 2), 0);
    assert_true(count_changes(before, with, SIZE / 2, SIZE) > SIZE * SIZE / 20);
    host.stop_hair();
    assert_int_equal(count_changes(before, host.grabFramebuffer(), 0, SIZE), 0);
    assert_int_equal(host.sentences + host.errors, 0);
}
} // namespace

int main(int argc, char** argv)
{
    if (!getenv("DISPLAY")) return execlp("xvfb-run", "xvfb-run", "-a", argv[0], nullptr);
    QSurfaceFormat format;
    format.setVersion(4, 5), format.setProfile(QSurfaceFormat::CoreProfile);
    format.setDepthBufferSize(24), format.setStencilBufferSize(8);
    QSurfaceFormat::setDefaultFormat(format);
    const QApplication application(argc, argv);
    const CMUnitTest tests[] = {cmocka_unit_test(pixels_of_the_widget_stay)};
    return cmocka_run_group_tests(tests, nullptr, nullptr);
}
