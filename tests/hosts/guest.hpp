// guest.hpp - hair in the OpenGL context of a host in C++.
#ifndef HAIR_TESTS_HOSTS_GUEST_HPP
#define HAIR_TESTS_HOSTS_GUEST_HPP

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
extern "C" {
#include <cmocka.h>
}

#include <cstdlib>
#include <cstring>
#include <hair/hair.h>
#include <hair/hair_asset.h>
#include <unistd.h>

constexpr int HOST_SIZE = 96;

// Run the program again under a virtual display unless there is a display.
inline void host_need_display(char** argv)
{
    if (!getenv("DISPLAY")) execlp("xvfb-run", "xvfb-run", "-a", argv[0], nullptr);
}

class guest
{
public:
    unsigned sentences = 0; // Warnings and errors of the library.

    bool is_there() const { return hair != nullptr; }

    // Start hair in the current context.
    void start(void* (*get_proc)(const char* name, void* user))
    {
        hair_asset* asset = nullptr;
        hair_groom* groom = nullptr;
        hair_host host = {nullptr, nullptr, count_sentence, &sentences};
        hair_context_desc context_desc = hair_context_desc_default();
        hair_style_desc style = hair_style_desc_default();
        hair_groom_desc groom_desc = hair_groom_desc_default();
        hair_look look = hair_look_default();
        hair_desc desc = hair_desc_default();
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

    // Step and draw, from 1.1 m in front of the head, into a framebuffer that does not encode.
    void draw()
    {
        hair_view view = hair_view_default();
        view.view[13] = -1.52f, view.view[14] = -1.1f;
        view.encode = HAIR_ENCODING_SRGB;
        std::memset(view.projection, 0, sizeof view.projection);
        view.projection[0] = view.projection[5] = 3.5f;
        view.projection[10] = -1.2f, view.projection[11] = -1, view.projection[14] = -0.44f;
        assert_int_equal(hair_step(hair, 1.0f / 60), HAIR_OK);
        assert_int_equal(hair_draw(hair, &view), HAIR_OK);
    }

    void stop()
    {
        hair_destroy(hair);
        hair_context_destroy(context);
        hair = nullptr;
    }

private:
    hair_context* context = nullptr;
    hair_instance* hair = nullptr;

    static void count_sentence(hair_log_level level, const char* sentence, void* user)
    {
        if (level == HAIR_LOG_INFO) return;
        print_message("%s\n", sentence);
        ++*static_cast<unsigned*>(user);
    }
};

#endif
