// record.cpp - Pictures and films of the window.
#include "tools/view/record.h"

#include <unistd.h>

namespace
{

constexpr uint32_t film_step = 2; // frames of 1/60 s for one of the film

hair_image read_image(const viewer& viewer, std::vector<unsigned char>& pixels)
{
    view_stage_read(viewer.stage, pixels);
    hair_image image = {};
    image.width = (uint32_t)viewer.stage.width;
    image.height = (uint32_t)viewer.stage.height;
    image.encoded = pixels.data();
    return image;
}

} // namespace

std::string view_new_name(const char* ending)
{
    std::string name;
    for (int i = 1; i < 10000; ++i) {
        name = "hair-view-" + std::to_string(i) + ending;
        if (access(name.c_str(), F_OK)) break;
    }
    return name;
}

int view_write_picture(const viewer& viewer, const std::string& path)
{
    std::vector<unsigned char> pixels;
    hair_image image = read_image(viewer, pixels);
    hair_output output;
    if (!hair_output_open(TOOL, path.c_str(), &output)) return HAIR_EXIT_RUNTIME;
    if (hair_image_write_png(&image, output.file))
        return hair_output_commit(&output) ? HAIR_EXIT_OK : HAIR_EXIT_RUNTIME;
    hair_complain(TOOL, "%s: cannot write the picture", path.c_str());
    hair_output_discard(&output);
    return HAIR_EXIT_RUNTIME;
}

int view_record_begin(viewer& viewer, const std::string& path)
{
    view_film& film = viewer.film;
    film.path = path;
    film.frames = 0;
    int code = hair_frame_writer_plan(TOOL, film.path.c_str(), (uint32_t)viewer.stage.width,
                                      (uint32_t)viewer.stage.height, 2, &film.writer);
    if (!code && !hair_frame_writer_open(&film.writer, 60.0 / film_step)) code = HAIR_EXIT_RUNTIME;
    film.is_on = !code;
    return code;
}

bool view_record_is_due(const viewer& viewer)
{
    return viewer.film.is_on && viewer.frame % film_step == 0;
}

int view_record_frame(viewer& viewer)
{
    view_film& film = viewer.film;
    if (!view_record_is_due(viewer)) return HAIR_EXIT_OK;
    bool is_resized = film.writer.width != (uint32_t)viewer.stage.width ||
                      film.writer.height != (uint32_t)viewer.stage.height;
    if (is_resized) return view_record_end(viewer);
    hair_image image = read_image(viewer, film.pixels);
    if (hair_frame_writer_put(&film.writer, &image, film.frames++)) return HAIR_EXIT_OK;
    film.is_on = false;
    hair_frame_writer_discard(&film.writer);
    return HAIR_EXIT_RUNTIME;
}

int view_record_end(viewer& viewer)
{
    view_film& film = viewer.film;
    if (!film.is_on) return HAIR_EXIT_OK;
    film.is_on = false;
    if (!film.frames) {
        hair_frame_writer_discard(&film.writer);
        return HAIR_EXIT_OK;
    }
    if (!hair_frame_writer_commit(&film.writer)) return HAIR_EXIT_RUNTIME;
    viewer_say(viewer, "Wrote the film " + film.path + ".");
    return HAIR_EXIT_OK;
}
