// egl.c - windowless OpenGL context on the first usable EGL device. Hardware devices are tried
// first.
#define EGL_NO_X11
#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <hair/hair_egl.h>
#include "lib/base/host.h"

#include <stdbool.h>
#include <stdio.h>
#include <string.h>

#define MAX_DEVICES 64
#define SURFACELESS (-1) // Replaces a device's index.

struct hair_egl {
    hair_host host;
    EGLDisplay display;
    EGLContext context;
};

// EGL's devices and extensions, and the result of each attempt.
struct search {
    hair_egl* egl;
    EGLDeviceEXT devices[MAX_DEVICES];
    EGLint count;
    PFNEGLQUERYDEVICESTRINGEXTPROC device_string;
    PFNEGLGETPLATFORMDISPLAYEXTPROC platform_display;
    bool surfaceless;
    char refused[420]; // Reasons, as in "device 0 (...): ...; device 1 (...): ..."
};

static const char* error_name(EGLint error)
{
    switch (error) {
    case EGL_NOT_INITIALIZED: return "EGL_NOT_INITIALIZED";
    case EGL_BAD_ACCESS: return "EGL_BAD_ACCESS";
    case EGL_BAD_ALLOC: return "EGL_BAD_ALLOC";
    case EGL_BAD_ATTRIBUTE: return "EGL_BAD_ATTRIBUTE";
    case EGL_BAD_CONTEXT: return "EGL_BAD_CONTEXT";
    case EGL_BAD_CONFIG: return "EGL_BAD_CONFIG";
    case EGL_BAD_CURRENT_SURFACE: return "EGL_BAD_CURRENT_SURFACE";
    case EGL_BAD_DISPLAY: return "EGL_BAD_DISPLAY";
    case EGL_BAD_MATCH: return "EGL_BAD_MATCH";
    case EGL_BAD_PARAMETER: return "EGL_BAD_PARAMETER";
    case EGL_CONTEXT_LOST: return "EGL_CONTEXT_LOST";
    default: return "an unknown EGL error";
    }
}

// Return true if the space-separated list contains the whole word.
static bool lists(const char* list, const char* word)
{
    size_t length = strlen(word);
    for (const char* at = list; at && (at = strstr(at, word)); at += length)
        if ((at == list || at[-1] == ' ') && (at[length] == ' ' || at[length] == 0)) return true;
    return false;
}

static const char* extensions_of(const struct search* search, EGLint device)
{
    HAIR_ASSERT(0 <= device && device < search->count);
    const char* list =
        search->device_string ? search->device_string(search->devices[device], EGL_EXTENSIONS) : NULL;
    return list ? list : "";
}

static bool is_software(const struct search* search, EGLint device)
{
    return lists(extensions_of(search, device), "EGL_MESA_device_software");
}

// Return the familiar name of a device, such as "/dev/dri/card0" or "software".
static const char* name_of(const struct search* search, EGLint device)
{
    if (device == SURFACELESS) return "surfaceless";
    if (is_software(search, device)) return "software";
    const char* file = NULL;
    if (lists(extensions_of(search, device), "EGL_EXT_device_drm"))
        file = search->device_string(search->devices[device], EGL_DRM_DEVICE_FILE_EXT);
    return file ? file : "hardware";
}

static void label(const struct search* search, EGLint device, char* out, size_t size)
{
    if (device == SURFACELESS)
        snprintf(out, size, "Mesa's surfaceless platform");
    else
        snprintf(out, size, "device %d (%s)", device, name_of(search, device));
}

static void find_devices(struct search* search)
{
    const char* offered =
        // NULL before EGL 1.5 without client extensions.
        eglQueryString(EGL_NO_DISPLAY, EGL_EXTENSIONS);
    if (lists(offered, "EGL_EXT_platform_base"))
        search->platform_display =
            (PFNEGLGETPLATFORMDISPLAYEXTPROC)eglGetProcAddress("eglGetPlatformDisplayEXT");
    if (!search->platform_display) return;
    search->surfaceless = lists(offered, "EGL_MESA_platform_surfaceless");

    bool base = lists(offered, "EGL_EXT_device_base");
    if (!lists(offered, "EGL_EXT_platform_device")) return;
    if (base || lists(offered, "EGL_EXT_device_query"))
        search->device_string = (PFNEGLQUERYDEVICESTRINGEXTPROC)eglGetProcAddress("eglQueryDeviceStringEXT");
    if (!base && !lists(offered, "EGL_EXT_device_enumeration")) return;
    PFNEGLQUERYDEVICESEXTPROC query = (PFNEGLQUERYDEVICESEXTPROC)eglGetProcAddress("eglQueryDevicesEXT");
    if (query && !query(MAX_DEVICES, search->devices, &search->count)) search->count = 0;
}

// Create a context and make it current. Return NULL on success, or the reason of the failure.
static const char* make_context(hair_egl* egl)
{
    // The core profile is the default. Older drivers refuse to report resets.
    static const EGLint attributes[] = {EGL_CONTEXT_MAJOR_VERSION,
                                        4,
                                        EGL_CONTEXT_MINOR_VERSION,
                                        5,
                                        EGL_CONTEXT_OPENGL_RESET_NOTIFICATION_STRATEGY,
                                        EGL_LOSE_CONTEXT_ON_RESET,
                                        EGL_NONE};
    static const EGLint silent[] = {EGL_CONTEXT_MAJOR_VERSION, 4, EGL_CONTEXT_MINOR_VERSION, 5, EGL_NONE};

    HAIR_ASSERT(egl->display != EGL_NO_DISPLAY && egl->context == EGL_NO_CONTEXT);
    const char* offered = eglQueryString(egl->display, EGL_EXTENSIONS);
    if (!lists(offered, "EGL_KHR_create_context")) return "no EGL_KHR_create_context";
    if (!lists(offered, "EGL_KHR_surfaceless_context")) return "no EGL_KHR_surfaceless_context";
    if (!lists(offered, "EGL_KHR_no_config_context") && !lists(offered, "EGL_MESA_configless_context"))
        return "no EGL_KHR_no_config_context";
    if (!eglBindAPI(EGL_OPENGL_API)) return "no OpenGL, only OpenGL ES";

    egl->context = eglCreateContext(egl->display, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, attributes);
    if (egl->context == EGL_NO_CONTEXT)
        egl->context = eglCreateContext(egl->display, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, silent);
    if (egl->context == EGL_NO_CONTEXT) {
        EGLint error = eglGetError();
        return error == EGL_BAD_MATCH ? "its driver is older than OpenGL 4.5 core" : error_name(error);
    }
    if (eglMakeCurrent(egl->display, EGL_NO_SURFACE, EGL_NO_SURFACE, egl->context)) return NULL;
    const char* why = error_name(eglGetError());
    eglDestroyContext(egl->display, egl->context);
    egl->context = EGL_NO_CONTEXT;
    return why;
}

// Open the display of a device. All users of a device in a process share one display, and
// eglTerminate would close it for all of them. Displays therefore stay initialized until the
// process ends.
static const char* open_display(const struct search* search, EGLint device)
{
    hair_egl* egl = search->egl;
    HAIR_ASSERT(search->platform_display);
    egl->display = device == SURFACELESS
                       ? search->platform_display(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, NULL)
                       : search->platform_display(EGL_PLATFORM_DEVICE_EXT, search->devices[device], NULL);
    if (egl->display == EGL_NO_DISPLAY) return "it has no display";
    if (!eglInitialize(egl->display, NULL, NULL)) return error_name(eglGetError());
    return make_context(egl);
}

static void log_taken(const struct search* search, const char* device)
{
    typedef const unsigned char* (*get_string)(unsigned int name);
    get_string glGetString = (get_string)eglGetProcAddress("glGetString");
    const unsigned char* renderer = glGetString ? glGetString(0x1F01) : NULL; // GL_RENDERER
    const unsigned char* version = glGetString ? glGetString(0x1F02) : NULL; // GL_VERSION
    hair_log(&search->egl->host, HAIR_LOG_INFO, "EGL %s taken: %s, OpenGL %s", device,
             renderer ? (const char*)renderer : "an unnamed renderer",
             version ? (const char*)version : "unnamed");
}

static void try_device(struct search* search, EGLint device)
{
    char name[256];
    label(search, device, name, sizeof name);
    if (search->egl->context != EGL_NO_CONTEXT) {
        hair_log(&search->egl->host, HAIR_LOG_INFO, "EGL %s not tried: an earlier one was taken", name);
        return;
    }
    const char* why = open_display(search, device);
    if (!why) {
        log_taken(search, name);
        return;
    }
    hair_log(&search->egl->host, HAIR_LOG_INFO, "EGL %s refused: %s", name, why);
    size_t used = strlen(search->refused);
    HAIR_ASSERT(used < sizeof search->refused);
    snprintf(search->refused + used, sizeof search->refused - used, "%s%s: %s", used ? "; " : "", name, why);
}

static void try_all(struct search* search)
{
    for (EGLint i = 0; i < search->count; ++i)
        if (!is_software(search, i)) try_device(search, i);
    for (EGLint i = 0; i < search->count; ++i)
        if (is_software(search, i)) try_device(search, i);
    if (search->surfaceless) try_device(search, SURFACELESS);
}

static hair_result create(struct search* search, int device)
{
    const hair_host* host = &search->egl->host;
    find_devices(search);
    if (device < -1 || device >= search->count)
        return hair_fail(host, HAIR_ERROR_ARGUMENT, "hair_egl_create: device is %d, not in [-1, %d]", device,
                         search->count - 1);
    if (device >= 0)
        try_device(search, device);
    else
        try_all(search);
    if (search->egl->context != EGL_NO_CONTEXT) return HAIR_OK;
    return hair_fail(host, HAIR_ERROR_OPENGL, "no EGL device gives OpenGL 4.5 core: %s",
                     *search->refused ? search->refused : "EGL lists none");
}

hair_result hair_egl_create(const hair_host* host, int device, hair_egl** out)
{
    hair_host own = hair_host_or_default(host);
    if (!out) return hair_fail(&own, HAIR_ERROR_ARGUMENT, "hair_egl_create: out is NULL");
    hair_egl* egl = hair_alloc(&own, 1, sizeof *egl);
    if (!egl) return hair_fail_memory(&own, "an EGL context");
    egl->host = own;
    egl->context = EGL_NO_CONTEXT;
    struct search search = {.egl = egl};

    hair_result result = create(&search, device);
    if (result)
        hair_free(&own, egl);
    else
        *out = egl;
    return result;
}

void hair_egl_destroy(hair_egl* egl)
{
    if (!egl) return;
    if (eglGetCurrentContext() == egl->context) hair_egl_make_current(NULL);
    eglDestroyContext(egl->display, egl->context);
    hair_host host = egl->host;
    hair_free(&host, egl);
}

hair_result hair_egl_make_current(hair_egl* egl)
{
    EGLDisplay display = egl ? egl->display : eglGetCurrentDisplay();
    if (display == EGL_NO_DISPLAY) return HAIR_OK; // No context is current already.
    if (egl) eglBindAPI(EGL_OPENGL_API); // The API is bound per thread, and defaults to OpenGL ES.
    if (eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, egl ? egl->context : EGL_NO_CONTEXT))
        return HAIR_OK;
    EGLint error = eglGetError();
    if (!egl) return HAIR_ERROR_OPENGL;
    return hair_fail(&egl->host, HAIR_ERROR_OPENGL, "the EGL context cannot be made current here: %s",
                     error_name(error));
}

void* hair_egl_get_proc(const char* name, void* user)
{
    (void)user;
    if (!name) return NULL;
    void (*function)(void) = eglGetProcAddress(name);
    void* address;
    // C has no cast between function and object pointers.
    memcpy(&address, &function, sizeof address);
    return address;
}
