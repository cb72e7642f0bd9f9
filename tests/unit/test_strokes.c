// test_strokes.c: lines and points: their width in pixels, clipping, light, colours, the camera's fit, and their files.
#include "test.h"
#include "device_fixture.h"
#include "loading.h"

enum { SIDE = 64 };

static lam_camera facing(double distance)
{
    lam_camera camera = lam_camera_default();
    camera.eye = (lam_vec3){0, 0, distance};
    camera.target = (lam_vec3){0, 0, 0};
    camera.fovy_rad = 1;
    return camera;
}

static lam_image draw(const lam_scene *scene, const lam_camera *camera, lam_draw_params params)
{
    params.samples = params.samples ? params.samples : 16;
    return draw_square(scene, camera, &params, SIDE);
}

static const float *at(const lam_image *image, int x, int y)
{
    return (const float *)image->pixels + 4 * ((size_t)y * SIDE + (size_t)x);
}

// The covered area, in pixels.
static double area(const lam_image *image)
{
    double sum = 0;
    for (int i = 0; i < SIDE * SIDE; i++)
        sum += (double)((const float *)image->pixels)[4 * i + 3];
    return sum;
}

// Every width in pixels, at any distance and in any direction.
TEST(widths)
{
    static const double distances[] = {2, 20};
    for (int i = 0; i < 2; i++)
        for (int diagonal = 0; diagonal < 2; diagonal++) {
            double d = distances[i], half = 0.5 * d * tan(0.5); // half of the picture's half height
            const float p[6] = {(float)-half, (float)(diagonal ? -half : 0), 0,
                                (float)half,  (float)(diagonal ? half : 0),  0};
            lam_mesh line = {.positions = p, .vertex_count = 2, .line_count = 1};
            AUTO_SCENE scene = scene_of(&line);
            lam_camera camera = facing(d);
            double length = SIDE / 2.0 * (diagonal ? sqrt(2) : 1);
            for (double width = 1; width < 9; width += 1.5) {
                AUTO_IMAGE image = draw(scene, &camera, (lam_draw_params){.line_width = (float)width});
                assert_true(fabs(area(&image) - length * width) < 0.06 * length * width);
            }
        }
    static const float one[3] = {0, 0, 0};
    lam_mesh point = {.positions = one, .vertex_count = 1, .point_count = 1};
    AUTO_SCENE scene = scene_of(&point);
    lam_camera camera = facing(3);
    for (double size = 2; size < 20; size += 3) {
        AUTO_IMAGE image = draw(scene, &camera, (lam_draw_params){.point_size = (float)size});
        double wanted = size < 4 ? size * size : 3.14159265 / 4 * size * size; // a square, or the area of a disc
        assert_true(fabs(area(&image) - wanted) < 0.03 * wanted + 0.01);
    }
}

// A line from behind the eye ends at the near plane, with the interpolated colour of the whole line.
TEST(clipping)
{
    static const float p[6] = {0, -0.5f, 6, 0, -0.5f, -6};
    static const float colors[8] = {0, 0, 0, 1, 1, 1, 1, 1};
    lam_mesh mesh = {.positions = p,
                     .vertex_count = 2,
                     .colors = colors,
                     .color_count = 2,
                     .colors_format = LAM_COLORS_LINEAR_F32,
                     .line_count = 1};
    AUTO_SCENE scene = scene_of(&mesh);
    lam_material white = lam_material_default();
    white.diffuse = (lam_rgba){1, 1, 1, 1};
    assert_true(lam_scene_set_default_material(scene, &white, NULL));
    lam_camera camera = facing(2);
    camera.near_plane = 1;
    camera.far_plane = 100;
    lam_image image = draw(scene, &camera, (lam_draw_params){.line_width = 3, .samples = 1});
    double f = SIDE / 2.0 / tan(0.5);
    int rows = 0;
    for (int y = 0; y < SIDE; y++) {
        const float *c = at(&image, SIDE / 2, y);
        if (c[3] == 0)
            continue;
        // The row shows the line at depth d: y = SIDE/2 + f · 0.5 / d.
        double d = f * 0.5 / (y + 0.5 - SIDE / 2.0), z = 2 - d, expected = (6 - z) / 12;
        assert_true(d > 0.98);
        assert_true(fabs((double)c[0] - expected) < 0.02);
        rows++;
    }
    assert_true(rows > 15);
    lam_image_free(&image);
    // A line completely in front of the near plane is invisible.
    camera.near_plane = 9;
    image = draw(scene, &camera, (lam_draw_params){.line_width = 3});
    assert_true(area(&image) == 0);
    lam_image_free(&image);
}

// Lines without normals are unlit, with their emission; lines with normals are lit, from any side and with flat
// shading.
TEST(light)
{
    static const float p[6] = {-1, 0, 0, 1, 0, 0}, up[6] = {0, 1, 0, 0, 1, 0};
    lam_mesh mesh = {.positions = p, .vertex_count = 2, .line_count = 1};
    lam_material m = lam_material_default();
    m.diffuse = (lam_rgba){0.25f, 0.5f, 0.75f, 1};
    m.ambient = m.specular = (lam_rgb){0, 0, 0};
    m.emission = (lam_rgb){0.5f, 0, 0};
    lam_light above = lam_light_default(LAM_LIGHT_DIRECTIONAL);
    above.direction = (lam_vec3){0, -0.6, -0.8};
    above.diffuse = (lam_rgb){1, 1, 1};
    for (int lit = 0; lit < 2; lit++) {
        mesh.normals = lit ? up : NULL;
        mesh.normal_count = lit ? 2 : 0;
        AUTO_SCENE scene = scene_of(&mesh);
        assert_true(lam_scene_set_default_material(scene, &m, NULL) && lam_scene_add_light(scene, &above, NULL) >= 0);
        lam_camera camera = facing(3);
        for (int shading = LAM_SHADING_PHONG; shading <= LAM_SHADING_FLAT; shading++) {
            lam_draw_params params = {.line_width = 4, .samples = 1, .shading = (lam_shading)shading};
            AUTO_IMAGE image = draw(scene, &camera, params);
            const float *c = at(&image, SIDE / 2, SIDE / 2);
            float share = lit ? 0.6f : 1;
            assert_true(fabsf(c[0] - (0.25f * share + 0.5f)) < 1e-5f && fabsf(c[1] - 0.5f * share) < 1e-5f &&
                        fabsf(c[2] - 0.75f * share) < 1e-5f);
        }
    }
}

// A line on a face is completely visible from every side.
TEST(line_on_face)
{
    static const float corners[12] = {-1, -1, 0, 1, -1, 0, 1, 1, 0, -1, 1, 0};
    static const uint32_t faces[6] = {0, 1, 2, 0, 2, 3}, diagonal[2] = {0, 2};
    lam_mesh face = {.positions = corners, .vertex_count = 4, .indices = faces, .triangle_count = 2};
    lam_mesh line = {.positions = corners, .vertex_count = 4, .indices = diagonal, .line_count = 1};
    lam_scene *scene = scene_of(&face), *alone = scene_of(&line);
    lam_object object = lam_object_default();
    object.mesh = lam_scene_add_mesh(scene, &line, NULL);
    assert_true(lam_scene_add_object(scene, &object, NULL) == 1);
    for (int i = 0; i < 8; i++) {
        lam_camera camera = lam_camera_default();
        camera.eye = (lam_vec3){3 * cos(i * 0.7), 3 * sin(i * 0.7), 1.5};
        lam_draw_params params = {.line_width = 2, .output = LAM_OUTPUT_IDS, .samples = 1};
        lam_image both = draw(scene, &camera, params), only = draw(alone, &camera, params);
        int seen = 0, wanted = 0;
        for (int k = 0; k < SIDE * SIDE; k++) {
            wanted += ((const float *)only.pixels)[4 * k + 3] > 0;
            seen += ((const float *)both.pixels)[4 * k + 3] > 0 && ((const float *)both.pixels)[4 * k + 1] == 1;
        }
        assert_true(wanted > 10 && seen >= wanted - 1); // the face has an edge at its end
        lam_image_free(&both);
        lam_image_free(&only);
    }
    lam_scene_free(scene);
    lam_scene_free(alone);
}

static const lam_mesh *mesh_at(const lam_scene *scene, int i) { return lam_scene_mesh(scene, i); }

TEST(obj_files)
{
    lam_scene *scene =
        load_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0.5 0.25\nf 1 2 3\ng a\nl 1 2 3 1\nl -1 -3\np 2 3 \\\n 1\n"
                  "v 9 9 9\ng b\nl 1/1 -1\n",
                  "a.obj");
    assert_int_equal(lam_scene_triangle_count(scene), 1);
    assert_int_equal(lam_scene_line_count(scene), 5);
    assert_int_equal(lam_scene_point_count(scene), 3);
    assert_int_equal(lam_scene_mesh_count(scene), 3);
    const lam_mesh *lines = mesh_at(scene, 1), *points = mesh_at(scene, 2);
    static const uint32_t ends[10] = {0, 1, 1, 2, 2, 0, 2, 0, 0, 3}, dots[3] = {1, 2, 0};
    assert_memory_equal(lines->indices, ends, sizeof ends);
    assert_memory_equal(points->indices, dots, sizeof dots);
    assert_int_equal(lines->part_count, 2);
    assert_string_equal(lines->parts[0].name, "a");
    assert_int_equal(lines->parts[0].triangle_count, 4);
    assert_string_equal(lines->parts[1].name, "b");
    assert_int_equal(lines->parts[1].first_triangle, 4);
    assert_int_equal(points->part_count, 1);
    assert_non_null(lines->texcoords);
    const float *st = lines->texcoords + 2 * (size_t)lines->texcoord_indices[8];
    assert_true(st[0] == 0.5f && st[1] == 0.25f);
    assert_true(lines->texcoords[2 * (size_t)lines->texcoord_indices[9]] == 0);
    assert_null(lines->normals);
    lam_vec3 high;
    lam_scene_bounds(scene, NULL, &high);
    assert_true(high.x == 9); // a vertex of a line alone
    lam_scene_free(scene);
    scene = load_text("v 0 0 0\nv 1 2 0\nl 1 2\n", "a.obj");
    assert_int_equal(lam_scene_object_count(scene), 1);
    lam_scene_free(scene);
}

#define PLY_HEAD "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"

TEST(ply_files)
{
    lam_scene *scene = load_text(PLY_HEAD "end_header\n0 0 0\n1 0 0\n0 2 0\n", "a.ply");
    assert_int_equal(lam_scene_point_count(scene), 3);
    assert_null(mesh_at(scene, 0)->indices);
    lam_scene_free(scene);
    scene = load_text(PLY_HEAD "property float nx\nproperty float ny\nproperty float nz\nelement face 1\n"
                               "property list uchar int vertex_indices\nelement edge 2\nproperty int vertex1\n"
                               "property uchar vertex2\nproperty uchar red\nproperty uchar green\nproperty uchar blue\n"
                               "end_header\n0 0 0 0 0 1\n1 0 0 0 0 1\n0 2 0 0 0 1\n3 0 1 2\n0 1 9 8 7\n2 1 6 5 4\n",
                      "a.ply");
    assert_int_equal(lam_scene_triangle_count(scene), 1);
    assert_int_equal(lam_scene_line_count(scene), 2);
    assert_int_equal(lam_scene_point_count(scene), 0);
    const lam_mesh *lines = mesh_at(scene, 1);
    static const uint32_t ends[4] = {0, 1, 2, 1};
    static const uint8_t colors[8] = {9, 8, 7, 255, 6, 5, 4, 255};
    assert_memory_equal(lines->indices, ends, sizeof ends);
    assert_int_equal(lines->colors_rate, LAM_PER_TRIANGLE);
    assert_memory_equal(lines->colors, colors, sizeof colors);
    assert_non_null(lines->normals);
    lam_scene_free(scene);
    // Edges without vertex numbers are omitted.
    scene = load_text(PLY_HEAD "element edge 1\nproperty int vertex1\nend_header\n0 0 0\n1 0 0\n0 2 0\n0\n", "a.ply");
    assert_string_equal(lam_scene_warning(scene, 0),
                        "a.ply:7: element edge has no integer property vertex2; its edges are not drawn");
    assert_int_equal(lam_scene_point_count(scene), 3);
    lam_scene_free(scene);
}

static const char *const gltf_mode =
    "{\"asset\": {\"version\": \"2.0\"}, \"nodes\": [{\"mesh\": 0}], \"meshes\": [{\"primitives\": [{\"attributes\": "
    "{\"POSITION\": 0}, \"mode\": %d%s}]}], \"accessors\": [{\"count\": 5, \"componentType\": 5126, \"type\": "
    "\"VEC3\"}, {\"bufferView\": 0, \"count\": 3, \"componentType\": 5121, \"type\": \"SCALAR\"}], \"bufferViews\": "
    "[{\"buffer\": 0, \"byteLength\": 3}], \"buffers\": [{\"byteLength\": 3, \"uri\": "
    "\"data:application/octet-stream;base64,BAEC\"}]}";

// The four modes, with and without indices.
TEST(gltf_files)
{
    static const struct {
        int mode;
        bool indexed;
        unsigned lines, points;
        uint32_t ends[10];
    } files[] = {
        {0, false, 0, 5, {0}},
        {0, true, 0, 3, {4, 1, 2}},
        {1, false, 2, 0, {0}},
        {1, true, 1, 0, {4, 1}},
        {2, false, 5, 0, {0, 1, 1, 2, 2, 3, 3, 4, 4, 0}},
        {2, true, 3, 0, {4, 1, 1, 2, 2, 4}},
        {3, false, 4, 0, {0, 1, 1, 2, 2, 3, 3, 4}},
        {3, true, 2, 0, {4, 1, 1, 2}},
    };
    for (size_t i = 0; i < sizeof files / sizeof *files; i++) {
        char text[1000];
        snprintf(text, sizeof text, gltf_mode, files[i].mode, files[i].indexed ? ", \"indices\": 1" : "");
        AUTO_SCENE scene = load_text(text, "a.gltf");
        const lam_mesh *mesh = mesh_at(scene, 0);
        assert_int_equal(lam_scene_line_count(scene), files[i].lines);
        assert_int_equal(lam_scene_point_count(scene), files[i].points);
        assert_null(mesh->normals);
        if (mesh->indices)
            assert_memory_equal(mesh->indices, files[i].ends,
                                (2 * files[i].lines + files[i].points) * sizeof(uint32_t));
        if (files[i].mode == 1)
            assert_string_equal(lam_scene_warning(scene, 0),
                                files[i].indexed
                                    ? "a.gltf: meshes[0].primitives[0]: the last of 3 corners makes no line"
                                    : "a.gltf: meshes[0].primitives[0]: the last of 5 corners makes no line");
    }
}

// The camera fits lines, a single line and a single point.
TEST(fit)
{
    static const char *const files[] = {"v 0 0 0\nv 1 0 0\nv 0 1 0\nv 5 0 0\nf 1 2 3\nl 1 4\n",
                                        "v 0 0 0\nv 1 2 3\nl 1 2\n", "v 4 5 6\np 1\n"};
    for (int i = 0; i < 3; i++) {
        AUTO_SCENE scene = load_text(files[i], "a.obj");
        lam_camera camera = lam_camera_fit(scene, SIDE, SIDE, NULL);
        AUTO_IMAGE image = draw(scene, &camera, (lam_draw_params){.line_width = 2, .point_size = 4});
        double rim = 0;
        for (int k = 0; k < SIDE; k++)
            rim += (double)(at(&image, k, 0)[3] + at(&image, k, SIDE - 1)[3] + at(&image, 0, k)[3] +
                            at(&image, SIDE - 1, k)[3]);
        assert_true(area(&image) > 10 && rim == 0);
    }
}

TEST(refusals)
{
    static const float p[9] = {0};
    static const uint32_t beyond[2] = {0, 3};
    const struct {
        lam_mesh mesh;
        const char *text;
    } wrong[] = {
        {{.positions = p, .vertex_count = 3, .triangle_count = 1, .line_count = 1},
         "mesh: 1 triangles, 1 lines and 0 points, expected one kind"},
        {{.positions = p, .vertex_count = 3, .line_count = 2},
         "mesh: 2 lines without indices need 4 vertices, found 3"},
        {{.positions = p, .vertex_count = 3, .indices = beyond, .line_count = 1},
         "mesh: an index is not below vertex_count, 3"},
        {{.vertex_count = 3, .point_count = 1}, "mesh: positions are NULL"},
    };
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        lam_error error = {0};
        AUTO_SCENE scene = lam_scene_make(NULL);
        assert_int_equal(lam_scene_add_mesh(scene, &wrong[i].mesh, &error), -1);
        assert_string_equal(error.text, wrong[i].text);
    }
    lam_mesh point = {.positions = p, .vertex_count = 1, .point_count = 1};
    AUTO_SCENE scene = scene_of(&point);
    lam_camera camera = facing(2);
    AUTO_IMAGE image = {0};
    lam_error error = {0};
    assert_true(lam_image_make(&image, 8, 8, LAM_RGBA8, NULL));
    assert_false(lam_draw(device, scene, &camera, &(lam_draw_params){.point_size = -1}, &image, NULL, &error));
    assert_string_equal(error.text, "point_size is -1, expected pixels from 0 to 1000");
    assert_false(lam_draw(device, scene, &camera, &(lam_draw_params){.line_width = 1e9f}, &image, NULL, &error));
    assert_string_equal(error.text, "line_width is 1e+09, expected pixels from 0 to 1000");
}

// The explanation of a pixel names the line, and positions in the model.
TEST(explained)
{
    static const float p[9] = {-1, 0, 0, 1, 0, 0, 1, 1, 0}, n[9] = {0, 0, 1, 0, 0, 1, 0, 0, 1};
    static const uint32_t ends[4] = {2, 1, 0, 1};
    lam_mesh mesh = {
        .positions = p, .vertex_count = 3, .indices = ends, .normals = n, .normal_count = 3, .line_count = 2};
    AUTO_SCENE scene = scene_of(&mesh);
    lam_error error = {0};
    lam_camera camera = facing(3);
    lam_explanation *e = lam_explain(device, scene, &camera, &(lam_draw_params){.line_width = 4, .samples = 1}, SIDE,
                                     SIDE, LAM_RGBA8, SIDE / 2, SIDE / 2, NULL, &error);
    assert_non_null(e);
    assert_int_equal(e->fragment_count, 1);
    assert_int_equal(e->fragments[0].corners, 2);
    assert_int_equal(e->fragments[0].triangle, 1);
    lam_vec3 q = e->fragments[0].points[0].world_position;
    assert_true(fabs(q.x) < 0.05 && fabs(q.y) < 0.05 && fabs(q.z) < 0.25);
    lam_explanation_free(e);
}

// A line without a chosen colour is a grey that is visible on a white and on a transparent background, and on a dark
// one as before.
TEST(unchosen_color)
{
    static const float p[6] = {-1, 0, 0, 1, 0, 0}, white[8] = {1, 1, 1, 1, 1, 1, 1, 1};
    static const lam_rgba backgrounds[] = {{1, 1, 1, 1}, {0, 0, 0, 0}, {0.02f, 0.02f, 0.02f, 1}};
    const float given = lam_material_default().diffuse.r;
    for (int colored = 0; colored < 2; colored++)
        for (int i = 0; i < 3; i++) {
            lam_mesh line = {.positions = p, .vertex_count = 2, .line_count = 1};
            if (colored) {
                line.colors = white;
                line.color_count = 2;
                line.colors_format = LAM_COLORS_LINEAR_F32;
            }
            AUTO_SCENE scene = scene_of(&line);
            lam_camera camera = facing(3);
            lam_image image =
                draw(scene, &camera, (lam_draw_params){.line_width = 8, .background = backgrounds[i], .samples = 1});
            float expected = colored || i == 2 ? given : 0.2f;
            assert_true(fabsf(at(&image, SIDE / 2, SIDE / 2)[0] - expected) < 1e-6f);
            lam_image_free(&image);
        }
}

FIXTURE(set_up, tear_down)
