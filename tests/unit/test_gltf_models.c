// test_gltf_models.c: every glTF file of the shared models loads, or is refused for the right reason; triangles and
// sizes equal the models' own tables.
#include "test.h"
#include "loading.h"
#include "share.h"

#include <dirent.h>
#include <sys/stat.h>

// Refused files, given by a part of their path: the code and a part of the error message.
static const struct {
    const char *path;
    lam_code code;
    const char *sentence;
} refusals[] = {
    {"Negative/Mesh_NoPosition/", LAM_CANNOT_READ, "its primitives (1) have no attribute POSITION"},
    {"Compatibility/Compatibility_04.gltf", LAM_UNSUPPORTED, "the file needs glTF 2.1, expected at most 2.0"},
#if !HAS_DRACO
    {"nefertiti_draco.glb", LAM_UNSUPPORTED, "KHR_draco_mesh_compression"},
    {"DenseSphere.glb", LAM_UNSUPPORTED, "KHR_draco_mesh_compression"},
    {"carbon-sphere.glb", LAM_UNSUPPORTED, "KHR_draco_mesh_compression"},
    {"chess-board.glb", LAM_UNSUPPORTED, "KHR_draco_mesh_compression"},
    {"glTF-Draco/", LAM_UNSUPPORTED, "KHR_draco_mesh_compression"},
    {"DracoSparseMesh.gltf", LAM_UNSUPPORTED, "KHR_draco_mesh_compression"},
#endif
};

// A row of the models' README: triangles of the default scene, and its extent at rest.
struct row {
    char path[200];
    unsigned triangles;
    double extent[3];
};
static struct row rows[400];
static int row_count, checked_rows, files, refused;
static size_t seen; // a third of them are read; long-gltf-models reads all
static char root[1000];

static void read_rows(void)
{
    char path[1100], line[2000];
    snprintf(path, sizeof path, "%s/README.md", root);
    FILE *readme = fopen(path, "r");
    while (readme && fgets(line, sizeof line, readme)) {
        struct row *row = &rows[row_count];
        const char *at = line;
        if (strncmp(line, "| gltf/", 7) != 0 && strncmp(line, "| glb/", 6) != 0)
            continue;
        sscanf(line, "| %199s", row->path);
        for (int column = 0; column < 5; column++)
            at = strchr(at, '|') + 1;
        assert_int_equal(
            sscanf(at, "%u | %lf x %lf x %lf", &row->triangles, &row->extent[0], &row->extent[1], &row->extent[2]), 4);
        assert_true(++row_count < (int)(sizeof rows / sizeof *rows));
    }
    if (readme)
        fclose(readme);
}

static void check_row(const char *relative, const lam_scene *scene)
{
    lam_vec3 low, high;
    for (int i = 0; i < row_count; i++) {
        const struct row *row = &rows[i];
        if (strcmp(row->path, relative) != 0)
            continue;
        if (lam_scene_triangle_count(scene) != row->triangles)
            fail_msg("%s: found %u triangles, expected %u", relative, (unsigned)lam_scene_triangle_count(scene),
                     row->triangles);
        checked_rows++;
        // Its extents do not include skins.
        static const char *const skinned[] = {"Animation_Skin/", "Instancing_09",       "Fox_quantized",
                                              "Fox_meshopt",     "03_skinned_cylinder", "emoji_heart"};
        for (size_t k = 0; k < sizeof skinned / sizeof *skinned; k++)
            if (strstr(relative, skinned[k]))
                return;
        lam_scene_bounds(scene, &low, &high);
        const double extent[3] = {high.x - low.x, high.y - low.y, high.z - low.z};
        double size = fmax(row->extent[0], fmax(row->extent[1], row->extent[2]));
        for (int axis = 0; axis < 3; axis++)
            if (fabs(extent[axis] - row->extent[axis]) > 2e-3 * size)
                fail_msg("%s: extent %g on axis %d, expected %g", relative, extent[axis], axis, row->extent[axis]);
    }
}

static void check_file(const char *path)
{
    lam_error error = {0};
    AUTO_SCENE scene = lam_scene_load(path, NULL, NULL, &error);
    const char *relative = path + strlen(root) + 1;
    files++;
    for (size_t i = 0; i < sizeof refusals / sizeof *refusals; i++) {
        if (!strstr(path, refusals[i].path))
            continue;
        refused++;
        if (scene || error.code != refusals[i].code || !strstr(error.text, refusals[i].sentence))
            fail_msg("%s: %s", relative, scene ? "loads, but should be refused" : error.text);
        return;
    }
    SUCCEEDS(scene);
    check_row(relative, scene);
}

static bool ends_with(const char *text, const char *end)
{
    return strlen(text) > strlen(end) && strcmp(text + strlen(text) - strlen(end), end) == 0;
}

static void walk(const char *folder)
{
    struct dirent **names;
    int count = scandir(folder, &names, NULL, alphasort);
    for (int i = 0; i < count; i++) {
        char path[1400];
        struct stat about;
        snprintf(path, sizeof path, "%s/%s", folder, names[i]->d_name);
        bool hidden = names[i]->d_name[0] == '.';
        free(names[i]);
        if (hidden || stat(path, &about) != 0)
            continue;
        if (S_ISDIR(about.st_mode))
            walk(path);
        else if ((ends_with(path, ".gltf") || ends_with(path, ".glb")) && is_taken(seen++, 3))
            check_file(path);
    }
    if (count >= 0)
        free(names);
}

TEST(test_shared_models)
{
    static const char *const folders[] = {"gltf", "glb", "gltf-tests"};
    const char *models = getenv("LAMBENT_MODELS");
    char path[1100];
    snprintf(root, sizeof root, "%s", models ? models : "../shared/models");
    read_rows();
    if (!row_count) {
        print_message("%s is not there: the shared models are not tested\n", root);
        skip();
    }
    for (int i = 0; i < 3; i++) {
        snprintf(path, sizeof path, "%s/%s", root, folders[i]);
        walk(path);
    }
    print_message("%d files, %d of them refused; %d with a row in the README\n", files, refused, checked_rows);
    assert_true(seen >= 300 && checked_rows >= (is_long() ? 100 : 30));
}
