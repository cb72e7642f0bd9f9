// module_formats.c: the formats that modules read. The program lambent-import turns a file into binary glTF
// (import_module.h), which the glTF importer reads.
#include "importer.h"

#include <stddef.h>

#if defined(LAMBENT_MODULES)

#include "companion.h"
#include "dynamic_library.h"
#include "fail.h"
#include "import_process.h"

#include <stdio.h>
#include <string.h>

static bool module_load(struct import_source *source, struct lam_scene *scene, lam_error *error);

// name, extensions, up axis of files that do not state it, whether this axis is only a habit, module, name in messages
#define ROW(name_, extensions_, up_, habit_, module_, described_)                                                      \
    {.name = name_,                                                                                                    \
     .extensions = extensions_,                                                                                        \
     .up = up_,                                                                                                        \
     .up_is_habit = habit_,                                                                                            \
     .load = module_load,                                                                                              \
     .module = module_,                                                                                                \
     .described = described_}
const struct importer module_importers[] = {
    ROW("fbx", "fbx", LAM_UP_Y, false, "assimp", "an FBX file"),
    ROW("dae", "dae", LAM_UP_Y, false, "assimp", "a COLLADA file"),
    ROW("3ds", "3ds", LAM_UP_Y, false, "assimp", "a 3DS file"),
    ROW("off", "off", LAM_UP_Y, true, "assimp", "an OFF file"),
    ROW("x", "x", LAM_UP_Y, false, "assimp", "a DirectX file"),
    ROW("amf", "amf", LAM_UP_Z, false, "assimp", "an AMF file"),
    ROW("lwo", "lwo", LAM_UP_Y, false, "assimp", "a LightWave file"),
    ROW("ac", "ac", LAM_UP_Y, false, "assimp", "an AC3D file"),
    ROW("step", "step stp", LAM_UP_Z, true, "occt", "a STEP file"),
    ROW("iges", "iges igs", LAM_UP_Z, true, "occt", "an IGES file"),
    ROW("brep", "brep brp", LAM_UP_Z, true, "occt", "a BREP file"),
    {.name = NULL},
};

bool module_is_installed(const struct importer *importer)
{
    char file[IMPORT_NAME_SIZE + 16], path[LIBRARY_PATH_SIZE];
    snprintf(file, sizeof file, "lambent-%s.so", importer->module);
    return library_own_path(IMPORT_PROGRAM, path) && library_own_path(file, path);
}

// Opens a picture that a file names, often by the path on another computer.
static bool open_moved(const struct import_source *source, const char *name, struct arena *arena, struct companion *out,
                       lam_error *error)
{
    struct import_source usual = *source;
    usual.open = companion_open;
    return companion_find(&usual, NULL, name, "", arena, out, error);
}

static bool fail_answer(const struct import_source *source, const struct importer *importer,
                        const struct import_answer *answer, lam_error *error)
{
    if (answer->result == IMPORT_NO_MEMORY)
        return fail(error, LAM_LIMIT, "%s: the reader of %s files needs more memory than the limit allows",
                    source->name, importer->name);
    return fail(error, answer->result == IMPORT_NO_MODULE ? LAM_UNSUPPORTED : LAM_CANNOT_READ,
                "%s: cannot read the %s file: %s", source->name, importer->name, answer->note);
}

static bool module_load(struct import_source *source, struct lam_scene *scene, lam_error *error)
{
    const struct importer *importer = module_importers;
    while (strcmp(importer->name, scene->format) != 0)
        importer++;
    struct import_answer answer = {0};
    struct file_bytes glb = {0};
    struct import_request request = {.version = IMPORT_MODULE_VERSION,
                                     .raw = source->params->color == LAM_COLOR_RAW,
                                     .measure = source->params->measure};
    if (!module_is_installed(importer))
        return fail(error, LAM_UNSUPPORTED,
                    "%s: this is %s, which the package " MODULES_PACKAGE " reads (apt install " MODULES_PACKAGE ")",
                    source->name, importer->described);
    if (!import_whole(source, error))
        return false;
    double seconds = source->call->control.time_limit_s;
    request.seconds = seconds > 0 && seconds < 3600 ? (uint32_t)seconds + 1 : 3600;
    request.deflection = source->params->deflection > 0 ? source->params->deflection : 1.0 / 4000;
    request.triangles = call_triangle_limit(source->call);
    request.memory = call_memory_left(source->call);
    request.size = source->size;
    snprintf(request.module, sizeof request.module, "%s", importer->module);
    snprintf(request.format, sizeof request.format, "%s", importer->name);
    if (!import_run(source, &request, &answer, &glb, error))
        return false;
    answer.note[sizeof answer.note - 1] = 0;
    for (char *c = answer.note; *c; c++)
        *c = *c < ' ' || *c > '~' ? '?' : *c; // the text may contain bytes of the file
    if (answer.result != IMPORT_READ || !glb.size) {
        file_release(&glb);
        return fail_answer(source, importer, &answer, error);
    }
    if (*answer.note)
        scene_warn(scene, "%s: %s", source->name, answer.note);
    file_release(source->file);
    *source->file = glb;
    source->bytes = source->parts.memory = glb.data;
    source->size = source->parts.size = glb.size;
    source->open = open_moved;
    if (!importer_gltf.load(source, scene, error))
        return false;
    scene->file.version = NULL; // of the binary glTF
    scene->file.reader_memory = answer.memory < 1ULL << 50 ? answer.memory : 0;
    scene->file.unit_m = answer.unit_m > 0 && answer.unit_m < 1e9 ? answer.unit_m : 0;
    return true;
}

#else

const struct importer module_importers[] = {{.name = NULL}};
bool module_is_installed(const struct importer *importer) { return !importer; }
int lam_import_start(void) { return -1; }

#endif
