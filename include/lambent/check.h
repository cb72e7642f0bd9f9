// lambent/check.h: runs somebody's shaders over reference scenes, tells how far their pictures are from the
// right ones, and which known mistake they look like. docs/check.md tells it for teachers and students.
#ifndef LAMBENT_CHECK_H
#define LAMBENT_CHECK_H

#include "device.h"

#ifdef __cplusplus
extern "C" {
#endif

// Whose names the shaders use for what the program gives them.
typedef enum lam_check_contract {
    LAM_CONTRACT_AUTO = 0, // told by the names of uniforms and attributes
    LAM_CONTRACT_LAMBENT,  // those of `lambent shader`
    LAM_CONTRACT_PITTSBURGH,
    LAM_CONTRACT_OREGON,
    LAM_CONTRACT_NYU,
    LAM_CONTRACT_COUNT
} lam_check_contract;

LAM_API const char *lam_check_contract_name(lam_check_contract contract); // "auto", "lambent", …; NULL out of range

// One name of a contract; `row` counts from 0. False past the last one. Strings are static.
typedef struct lam_check_name {
    const char *name;     // "lights[].lightPosition" for members of a list
    const char *type;     // "vec4"
    const char *meaning;  // one line
    const char *synonyms; // other names taken for it, separated by blanks; NULL: none
    bool attribute;
} lam_check_name;
LAM_API bool lam_check_contract_row(lam_check_contract contract, int row, lam_check_name *name);

// The mistakes that are known, by their ids ("no-gate"), and what each is, in a sentence. NULL past the last.
LAM_API const char *lam_check_mistake(int index);
LAM_API const char *lam_check_mistake_says(int index);

// The reference scenes, and what each shows. NULL past the last.
LAM_API const char *lam_check_scene_name(int index);
LAM_API const char *lam_check_scene_shows(int index);

// Draws a job that lam_check_run hands out. It compiles and runs the shaders under test, which may crash the
// driver or never end: call it in a process of its own and stop that when its time is over. `drawn` is freed
// by the caller. `gl_device`: as lam_gl_params.device; NULL: the first usable one. LAM_UNSUPPORTED: no
// OpenGL; shaders that are refused are no error here.
LAM_API bool lam_check_draw(const void *job, size_t size, const char *gl_device, lam_bytes *drawn, lam_error *error);

// What came of a process that drew.
typedef enum lam_check_end {
    LAM_CHECK_DRAWN = 0, // `drawn` holds what lam_check_draw made
    LAM_CHECK_FAILED,    // `error` says why
    LAM_CHECK_TIMEOUT,   // it was stopped when its time was over
    LAM_CHECK_CRASHED,   // it died
} lam_check_end;
typedef lam_check_end lam_check_draw_fn(void *user, const lam_bytes *job, lam_bytes *drawn, lam_error *error);

// Pictures of known mistakes, kept from one check to the next: the shaders of a class are judged by the same,
// which saves nearly all of the time. Up to `bytes_most`; what does not fit is drawn again. For one thread at
// a time, and for one OpenGL device. NULL: out of memory.
typedef struct lam_check_pictures lam_check_pictures;
LAM_API lam_check_pictures *lam_check_pictures_make(size_t bytes_most, lam_error *error);
LAM_API void lam_check_pictures_free(lam_check_pictures *pictures); // NULL is fine

typedef struct lam_check_params {
    const char *fragment, *fragment_name; // GLSL, and the file's name for messages
    const char *vertex,
        *vertex_name; // NULL: a correct one is made that gives the fragment shader what it reads
    lam_check_contract contract;
    int size; // pixels of a picture's side, 32..1024; 0: 128
    // Largest difference of a channel, 1 = full range, that pixels may have; 0: 2/255. A scene passes when at
    // most one pixel in 200 has more, and the mean is not above a quarter of it.
    double tolerance;
    // LAM_FRAME_OBJECT, LAM_FRAME_CAMERA: what light positions are given in; LAM_FRAME_WORLD: the contract's own
    lam_light_frame light_frame;
    // LAM_REFLECTION_PHONG, LAM_REFLECTION_BLINN_PHONG: the highlight asked for; AUTO: the contract's own
    lam_reflection reflection;
    const char *const *scenes; // names of those to use; NULL: all that the contract can say
    int scene_count;
    const char *gl_device;        // as lam_gl_params.device; NULL: the first usable one
    lam_check_pictures *pictures; // NULL: none are kept
    lam_check_draw_fn *draw;      // NULL: in this process, for shaders that one trusts
    void *user;                   // handed to `draw`
} lam_check_params;

typedef enum lam_check_verdict {
    LAM_CHECK_PASSES = 0,
    LAM_CHECK_DIFFERS,
    LAM_CHECK_REFUSED,    // does not compile or link
    LAM_CHECK_ENDLESS,    // did not end in its time
    LAM_CHECK_CRASHES,    // the driver died of it
    LAM_CHECK_NOT_NUMBER, // NaN or infinity in a picture
} lam_check_verdict;

// How one scene came out. Differences are over the pixels whose neighbours are all inside the model; colours
// are clamped to 0…1, as a screen would.
typedef struct lam_check_scene {
    const char *name, *shows;
    lam_image theirs, reference; // LAM_RGBA32F, straight alpha
    double maximum, mean;        // of a channel
    double share_over;           // of pixels, over the tolerance
    uint64_t pixels, not_numbers;
    bool passes;
    const char *looks_like; // id of the mistake that explains this scene alone; NULL: none or it passes
} lam_check_scene;

// A mistake that explains the pictures.
typedef struct lam_check_finding {
    const char *mistake;            // id
    const char *says;               // a sentence
    char *write;                    // what to write instead, in the names of the shader
    bool certain;                   // with it (and those before it) every picture is explained within the tolerance
    double mean_before, mean_after; // mean difference over all scenes without and with it
} lam_check_finding;

typedef enum lam_check_note_kind {
    LAM_CHECK_NOTE_COMPILER, // the driver's own words
    LAM_CHECK_NOTE_HINT,     // what they mean, or what is unusual
    LAM_CHECK_NOTE_UNKNOWN,  // a name that the contract does not know
} lam_check_note_kind;
typedef struct lam_check_note {
    lam_check_note_kind kind;
    const char *file; // the name given; NULL: both or none
    int line;         // 0: none
    char *text;
} lam_check_note;

typedef struct lam_check_report {
    lam_check_verdict verdict;
    lam_check_contract contract;
    bool vertex_lit;  // the lighting is in the vertex shader
    bool made_vertex; // the vertex shader is ours
    char driver[128];
    lam_check_scene *scenes;
    int scene_count;
    double mean;                 // of the scenes' means
    lam_check_finding *findings; // in the order found: the first explains most
    int finding_count;
    lam_check_note *notes;
    int note_count;
    void *memory; // what the strings above live in
} lam_check_report;

// Checks. False only where no verdict can be had: LAM_BAD_ARGUMENT (no contract fits, an unknown scene),
// LAM_UNSUPPORTED (no OpenGL), LAM_LIMIT. The report is freed by the caller.
LAM_API bool lam_check_run(const lam_check_params *params, lam_check_report *report, lam_error *error);
LAM_API void lam_check_report_free(lam_check_report *report); // zeroed is fine

LAM_API const char *lam_check_verdict_name(lam_check_verdict verdict); // "passes", …; NULL out of range

#ifdef __cplusplus
}
#endif
#endif
