// test_scene_file.c: scene files: objects, errors, truncated files, failed allocations, and writing. tests/cli/doors.py tests
// the keys of lights, materials, cameras and settings.
#include "test.h"
#include "loading.h"

#define TRIANGLE "v 0 0 0\nv 1 0 0\nv 0 1 0\n"

// The files next to the scene.
static bool open_beside(void *user, const char *name, lam_bytes *bytes, lam_error *error)
{
    (void)user;
    const char *text = strcmp(name, "a.obj") == 0 ? "mtllib a.mtl\n" TRIANGLE
                                                    "usemtl red\nf 1 2 3\nusemtl blue\nf 1 3 2\n"
                       : strcmp(name, "a.mtl") == 0      ? "newmtl red\nKd 1 0 0\nNs 9\nnewmtl blue\nKd 0 0 1\n"
                       : strcmp(name, "in/b.obj") == 0   ? "mtllib b.mtl\n" TRIANGLE "usemtl green\nf 1 2 3\n"
                       : strcmp(name, "in/b.mtl") == 0   ? "newmtl green\nKd 0 1 0\n"
                       : strcmp(name, "points.obj") == 0 ? "v nan 0 0\n"
                       : strcmp(name, "inner.json") == 0 ? "{\"lambent\": 1}"
                                                         : NULL;
    if (!text) {
        *error = (lam_error){LAM_CANNOT_READ, "there is no such file"};
        return false;
    }
    bytes->size = strlen(text);
    bytes->data = malloc(bytes->size);
    memcpy(bytes->data, text, bytes->size);
    return true;
}

static lam_scene *load_scene(const char *text, lam_error *error)
{
    lam_load_params params = {.threads = 1, .open = open_beside};
    return lam_scene_load_memory(text, strlen(text), "s.json", &params, NULL, error);
}

static lam_scene *good(const char *text)
{
    lam_error error = {0};
    lam_scene *scene = load_scene(text, &error);
    if (!scene)
        fail_msg("%s: %s", text, error.text);
    return scene;
}

#define BALL "\"objects\": [{\"shape\": \"sphere\", \"slices\": 4, \"stacks\": 2}]"

TEST(test_defaults)
{
    lam_scene *scene = good("{\"lambent\": 1, " BALL "}");
    lam_picture_settings settings;
    assert_true(lam_scene_picture_settings(scene, &settings));
    assert_int_equal(settings.present, 0);
    assert_int_equal(lam_scene_light_count(scene), 0);
    assert_int_equal(lam_scene_up(scene), LAM_UP_Y);
    const lam_object *ball = lam_scene_object(scene, 0);
    assert_string_equal(ball->name, "sphere");
    assert_int_equal(ball->material, -1);
    assert_false(ball->one_sided);
    assert_string_equal(lam_scene_format(scene), "scene");
    lam_scene_free(scene);
    AUTO_SCENE plain = lam_scene_make(NULL);
    assert_false(lam_scene_picture_settings(plain, &settings));
}

TEST(test_objects)
{
    lam_scene *scene =
        good("{\"lambent\": 1, \"materials\": {\"m\": {\"diffuse\": [0.1, 0.2, 0.3, 0.5], \"specular\": "
             "\"white\", "
             "\"emission\": [1, 2, 3], \"shininess\": 7, \"reflectivity\": [0.1, 0.1, 0.1], \"opacity\": "
             "0.5, \"fibre\": true}}, "
             "\"objects\": [{\"name\": \"one\", \"shape\": \"cube\", \"radius\": 2, \"transform\": "
             "[[\"translate\", 1, 2, 3], "
             "[\"rotate\", 90, 0, 0, 1], [\"scale\", 2, 3, 4]], \"material\": \"m\", \"back_material\": "
             "{\"diffuse\": [1, 0, 0]}, "
             "\"two_sided\": false, \"cull\": \"back\", \"tangents\": \"field\"}, "
             "{\"name\": \"two\", \"file\": \"a.obj\", \"materials\": {\"blue\": {\"shininess\": 3}}, "
             "\"normals\": \"facet\", "
             "\"transform\": [1, 0, 0, 5, 0, 1, 0, 6, 0, 0, 1, 7, 0, 0, 0, 1], \"crease_angle\": 20}, "
             "{\"file\": \"in/b.obj\", \"material\": \"Gold\", \"transform\": [[\"scale\", 2]]}]}");
    const lam_object *one = lam_scene_object(scene, 0), *two = lam_scene_object(scene, 1),
                     *three = lam_scene_object(scene, 2);
    assert_string_equal(one->name, "one");
    // The last step acts first: (1, 0, 0) → scaled (2, 0, 0) → rotated (0, 2, 0) → moved (1, 4, 3).
    const double(*m)[4] = one->transform.m;
    assert_true(fabs(m[0][0] + m[0][3] - 1) < 1e-15 && fabs(m[1][0] + m[1][3] - 4) < 1e-15 && m[2][0] + m[2][3] == 3);
    const lam_material *front = lam_scene_material(scene, one->material),
                       *back = lam_scene_material(scene, one->back_material);
    assert_true(front->diffuse.a == 0.25f && front->ambient.g == 0.2f && front->specular.r == 1 &&
                front->emission.b == 3 && front->shininess == 7 && front->reflectivity.r == 0.1f && front->fibre);
    // Omitted properties of the back are the front's.
    assert_true(back->diffuse.r == 1 && back->ambient.g == 0.2f && back->shininess == 7 && back->fibre);
    assert_true(one->one_sided && one->cull == LAM_CULL_BACK);
    assert_null(lam_scene_mesh(scene, one->mesh)->tangents);
    assert_true(two->transform.m[0][3] == 5 && two->transform.m[2][3] == 7);
    const lam_mesh *mesh = lam_scene_mesh(scene, two->mesh);
    assert_int_equal(mesh->part_count, 2);
    const lam_material *red = lam_scene_material(scene, mesh->parts[0].material);
    const lam_material *blue = lam_scene_material(scene, mesh->parts[1].material);
    assert_string_equal(red->name, "red");
    assert_true(red->shininess == 9 && blue->diffuse.b == 1 && blue->shininess == 3);
    assert_int_equal(three->transform.m[1][1], 2);
    assert_true(lam_scene_material(scene, three->material)->shininess ==
                lam_material_named(LAM_MATERIAL_GOLD, LAM_COLOR_SRGB).shininess);
    const lam_mesh *inner = lam_scene_mesh(scene, three->mesh);
    assert_string_equal(lam_scene_material(scene, inner->parts[0].material)->name, "green");
    assert_null(lam_scene_warning(scene, 0));
    lam_scene_free(scene);
}

TEST(test_errors)
{
    static const struct {
        const char *text, *sentence;
    } rows[] = {
#define WITH(more, sentence)   {"{\"lambent\": 1, " BALL ", " more "}", "s.json: " sentence}
#define OBJECT(more, sentence) {"{\"lambent\": 1, \"objects\": [{" more "}]}", "s.json: objects[0]" sentence}
#define LIGHT(more, sentence)  WITH("\"lights\": [{" more "}]", "lights[0]" sentence)
#define SPHERE                 "\"shape\": \"sphere\", "
        {"{\"lambent\": 1,\n \"objects\": [}", "s.json:2: column 14: found '}', expected a value"},
        {"{\"lambent\": 1, \"lambent\": 1}", "s.json:1: column 16: the key 'lambent' is given twice"},
        {"{\"x\": \"\\\"lambent\\\"\", \"lambent\": 1}",
         "s.json: x: unknown key; expected lambent, image, camera, ambient, environment, up, materials, objects, "
         "lights, ..."},
        {"{\"lambent\": 1}", "s.json: 'objects' is missing, expected a list of at least one object"},
        {"{\"lambent\": 2, " BALL "}", "s.json: lambent: the format's version is 2, this program reads version 1"},
        {"{\"lambent\": \"1\", " BALL "}", "s.json: lambent: found \"1\", expected a number"},
        {"{\"lambent\": 1, \"objects\": []}",
         "s.json: objects: found a list of 0, expected a list of at least one object"},
        WITH("\"lihgts\": []", "lihgts: unknown key; did you mean 'lights'?"),
        WITH("\"image\": {\"size\": [2.5, 2]}", "image.size[0]: found 2.5, expected pixels from 1 to 65535"),
        WITH("\"image\": {\"color_mode\": \"rwa\"}",
             "image.color_mode: found \"rwa\", expected srgb or raw; did you mean 'raw'?"),
        WITH("\"image\": {\"color\": \"rwa\"}",
             "image.color: found \"rwa\", expected srgb or raw; did you mean 'raw'?"),
        WITH("\"camera\": 5", "camera: found 5, expected an object, { … }"),
        WITH("\"environment\": {\"faces\": [\"a\"]}",
             "environment.faces: found a list of 1, expected six names of pictures: +x, -x, +y, -y, +z, -z"),
        WITH("\"materials\": {\"m\": {\"shinines\": 1}}",
             "materials.m.shinines: unknown key; did you mean 'shininess'?"),
        WITH("\"materials\": []", "materials: found a list of 0, expected an object of named materials"),
        OBJECT("\"name\": \"x\"", ": contains neither shape nor file, expected one of them"),
        OBJECT(SPHERE "\"file\": \"a.obj\"", ": contains both shape and file, expected only one"),
        OBJECT("\"shape\": \"sphrere\"", ".shape: no shape is named 'sphrere', the nearest name is 'sphere'"),
        OBJECT(SPHERE "\"radius\": 0", ".radius: found 0, expected a number of at least 1e-30"),
        OBJECT(SPHERE "\"slices\": 2", ".slices: found 2, expected a number from 3 to 16384"),
        OBJECT(SPHERE "\"stacks\": 4.5", ".stacks: found 4.5, expected a whole number"),
        OBJECT("\"file\": \"none.obj\"", ".file: there is no such file"),
        OBJECT("\"file\": \"inner.json\"", ".file: 'inner.json' is a scene file, expected a model"),
        OBJECT("\"file\": \"\"", ".file: found \"\", expected a string that is not empty"),
        OBJECT("\"file\": \"a.obj\", \"materials\": {\"green\": {}}",
               ".materials.green: the model has no material of this name"),
        OBJECT("\"file\": \"a.obj\", \"parts\": [null]", ".parts: found a list of 1, expected a list of 2, "
                                                         "one material or null for each part of the model"),
        OBJECT("\"file\": \"a.obj\", \"radius\": 4", ".radius: unknown key; expected name, transform, material, "
                                                     "back_material, two_sided, cull, tangents, normals, crease_angle, "
                                                     "file, materials, parts, scene, variant, animation, time"),
        OBJECT(SPHERE "\"material\": {\"shinines\": 4}", ".material.shinines: unknown key; did you mean 'shininess'?"),
        OBJECT(SPHERE "\"material\": \"glod\"",
               ".material: no material is named 'glod'; did you mean 'gold'? `lambent materials` lists the names"),
        OBJECT(SPHERE "\"transform\": [[\"rotate\", 3, 0, 0, 0]]",
               ".transform[0]: the axis of the rotation is 0, 0, 0, expected a direction"),
        OBJECT(SPHERE "\"transform\": [[\"scale\", 1, 0, 1]]",
               ".transform[0]: scales by 0, which leaves no surface to light"),
        OBJECT(SPHERE "\"transform\": [[\"skew\", 1]]",
               ".transform[0]: found \"skew\" with 1 number, expected [\"translate\", x, "
               "y, z], [\"rotate\", degrees, x, y, z] or [\"scale\", x, y, z]"),
        OBJECT(SPHERE "\"transform\": [1, 2, 3]", ".transform: found a list of 3, expected a list of 16 numbers"),
        OBJECT(SPHERE "\"transform\": [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1]",
               ".transform: the transform cannot be inverted: it flattens the object, or its numbers are too "
               "large"),
        OBJECT(SPHERE "\"transform\": [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 1, 1]",
               ".transform: the matrix's last row is 0, 0, 1, 1, expected 0, 0, 0, 1"),
        OBJECT(SPHERE "\"cull\": \"both\"", ".cull: found \"both\", expected none, back or front"),
        LIGHT("\"name\": \"x\"", ": 'type' is missing, expected ambient, hemisphere, point, directional or spot"),
        LIGHT("\"type\": \"sun\"",
              ".type: found \"sun\", expected ambient, hemisphere, point, directional or spot; did you "
              "mean 'directional'?"),
        LIGHT("\"type\": \"point\", \"intensity\": 1e30, \"color\": [1e30, 0, 0]",
              ": point light: diffuse.r is inf, expected a finite number of 0 or more"),
        WITH("\"lights\": {}", "lights: found an object, expected a list of lights, [ … ]"),
        {"{\"lambent\": 1, \"ambient\": [1e999, 0, 0]}", ""},
    };
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        lam_error error = {0};
        assert_null(load_scene(rows[i].text, &error));
        if (strstr(rows[i].text, "1e999")) // JSON has no infinity
            assert_non_null(strstr(error.text, "found '1e999', expected a number within the range of a double"));
        else if (strstr(rows[i].sentence, ", ...")) // the settings of the table follow
            assert_memory_equal(error.text, rows[i].sentence, strlen(rows[i].sentence) - strlen("..."));
        else
            assert_string_equal(error.text, rows[i].sentence);
        assert_int_equal(error.code, strstr(rows[i].text, "\"lambent\": 2") ? LAM_UNSUPPORTED : LAM_CANNOT_READ);
        assert_null(load_scene(rows[i].text, NULL));
    }
    lam_error error = {0};
    assert_null(load_scene("{\"lambent\": 1, \"objects\": [{\"file\": \"points.obj\"}]}", &error));
    assert_non_null(strstr(error.text, "contains nothing to draw"));
}

static const char whole[] =
    "{\"lambent\": 1, \"image\": {\"size\": [8, 8]}, \"materials\": {\"m\": {\"diffuse\": [1, 0, 0]}}, "
    "\"objects\": ["
    "{\"name\": \"x\", \"file\": \"a.obj\", \"transform\": [[\"scale\", 2]], \"back_material\": \"m\"}, "
    "{\"shape\": \"cube\", \"slices\": 3, \"stacks\": 1, \"normals\": \"smooth\"}], "
    "\"lights\": [{\"name\": \"l\", \"type\": \"point\", \"frame\": \"object\", \"object\": \"x\"}]}";

TEST(test_prefixes)
{
    char text[sizeof whole];
    for (size_t length = 0; length < sizeof whole - 1; length++) {
        memcpy(text, whole, length);
        text[length] = 0;
        lam_error error = {0};
        assert_null(load_scene(text, &error));
        assert_true(error.code == LAM_CANNOT_READ && error.text[0]);
    }
    lam_scene_free(good(whole));
}

TEST(test_memory)
{
    for (long i = 0;; i++) {
        lam_error error = {0};
        arena_fail_after(i);
        lam_scene *scene = load_scene(whole, &error);
        arena_fail_after(-1);
        lam_scene_free(scene);
        if (scene)
            break;
        assert_int_equal(error.code, LAM_MACHINE);
        assert_true(i < 10000);
    }
    lam_load_params params = {.threads = 1, .open = open_beside};
    lam_control control = {.memory_limit_bytes = 4096};
    lam_error error = {0};
    assert_null(lam_scene_load_memory(whole, sizeof whole - 1, "s.json", &params, &control, &error));
    assert_int_equal(error.code, LAM_LIMIT);
}

// Everything that a scene can contain is restored bit for bit.
TEST(test_writing)
{
    char folder[] = "/tmp/lambent-scene-XXXXXX", path[64], model[64];
    assert_non_null(mkdtemp(folder));
    snprintf(path, sizeof path, "%s/s.json", folder);
    snprintf(model, sizeof model, "%s/m.obj", folder);
    FILE *file = fopen(model, "w");
    fputs(TRIANGLE "f 1 2 3\n", file);
    fclose(file);
    lam_error error = {0};
    AUTO_SCENE scene = lam_scene_load(model, NULL, NULL, &error);
    lam_shape_params segments = {.radius = 0.1 + 0.2, .slices = 5, .stacks = 3};
    lam_object object = lam_object_default();
    object.mesh = lam_scene_add_shape(scene, "torus", &segments, &error);
    lam_material material = lam_material_named(LAM_MATERIAL_BRASS, LAM_COLOR_SRGB);
    material.emission = (lam_rgb){1e-7f, 3e20f, 1.0f / 3};
    material.diffuse.a = 0.7f;
    material.fibre = true;
    object.material = lam_scene_add_material(scene, &material, &error);
    material.fibre = false;
    material.diffuse.a = 1;
    object.back_material = lam_scene_add_material(scene, &material, &error);
    object.name = "ring";
    object.one_sided = true;
    object.cull = LAM_CULL_FRONT;
    object.transform.m[0][0] = 0.1 + 1e-17;
    object.transform.m[0][3] = 1.0 / 3;
    object.transform.m[2][1] = -0.0;
    assert_true(lam_scene_add_object(scene, &object, &error) == 1);
    lam_light lights[4] = {lam_light_default(LAM_LIGHT_SPOT), lam_light_default(LAM_LIGHT_SPOT),
                           lam_light_default(LAM_LIGHT_POINT), lam_light_default(LAM_LIGHT_HEMISPHERE)};
    lights[0].cutoff_rad = 1.5707964f;
    lights[0].exponent = 0.1f;
    lights[0].direction = (lam_vec3){0.1, 1.0 / 7, 3};
    lights[1].inner_rad = 0.123456f;
    lights[1].outer_rad = 0.1234561f;
    lights[1].frame = LAM_FRAME_OBJECT;
    lights[1].object = "ring";
    lights[2].attenuation = (lam_attenuation){0, 0, 0};
    lights[2].range = 7.7f;
    lights[2].radius = 0.3f;
    lights[0].no_shadows = true;
    for (int i = 0; i < 4; i++)
        assert_true(lam_scene_add_light(scene, &lights[i], &error) == i);
    lam_scene_set_ambient(scene, (lam_rgb){0.1f, 0.7f, 1e-3f});
    lam_picture_settings s = {
        .present = (LAM_SETTING_LIGHTS << 1) - 1, .width = 7, .height = 9, .camera = lam_camera_default()};
    s.draw = (lam_draw_params){.samples = 2,
                               .background = {0.1f, 0.2f, 0.3f, 0.4f},
                               .color = LAM_COLOR_RAW,
                               .shading = LAM_SHADING_FLAT,
                               .stage = LAM_STAGE_VERTEX,
                               .rig = LAM_RIG_NONE,
                               .light_cutoff = -1,
                               .reference = 64,
                               .ground = LAM_GROUND_COLOR,
                               .ground_color = {0.1f, 1.0f / 3, 0}};
    // Every row of the table with a value other than its default. The ones above are consistent with each other.
    for (int i = 0; lam_draw_setting(i); i++) {
        const lam_setting *setting = lam_draw_setting(i);
        void *member = (char *)&s.draw + setting->offset;
        s.draw_present |= UINT64_C(1) << i;
        if (!lam_setting_is_default(setting, &s.draw))
            continue;
        if (setting->type == LAM_SETTING_NUMBER)
            *(float *)member = (float)(setting->min + (setting->max - setting->min) / 7);
        else if (setting->type == LAM_SETTING_WHOLE)
            *(int *)member = (int)setting->max;
        else if (setting->type == LAM_SETTING_ANGLE)
            *(float *)member = 0.71234567f;
        else if (setting->type == LAM_SETTING_WORDS)
            *(int *)member = 5;
        else if (setting->type == LAM_SETTING_RGBA)
            *(lam_rgba *)member = (lam_rgba){0.1f, 0, 1.0f / 3, 0.5f};
        else if (setting->type == LAM_SETTING_WORD)
            assert_non_null(setting->word(1, member));
        else
            *(bool *)member = true;
        assert_false(lam_setting_is_default(setting, &s.draw));
    }
    s.camera.fovy_rad = 0.7123456789012345;
    s.camera.eye = (lam_vec3){1.0 / 3, 1e-9, 12345678.9};
    s.camera.near_plane = 0.1;
    s.camera.far_plane = 100;
    assert_true(lam_scene_save(scene, &s, path, &error));
    lam_scene *back = lam_scene_load(path, NULL, NULL, &error);
    SUCCEEDS(back);
    lam_picture_settings t;
    assert_true(lam_scene_picture_settings(back, &t));
    assert_int_equal(t.present, s.present);
    assert_true(t.draw_present == s.draw_present);
    for (int i = 0; lam_draw_setting(i); i++) {
        lam_draw_params copy = t.draw;
        lam_setting_copy(lam_draw_setting(i), &s.draw, &copy);
        if (memcmp(&copy, &t.draw, sizeof copy) != 0)
            fail_msg("%s came back with another value", lam_draw_setting(i)->key);
    }
    assert_memory_equal(&t.draw.samples, &s.draw.samples, sizeof s.draw.samples);
    assert_memory_equal(&t.draw.background, &s.draw.background, sizeof s.draw.background);
    assert_true(t.draw.color == s.draw.color && t.draw.rig == LAM_RIG_NONE);
    assert_memory_equal(&t.camera.eye, &s.camera.eye, sizeof s.camera.eye);
    assert_true(fabs(t.camera.fovy_rad - s.camera.fovy_rad) <= 1.2e-16);
    assert_true(t.camera.near_plane == 0.1 && t.camera.far_plane == 100 && t.width == 7 && t.height == 9);
    const lam_object *ring = lam_scene_object(back, 1);
    assert_memory_equal(&ring->transform, &object.transform, sizeof object.transform);
    assert_true(ring->one_sided && ring->cull == LAM_CULL_FRONT && strcmp(ring->name, "ring") == 0);
    const lam_mesh *made = lam_scene_mesh(back, ring->mesh), *first = lam_scene_mesh(scene, object.mesh);
    assert_int_equal(made->vertex_count, first->vertex_count);
    assert_memory_equal(made->positions, first->positions, 12 * (size_t)first->vertex_count);
    for (int side = 0; side < 2; side++) {
        const lam_material *a = lam_scene_material(scene, side ? object.back_material : object.material);
        const lam_material *b = lam_scene_material(back, side ? ring->back_material : ring->material);
        assert_memory_equal(a, b, offsetof(lam_material, fibre)); // the colours and the shininess
        assert_int_equal(a->fibre, b->fibre);
    }
    for (int i = 0; i < 4; i++) {
        lam_light a = *lam_scene_light(scene, i), b = *lam_scene_light(back, i);
        assert_memory_equal(&a.position, &b.position, sizeof a.position + sizeof a.direction + 3 * sizeof a.ambient);
        assert_true(a.range == b.range && a.exponent == b.exponent && a.inner_rad == b.inner_rad &&
                    a.outer_rad == b.outer_rad);
        assert_true(a.cutoff_rad == b.cutoff_rad || a.outer_rad > 0);
        assert_true(a.sky.r == b.sky.r && a.ground.b == b.ground.b);
        assert_true(a.radius == b.radius && a.no_shadows == b.no_shadows);
    }
    assert_true(lam_scene_light(back, 2)->attenuation.constant == 1); // the meaning of three zeros
    lam_rgb ambient = lam_scene_ambient(back);
    assert_true(ambient.r == 0.1f && ambient.g == 0.7f && ambient.b == 1e-3f);
    lam_scene_free(back);

    // A mesh made by hand has no name for the file.
    float corners[9] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
    lam_mesh mesh = {.positions = corners, .vertex_count = 3, .triangle_count = 1};
    lam_object extra = lam_object_default();
    extra.mesh = lam_scene_add_mesh(scene, &mesh, &error);
    lam_scene_add_object(scene, &extra, &error);
    assert_false(lam_scene_save(scene, NULL, path, &error));
    assert_int_equal(error.code, LAM_UNSUPPORTED);
    assert_false(lam_scene_save(scene, NULL, "/nowhere/x.json", &error));
    assert_int_equal(error.code, LAM_CANNOT_WRITE);
    assert_false(lam_scene_save(NULL, NULL, path, &error));
    unlink(path);
    unlink(model);
    rmdir(folder);
}
