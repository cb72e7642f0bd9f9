// reference_scene.h: the reference scenes: small, each made to show one thing; as a scene for the CPU device and as
// numbers for a shader's uniforms.
#ifndef REFERENCE_SCENE_H
#define REFERENCE_SCENE_H

#include <lambent/check.h>
#include <lambent/lambent.h>

enum { STUDY_LIGHTS_MOST = 3, STUDY_MESHES = 5 };

enum reference_mesh { MESH_TEAPOT, MESH_SPHERE, MESH_COARSE, MESH_PLANE, MESH_BOWL };

// What a contract must be able to say for a study to make sense with it.
enum reference_need {
    NEED_AMBIENT = 1,
    NEED_ATTENUATION = 2,
    NEED_DIRECTIONAL = 4,
    NEED_POINT = 8,
    NEED_LIGHTS = 16, // more than one
    NEED_SPOT = 32,
    NEED_ALPHA = 64,
    NEED_FLAT = 128,
    NEED_TWO_SIDES = 256,
    NEED_SHININESS = 512, // one that can be set
    NEED_VERTEX_LIT = 1024,
};

// What a shader says of itself besides, in the same bits: of each light, whether it has a kind of its own and
// no attenuation; of the whole, that it has no highlight or is flat.
enum reference_rule {
    RULE_POINT = 1,
    RULE_DIRECTIONAL = 2,
    RULE_SPOT = 3, // with a cutoff
    RULE_KIND = 3,
    RULE_UNATTENUATED = 4,
    RULE_BITS = 3, // of a light; the first one's begin at RULE_FIRST
    RULE_FIRST = 16,
    RULE_MATT = 1 << 28,
    RULE_FLAT = 1 << 29,
};

// A light, in the world's space.
struct reference_light {
    lam_light_type type; // point, directional, spot
    lam_vec3 position;
    lam_vec3 from;        // directional: the direction to the light; spot: minus its axis
    lam_rgb color;        // Ld
    lam_rgb specular;     // Ls
    lam_rgb ambient;      // La
    float attenuation[3]; // constant, linear, quadratic
    float cutoff_deg, exponent;
};

struct reference_scene {
    const char *name, *shows; // "gate": "light from behind, a wide highlight"
    unsigned needs;
    enum reference_mesh mesh;
    lam_vec3 scale, turn_axis, move; // of the model: scaled, turned, moved
    double turn_deg;
    lam_vec3 eye, target;
    lam_rgb ambient, diffuse, specular; // colours of the material
    float ka, kd, ks;                   // their strengths
    float alpha;                        // of the diffuse colour
    float shininess;
    bool flat;
    int light_count;
    struct reference_light lights[STUDY_LIGHTS_MOST];
};

extern const struct reference_scene reference_scenes[];
extern const int reference_scene_count;

int reference_scene_find(const char *name); // −1: none

// Three vertices for each triangle: positions and normals, three floats each. From malloc.
struct reference_points {
    float *positions, *normals;
    int count;
};
bool reference_points(enum reference_mesh mesh, struct reference_points *points, lam_error *error);
void reference_points_free(struct reference_points *points);

// Column vectors, m[row][column].
struct reference_matrices {
    lam_mat4 model, view, model_view, projection, model_view_projection;
    double normal[3][3]; // inverse transpose of the model-view's 3×3
    lam_mat4 normal4;    // inverse transpose of all of it, as some host programs send it
};
void reference_matrices(const struct reference_scene *reference_scene, struct reference_matrices *out);

// The scene and camera that the CPU device draws.
lam_scene *reference_to_scene(const struct reference_scene *reference_scene, lam_camera *camera, lam_error *error);

#endif
