// embed.c - Write files as one array of bytes in C.
//
// The array is name, 0, text, 0 for each file, and an empty name at the end. One array without
// pointers needs no relocations and no writable section.
#include <stdbool.h>
#include <stdio.h>
#include <string.h>

static void put(FILE* out, int byte, long* column)
{
    fprintf(out, (*column)++ % 24 ? "%d," : "\n%d,", byte);
}

int main(int count, char** arguments)
{
    FILE* out = count > 1 ? fopen(arguments[1], "w") : NULL;
    if (!out) {
        fprintf(stderr, "usage: embed OUT.c FILE...\n");
        return 2;
    }
    fprintf(out, "const unsigned char hair_sources[] = {");
    long column = 0;
    for (int i = 2; i < count; ++i) {
        const char* name = strchr(arguments[i], '/'); // relative to glsl/
        FILE* in = fopen(arguments[i], "rb");
        if (!in || !name) {
            fprintf(stderr, "embed: cannot read %s\n", arguments[i]);
            if (in) fclose(in);
            fclose(out);
            return 1;
        }
        for (++name; *name; ++name) put(out, *name, &column);
        put(out, 0, &column);
        for (int c = fgetc(in); c != EOF; c = fgetc(in)) put(out, c, &column);
        put(out, 0, &column);
        fclose(in);
    }
    fprintf(out, "0};\n");
    bool failed = ferror(out);
    failed |= fclose(out) != 0;
    return failed;
}
