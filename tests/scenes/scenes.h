// scenes.h: a table of demonstration scenes. The tests of images, of OpenGL and of the web module draw them.
#ifndef SCENES_H
#define SCENES_H

#include <lambent/lambent.h>

// A scene with everything that determines its picture. The caller frees the scene.
struct demo {
    lam_scene *scene;
    lam_camera camera;
    lam_draw_params params;
    int width, height; // of the picture in the tests
    lam_pixel_format format;
};

struct demo_row {
    const char *name;    // lower case, hyphens
    const char *summary; // the contents of the picture, and the error that the picture would show
    bool (*build)(struct demo *demo, lam_error *error);
};

// The table of scenes, and its length.
extern const struct demo_row demos[];
extern const int demo_count;

// Builds a scene of the table. After a failure, there is nothing to free.
bool demo_build(const struct demo_row *row, struct demo *demo, lam_error *error);

// Builds the scene with this name. The error is LAM_BAD_ARGUMENT if no scene has the name.
bool demo_build_named(const char *name, struct demo *demo, lam_error *error);

#endif
