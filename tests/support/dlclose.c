// dlclose.c - keeps the OpenGL driver loaded to the end of the program, and its own leaks out of the report.
//
// Leaks are looked for when the program ends. By then EGL has unloaded the driver: what the driver itself
// forgot (a few hundred bytes, whoever calls it) would be reported without a name to suppress it by.

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
