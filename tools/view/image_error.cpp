// image_error.cpp - Visible error of the picture at rest, against the mean of many pictures that
// are shifted by fractions of a pixel.
#include "tools/view/image_error.h"

#include <epoxy/gl.h>

#include <math.h>

extern "C" {
#include "tools/common/flip.h"
}

namespace
{

constexpr uint32_t first_pictures = 8; // The error is measured after 8, 16, 32, ... pictures.

// Compute the i-th shift, in pixels. Any number of shifts is evenly distributed over the square by
// multiples of powers of the plastic number (Roberts 2018).
void find_shift(uint32_t i, float out[2])
{
    const double step[2] = {0.7548776662466927, 0.5698402909980532};
    for (int k = 0; k < 2; ++k) out[k] = (float)(fmod(0.5 + step[k] * (i + 1), 1) - 0.5);
}

// Encode a linear colour as the picture in the window, by the curve of hair_tone_frag.
float encode(float linear, float exposure)
{
    float c = exposure * linear;
    if (c > 0.5f) c = 1 - 0.5f * expf(1 - 2 * c);
    return c > 0.0031308f ? 1.055f * powf(c, 1 / 2.4f) - 0.055f : 12.92f * c;
}

void compute(view_image_error* error)
{
    std::vector<float> errors((size_t)error->width * error->height);
    double sum = -1;
    if (hair_flip(error->reference.data(), error->shown.data(), error->width, error->height,
                  HAIR_FLIP_DISPLAY, errors.data())) {
        sum = 0;
        for (float e : errors) sum += (double)e;
        sum /= (double)errors.size();
    }
    error->next_flip = sum;
    error->is_done = true;
}

void begin_flip(view_image_error& error, const hair_scene& scene, unsigned shown, uint32_t samples)
{
    view_image_error_finish(error);
    size_t values = error.sum.size();
    error.shown.resize(values);
    view_image_error_reference(error, scene.exposure, error.reference);
    glGetTextureImage(shown, 0, GL_RGB, GL_FLOAT, (GLsizei)(values * sizeof(float)), error.shown.data());
    error.samples = samples;
    error.is_done = false;
    error.thread = std::thread(compute, &error);
}

void restart(view_image_error& error, uint32_t width, uint32_t height, uint64_t motion)
{
    view_image_error_finish(error);
    error.motion = motion;
    error.width = width;
    error.height = height;
    error.pictures = 0;
    error.flip = -1;
    error.sum.assign(3 * (size_t)width * height, 0);
}

} // namespace

void view_image_error_reference(const view_image_error& error, float exposure, std::vector<float>& out)
{
    out.resize(error.pictures ? error.sum.size() : 0);
    for (size_t i = 0; i < out.size(); ++i) out[i] = encode(error.sum[i] / (float)error.pictures, exposure);
}

void view_image_error_finish(view_image_error& error)
{
    if (!error.thread.joinable()) return;
    error.thread.join();
    error.flip = error.next_flip;
}

int view_image_error_update(view_image_error& error, view_session& session, const hair_scene& scene,
                            unsigned shown, uint64_t motion)
{
    const view_quality& quality = view_quality_of(0);
    GLint width = 0, height = 0;
    glGetTextureLevelParameteriv(shown, 0, GL_TEXTURE_WIDTH, &width);
    glGetTextureLevelParameteriv(shown, 0, GL_TEXTURE_HEIGHT, &height);
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    glPixelStorei(GL_PACK_ROW_LENGTH, 0);
    bool is_other =
        error.motion != motion || error.width != (uint32_t)width || error.height != (uint32_t)height;
    if (is_other || error.sum.empty()) restart(error, (uint32_t)width, (uint32_t)height, motion);
    if (error.is_done) view_image_error_finish(error);
    if (error.pictures * quality.samples >= view_reference_samples) return HAIR_EXIT_OK;

    float shift[2];
    find_shift(error.pictures, shift);
    hair_render* present = session.render;
    int code = view_session_draw_shifted(session, scene, error.width, error.height, quality, shift);
    unsigned texture = session.render ? hair_render_linear_texture(session.render) : 0;
    session.render = present;
    if (code) return code;
    std::vector<float> pixels(error.sum.size());
    glGetTextureImage(texture, 0, GL_RGB, GL_FLOAT, (GLsizei)(pixels.size() * sizeof(float)), pixels.data());
    for (size_t i = 0; i < pixels.size(); ++i) error.sum[i] += pixels[i];
    ++error.pictures;
    bool is_power = !(error.pictures & (error.pictures - 1));
    if (error.pictures >= first_pictures && is_power)
        begin_flip(error, scene, shown, error.pictures * quality.samples);
    return HAIR_EXIT_OK;
}
