// scene_reader.h: functions that all readers of scene files share: positions in the file, and values that are checked
// on access. docs/scene-file.md describes the format for users; `lambent generate scene-schema` prints a schema of the
// format for programs.
#ifndef SCENE_READER_H
#define SCENE_READER_H

#include "fields.h"
#include "importer.h"
#include "json_reader.h"
#include "name_table.h"
#include "shown_name.h"

struct scene_reader {
    const struct import_source *source;
    struct lam_scene *scene;
    lam_picture_settings *settings;  // in the scene's arena
    bool has_lights;                 // the file lists its lights; lights of its models are ignored
    lam_color_mode color;            // the colour mode of this file and its models
    json_t *materials;               // the file's named materials, or NULL
    int *material_at;                // for each of the file's materials in order, its index in the scene
    struct name_table models_by_key; // keys of models (scene_models.c); the values are indices in `models`
    struct scene_list models;        // pointers, in the scene's arena
    lam_error *error;
};

// Fails with LAM_CANNOT_READ and "NAME: PLACE: sentence". Returns false.
bool fail_place(struct scene_reader *r, const struct place *place, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

// Checks the keys of an object. An unknown key is an error; the message suggests the nearest allowed key. The list
// `keys` ends with NULL.
bool check_keys(struct scene_reader *r, const struct place *place, const json_t *object, const char *const *keys);

// These functions check the value of a key of `object` and store the value. *out is unchanged if the key is missing.
// The functions return false if the value is wrong. Numbers must be in [min, max].
bool take_number(struct scene_reader *r, const struct place *place, const json_t *object, const char *key, double min,
                 double max, double *out);
bool take_whole(struct scene_reader *r, const struct place *place, const json_t *object, const char *key, int min,
                int max, int *out);
bool take_bool(struct scene_reader *r, const struct place *place, const json_t *object, const char *key, bool *out);
bool take_vector(struct scene_reader *r, const struct place *place, const json_t *object, const char *key,
                 lam_vec3 *out);
bool take_direction(struct scene_reader *r, const struct place *place, const json_t *object, const char *key,
                    lam_vec3 *out);
// Gets a nonempty string, copied into the scene's arena.
bool take_text(struct scene_reader *r, const struct place *place, const json_t *object, const char *key,
               const char **out);
// These functions get a colour: "#rrggbb", a colour name, or linear numbers. Only take_rgba allows an alpha.
bool take_rgb(struct scene_reader *r, const struct place *place, const json_t *object, const char *key, lam_rgb *out);
bool take_rgba(struct scene_reader *r, const struct place *place, const json_t *object, const char *key, lam_rgba *out);

// Gets one of several keywords. The list `words` ends with a NULL name.
bool take_word(struct scene_reader *r, const struct place *place, const json_t *object, const char *key,
               const struct json_choice *words, int *out);
extern const struct json_choice color_words[], normals_words[], cull_words[], up_words[], frame_words[],
    tangent_words[];

void light_type_words(struct json_choice words[LAM_LIGHT_TYPE_COUNT + 1]);
void tone_words(struct json_choice words[LAM_TONE_COUNT + 1]);
// Gets the keywords of a setting of type LAM_SETTING_WORD, at most WORDS_MAX − 1 of them.
enum { WORDS_MAX = 32 };
void setting_words(const lam_setting *setting, struct json_choice words[WORDS_MAX]);

// Reads the value of a field's key and stores the value in a material or light.
bool take_field(struct scene_reader *r, const struct place *place, const json_t *object, const lam_field *field,
                void *out);

// Gets the numbers of a list, which must contain `min` to `max` numbers. `count` may be NULL.
bool numbers_of(struct scene_reader *r, const struct place *place, const json_t *list, size_t min, size_t max,
                double *out, size_t *count);

// These functions read the sections of the file into the scene.
bool read_materials(struct scene_reader *r, const json_t *root);
bool read_environment(struct scene_reader *r, const json_t *root);
bool read_objects(struct scene_reader *r, const json_t *root);
bool read_lights(struct scene_reader *r, const json_t *root);

// Reads a material. `value` is the name of a material of the file, the name of a classic material, or an object with
// keys. Missing keys are copied from `base`; if `base` is NULL, missing keys have their defaults. Sets *index to the
// material's index in the scene.
bool read_material_value(struct scene_reader *r, const struct place *place, const json_t *value,
                         const lam_material *base, int *index);
// Reads the keys of a material and stores their values in `material`.
bool read_material_keys(struct scene_reader *r, const struct place *place, const json_t *value, bool whole,
                        lam_material *material);

// Reads a transform: a list of steps, or a matrix of 16 numbers.
bool read_transform(struct scene_reader *r, const struct place *place, const json_t *value, lam_mat4 *out);

#endif
