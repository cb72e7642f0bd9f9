// decode.c: decodes a model's pictures, to measure the time. `decode FILE…` reads the pictures one after the other and
// keeps all of them until it ends.
#include <lambent/image.h>

#include <stdio.h>

int main(int count, char **names)
{
    for (int i = 1; i < count; i++) {
        lam_image image; // freed when the process ends
        lam_error error = {0};
        if (!lam_image_load(&image, names[i], NULL, &error)) {
            fprintf(stderr, "decode: %s\n", error.text);
            return 1;
        }
    }
    return 0;
}
