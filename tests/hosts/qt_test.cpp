// qt_test.cpp - a QOpenGLWidget of Qt 6 paints the same pixels after hair as before. QPainter draws
// behind the hair and in front of its left half, in the state that OpenGL has after hair.
#include "tests/hosts/guest.hpp"

#include <QApplication>
#include <QOpenGLContext>
#include <QOpenGLFunctions>
#include <QOpenGLWidget>
#include <QPainter>
#include <QSurfaceFormat>

namespace
{
void* get_proc(const char* name, void*)
{
    return reinterpret_cast<void*>(QOpenGLContext::currentContext()->getProcAddress(name));
}

class window : public QOpenGLWidget
{
  public:
    guest hair;
    unsigned errors = 0;

  protected:
    void paintGL() override
    {
        QOpenGLFunctions* gl = QOpenGLContext::currentContext()->functions();
        QPainter painter(this);
        QLinearGradient gradient(0, 0, HOST_SIZE, HOST_SIZE);
        gradient.setColorAt(0, Qt::darkBlue), gradient.setColorAt(1, Qt::darkGreen);
        painter.fillRect(0, 0, HOST_SIZE, HOST_SIZE, gradient);
        painter.drawEllipse(70, 5, 20, 12);
        if (hair.is_there()) {
            painter.beginNativePainting();
            gl->glEnable(GL_DEPTH_TEST);
            gl->glClear(GL_DEPTH_BUFFER_BIT);
            hair.draw();
            errors += gl->glGetError() != GL_NO_ERROR;
            painter.endNativePainting();
        }
        painter.fillRect(0, 0, HOST_SIZE / 2, HOST_SIZE, QColor(200, 120, 40));
    }
};

unsigned count_changes(const QImage& a, const QImage& b, int first, int end)
{
    unsigned out = 0;
    for (int y = 0; y < HOST_SIZE; ++y)
        for (int x = first; x < end; ++x) out += a.pixel(x, y) != b.pixel(x, y);
    return out;
}

void pixels_of_the_widget_stay(void**)
{
    window host;
    host.resize(HOST_SIZE, HOST_SIZE);
    host.show();
    QApplication::processEvents();
    assert_true(host.isValid());
    const QImage before = host.grabFramebuffer();
    assert_true(before.pixel(HOST_SIZE - 1, 0) != before.pixel(HOST_SIZE - 1, HOST_SIZE - 1));
    host.makeCurrent();
    host.hair.start(get_proc);
    const QImage with = host.grabFramebuffer();
    assert_int_equal(count_changes(before, with, 0, HOST_SIZE / 2), 0);
    assert_true(count_changes(before, with, HOST_SIZE / 2, HOST_SIZE) > HOST_SIZE * HOST_SIZE / 20);
    host.makeCurrent();
    host.hair.stop();
    assert_int_equal(count_changes(before, host.grabFramebuffer(), 0, HOST_SIZE), 0);
    assert_int_equal(host.hair.sentences + host.errors, 0);
}
} // namespace

int main(int argc, char** argv)
{
    host_need_display(argv);
    QSurfaceFormat format;
    format.setVersion(4, 5);
    format.setProfile(QSurfaceFormat::CoreProfile);
    format.setDepthBufferSize(24), format.setStencilBufferSize(8);
    QSurfaceFormat::setDefaultFormat(format);
    const QApplication application(argc, argv);
    const CMUnitTest tests[] = {cmocka_unit_test(pixels_of_the_widget_stay)};
    return cmocka_run_group_tests(tests, nullptr, nullptr);
}
