// model.c: generates the benchmark's models: `model sphere|terrain TRIANGLES FILE.ply|.stl|.obj`.
//
// The sphere is bumpy, so that all its rows differ. The terrain is a height field over [-1, 1] x [-1, 1] that fills a
// picture seen from above. Both have about TRIANGLES triangles. PLY files are binary, with shared positions and without
// normals. STL files are binary. OBJ files have six decimals. Scanners and slicers write such files.
#include <math.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

struct model {
    float *positions;  // x, y, z of each vertex
    uint32_t *indices; // three for each triangle
    size_t vertices, triangles;
};

static const double pi = 3.14159265358979323846;

static void make_room(struct model *model, size_t vertices, size_t triangles)
{
    model->positions = malloc(vertices * 3 * sizeof(float));
    model->indices = malloc(triangles * 3 * sizeof(uint32_t));
    if (!model->positions || !model->indices) {
        fprintf(stderr, "model: no memory for %zu triangles\n", triangles);
        exit(1);
    }
}

static void add_vertex(struct model *model, double x, double y, double z)
{
    float *p = model->positions + 3 * model->vertices++;
    p[0] = (float)x, p[1] = (float)y, p[2] = (float)z;
}

static void add_triangle(struct model *model, size_t a, size_t b, size_t c)
{
    uint32_t *t = model->indices + 3 * model->triangles++;
    t[0] = (uint32_t)a, t[1] = (uint32_t)b, t[2] = (uint32_t)c;
}

// The sphere consists of rings of quadrilaterals. At the poles, the rings consist of triangles.
static struct model make_sphere(size_t triangles)
{
    struct model model = {0};
    size_t rings = (size_t)lround(sqrt((double)triangles / 4));
    if (rings < 4)
        rings = 4;
    size_t around = 2 * rings;
    make_room(&model, (rings + 1) * around, 2 * rings * around);
    for (size_t j = 0; j <= rings; j++) {
        double theta = pi * (double)j / (double)rings, s = sin(theta), c = cos(theta);
        for (size_t i = 0; i < around; i++) {
            double turn = 2 * pi * (double)i / (double)around;
            double r = 1 + 0.06 * cos(9 * turn) * sin(7 * theta) * s;
            add_vertex(&model, r * s * cos(turn), r * c, r * s * sin(turn));
        }
    }
    for (size_t j = 0; j < rings; j++)
        for (size_t i = 0; i < around; i++) {
            size_t a = j * around + i, b = j * around + (i + 1) % around, c = a + around, d = b + around;
            if (j > 0)
                add_triangle(&model, a, b, d);
            if (j < rings - 1)
                add_triangle(&model, a, d, c);
        }
    return model;
}

// y is up, as for the sphere.
static struct model make_terrain(size_t triangles)
{
    struct model model = {0};
    size_t side = (size_t)lround(sqrt((double)triangles / 2));
    if (side < 2)
        side = 2;
    make_room(&model, (side + 1) * (side + 1), 2 * side * side);
    for (size_t j = 0; j <= side; j++)
        for (size_t i = 0; i <= side; i++) {
            double x = 2 * (double)i / (double)side - 1, z = 2 * (double)j / (double)side - 1;
            add_vertex(&model, x, 0.02 * sin(11 * x + 3 * z) + 0.015 * cos(17 * z - 5 * x), z);
        }
    for (size_t j = 0; j < side; j++)
        for (size_t i = 0; i < side; i++) {
            size_t a = j * (side + 1) + i, b = a + 1, c = a + side + 1, d = c + 1;
            add_triangle(&model, a, c, d);
            add_triangle(&model, a, d, b);
        }
    return model;
}

static void write_ply(FILE *file, const struct model *model)
{
    fprintf(file,
            "ply\nformat binary_little_endian 1.0\nelement vertex %zu\nproperty float x\nproperty float y\n"
            "property float z\nelement face %zu\nproperty list uchar int vertex_indices\nend_header\n",
            model->vertices, model->triangles);
    fwrite(model->positions, 12, model->vertices, file);
    for (size_t t = 0; t < model->triangles; t++) {
        putc(3, file);
        fwrite(model->indices + 3 * t, 4, 3, file);
    }
}

static void write_stl(FILE *file, const struct model *model)
{
    char header[80] = "benchmark";
    uint32_t count = (uint32_t)model->triangles;
    fwrite(header, 1, sizeof header, file);
    fwrite(&count, 4, 1, file);
    for (size_t t = 0; t < model->triangles; t++) {
        unsigned char facet[50] = {0}; // a zero normal, as in files of many programs
        for (size_t k = 0; k < 3; k++)
            memcpy(facet + 12 + 12 * k, model->positions + 3 * (size_t)model->indices[3 * t + k], 12);
        fwrite(facet, 1, sizeof facet, file);
    }
}

static void write_obj(FILE *file, const struct model *model)
{
    for (size_t v = 0; v < model->vertices; v++) {
        const float *p = model->positions + 3 * v;
        fprintf(file, "v %.6f %.6f %.6f\n", (double)p[0], (double)p[1], (double)p[2]);
    }
    for (size_t t = 0; t < model->triangles; t++) {
        const uint32_t *i = model->indices + 3 * t;
        fprintf(file, "f %u %u %u\n", i[0] + 1, i[1] + 1, i[2] + 1);
    }
}

static bool ends_with(const char *text, const char *end)
{
    size_t a = strlen(text), b = strlen(end);
    return a >= b && strcmp(text + a - b, end) == 0;
}

int main(int count, char **arguments)
{
    if (count != 4) {
        fprintf(stderr, "usage: model sphere|terrain TRIANGLES FILE.ply|.stl|.obj\n");
        return 1;
    }
    const char *path = arguments[3];
    long triangles = atol(arguments[2]);
    bool sphere = strcmp(arguments[1], "sphere") == 0;
    if ((!sphere && strcmp(arguments[1], "terrain") != 0) || triangles < 1 || triangles > 500000000) {
        fprintf(stderr, "model: expected sphere or terrain and 1 to 500000000 triangles, found '%s' '%s'\n",
                arguments[1], arguments[2]);
        return 1;
    }
    struct model model = sphere ? make_sphere((size_t)triangles) : make_terrain((size_t)triangles);
    FILE *file = fopen(path, "wb");
    if (!file) {
        perror(path);
        return 1;
    }
    setvbuf(file, NULL, _IOFBF, 1 << 20);
    if (ends_with(path, ".ply"))
        write_ply(file, &model);
    else if (ends_with(path, ".stl"))
        write_stl(file, &model);
    else if (ends_with(path, ".obj"))
        write_obj(file, &model);
    else {
        fprintf(stderr, "model: %s: expected a name that ends in .ply, .stl or .obj\n", path);
        return 1;
    }
    if (fclose(file) != 0) {
        perror(path);
        return 1;
    }
    free(model.positions);
    free(model.indices);
    return 0;
}
