// description.h: one description of a picture, whatever its spelling, and the reader that applies it to a scene.
//
// A description is a tree of keys and values (Jansson's, src/formats/json). Two spellings make it: JSON (scene files) and
// the words of an option (words.c). A value with a unit is a string, "2r", until the scene is known: r is the radius of
// the scene's bounding sphere. A value's place (struct place) is the path of keys that leads to it, so that an error names
// the file and the path, or the option's own word. docs/scene-file.md describes the keys for users.
#ifndef DESCRIPTION_H
#define DESCRIPTION_H

#include "fields.h"
#include "importer.h"
#include "json_reader.h"
#include "name_table.h"
#include "shown_name.h"

#include <lambent/camera.h>
#include <lambent/scene_file.h>

struct sphere {
    lam_vec3 centre;
    double radius;
};

struct reader {
    struct json_reader json; // the spelling, and the error
    // the scene that is described; NULL if a light is only checked. Strings of a scene file are copied to its arena
    struct lam_scene *scene;
    lam_color_mode color;     // the colour mode of this description and its models
    const lam_camera *camera; // the camera for lights in its frame; NULL if it is not known
    struct sphere sphere;     // of the scene; a radius of 0 means that it is not yet known

    // Only for scene files:
    const struct import_source *source;
    lam_picture_settings *settings;  // in the scene's arena
    bool has_lights;                 // the file lists its lights; lights of its models are ignored
    struct name_table materials;     // the file's named materials, with their indices in the scene
    json_t *named_materials;         // their keys, or NULL
    struct name_table models_by_key; // keys of models (models.c); the values are indices in `models`
    struct scene_list models;        // pointers, in the scene's arena
};

// --- the spelling of options

// Makes an object of "key=value,key=value" in `text`, at most WORDS_MAX − 1 bytes. Numbers become numbers, 1/2/3 a list,
// and yes and no (also on and off) true and false; everything else remains a string. A flag without a value is true. If
// `first_key` is not NULL, the text begins with the value of this key, up to `end`; if `is_flag` is not NULL, unless it is
// a pair or a flag. Returns NULL on failure, with LAM_BAD_ARGUMENT.
enum { WORDS_MAX = 1024 };
json_t *words_parse(const char *text, const char *first_key, char end, bool (*is_flag)(const char *key),
                    lam_error *error);

// --- values

// These functions check the value of a key of `object` and store the value. *out is unchanged if the key is missing.
// The functions return false if the value is wrong. Numbers must be in [min, max].
bool take_whole(struct reader *r, const struct place *place, const json_t *object, const char *key, int min, int max,
                int *out);
bool take_vector(struct reader *r, const struct place *place, const json_t *object, const char *key, lam_vec3 *out);
bool take_direction(struct reader *r, const struct place *place, const json_t *object, const char *key, lam_vec3 *out);
// Gets a nonempty string. The string of a scene file is copied into the scene's arena.
bool take_text(struct reader *r, const struct place *place, const json_t *object, const char *key, const char **out);
// These functions get a colour: "#rrggbb", a colour name, one number or linear numbers. Only take_rgba allows an alpha.
bool take_rgb(struct reader *r, const struct place *place, const json_t *object, const char *key, lam_rgb *out);
bool take_rgba(struct reader *r, const struct place *place, const json_t *object, const char *key, lam_rgba *out);
// Reads the value of a field's key and stores the value in a material or light. A length may be in radii.
bool take_field(struct reader *r, const struct place *place, const json_t *object, const lam_field *field, void *out);

// Gets three numbers, or four if `w` is not NULL, and returns in *in_radii whether they are in radii of the sphere. A 0
// needs no r, and w has none.
bool take_point(struct reader *r, const struct place *place, const json_t *object, const char *key, lam_vec3 *out,
                double *w, bool *in_radii);
// Finds the scene's sphere. Without a model, its radius is 1, and lengths in radii are an error (`needed`).
bool find_sphere(struct reader *r, const struct place *place, bool needed);

extern const struct json_choice color_words[], normals_words[], cull_words[], up_words[], frame_words[],
    tangent_words[];

// --- parts of a picture

// Reads a light. Its place and direction are those for the scene, whose objects must be there.
bool read_light(struct reader *r, const struct place *place, const json_t *value, lam_light *light);

// Changes a material by the keys of an object.
bool read_material_keys(struct reader *r, const struct place *place, const json_t *object, lam_material *material);
// Reads a material: the name of a material of the file, the words of an option, or an object with keys. Missing keys are
// copied from `base`; if `base` is NULL, missing keys have their defaults. Sets *index to the material's index in the
// scene.
bool read_material(struct reader *r, const struct place *place, const json_t *value, const lam_material *base,
                   int *index);

// Reads a camera. Missing keys have the defaults of the reader's scene.
bool read_camera(struct reader *r, const struct place *place, const json_t *value, lam_camera *camera);

// Reads a transform: a list of steps, or a matrix of 16 numbers.
bool read_transform(struct reader *r, const struct place *place, const json_t *value, lam_mat4 *out);

// These functions read the sections of a scene file.
bool read_settings(struct reader *r, const json_t *root);
bool read_environment(struct reader *r, const json_t *root);
bool read_materials(struct reader *r, const json_t *root);
bool read_objects(struct reader *r, const json_t *root);

#endif
