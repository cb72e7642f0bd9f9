// decode.c: what the pictures of a model take by themselves: `decode FILE…` reads them one after the other and keeps all
// until it ends.
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
