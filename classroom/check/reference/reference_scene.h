// reference_scene.h: the reference scenes, each of which tests one feature. Other code uses the reference scenes as
// scenes for the CPU device and as values for a shader's uniforms.
#ifndef REFERENCE_SCENE_H
#define REFERENCE_SCENE_H

#include <lambent/check.h>

enum { MAX_SCENE_LIGHTS = 4, MESH_COUNT = 9 };

// A patch is the plane with a rotated texture. There are four patches: unchanged, with u mirrored, with v downward, and
// with both.
enum reference_mesh {
    MESH_TEAPOT,
    MESH_SPHERE,
    MESH_COARSE,
    MESH_PLANE,
    MESH_BOWL,
    MESH_PATCH,
    MESH_PATCH_MIRRORED,
    MESH_PATCH_DOWN,
    MESH_PATCH_DOWN_MIRRORED
};

// Features that a contract must support to express a scene.
enum reference_need {
    NEED_AMBIENT = 1,
    NEED_ATTENUATION = 2,
    NEED_DIRECTIONAL = 4,
    NEED_POINT = 8,
    NEED_LIGHTS = 16, // several lights
    NEED_SPOT = 32,
    NEED_ALPHA = 64,
    NEED_FLAT = 128,
    NEED_TWO_SIDES = 256,
    NEED_SHININESS = 512, // variable shininess
    NEED_VERTEX_LIT = 1024,
    NEED_NORMAL_MAP = 2048,
    NEED_TANGENT_SIGN = 4096, // the sign of the bitangent is an input
    NEED_EMISSION_MAP = 8192,
};

// Restrictions that follow from the shader's source: the kind of each light, whether the light is attenuated, a missing
// specular term, and flat shading. The bits of reference_rule share an integer with the bits of reference_need.
enum reference_rule {
    RULE_POINT = 1,
    RULE_DIRECTIONAL = 2,
    RULE_SPOT = 3, // a light with a cutoff
    RULE_KIND = 3,
    RULE_UNATTENUATED = 4,
    RULE_BITS = 3, // bits for each light, the first at bit RULE_FIRST
    RULE_FIRST = 16,
    RULE_NO_SPECULAR = 1 << 28,
    RULE_FLAT = 1 << 29,
};

// A light, in world space.
struct reference_light {
    lam_light_type type; // point, directional, spot
    lam_vec3 position;
    // For a directional light, the direction to the light. For a spot, the direction opposite to the spot's axis. For a
    // point light, the direction opposite to the axis that some shaders read; zero means the direction from the
    // camera's target to the light.
    lam_vec3 to_light;
    lam_rgb color;        // Ld
    lam_rgb specular;     // Ls
    lam_rgb ambient;      // La
    float attenuation[3]; // constant, linear, quadratic
    float cutoff_deg, exponent;
};

struct reference_scene {
    const char *name, *description;
    unsigned needs;
    enum reference_mesh mesh;
    lam_vec3 scale, turn_axis, move; // the model is scaled, rotated, then translated
    double turn_deg;
    lam_vec3 eye, target;
    lam_rgb ambient, diffuse, specular; // colours of the material
    float ka, kd, ks;                   // the strengths of the terms
    float alpha;                        // the alpha of the diffuse colour
    float shininess;
    // Used by shaders with metalness and roughness. For these shaders, `diffuse` is the base colour, and kd and ks are
    // 1.
    float metallic, roughness;
    bool physical;
    bool is_radiance; // the shader divides by pi, so its lights are pi times as bright
    // as in OpenGL 1, each light has its own ambient light, which is attenuated; there is no other ambient light
    bool dims_ambient;
    float roughness_angle_rad; // used by shaders of rough matt surfaces (Oren–Nayar); the steps of toon shading
    bool flat;
    // The normal in a normal map, with components along tangent, bitangent and normal. A zero vector means a flat
    // surface. As in filtered maps, the vector does not have exactly unit length.
    lam_vec3 bump;
    lam_rgb emission; // the colour of an emission map
    // Used by shaders that read maps. `maps` contains the bits (map_bit) of all maps, and `factors` the bits of the
    // maps that have a separate factor. The product of factor and texel is the corresponding number above.
    unsigned maps, factors;
    float occlusion;    // the value of an occlusion map
    bool encoded_maps;  // contract.maps
    bool tints_ambient; // the base colour map also multiplies the ambient colour
    int light_count;
    struct reference_light lights[MAX_SCENE_LIGHTS];
};

extern const struct reference_scene reference_scenes[];
extern const int reference_scene_count;

int reference_scene_find(const char *name); // returns −1 if not found

// Positions, normals and tangents of vertices, three floats each, without duplicate vertices, and three indices for
// each triangle. The 16-bit indices of OpenGL ES 2 are sufficient. The arrays are allocated with malloc.
struct reference_points {
    float *positions, *normals, *tangents;
    // Data for maps. Texture coordinates consist of two floats. Texture coordinates are linear in the position, so
    // their derivatives are nonzero everywhere. Tangents have four floats: the tangent and the sign of the bitangent.
    // On a patch the tangent is the direction in which u increases.
    float *texture_coordinates, *surface_tangents, *bitangents;
    uint16_t *indices;
    int vertex_count, count; // `count` is the number of indices
};
bool reference_points(enum reference_mesh mesh, struct reference_points *points, lam_error *error);
void reference_points_free(struct reference_points *points);

// Column vectors, m[row][column].
struct reference_matrices {
    lam_mat4 model, view, model_view, projection, model_view_projection;
    double normal[3][3]; // inverse transpose of the upper left 3×3 block of the model-view matrix
    lam_mat4 normal4;    // inverse transpose of the whole model-view matrix, which some programs use instead
};
void reference_matrices(const struct reference_scene *reference_scene, struct reference_matrices *out);

// Makes the scene and camera for the CPU device.
lam_scene *reference_to_scene(const struct reference_scene *reference_scene, lam_camera *camera, lam_error *error);

// --- A painter's context, and the reference meshes drawn so far.

enum { MAX_TEXTURE_COORDINATES = 2, MAX_FACTORS = 2 };

struct canvas {
    lam_check_painter painter; // a copy, because a cache may keep the context after the original is freed
    void *context;             // the painter's context; NULL if not open
    int size;
    char renderer[128];
    struct reference_points points[MESH_COUNT];
    lam_check_mesh meshes[MESH_COUNT]; // index_count is 0 until the mesh is made
    float *normals[MESH_COUNT];        // four floats per vertex
    float *factors[MESH_COUNT];        // four floats per vertex, made on first use
};

bool canvas_open(struct canvas *canvas, const lam_check_painter *painter, lam_check_language language, int size,
                 lam_error *error);
void canvas_close(struct canvas *canvas); // a zeroed struct is allowed

// The indices of a program's inputs for map data, −1 if missing.
struct map_inputs {
    int texture_coordinates[MAX_TEXTURE_COORDINATES], tangent, bitangent; // tangent: four floats
    int factors[MAX_FACTORS];                                             // colours that are the same at every vertex
};
extern const struct map_inputs no_map_inputs;

// Draws `mesh` instead of drawing->mesh. `inputs` are the inputs that receive the streams.
bool canvas_draw(struct canvas *canvas, enum reference_mesh mesh, const lam_check_drawing *drawing,
                 const struct map_inputs *inputs, float *pixels, lam_error *error);

// The components of a type. A matrix has several columns; a vector has one column with several rows.
struct type_shape {
    const char *name;
    int columns, rows;
};
struct type_shape type_shape(lam_check_type type);

// Returns the index of the input with this name (as the painter reports names), or -1 if there is none.
int canvas_input(const lam_check_program *program, const char *name, bool attribute);

#endif
