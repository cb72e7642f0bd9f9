// opengl_scene.c: reads the OpenGL program's scene and the PLY file that the scene names. Each line of the scene is a
// keyword and its numbers.
#include "opengl_scene.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static void give_up(const char *path, const char *what)
{
    fprintf(stderr, "opengl: %s: %s\n", path, what);
    exit(1);
}

static void *room(size_t bytes)
{
    void *memory = calloc(1, bytes);
    if (!memory)
        give_up("memory", "not enough for the model");
    return memory;
}

static void read_exactly(void *to, size_t size, size_t count, FILE *file, const char *path)
{
    if (fread(to, size, count, file) != count)
        give_up(path, "ends before its triangles do");
}

static void read_ply(struct gl_scene *scene, const char *path)
{
    FILE *file = fopen(path, "rb");
    if (!file)
        give_up(path, "cannot be opened");
    setvbuf(file, NULL, _IOFBF, 1 << 20);
    char line[256];
    while (fgets(line, sizeof line, file) && strcmp(line, "end_header\n") != 0) {
        sscanf(line, "element vertex %zu", &scene->vertices);
        sscanf(line, "element face %zu", &scene->triangles);
    }
    scene->positions = room(scene->vertices * 3 * sizeof(float));
    scene->indices = room(scene->triangles * 3 * sizeof(uint32_t));
    read_exactly(scene->positions, 12, scene->vertices, file, path);
    for (size_t t = 0; t < scene->triangles; t++) {
        unsigned char face[13];
        read_exactly(face, 1, sizeof face, file, path);
        if (face[0] != 3)
            give_up(path, "has a face that is no triangle");
        memcpy(scene->indices + 3 * t, face + 1, 12);
        for (int k = 0; k < 3; k++)
            if (scene->indices[3 * t + (size_t)k] >= scene->vertices)
                give_up(path, "has an index beyond its vertices");
    }
    fclose(file);
}

static void subtract(const float *a, const float *b, double *result)
{
    for (int k = 0; k < 3; k++)
        result[k] = (double)a[k] - (double)b[k];
}

static double dot(const double *a, const double *b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

// Computes vertex normals from face normals, weighted by the angle at the corner. Lambent's normals are the same if no
// edge is sharper than the crease angle.
static void make_normals(struct gl_scene *scene)
{
    double *sums = room(scene->vertices * 3 * sizeof(double));
    for (size_t t = 0; t < scene->triangles; t++) {
        const uint32_t *corner = scene->indices + 3 * t;
        double edge[3][3]; // edge k starts at corner k
        for (int k = 0; k < 3; k++)
            subtract(scene->positions + 3 * (size_t)corner[(k + 1) % 3], scene->positions + 3 * (size_t)corner[k],
                     edge[k]);
        double back[3] = {-edge[2][0], -edge[2][1], -edge[2][2]};
        double normal[3] = {edge[0][1] * back[2] - edge[0][2] * back[1], edge[0][2] * back[0] - edge[0][0] * back[2],
                            edge[0][0] * back[1] - edge[0][1] * back[0]};
        double length = sqrt(dot(normal, normal));
        if (!(length > 0))
            continue;
        for (int k = 0; k < 3; k++) {
            const double *out = edge[k], *in = edge[(k + 2) % 3];
            double cosine = -dot(out, in) / sqrt(dot(out, out) * dot(in, in));
            double angle = acos(fmax(-1, fmin(1, cosine)));
            for (int axis = 0; axis < 3; axis++)
                sums[3 * (size_t)corner[k] + (size_t)axis] += angle * normal[axis] / length;
        }
    }
    scene->normals = room(scene->vertices * 3 * sizeof(float));
    for (size_t v = 0; v < scene->vertices; v++) {
        double length = sqrt(dot(sums + 3 * v, sums + 3 * v));
        for (size_t axis = 0; axis < 3 && length > 0; axis++)
            scene->normals[3 * v + axis] = (float)(sums[3 * v + axis] / length);
    }
    free(sums);
}

static void read_light(struct gl_scene *scene, const char *path, const char *numbers)
{
    if (scene->light_count % 64 == 0) {
        scene->lights = realloc(scene->lights, (size_t)(scene->light_count + 64) * sizeof *scene->lights);
        if (!scene->lights)
            give_up(path, "has more lights than memory holds");
    }
    struct point_light *light = &scene->lights[scene->light_count++];
    float *p = light->position, *d = light->diffuse, *s = light->specular, *a = light->attenuation;
    if (sscanf(numbers, "%f %f %f %f %f %f %f %f %f %f %f %f", p, p + 1, p + 2, d, d + 1, d + 2, s, s + 1, s + 2, a,
               a + 1, a + 2) != 12)
        give_up(path, "a light needs twelve numbers: position, diffuse, specular, attenuation");
}

static void read_vector(const char *path, const char *numbers, double *vector)
{
    if (sscanf(numbers, "%lf %lf %lf", vector, vector + 1, vector + 2) != 3)
        give_up(path, "a vector needs three numbers");
}

struct gl_scene gl_scene_read(const char *path)
{
    struct gl_scene scene = {.width = 1024, .height = 1024, .samples = 1, .fovy_degrees = 30, .up = {0, 1, 0}};
    char line[4096], model[4096] = "";
    FILE *file = fopen(path, "r");
    if (!file)
        give_up(path, "cannot be opened");
    while (fgets(line, sizeof line, file)) {
        line[strcspn(line, "\n")] = 0;
        char *rest = line + strcspn(line, " ");
        if (*rest)
            *rest++ = 0;
        if (strcmp(line, "model") == 0)
            snprintf(model, sizeof model, "%s", rest);
        else if (strcmp(line, "size") == 0)
            sscanf(rest, "%d %d", &scene.width, &scene.height);
        else if (strcmp(line, "samples") == 0)
            scene.samples = atoi(rest);
        else if (strcmp(line, "shading") == 0)
            scene.shading = strcmp(rest, "flat") == 0 ? FLAT : strcmp(rest, "gouraud") == 0 ? GOURAUD : PHONG;
        else if (strcmp(line, "eye") == 0)
            read_vector(path, rest, scene.eye);
        else if (strcmp(line, "target") == 0)
            read_vector(path, rest, scene.target);
        else if (strcmp(line, "up") == 0)
            read_vector(path, rest, scene.up);
        else if (strcmp(line, "fovy") == 0)
            scene.fovy_degrees = atof(rest);
        else if (strcmp(line, "planes") == 0)
            sscanf(rest, "%lf %lf", &scene.near_plane, &scene.far_plane);
        else if (strcmp(line, "ambient") == 0)
            sscanf(rest, "%f %f %f", scene.ambient, scene.ambient + 1, scene.ambient + 2);
        else if (strcmp(line, "shininess") == 0)
            scene.shininess = atoi(rest);
        else if (strcmp(line, "light") == 0)
            read_light(&scene, path, rest);
        else
            give_up(path, "has an unknown keyword");
    }
    fclose(file);
    read_ply(&scene, model);
    make_normals(&scene);
    return scene;
}
