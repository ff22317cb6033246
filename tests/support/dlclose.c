// dlclose.c - a dlclose() that keeps the OpenGL driver loaded to the end of the program, and leaks
// of the driver out of the report.
//
// Leaks are searched at the end of the program. Without this file EGL has then unloaded the driver.
// The driver's own leaks of a few hundred bytes would be reported without a name by which to
// suppress them.

int dlclose(void* library);
const char* __lsan_default_suppressions(void);

int dlclose(void* library)
{
    (void)library;
    return 0;
}

const char* __lsan_default_suppressions(void)
{
    return "leak:_dri.so\nleak:libEGL_mesa.so\nleak:libLLVM\nleak:libgallium\n";
}
