// lambent/device.h: devices, which render scenes to pictures.
#ifndef LAMBENT_DEVICE_H
#define LAMBENT_DEVICE_H

#include "camera.h"
#include "image.h"
#include "reflection.h"
#include "scene.h"

#ifdef __cplusplus
extern "C" {
#endif

// A device draws one picture at a time. Different threads must use different devices, but may share a scene while no
// thread changes the scene. A device keeps its memory between frames: drawing the same kind of frame again allocates
// nothing.
typedef struct lam_device lam_device;

// Instruction sets of the CPU device. All give bit-identical pictures.
typedef enum lam_isa {
    LAM_ISA_AUTO = 0, // the widest one that processor and build support
    LAM_ISA_SCALAR,   // C without SIMD
    LAM_ISA_SSE4,     // SSE4.2, 4 lanes
    LAM_ISA_AVX2,     // 8 lanes
    LAM_ISA_AVX512,   // AVX-512 F, BW, DQ and VL, 16 lanes
    LAM_ISA_NEON,     // 4 lanes
    LAM_ISA_WASM,     // WebAssembly's SIMD128, 4 lanes
    LAM_ISA_COUNT
} lam_isa;

// Returns the name of an instruction set: "scalar", "sse4". Returns a static string, or NULL if the index is out of
// range.
LAM_API const char *lam_isa_name(lam_isa isa);

// Returns whether this build and this processor support the instruction set.
LAM_API bool lam_isa_usable(lam_isa isa);

// Parameters of a CPU device. All zero: one thread for each processor, and the widest instruction set.
typedef struct lam_cpu_params {
    int threads; // number, the calling thread included, 1..1024; 0: auto
    lam_isa isa; // the instruction set
    LAM_RESERVED(8);
} lam_cpu_params;

// Makes the CPU device; `params` may be NULL. Returns NULL on failure: LAM_UNSUPPORTED (the instruction set),
// LAM_LIMIT. In C the parameters can be written in the call:
//  lam_device_cpu(&(lam_cpu_params){.threads = 4}, &error)
LAM_API lam_device *lam_device_cpu(const lam_cpu_params *params, lam_error *error);

// Makes a device that checks its arguments and builds the frame but draws nothing, for tests and for measuring the rest
// of the work. Fails with LAM_LIMIT.
LAM_API lam_device *lam_device_null(lam_error *error);

LAM_API void lam_device_free(lam_device *device); // NULL is allowed

// Returns one line about the device: "cpu avx2, 2 threads". The string lives as long as the device.
LAM_API const char *lam_device_name(const lam_device *device);

// Returns the instruction set in use, or LAM_ISA_AUTO if this is not a CPU device.
LAM_API lam_isa lam_device_isa(const lam_device *device);

// Returns the number of threads that draw; 0: the device has no threads of its own.
LAM_API int lam_device_threads(const lam_device *device);

// Shading methods: where the lighting is evaluated.
typedef enum lam_shading {
    LAM_SHADING_PHONG = 0, // at every pixel, with interpolated normals
    LAM_SHADING_GOURAUD,   // at every vertex; colours are interpolated
    // Once for each triangle, at its last vertex, with the triangle's normal (lam_flat_normal).
    LAM_SHADING_FLAT,
} lam_shading;

// The stage that evaluates the lighting. The CPU device gives identical bytes for every stage of a shading method.
typedef enum lam_stage {
    LAM_STAGE_AUTO = 0,    // fragment
    LAM_STAGE_APPLICATION, // before drawing: flat, Gouraud
    LAM_STAGE_VERTEX,      // flat, Gouraud
    LAM_STAGE_FRAGMENT,    // flat, Phong
} lam_stage;

// The position of the eye for highlights.
typedef enum lam_viewer {
    LAM_VIEWER_LOCAL = 0, // the camera; infinitely far if orthographic
    LAM_VIEWER_INFINITE,  // infinitely far along +z of eye space
} lam_viewer;

// The normal of flat shading.
typedef enum lam_flat_normal {
    LAM_FLAT_NORMAL_FACE = 0, // the normal of the triangle's plane
    LAM_FLAT_NORMAL_VERTEX,   // the normal of the triangle's last vertex, as in OpenGL
} lam_flat_normal;

// The content of a frame: the picture, one part of its light, or a property of its surfaces.
//
// Light outputs are drawn like the picture: over the background, and sRGB-encoded in 8 bits (lam_output_is_light).
// Other outputs are neither blended nor encoded. A float picture stores the number itself, and an 8-bit picture stores
// the code given here. In an 8-bit picture, pixels without a triangle store the background; in a float picture, they
// store 0 with alpha 0. Numbers of other outputs are not averaged: each number comes from the triangle at the covered
// sample nearest to the pixel's centre.
typedef enum lam_output {
    LAM_OUTPUT_PICTURE = 0, // the whole sum
    // Terms of the sum. The five add up to the picture without a background (an unlit colour is part of the diffuse
    // term). With gl1, the terms are not clamped.
    LAM_OUTPUT_AMBIENT,
    LAM_OUTPUT_DIFFUSE,
    LAM_OUTPUT_SPECULAR,
    LAM_OUTPUT_EMISSION,
    LAM_OUTPUT_REFLECTION, // the environment mirrored by classic materials
    // The ambient, diffuse and specular terms of one light. The contributions of all lights and of the environment, the
    // scene's ambient light and emission add up to the picture. Unlit surfaces are black.
    LAM_OUTPUT_LIGHT,
    // Normals as used by the lighting, in eye space: x right, y up, z to the viewer; reversed on back faces. 8-bit
    // code: (x + 1)/2.
    LAM_OUTPUT_NORMALS,
    // Tangents from the file or the direction field, perpendicular to the normal, with the 8-bit code of normals.
    LAM_OUTPUT_TANGENTS,
    // Distance d in front of the eye along the view, model units. 8-bit code: (far − d)/(far − near), so that near is
    // white and far is black. near and far are the distances of the scene's nearest and farthest vertices, limited to
    // the camera's planes (lam_frame_report.depth_near, depth_far). A range below 1/100000 of far is all white.
    LAM_OUTPUT_DEPTH,
    LAM_OUTPUT_N_L, // cosine between normal and light; 8-bit: max(n·l, 0)
    // Cosine between normal and half vector. 8-bit code: max(n·h, 0).
    LAM_OUTPUT_N_H,
    // 1: front, −1: back. 8-bit code: front blue (0, 102, 255), back red (255, 51, 0).
    LAM_OUTPUT_FACING,
    // Red: the triangle's number in its mesh modulo 2²⁴. Green: the object's number. Blue: the triangle's number / 2²⁴.
    // 8-bit code: a colour for each triangle of each object, no channel below 48.
    LAM_OUTPUT_IDS,
    // Fraction of the pixel's samples that are covered. Alpha is 1 everywhere, even without triangles.
    LAM_OUTPUT_COVERAGE,
    // The number of triangles that cover a sample before the depth test, without culled triangles, averaged over the
    // pixel's samples. Alpha is 1 everywhere, even without triangles. 8-bit code: c/(c + 3).
    LAM_OUTPUT_OVERDRAW,
    // The distance of each channel of the picture from the range 0…1, negative below. 8-bit code: red if a channel is
    // above, blue if one is below, otherwise the picture in dark grey.
    LAM_OUTPUT_CLIPPED,
    // The colour of the material at the point, for every shading method: the base colour of a physical material or the
    // diffuse colour of a classic one, times maps and vertex colours. A classic reflection model leaves physical
    // materials as they are here; LAM_REFLECTION_GGX converts classic ones. 8-bit code: sRGB-encoded.
    LAM_OUTPUT_BASE_COLOR,
    LAM_OUTPUT_ROUGHNESS, // of lit physical materials, as given; otherwise 0
    LAM_OUTPUT_METALLIC,  // the same for the metallic share
    LAM_OUTPUT_OCCLUSION, // factor of the occlusion map; 1: no map
    // Level of detail of the diffuse map, or else of the material's first map; 0: no map. A level below 0 means
    // magnification; without a footprint it is -50. 8-bit code: level / 10.
    LAM_OUTPUT_LOD,
    // The fraction of surrounding light that reaches the point (lam_occlusion, lam_cavity), 0 … 1.
    LAM_OUTPUT_AMBIENT_OCCLUSION,
    // The light of the environment: the reflection term of classic materials, and the environment's share of the
    // diffuse and specular terms of physical materials. Black if a surface is not lit.
    LAM_OUTPUT_ENVIRONMENT,
    // The normals of LAM_OUTPUT_NORMALS along the axes of world space. 8-bit code: (x + 1)/2.
    LAM_OUTPUT_NORMALS_WORLD,
    // Labels, for masks: the number of the object, counted from 1, and the number of the part, counted from 1 over the
    // parts of all objects in order (a mesh without parts counts as one). 0: the ground. 8-bit code: a colour for each
    // label, as for LAM_OUTPUT_IDS.
    LAM_OUTPUT_OBJECT_ID,
    LAM_OUTPUT_PART_ID,
    LAM_OUTPUT_COUNT,
} lam_output;

// Tone curves map light of any strength to the range of a display. Each accepts linear light after exposure, with the
// primaries of sRGB, and returns linear light from 0 to 1, which is then encoded (docs/lighting/tone.md has formulas,
// sources and plots). Tone curves apply to 8-bit pictures; float pictures store the light itself.
typedef enum lam_tone {
    // KHRONOS_NEUTRAL if the frame shows a physical material, CONTRAST if the studio illuminates a grey curved model or
    // a terrain, SOFT if it illuminates another model without unlit and emissive materials, otherwise NONE.
    LAM_TONE_AUTO = 0,
    LAM_TONE_NONE,     // no curve: each channel is clipped at 1
    LAM_TONE_REINHARD, // x / (1 + x) for each channel (Reinhard et al., 2002)
    // Hill's fit of the ACES reference and output transform for sRGB screens.
    LAM_TONE_ACES,
    LAM_TONE_AGX, // Sobotka's AgX, its default contrast by Wrensch's polynomial
    // Keeps colours up to 0.8 apart from a small offset; compresses and desaturates brighter colours (Khronos PBR
    // Neutral).
    LAM_TONE_KHRONOS_NEUTRAL,
    // 0.4 (x / 0.4)^2 for each channel: shades of grey differ more than with NONE.
    LAM_TONE_CONTRAST,
    // Unchanged up to 0.85, compressed towards 1 above, for each channel.
    LAM_TONE_SOFT,
    LAM_TONE_COUNT
} lam_tone;

// Returns the name of a tone curve: "auto", "khronos-neutral". Returns a static string, or NULL if the index is out of
// range.
LAM_API const char *lam_tone_name(lam_tone tone);

// Returns a curve's formula for a channel x of at least 0, such as "x / (1 + x)". For a curve that mixes the channels,
// the text names the curve and its page in the documentation. AUTO and NONE: "x". Returns a static string.
LAM_API const char *lam_tone_formula(lam_tone tone);

// Applies a tone curve to a colour, each channel at least 0. AUTO and NONE clip each channel at 1.
LAM_API lam_rgb lam_tone_apply(lam_tone tone, lam_rgb color);

// Returns the name of an output: "picture", "ambient", "n.l". Returns a static string, or NULL if the index is out of
// range.
LAM_API const char *lam_output_name(lam_output output);

// Returns what an output shows, in a few words. Returns a static string, or NULL if the index is out of range.
LAM_API const char *lam_output_summary(lam_output output);

// Returns whether an output is light: the picture, a term, or one light.
LAM_API bool lam_output_is_light(lam_output output);

// Returns whether an output shows a single light (lam_draw_params.output_light).
LAM_API bool lam_output_is_one_light(lam_output output);

// Returns the default samples per pixel for a picture of this size: 16 up to 256² pixels, so that thin wires do not
// break into dashes, 8 up to 512², and 4 above.
LAM_API int lam_default_samples(int width, int height);

// Ambient occlusion: the fraction of surrounding light that nearby surfaces do not block (docs/lighting/occlusion.md).
// Under Phong shading, occlusion dims ambient, hemisphere and environment light, and the share lam_light.occluded of
// other lights. Translucent surfaces are not occluded.
typedef enum lam_occlusion {
    // SCREEN if Phong shading is used and a light of the frame has a share `occluded` or an environment lights the
    // frame; else OFF.
    LAM_OCCLUSION_AUTO = 0,
    LAM_OCCLUSION_OFF,
    // Computed from the depths of the visible surfaces around each pixel (Jimenez et al., "Practical Real-Time
    // Strategies for Accurate Indirect Occlusion", 2016). Hidden surfaces occlude nothing.
    LAM_OCCLUSION_SCREEN,
    // Computed by occlusion_samples rays from each lit point: the integral that SCREEN estimates, over all surfaces of
    // the scene. CPU device only; other devices fail with LAM_UNSUPPORTED.
    LAM_OCCLUSION_RAYS,
    LAM_OCCLUSION_COUNT
} lam_occlusion;

// Ambient occlusion at a small radius, which makes letters, holes and seams visible. The radius is 0.05 of half the
// diagonal of the scene's box, and at least three cells of the picture (docs/lighting/occlusion.md).
typedef enum lam_cavity {
    LAM_CAVITY_AUTO = 0, // ON if LAM_OCCLUSION_AUTO means SCREEN, else OFF
    LAM_CAVITY_OFF,      // no cavity shading
    LAM_CAVITY_ON,       // dark valleys
    LAM_CAVITY_COUNT
} lam_cavity;

// Specular antialiasing: increases the roughness of physical materials where the normal varies within a pixel, in the
// mesh or in a normal map, so that bumpy surfaces do not glitter (docs/lighting/physical.md).
typedef enum lam_specular_aa {
    // ON under Phong shading if LAM_OCCLUSION_AUTO means SCREEN and `reference` is false. Otherwise OFF.
    LAM_SPECULAR_AA_AUTO = 0,
    LAM_SPECULAR_AA_OFF, // the exact equations
    LAM_SPECULAR_AA_ON,
    LAM_SPECULAR_AA_COUNT
} lam_specular_aa;

// A filter against the noise of path tracing (lam_draw_params.bounces). It needs two paths or more.
typedef enum lam_denoise {
    // ON from 2 bounces on, below 1024 paths, without lam_draw_params.noise.
    LAM_DENOISE_AUTO = 0,
    LAM_DENOISE_OFF, // the mean of the paths, which is right on average
    LAM_DENOISE_ON,  // the filtered mean
    LAM_DENOISE_COUNT
} lam_denoise;

// The filters of texture maps.
typedef enum lam_map_filter {
    LAM_MAP_FILTER_FILE = 0,  // as each map says (lam_texture_map)
    LAM_MAP_FILTER_NEAREST,   // the nearest texel of the picture
    LAM_MAP_FILTER_BILINEAR,  // four texels of the picture
    LAM_MAP_FILTER_TRILINEAR, // four texels of two mipmap levels
    LAM_MAP_FILTER_COUNT
} lam_map_filter;

// Lights dark models with up to 2.5 stops more light, so that more than their outline is visible, and white physical
// models with 5/6 stop less. The base colours determine the amount for all views of a model (docs/lighting/tone.md).
typedef enum lam_brighten {
    // On for scenes from model files in the studio's light, with their own colours and without lights or emission. Off
    // with LAM_COLOR_RAW, and on a ground of LAM_GROUND_CHECKER or LAM_GROUND_COLOR.
    LAM_BRIGHTEN_AUTO = 0,
    LAM_BRIGHTEN_OFF,
    LAM_BRIGHTEN_COUNT
} lam_brighten;

// Draws panes that a model file only blends as glass. Blending weakens the reflections of a pane, and adds a film of the
// base colour.
typedef enum lam_glass {
    LAM_GLASS_OFF = 0, // as the file describes them
    // A physical material becomes thin, smooth glass (transmission 1, metallic 0, roughness at most 0.1) if its name
    // contains "glass", "window", "windscreen" or "windshield", it is blended with an opacity above 0 and up to 0.6, has
    // no maps of colour and opacity, and transmits nothing. The glass tints the light by 1 − opacity (1 − base colour), as
    // the blended pane does before white.
    LAM_GLASS_AUTO,
    LAM_GLASS_COUNT
} lam_glass;

// The ground: a plane at the scene's lowest point, perpendicular to its up axis (lam_scene_set_up), on which the
// scene's lights cast shadows as if lam_draw_params.shadows were set (docs/lighting/ground.md). The plane is opaque up
// to a distance of 3 radii of the scene's sphere from the centre, and fades to transparent at 6 radii. The plane is
// invisible from below and casts no shadows. Fitting the camera and measuring the scene ignore the plane. The ground
// requires Phong shading.
typedef enum lam_ground {
    LAM_GROUND_NONE = 0, // no ground
    // A shadow catcher: black, with the fraction of light that the scene blocks from a white, matt ground as alpha. The
    // shadow catcher works over any background. Outputs of surface properties, except ambient occlusion, omit it.
    LAM_GROUND_SHADOW,
    // A checkerboard. The side of a square is the largest of 1, 2 and 5 times a power of ten that is at most half of
    // the radius. Squares begin at multiples of this length in world space.
    LAM_GROUND_CHECKER,
    LAM_GROUND_COLOR, // a matt surface
    LAM_GROUND_COUNT
} lam_ground;

// Returns the name of a kind of ground: "off", "shadow". Returns a static string, or NULL if the index is out of range.
LAM_API const char *lam_ground_name(lam_ground ground);

// Edges of surfaces that are drawn as lines (docs/edges.md). The values are bits.
typedef enum lam_edges {
    // Edges at which two faces meet at more than lam_draw_params.edge_angle_rad, or more than two faces meet.
    LAM_EDGES_CREASE = 1,
    LAM_EDGES_BOUNDARY = 2, // edges of only one face
    // Edges between a face seen from the front and a face seen from behind.
    LAM_EDGES_SILHOUETTE = 4,
    LAM_EDGES_ALL = 7, // all of them
} lam_edges;

// How edges behind surfaces are drawn.
typedef enum lam_hidden_lines {
    LAM_HIDDEN_LINES_REMOVE = 0, // not drawn
    LAM_HIDDEN_LINES_DASH,       // dashed
    LAM_HIDDEN_LINES_SHOW,       // as if no surface hid them
    LAM_HIDDEN_LINES_COUNT
} lam_hidden_lines;

// The settings of a frame. Zero is the default of each field.
typedef struct lam_draw_params {
    int samples; // per pixel: 1, 2, 4, 8 or 16; 0: lam_default_samples
    // Linear, not premultiplied. All zero: transparent.
    lam_rgba background;
    lam_color_mode color; // encoding of 8-bit pictures
    // Stops, −100…100: light is multiplied by 2^exposure, linearly, before it is composited over the background and
    // encoded. The background, alpha and outputs of surface properties do not change.
    double exposure;
    lam_rig rig;                 // lights in addition to the scene's
    lam_shading shading;         // the shading method
    lam_reflection reflection;   // the reflection model
    lam_stage stage;             // LAM_BAD_ARGUMENT if `shading` has no such stage
    lam_viewer viewer;           // the eye for highlights
    lam_flat_normal flat_normal; // the normal of LAM_SHADING_FLAT
    // Shininess means Phong's α: Blinn–Phong uses 4α, so that both highlights look alike.
    bool match_highlights;
    // Omits multiple scattering between microfacets (GGX), for comparison with renderers without it. Rough metals are
    // then darker.
    bool single_scattering;
    // Lighting as in OpenGL 1: vertex colours are clamped to 0…1 before interpolation, shininess is at most 128, and
    // attenuation and cone also dim each light's ambient term.
    bool gl1;
    // In frames with more than 16 lights, each region of the picture skips its weakest lights if they together change
    // an encoded channel by less than this fraction of its range; at most 1. 0: ½/255, so that no byte differs by more
    // than 1. Below 0: every light is evaluated everywhere, as the OpenGL device always does.
    float light_cutoff;
    // The largest number of texture probes along the longer axis of a pixel's footprint, 1..16, for textures seen at a
    // slant. 0: 8 for colours, normals and bumps, unless the map chooses LAM_FILTER_NEAREST or LAM_MIP_NONE; 1 for other
    // maps. A pixel takes as many probes as its footprint needs (docs/textures.md).
    int anisotropy;
    // Replaces the filters of all maps. lam_shader_uniform.map keeps the filters of the map.
    lam_map_filter map_filter;
    lam_output output; // the content of the frame
    // LAM_OUTPUT_LIGHT, LAM_OUTPUT_N_L, LAM_OUTPUT_N_H: the index of the light in lam_draw_lights.
    int output_light;
    lam_tone tone; // applied after exposure, in 8-bit pictures
    // Physical materials under an environment: integrates over this many directions at each lit point, 16..1048576,
    // instead of the split sum (docs/lighting/environment.md). 0: the split sum. CPU device only; other devices fail
    // with LAM_UNSUPPORTED.
    int reference;
    // Light between surfaces, by path tracing (docs/lighting/bounces.md). 0: local lighting. 1: the light of lamps, of
    // the environment and of emitting surfaces, with shadows. N: also light that surfaces have reflected up to N times,
    // mirrors that show the model, and glass that refracts; up to 1000. Only the picture and LAM_OUTPUT_CLIPPED show
    // it. LAM_BAD_ARGUMENT: together with gl1, or without Phong shading. CPU device only; others fail with
    // LAM_UNSUPPORTED.
    int bounces;
    // Paths from each surface in a pixel, 1..65536; 0: 64, or 65536 with `noise` or `stop_after_s`. The noise of a pixel
    // is inversely proportional to the square root of this number.
    int paths;
    lam_denoise denoise; // the noise of `bounces` (docs/lighting/bounces.md)
    // Parts of 64×64 pixels end before `paths` when their estimated noise is at most this, 0..255: the root mean square
    // error in values of 8-bit pictures. 0: no part ends before.
    float noise;
    // The picture is finished when this many seconds have passed since the start of the call, with the paths that it has
    // then, at least 16 (lam_frame_report.paths). With these paths, `paths` gives the same picture. 0: no limit.
    float stop_after_s;
    // The width of lines and the diameter of points, in pixels, up to 1000. 0 for lines: 1.5. 0 for points: 16 % of the
    // picture's shorter side, divided by the square root of the number of points, but at most 2.5 % of the shorter
    // side. The result is at least 3 pixels, and at least 8 pixels for fewer than 100 points. Points below 4 pixels are
    // squares. Lines and points are moved towards the eye by their own width, so that lines on a surface remain
    // visible.
    float line_width, point_size;
    // Triangles between a point and a light block the diffuse and specular terms of every light that casts shadows
    // (lam_light.no_shadows, docs/lighting/shadows.md).
    bool shadows;
    // Shadow rays start on the flat triangles, so that the terminator of a coarse smooth mesh shows its triangles. By
    // default, shadow rays start on the curved surface defined by the vertex normals.
    bool flat_terminator;
    // Paths of light refract at glass everywhere, so that glass focuses light on rough surfaces (docs/lighting/bounces.md).
    // Lights then shed nothing through glass, because no path meets them. By default, glass lets light pass in a straight line
    // after a reflection from a rough surface.
    bool caustics;
    // Shadow rays to a light with a radius from each point in its penumbra, 1..256; 0: 128. Above 48, pixels share
    // rays (docs/lighting/shadows.md).
    int shadow_samples;
    lam_occlusion occlusion; // LAM_BAD_ARGUMENT: SCREEN or RAYS without Phong shading
    // The largest distance at which surfaces occlude, relative to half the diagonal of the scene's box, in (0, 10]. 0:
    // 0.1.
    float occlusion_radius;
    // Rays from each lit point for LAM_OCCLUSION_RAYS, 1..1024; 0: 64.
    int occlusion_samples;
    lam_ground ground; // CPU device only; others fail with LAM_UNSUPPORTED
    // The linear colour of COLOR, and of the bright squares of CHECKER; the dark squares have 0.45 times this colour.
    // All zero: 0.6 for CHECKER.
    lam_rgb ground_color;
    // Draws lines over the picture (only LAM_OUTPUT_PICTURE): the edges of all faces (of the file's polygons if they
    // are known, lam_mesh.inner_edges). `edges` adds feature edges. The coverage of a pixel is computed from the line's
    // distance to its centre and does not depend on `samples`; light, exposure and tone do not change line colours. A
    // surface hides the edges behind it if its opacity is at least ½ and it does not transmit light (docs/edges.md).
    bool wireframe;
    // Surfaces hide lines but are not drawn themselves: the picture contains only lines and points.
    bool no_surfaces;
    unsigned edges;                    // LAM_EDGES_…; 0: none
    lam_hidden_lines hidden_lines;     // of edges behind surfaces
    float edge_angle_rad;              // of LAM_EDGES_CREASE, 0…π; 0: 40°
    float wireframe_width, edge_width; // pixels, up to 1000; 0: 1 and 1.5
    // Linear, not premultiplied. All zero: black, and white with no_surfaces over a background darker than 0.18.
    lam_rgba wireframe_color, edge_color;
    // ON fails with LAM_BAD_ARGUMENT together with LAM_OCCLUSION_RAYS or without Phong shading.
    lam_cavity cavity;
    lam_specular_aa specular_aa; // ON without Phong shading fails with LAM_BAD_ARGUMENT
    lam_brighten brighten;       // more light for dark models, less for white ones
    // Annotations, drawn over the picture like the lines above; all measure the scene's box (lam_scene_bounds), in model
    // units along the axes of world space (docs/annotations.md).
    // An arrow and a number for each side of the box; lam_camera_fit_ground leaves space for them.
    bool dimensions;
    // A bar of 1, 2 or 5 times a power of ten units; with perspective, valid at the middle of the box.
    bool scale_bar;
    bool axes; // the directions of the axes: x red, y green, z blue
    // Lines on the plane under the box, 1, 2 or 5 times a power of ten units apart. Surfaces hide them.
    bool grid;
    // Above 0, up to 1: pictures (LAM_OUTPUT_PICTURE) show the environment that lights the scene instead of `background`,
    // along the rays of the camera (in an orthographic view all are parallel: one colour), after exposure and tone. The
    // environment is blurred like the mirror image in a surface of this roughness; up to 0.045 it is sharp. Without an
    // environment: LAM_BAD_ARGUMENT.
    float background_environment;
    lam_glass glass; // whether panes that are only blended become glass
    LAM_RESERVED(11);
} lam_draw_params;

// Timings of a frame in milliseconds, and counters.
typedef struct lam_frame_report {
    double frame_ms;     // flattening the scene: lights and matrices
    double vertices_ms;  // positions to clip space
    double triangles_ms; // culling, clipping, binning
    // Computing missing normals (lam_load_params.normals_when_drawn).
    double normals_ms;
    // Time for LAM_OCCLUSION_SCREEN, without finding the depths (rays are part of lighting_ms).
    double occlusion_ms;
    double tiles_ms; // coverage, lighting and resolve of all tiles
    double total_ms; // the whole call
    // tiles_ms divided in proportion to the times summed over the threads.
    double coverage_ms, lighting_ms, resolve_ms;
    // OpenGL device: creating and uploading new or changed buffers (without lighting_ms, the lighting of the stage
    // `application`); drawing until the GPU is done; reading back and encoding. vertices_ms to tiles_ms are 0.
    double upload_ms, draw_ms, read_ms;
    // OpenGL device: bytes of vertices, colours, lights, materials and environment sent in this frame.
    uint64_t bytes_uploaded;
    uint64_t triangles;        // of the scene, and of the ground if there is one
    uint64_t triangles_binned; // triangles that reached a tile
    uint64_t pixels_covered;   // pixels covered by a triangle
    // Evaluations of the lighting: pixels, vertices or triangles. The OpenGL device counts only the evaluations on the
    // processor.
    uint64_t points_lit;
    uint64_t lights_evaluated; // summed over those points
    // The memory of the device after the frame. Scratch memory that each thread needs is counted once.
    uint64_t memory_bytes;
    // LAM_OUTPUT_DEPTH: the distances, in model units, that are white and black in 8 bits. Otherwise 0.
    double depth_near, depth_far;
    // Time for building the bounding volume hierarchy, in milliseconds; 0 if it was not needed, or reused from the last
    // frame.
    double hierarchy_ms;
    uint64_t rays; // from lit points, for shadows and ambient occlusion
    bool ground;   // whether the camera sees the ground
    // The height of the ground along the scene's up axis, and the side of a checker's squares, model units. Without a
    // ground 0.
    double ground_height, ground_square;
    // Time for finding the drawn edges and their visible parts, without hierarchy_ms.
    double edges_ms;
    uint64_t edges_drawn; // edges inside the picture, hidden ones included
    uint64_t edge_rays;   // from points of edges to the eye
    // Stops that a dark model was brightened by (lam_brighten); negative for a white model.
    double brightened;
    // Path tracing (lam_draw_params.bounces): the paths from each surface in a pixel, on average over the picture, and the
    // estimated root mean square error in values of 8-bit pictures, without the filter. 0 for other pictures; the error is
    // 0 if there was one path.
    double paths, noise;
    uint64_t glass_materials; // materials that lam_glass changed
    LAM_RESERVED(1);
} lam_frame_report;

// Draws the scene from the camera into `image`, which the caller created with the desired size and pixel format.
// `params` and `control` may be NULL. On failure the image's contents are undefined. Errors: LAM_BAD_ARGUMENT,
// LAM_LIMIT (memory, time, more than 65536 translucent triangles over one pixel), LAM_CANCELLED, LAM_UNSUPPORTED
// (OpenGL).
LAM_API bool lam_draw(lam_device *device, const lam_scene *scene, const lam_camera *camera,
                      const lam_draw_params *params, lam_image *image, const lam_control *control, lam_error *error);

// Finds the exposure, in stops, at which 95 % of the covered pixels of a frame are at most as bright as 0.8 (BT.709
// luminance), rounded to thirds of a stop. The exposure is 0 if there is no light. The frame is drawn with an exposure
// of 0, at most 512 pixels wide and high. Errors as lam_draw.
LAM_API bool lam_exposure_fit(lam_device *device, const lam_scene *scene, const lam_camera *camera,
                              const lam_draw_params *params, int width, int height, const lam_control *control,
                              double *stops, lam_error *error);

// Works like lam_camera_fit for a picture with a ground (params->ground): by default the scene fills 0.8 of the
// picture, and the rest leaves space for its shadow. If `axis` is not NULL, the scene rotates about an axis through
// `centre`, as in lam_camera_fit_turning; pass the scene before the rotation. Without a ground (or with `params` NULL)
// the result is the camera of those two functions.
LAM_API lam_camera lam_camera_fit_ground(const lam_scene *scene, const lam_draw_params *params, int width, int height,
                                         const lam_view *view, lam_vec3 centre, const lam_vec3 *axis);

// Lists the lights of a frame: first the lights of the scene, then the lights of the rig. Returns their number and
// copies the first `capacity` of them to `lights`, which may be NULL. `ground`: as in lam_scene_rig_lights. Names are
// valid until the scene changes.
LAM_API int lam_draw_lights(const lam_scene *scene, lam_rig rig, bool ground, lam_light *lights, int capacity);

// Returns params->tone, or the curve that the light of params->rig selects if that is LAM_TONE_AUTO: LAM_TONE_CONTRAST,
// LAM_TONE_SOFT, or LAM_TONE_AUTO if it selects none. If your program adds the lights of lam_scene_rig_lights to the
// scene itself, call this function before and draw with its curve: the result is the picture that LAM_TONE_AUTO gives
// with the rig.
LAM_API lam_tone lam_draw_tone(const lam_scene *scene, const lam_draw_params *params);

// Returns the report of the device's last frame; all zero before the first frame.
LAM_API void lam_device_report(const lam_device *device, lam_frame_report *report);

// The size of the text that lam_device_comment writes, in bytes.
enum { LAM_COMMENT_SIZE = 96 };

// Writes what lam_save_params.comment should say of the device's last picture if its paths of light were traced, such as
// "16 paths of light, estimated noise 3.20 of 255". Writes an empty text after other pictures.
LAM_API void lam_device_comment(const lam_device *device, char comment[LAM_COMMENT_SIZE]);

#ifdef __cplusplus
}
#endif
#endif
