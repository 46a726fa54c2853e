// A shape as bytes: created once, stored in a file, checked byte by byte when it is read.
#include <ovoid/ovoid.h>

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

int main(void) {
    ovoid_error error;
    ovoid_shape_options options = {.radius = 0.1};
    ovoid_shape *cone = ovoid_shape_create_pyramid(&(ovoid_prism){1, 2, 24}, &options, &error);
    if (!cone) {
        fprintf(stderr, "%s\n", error.message);
        return 1;
    }

    // Ask for the size, then write; the bytes can go into a file as they are.
    size_t size = ovoid_shape_write(cone, NULL, 0);
    unsigned char *bytes = malloc(size);
    FILE *file = tmpfile();
    if (!bytes || !file) {
        fprintf(stderr, "no memory or no file\n");
        free(bytes);
        return 1;
    }
    ovoid_shape_write(cone, bytes, size);
    fwrite(bytes, 1, size, file);

    // Read it back.
    rewind(file);
    memset(bytes, 0, size);
    size_t got = fread(bytes, 1, size, file);
    ovoid_shape *copy = ovoid_shape_read(bytes, got, NULL, &error);
    printf("%zu bytes, read back: %s\n", size, copy ? "yes" : error.message);

    // One flipped bit is detected.
    bytes[size / 2] ^= 1;
    ovoid_shape *broken = ovoid_shape_read(bytes, got, NULL, &error);
    printf("with one bit flipped: %s\n", broken ? "not noticed" : error.message);

    int right = copy && !broken && ovoid_shape_get_radius(copy) == 0.1;
    ovoid_shape_destroy(copy);
    ovoid_shape_destroy(cone);
    fclose(file);
    free(bytes);
    return right ? 0 : 1;
}
