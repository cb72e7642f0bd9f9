// decode.c: measures the decoding of a model's pictures: `decode FILE…` reads one after another and keeps all until it
// ends.
#include <lambent/image.h>

#include <stdio.h>

int main(int count, char **names)
{
    for (int i = 1; i < count; i++) {
        lam_image image; // freed by the end of the process
        lam_error error = {0};
        if (!lam_image_load(&image, names[i], NULL, &error)) {
            fprintf(stderr, "decode: %s\n", error.text);
            return 1;
        }
    }
    return 0;
}
