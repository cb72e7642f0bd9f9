// lambent/device.h: devices draw scenes into pictures.
#ifndef LAMBENT_DEVICE_H
#define LAMBENT_DEVICE_H

#include "camera.h"
#include "image.h"
#include "scene.h"

#ifdef __cplusplus
extern "C" {
#endif

// Opaque. One device draws one picture at a time; different threads use different devices, and may share a scene
// that nobody changes. A device keeps its memory from frame to frame: drawing the same kind of frame again
// allocates nothing.
typedef struct lam_device lam_device;

// Instruction sets of the CPU device. Every one gives the same bytes.
typedef enum lam_isa {
    LAM_ISA_AUTO = 0, // the widest that the processor and this build have
    LAM_ISA_SCALAR,   // C without vectors
    LAM_ISA_SSE4,     // SSE4.2, 4 lanes
    LAM_ISA_AVX2,     // 8 lanes
    LAM_ISA_AVX512,   // AVX-512 F, BW, DQ and VL, 16 lanes
    LAM_ISA_NEON,     // 4 lanes
    LAM_ISA_COUNT
} lam_isa;

LAM_API const char *lam_isa_name(lam_isa isa); // "scalar", "sse4", …; NULL out of range
LAM_API bool lam_isa_usable(lam_isa isa);      // in this build and on this processor

typedef struct lam_cpu_params {
    int threads; // threads to draw with, the calling one included, 1..1024; 0: one for each processor
    lam_isa isa;
} lam_cpu_params;

// The software device. NULL and the reason when the instruction set is not to be had (LAM_UNSUPPORTED) or memory is
// out (LAM_LIMIT). `params` may be NULL. lam_cpu_params can be written in the call in C:
//     lam_device_cpu(&(lam_cpu_params){ .threads = 4 }, &error)
LAM_API lam_device *lam_device_cpu(const lam_cpu_params *params, lam_error *error);

// A device that checks its arguments, builds the frame and draws nothing: for tests and for timing what is above
// devices.
LAM_API lam_device *lam_device_null(lam_error *error);

LAM_API void lam_device_free(lam_device *device);              // NULL is fine
LAM_API const char *lam_device_name(const lam_device *device); // "cpu avx2, 2 threads"; lives as long as the device
LAM_API lam_isa lam_device_isa(const lam_device *device);      // the one in use; LAM_ISA_AUTO: no CPU device
LAM_API int lam_device_threads(const lam_device *device);      // threads it draws with; 0: none of its own

typedef enum lam_shading {
    LAM_SHADING_PHONG = 0, // normals interpolated, every pixel lit
    LAM_SHADING_GOURAUD,   // every vertex lit, colours interpolated
    LAM_SHADING_FLAT,      // every triangle lit once, with its face normal at its last vertex
} lam_shading;

typedef enum lam_reflection {
    LAM_REFLECTION_AUTO = 0, // Blinn–Phong for classic materials
    LAM_REFLECTION_NONE,     // the diffuse colour, unlit
    LAM_REFLECTION_LAMBERT,
    LAM_REFLECTION_PHONG,
    LAM_REFLECTION_BLINN_PHONG,
    LAM_REFLECTION_KAJIYA_KAY,
    LAM_REFLECTION_KAJIYA_KAY_LECTURE,
} lam_reflection;

// Where lighting is worked out. The CPU device gives the same bytes for every stage that a shading method can run in.
typedef enum lam_stage {
    LAM_STAGE_AUTO = 0,    // fragment
    LAM_STAGE_APPLICATION, // before drawing: flat, Gouraud
    LAM_STAGE_VERTEX,      // flat, Gouraud
    LAM_STAGE_FRAGMENT,    // flat, Phong
} lam_stage;

// Where the eye is for highlights.
typedef enum lam_viewer {
    LAM_VIEWER_LOCAL = 0, // at its place; infinitely far for an orthographic camera
    LAM_VIEWER_INFINITE,  // infinitely far along +z of eye space for every point
} lam_viewer;

// Which normal flat shading takes.
typedef enum lam_flat_normal {
    LAM_FLAT_NORMAL_FACE = 0, // the triangle's own
    LAM_FLAT_NORMAL_VERTEX,   // its last vertex's, as OpenGL does with smooth normals
} lam_flat_normal;

// What a frame shows: the picture, one part of its light, or a number of its surfaces. Light is drawn as the picture
// is: over the background, and sRGB-encoded in 8 bits (lam_output_is_light). The numbers are neither: a float picture
// holds the number itself, an 8-bit one the code that stands behind it here, and what no triangle covers is 0 with
// alpha 0, however the background. A number is not averaged: it is that of the triangle at the covered sample nearest
// to the pixel's centre.
typedef enum lam_output {
    LAM_OUTPUT_PICTURE = 0,
    // Terms of the sum: the five add up to the picture (unlit, the colour is the diffuse term). A background would
    // count five times. With gl1, terms are not clamped.
    LAM_OUTPUT_AMBIENT,
    LAM_OUTPUT_DIFFUSE,
    LAM_OUTPUT_SPECULAR,
    LAM_OUTPUT_EMISSION,
    LAM_OUTPUT_REFLECTION, // of the environment
    // All that one light gives: ambient, diffuse and specular. Those of all lights, the scene's ambient light, emission
    // and reflection add up to the picture. Black for a frame that is not lit.
    LAM_OUTPUT_LIGHT,
    // As the lighting sees them, in eye space: x right, y up, z to the viewer; seen from behind, turned. 8 bits: (x +
    // 1)/2.
    LAM_OUTPUT_NORMALS,
    LAM_OUTPUT_TANGENTS, // the file's, or the direction field, perpendicular to the normal
    LAM_OUTPUT_DEPTH,    // distance in front of the eye along the view, model units; 8 bits: near white, far black
    LAM_OUTPUT_N_L,      // cosine between normal and light; 8 bits: max(n·l, 0)
    LAM_OUTPUT_N_H,      // cosine between normal and half vector; 8 bits: max(n·h, 0)
    LAM_OUTPUT_FACING,   // 1: front, −1: back; 8 bits: front blue (0, 102, 255), back red (255, 51, 0)
    // Triangle number in its mesh modulo 2²⁴, object number, the rest of the triangle number; 8 bits: a colour for each
    // triangle of each object, no channel below 48.
    LAM_OUTPUT_IDS,
    LAM_OUTPUT_COVERAGE, // share of the pixel's samples that are covered; alpha 1 everywhere
    // Triangles that cover a sample before the depth test, mean over the pixel's samples, culled ones not counted;
    // alpha 1 everywhere; 8 bits: c/(c + 3).
    LAM_OUTPUT_OVERDRAW,
    // By how much each channel of the picture leaves 0…1 (negative: below); 8 bits: red where one is above, blue where
    // one is below, else the picture in dark grey.
    LAM_OUTPUT_CLIPPED,
    LAM_OUTPUT_COUNT,
} lam_output;

LAM_API const char *lam_output_name(lam_output show); // "picture", "ambient", … "n.l", …; NULL out of range
LAM_API bool lam_output_is_light(lam_output show);    // the picture, the terms and a light

// How a frame is drawn. All zero is the plain default.
typedef struct lam_draw_params {
    int samples;         // per pixel: 1, 2, 4, 8 or 16; 0: 4
    lam_rgba background; // linear, not premultiplied; default clear
    lam_color_mode color;
    // Stops, −100…100: the light of the picture, of a term and of a light is multiplied by 2^exposure, in
    // linear light, before it lies over the background (which stays as it is) and is encoded. Alpha and the
    // numbers of surfaces stay as they are. 0: as the equations give it.
    double exposure;
    lam_rig rig;
    lam_shading shading;
    lam_reflection reflection;
    lam_stage stage; // a stage that the shading cannot run in is LAM_BAD_ARGUMENT
    lam_viewer viewer;
    lam_flat_normal flat_normal;
    bool match_highlights; // shininess is Phong's α: Blinn–Phong takes 4α, so that both highlights look alike
    // as OpenGL 1 did: vertex colours clamped to 0…1 before they are interpolated, shininess at most 128, and each
    // light's ambient attenuated and narrowed by its cone
    bool gl1;
    // Many lights: in frames of more than 16, each part of the picture leaves out the weakest lights, as long
    // as all that they could add to a channel, together, stays below this share of the whole range of the
    // picture's encoded channels. 0: ½/255, so that no byte is off by more than 1; less than 0: every light
    // is evaluated everywhere; at most 1. The OpenGL device always evaluates every light.
    float light_cutoff;
    lam_output show;
    int show_light; // LAM_OUTPUT_LIGHT, LAM_OUTPUT_N_L, LAM_OUTPUT_N_H: which, by its number in lam_draw_lights
} lam_draw_params;

// What a frame took. Milliseconds, and counts.
typedef struct lam_frame_report {
    double frame_ms;     // flattening the scene: lights and matrices into eye space
    double vertices_ms;  // positions to clip space
    double triangles_ms; // rejecting, clipping, binning
    double normals_ms;   // making those that meshes lack (lam_load_params.normals_when_drawn)
    double tiles_ms;     // coverage, lighting and resolve of all tiles, wall time
    double total_ms;     // the whole call
    // Shares of tiles_ms by work, from times summed over the threads.
    double coverage_ms, lighting_ms, resolve_ms;
    // The OpenGL device: making and sending what was not there or has changed (without lighting_ms, that of
    // the stage `application`); drawing, waited for; reading back and encoding. The times above tiles_ms are
    // 0 there.
    double upload_ms, draw_ms, read_ms;
    uint64_t bytes_uploaded;   // vertices, colours, lights, materials, environment sent to the device in this frame
    uint64_t triangles;        // given
    uint64_t triangles_binned; // that reached a tile
    uint64_t pixels_covered;
    // evaluations of the lighting: pixels, vertices or triangles; OpenGL tells only the processor's own
    uint64_t points_lit;
    uint64_t lights_evaluated; // summed over those points
    uint64_t memory_bytes;     // held by the device after the frame
} lam_frame_report;

// Draws the scene as the camera sees it into `image` (made by the caller, whose size and pixel format decide).
// `params`, `control` may be NULL. On failure the image's contents are undefined. Errors: LAM_BAD_ARGUMENT, LAM_LIMIT
// (memory, time, more than 65536 translucent triangles over one pixel), LAM_CANCELLED.
LAM_API bool lam_draw(lam_device *device, const lam_scene *scene, const lam_camera *camera,
                      const lam_draw_params *params, lam_image *image, const lam_control *control, lam_error *error);

// The lights of a frame: the scene's, then the rig's. Returns their number, and copies as many as fit into `lights`
// (NULL: none). Names live as long as the scene is unchanged.
LAM_API int lam_draw_lights(const lam_scene *scene, lam_rig rig, lam_light *lights, int room);

// The report of the device's last frame, zeroed before the first.
LAM_API void lam_device_report(const lam_device *device, lam_frame_report *report);

#ifdef __cplusplus
}
#endif
#endif
