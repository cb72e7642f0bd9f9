// test_scene_file.c: scene files: every key, every error, truncated files, failed allocations, and writing.
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
    lam_scene *plain = lam_scene_make(NULL);
    assert_false(lam_scene_picture_settings(plain, &settings));
    lam_scene_free(plain);
}

TEST(test_picture)
{
    lam_scene *scene =
        good("{\"lambent\": 1, \"image\": {\"size\": [30, 20], \"samples\": 8, \"background\": "
             "\"#80808080\", \"color_mode\": \"raw\", "
             "\"exposure\": 0}, \"camera\": {\"eye\": [1, 2, 3], \"target\": [0, 1, 0], \"up\": [0, 0, 1], "
             "\"ortho_half_height\": 2, \"near\": -1, \"far\": 5}, \"ambient\": [0.1, 0.2, 0.3], "
             "\"shading\": \"flat\", "
             "\"reflection\": \"kajiya-kay\", \"stage\": \"vertex\", \"viewer\": \"infinite\", "
             "\"flat_normal\": \"vertex\", "
             "\"match_highlights\": true, \"single_scattering\": true, \"gl1\": true, \"up\": \"z\", \"light_cutoff\": "
             "0.25, \"lights\": "
             "[], " BALL "}");
    lam_picture_settings s;
    assert_true(lam_scene_picture_settings(scene, &s));
    assert_int_equal(s.present, LAM_SETTING_SIZE | LAM_SETTING_SAMPLES | LAM_SETTING_BACKGROUND | LAM_SETTING_COLOR |
                                    LAM_SETTING_EXPOSURE | LAM_SETTING_CAMERA | LAM_SETTING_LIGHTS);
    static const char *const given[] = {"shading",          "reflection",        "stage", "viewer",      "flat_normal",
                                        "match_highlights", "single_scattering", "gl1",   "light_cutoff"};
    uint64_t rows = 0;
    for (size_t i = 0; i < sizeof given / sizeof *given; i++)
        rows |= UINT64_C(1) << lam_draw_setting_find(given[i]);
    assert_true(s.draw_present == rows);
    assert_true(s.draw.light_cutoff == 0.25f);
    assert_true(s.width == 30 && s.height == 20 && s.draw.samples == 8);
    assert_true(s.draw.background.r == (float)(128.0 / 255) && s.draw.background.a == (float)(128.0 / 255));
    assert_int_equal(s.draw.color, LAM_COLOR_RAW);
    assert_true(s.camera.eye.z == 3 && s.camera.target.y == 1 && s.camera.up.z == 1 &&
                s.camera.ortho_half_height == 2 && s.camera.near_plane == -1 && s.camera.far_plane == 5);
    assert_true(s.draw.shading == LAM_SHADING_FLAT && s.draw.reflection == LAM_REFLECTION_KAJIYA_KAY &&
                s.draw.stage == LAM_STAGE_VERTEX && s.draw.viewer == LAM_VIEWER_INFINITE &&
                s.draw.flat_normal == LAM_FLAT_NORMAL_VERTEX && s.draw.match_highlights && s.draw.single_scattering &&
                s.draw.gl1);
    assert_int_equal(s.draw.rig, LAM_RIG_NONE);
    assert_int_equal(lam_scene_up(scene), LAM_UP_Z);
    assert_true(lam_scene_ambient(scene).b == 0.3f);
    lam_scene_free(scene);

    scene = good("{\"lambent\": 1, \"camera\": {\"fovy\": 60}, \"stage\": \"application\", " BALL "}");
    lam_scene_picture_settings(scene, &s);
    assert_true(fabs(s.camera.fovy_rad - acos(0.5)) < 1e-15 && s.camera.eye.z == 4 && s.camera.near_plane == 0);
    assert_int_equal(s.draw.shading, LAM_SHADING_GOURAUD);
    lam_scene_free(scene);
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

TEST(test_lights)
{
    lam_scene *scene = good(
        "{\"lambent\": 1, " BALL ", \"lights\": [{\"type\": \"ambient\", \"color\": [1, 1, 1], \"intensity\": 0.5}, "
        "{\"type\": \"hemisphere\", \"sky\": [1, 0, 0], \"ground\": [0, 1, 0], \"up\": [1, 0, 0], \"frame\": "
        "\"camera\"}, "
        "{\"name\": \"p\", \"type\": \"point\", \"position\": [2, 4, 6, 2], \"attenuation\": [0, 0, 1], "
        "\"range\": 9, \"shadows\": false, \"radius\": 0.5}, "
        "{\"type\": \"point\", \"position\": [1, 2, 3, 0]}, {\"type\": \"directional\", \"position\": [0, 1, "
        "0, 0]}, "
        "{\"type\": \"directional\", \"direction\": [1, 0, 0], \"color\": [1, 0.5, 0], \"intensity\": 2, "
        "\"specular\": [0, 0, 1], \"radius\": 30}, "
        "{\"type\": \"spot\", \"position\": [1, 1, 1], \"target\": [1, 0, 1], \"cutoff\": 30, \"exponent\": "
        "2}, "
        "{\"type\": \"spot\", \"inner\": 10, \"outer\": 20, \"frame\": \"object\", \"object\": \"sphere\"}, "
        "{\"type\": \"spot\", \"exponent\": 4}, {\"type\": \"spot\"}, {\"type\": \"spot\", \"cutoff\": "
        "180}]}");
    const lam_light *l[11];
    for (int i = 0; i < 11; i++)
        l[i] = lam_scene_light(scene, i);
    assert_true(l[0]->ambient.r == 0.5f);
    assert_true(l[1]->sky.r == 1 && l[1]->ground.g == 1 && l[1]->up.x == 1 && l[1]->frame == LAM_FRAME_CAMERA);
    assert_true(l[2]->position.x == 1 && l[2]->position.z == 3 && l[2]->attenuation.quadratic == 1 &&
                l[2]->attenuation.constant == 0 && l[2]->range == 9);
    assert_true(l[3]->type == LAM_LIGHT_DIRECTIONAL && l[3]->direction.x == -1 && l[3]->direction.z == -3);
    assert_true(l[2]->no_shadows && l[2]->radius == 0.5f && !l[3]->no_shadows && l[3]->radius == 0);
    assert_true(l[4]->direction.y == -1);
    assert_true(fabs((double)l[5]->angular_radius_rad - asin(0.5)) < 1e-7 && l[5]->radius == 0);
    assert_true(l[5]->diffuse.r == 2 && l[5]->diffuse.g == 1 && l[5]->specular.r == 0 && l[5]->specular.b == 1);
    assert_true(l[6]->direction.y == -1 && fabs((double)l[6]->cutoff_rad - asin(0.5)) < 1e-7 && l[6]->exponent == 2);
    assert_true(l[7]->outer_rad > l[7]->inner_rad && l[7]->inner_rad > 0.17f && l[7]->cutoff_rad == 0);
    assert_string_equal(l[7]->object, "sphere");
    assert_true(l[8]->cutoff_rad == 0 && l[8]->exponent == 4);
    assert_true(fabs((double)l[9]->cutoff_rad - atan(1)) < 1e-7 && l[9]->exponent == 0);
    assert_true(l[10]->cutoff_rad > 3.14f);
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
        WITH("\"image\": {\"size\": [0, 2]}", "image.size[0]: found 0, expected pixels from 1 to 65535"),
        WITH("\"image\": {\"size\": [2.5, 2]}", "image.size[0]: found 2.5, expected pixels from 1 to 65535"),
        WITH("\"image\": {\"samples\": 3}", "image.samples: found 3, expected 1, 2, 4, 8 or 16"),
        WITH("\"image\": {\"color\": \"raw\", \"color_mode\": \"raw\"}",
             "image: contains both color_mode and color, expected only one"),
        WITH("\"image\": {\"color_mode\": \"rwa\"}",
             "image.color_mode: found \"rwa\", expected srgb or raw; did you mean 'raw'?"),
        WITH("\"image\": {\"color\": \"rwa\"}",
             "image.color: found \"rwa\", expected srgb or raw; did you mean 'raw'?"),
        WITH("\"image\": {\"background\": [0, 0, 0, 2]}",
             "image.background[3]: found 2, expected a number from 0 to 1"),
        WITH("\"camera\": {\"fovy\": 180}", "camera.fovy: found 180, expected degrees above 0 and below 180"),
        WITH("\"camera\": {\"near\": 1}", "camera: has only near, expected both of near and far, or neither"),
        WITH("\"camera\": {\"near\": 3, \"far\": 2}", "camera: near is 3 and far is 2, expected 0 < near < far"),
        WITH("\"camera\": {\"fovy\": 30, \"ortho_half_height\": 1}",
             "camera: contains both fovy and ortho_half_height, expected only one"),
        WITH("\"camera\": {\"eye\": [0, 0, 0]}", "camera: eye and target are the same point"),
        WITH("\"camera\": {\"up\": [0, 0, 0]}", "camera.up: found 0, 0, 0, expected a direction"),
        WITH("\"camera\": {\"eye\": [0, 0]}", "camera.eye: found a list of 2, expected a list of 3 numbers"),
        WITH("\"camera\": {\"eye\": [0, 0, \"x\"]}", "camera.eye[2]: found \"x\", expected a number"),
        WITH("\"camera\": 5", "camera: found 5, expected an object, { … }"),
        WITH("\"ambient\": [0, -1, 0]", "ambient[1]: found -1, expected a number of at least 0"),
        WITH("\"ambient\": \"blurple\"",
             "ambient: found \"blurple\", expected a colour: \"#rrggbb\", a name such as \"white\", or "
             "a list of linear numbers"),
        WITH("\"gl1\": 1", "gl1: found 1, expected true or false"),
        WITH("\"stage\": \"vertex\", \"shading\": \"phong\"",
             "stage: Phong shading needs the stage fragment; application and vertex work with flat and gouraud"),
        WITH("\"stage\": \"fragment\", \"shading\": \"gouraud\"",
             "stage: Gouraud shading needs the stage application or vertex; fragment works with flat and "
             "phong"),
        WITH("\"environment\": {\"rotation\": 5}", "environment: expected one of faces, equirectangular and builtin"),
        WITH("\"environment\": {\"faces\": [\"a\"]}",
             "environment.faces: found a list of 1, expected six names of pictures: +x, -x, +y, -y, +z, -z"),
        WITH("\"materials\": {\"m\": {\"shininess\": -1}}",
             "materials.m.shininess: found -1, expected a number of at least 0"),
        WITH("\"materials\": {\"m\": {\"shinines\": 1}}",
             "materials.m.shinines: unknown key; did you mean 'shininess'?"),
        WITH("\"materials\": {\"m\": {\"ambient\": \"#11223344\"}}",
             "materials.m.ambient: contains an alpha, expected a colour without alpha"),
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
        OBJECT(SPHERE "\"material\": \"glod\"", ".material: no material is named 'glod'; did you mean 'gold'?"),
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
        LIGHT("\"type\": \"point\", \"power\": 4", ".power: unknown key; did you mean 'intensity'?"),
        LIGHT("\"type\": \"point\", \"cutoff\": 4",
              ".cutoff: unknown key; expected name, type, frame, object, color, "
              "intensity, position, ambient, diffuse, specular, attenuation, range, occluded, shadows, radius"),
        LIGHT("\"type\": \"point\", \"attenuation\": [0, 0, 0]",
              ".attenuation: all three numbers are 0, expected a + b d + c d^2 to be more than 0"),
        LIGHT("\"type\": \"point\", \"attenuation\": [1, -2, 0]",
              ".attenuation[1]: found -2, expected a number of at least 0"),
        LIGHT("\"type\": \"point\", \"range\": -2", ".range: found -2, expected a number of at least 0"),
        LIGHT("\"type\": \"directional\", \"position\": [1, 2, 3]",
              ".position: a directional light has a direction, or a position whose fourth number is 0"),
        LIGHT("\"type\": \"spot\", \"position\": [1, 2, 3, 0]",
              ".position: the fourth number is 0, but a spot light needs a position"),
        LIGHT("\"type\": \"point\", \"position\": [0, 0, 0, 0]", ".position: found 0, 0, 0, 0, expected a direction"),
        LIGHT("\"type\": \"spot\", \"inner\": 30, \"outer\": 20",
              ".inner: found 30, expected less than outer, which is 20"),
        LIGHT("\"type\": \"spot\", \"inner\": 30", ": inner is given without outer, expected both"),
        LIGHT("\"type\": \"spot\", \"cutoff\": 120",
              ".cutoff: found 120, expected degrees above 0 and up to 90, or 180"),
        LIGHT("\"type\": \"spot\", \"cutoff\": 20, \"outer\": 20",
              ": inner and outer cannot be combined with cutoff or exponent"),
        LIGHT("\"type\": \"spot\", \"direction\": [0, 0, 0]", ".direction: found 0, 0, 0, expected a direction"),
        LIGHT("\"type\": \"point\", \"frame\": \"object\", \"object\": \"cube\"", ".object: no object is named 'cube'"),
        LIGHT("\"type\": \"point\", \"object\": \"sphere\"", ".object: is allowed only with \"frame\": \"object\""),
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
    lam_scene *scene = lam_scene_load(model, NULL, NULL, &error);
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
                               .reflection = LAM_REFLECTION_PHONG,
                               .stage = LAM_STAGE_VERTEX,
                               .viewer = LAM_VIEWER_INFINITE,
                               .flat_normal = LAM_FLAT_NORMAL_VERTEX,
                               .gl1 = true,
                               .rig = LAM_RIG_NONE,
                               .light_cutoff = -1,
                               .match_highlights = true,
                               .reference = 64,
                               .shadows = true,
                               .flat_terminator = true,
                               .shadow_samples = 5,
                               .wireframe = true,
                               .no_surfaces = true,
                               .edges = LAM_EDGES_CREASE | LAM_EDGES_SILHOUETTE,
                               .hidden_lines = LAM_HIDDEN_LINES_SHOW,
                               .edge_angle_rad = 0.71234567f,
                               .edge_width = 1.7f,
                               .wireframe_width = 0.3f,
                               .edge_color = {0.1f, 0.2f, 1.0f / 3, 0.5f},
                               .wireframe_color = {0, 0, 0, 1},
                               .ground = LAM_GROUND_COLOR,
                               .ground_color = {0.1f, 1.0f / 3, 0},
                               .occlusion = LAM_OCCLUSION_RAYS,
                               .occlusion_radius = 0.3f,
                               .occlusion_samples = 9,
                               .single_scattering = true};
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
    if (!back)
        fail_msg("%s", error.text);
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
    assert_true(t.draw.color == s.draw.color && t.draw.shading == s.draw.shading &&
                t.draw.reflection == s.draw.reflection && t.draw.stage == s.draw.stage &&
                t.draw.viewer == s.draw.viewer && t.draw.flat_normal == s.draw.flat_normal && t.draw.gl1 &&
                t.draw.match_highlights && t.draw.single_scattering && t.draw.rig == LAM_RIG_NONE &&
                t.draw.light_cutoff < 0 && t.draw.reference == 64);
    assert_true(t.draw.ground == LAM_GROUND_COLOR);
    assert_memory_equal(&t.draw.ground_color, &s.draw.ground_color, sizeof s.draw.ground_color);
    assert_true(t.draw.wireframe && t.draw.no_surfaces && t.draw.edges == s.draw.edges &&
                t.draw.hidden_lines == LAM_HIDDEN_LINES_SHOW && t.draw.edge_width == 1.7f &&
                t.draw.wireframe_width == 0.3f && t.draw.edge_angle_rad == s.draw.edge_angle_rad);
    assert_memory_equal(&t.draw.wireframe_color, &s.draw.wireframe_color, 2 * sizeof s.draw.edge_color);
    assert_true(t.draw.shadows && t.draw.flat_terminator && t.draw.shadow_samples == 5);
    assert_true(t.draw.occlusion == LAM_OCCLUSION_RAYS && t.draw.occlusion_radius == 0.3f &&
                t.draw.occlusion_samples == 9);
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
    lam_scene_free(scene);
    unlink(path);
    unlink(model);
    rmdir(folder);
}
