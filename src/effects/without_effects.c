// without_effects.c: the functions of the effects' entry headers and the public functions of environments, for a build
// that leaves the effects out (-Deffects=false). Such a build has no environments, and frame_check.c refuses the other
// effects, so a device never calls the functions that return nothing useful here.
#include "edges.h"
#include "environment.h"
#include "fail.h"
#include "occlusion.h"
#include "paths.h"

#include <lambent/pick.h>

static bool left_out(const char *what, lam_error *error)
{
    return fail(error, LAM_UNSUPPORTED, "this build of lambent cannot %s: its effects were left out (-Deffects=false)",
                what);
}

// clang-format off
#define NO_ENVIRONMENT(name, ...) lam_environment *name(__VA_ARGS__) { return left_out("use environments", error), NULL; }
// clang-format on

#pragma GCC diagnostic ignored "-Wunused-parameter"

// --- environments

NO_ENVIRONMENT(lam_environment_make, const lam_image *const faces[LAM_FACE_COUNT], lam_color_mode color,
               lam_error *error)
NO_ENVIRONMENT(lam_environment_from_image, const lam_image *image, lam_color_mode color, lam_error *error)
NO_ENVIRONMENT(lam_environment_load_faces, const char *const paths[LAM_FACE_COUNT], lam_color_mode color,
               const lam_control *control, lam_error *error)
NO_ENVIRONMENT(lam_environment_load, const char *path, lam_color_mode color, const lam_control *control,
               lam_error *error)
NO_ENVIRONMENT(lam_environment_built_in, const char *name, lam_error *error)
NO_ENVIRONMENT(environment_read, const struct picture_source *source, int count, lam_color_mode color,
               struct call_control *call, lam_error *error)

const char *lam_environment_built_in_name(int index) { return NULL; }
void lam_environment_free(lam_environment *environment) {}
int lam_environment_size(const lam_environment *environment) { return 0; }
lam_rgb lam_environment_sample(const lam_environment *environment, lam_vec3 direction) { return (lam_rgb){0, 0, 0}; }

bool lam_environment_light_image(const lam_environment *environment, lam_image *image, const lam_control *control,
                                 lam_error *error)
{
    return left_out("use environments", error);
}

// A scene without a studio would be a failure to allocate memory, so the function returns a pointer to nothing.
struct lazy_environment *lazy_environment_make(void)
{
    static char none;
    return (struct lazy_environment *)&none;
}
const lam_environment *lazy_environment_studio(struct lazy_environment *lazy, lam_error *error)
{
    return left_out("use environments", error), NULL;
}
void lazy_environment_free(struct lazy_environment *lazy) {}
lam_environment *cube_share(const lam_environment *cube) { return NULL; }
unsigned environment_light_parts(float first, float last) { return 0; }
int prefiltered_size(int level) { return 0; }
int environment_light_first(int level) { return 0; }
int environment_light_rows(void) { return 0; }

const struct environment_light *environment_light(const lam_environment *cube, unsigned needed, struct pool *pool,
                                                  struct call_control *call, lam_error *error)
{
    return left_out("use environments", error), NULL;
}

const struct environment_light *environment_light_without_lamp(const lam_environment *cube, unsigned needed,
                                                               struct pool *pool, struct call_control *call,
                                                               lam_error *error)
{
    return left_out("use environments", error), NULL;
}

bool environment_lamp(const lam_environment *cube, struct environment_lamp *lamp, struct call_control *call,
                      lam_error *error)
{
    return left_out("use environments", error);
}

bool environment_samples_make(struct environment_samples *samples, const lam_environment *cube,
                              const float to_environment[3][3], int count, struct buffer *storage,
                              struct call_control *call, lam_error *error)
{
    return left_out("use environments", error);
}

const struct environment_lookups *environment_lookups_of(int lanes) { return NULL; }

// --- rays

void frame_rays_build(struct frame *frame, const lam_scene *scene, const lam_mat4 *view) {}

const struct hierarchy *hierarchy_of_frame(struct hierarchy_memory *memory, const struct frame *frame,
                                           struct pool *pool, struct call_control *call, bool *built, lam_error *error)
{
    return left_out("trace rays", error), NULL;
}

void hierarchy_free(struct hierarchy_memory *memory) {}
uint64_t hierarchy_bytes(const struct hierarchy_memory *memory) { return 0; }
void ray_corner_color(const lam_mesh *mesh, uint32_t corner, float out[4]) {}
bool ray_corner_texcoord(const lam_mesh *mesh, int set, uint32_t corner, float out[2]) { return false; }
void light_pattern_fill(struct light_pattern *pattern, int count) {}
void occlusion_pattern_fill(struct occlusion_pattern *pattern, int count) {}
void ray_starts_find(const struct light_rays *rays, const struct ray_surface *surface, const struct ray_points *points,
                     int lanes, struct ray_starts *starts)
{
}
const struct ray_kernels *ray_kernels_of(int lanes) { return NULL; }

bool lam_pick(const lam_scene *scene, const lam_camera *camera, const lam_draw_params *params,
              const lam_pick_pixel *pixel, const lam_control *control, lam_picked *picked, lam_error *error)
{
    return left_out("find the surface at a pixel", error);
}

// --- edges and occlusion

void frame_edges_build(struct frame *frame, const lam_scene *scene, const lam_mat4 *view, const lam_mat4 *pixel)
{
    frame->draws_edges = false;
}

bool edges_find(struct edge_memory *memory, const struct frame *frame, const struct hierarchy *hierarchy, int lanes,
                struct pool *pool, struct call_control *call, struct edge_counts *counts, lam_error *error)
{
    return left_out("draw edges", error);
}

void edges_blend(const struct edge_memory *memory, const struct frame *frame, lam_image *image, struct pool *pool) {}
void edges_free(struct edge_memory *memory) {}
uint64_t edges_bytes(const struct edge_memory *memory) { return 0; }

bool screen_occlusion_start(struct screen_occlusion *occlusion, const struct frame *frame, struct scratch_memory *lent,
                            int lent_count, struct buffer *storage, struct pool *pool, struct call_control *call,
                            lam_error *error)
{
    return left_out("compute ambient occlusion", error);
}

void screen_occlusion_find(struct screen_occlusion *occlusion, int lanes, struct pool *pool, struct call_control *call)
{
}

// --- paths

bool path_frame_make(struct path_frame *paths, struct call_control *call, lam_error *error)
{
    return left_out("draw light between surfaces", error);
}

void path_frame_free(struct path_frame *paths) {}
uint64_t path_frame_bytes(const struct path_frame *paths) { return 0; }
void path_start(struct path *path, float x, float y, uint32_t number) {}
const struct path_kernels *path_kernels_of(int lanes) { return NULL; }

bool path_denoise(const struct path_pictures *in, lam_image *out, struct pool *pool, struct call_control *call,
                  lam_error *error)
{
    return false;
}

bool paths_trace(const struct path_frame *paths, struct path_stream *stream, struct light_rays *rays,
                 const struct path_shader *shader, struct call_control *call)
{
    return true;
}
