// threemf.h: internals of the 3MF importer.
//
// A 3MF file is a ZIP archive with model parts in XML. threemf_package.c opens the archive (zlib), and threemf_xml.c
// parses a part (expat). threemf_slicer.c reads the configurations of slicers. threemf_model.c reads the elements of the
// model parts, with threemf_properties.c, threemf_layers.c, threemf_display.c and threemf_paint.c. threemf_mesh.c
// converts the part's objects to meshes, and threemf_build.c places the objects of the build items, and the components
// of these objects.
#ifndef THREEMF_H
#define THREEMF_H

#include "importer.h"
#include "name_table.h"

// A growing array, which is freed with the struct threemf.
struct threemf_rows {
    void *items;
    size_t count, capacity, bytes; // `bytes` counts towards the call's memory limit
};

enum resource_kind {
    RESOURCE_OBJECT,
    RESOURCE_BASE,
    RESOURCE_COLORS,
    RESOURCE_TEXTURE,
    RESOURCE_TEXCOORDS,
    RESOURCE_MULTI,
    RESOURCE_DISPLAY // display properties
};

// A resource of a model part: an <object>, a property group, or a texture.
struct threemf_resource {
    enum resource_kind kind;
    // For property groups, the range of their elements in the part's lists of colours (BASE, COLORS), texture
    // coordinates or pairs (MULTI).
    uint32_t first, count;
    // The material of the first element (BASE), or the material with the texture (TEXCOORDS, MULTI). −1 if there is no
    // such material.
    int material;
    bool faulty;                   // the picture cannot be read, so triangles are drawn without it
    int32_t base;                  // composite materials: index of the resource with the mixed colours
    struct threemf_object *object; // OBJECT
    struct threemf_layers *layers; // MULTI
    lam_texture_map map;           // the settings of a texture; `texture` is NULL if its picture could not be read
};

// The groups of multiproperties; each element has one index for each group.
enum { LAYERS_MAX = 16 };
struct threemf_layers {
    int count;
    int32_t groups[LAYERS_MAX]; // indices of resources
    // Whether the layer multiplies the layers below it. Otherwise, the layer is blended over the layers below it, by
    // its alpha.
    bool multiply[LAYERS_MAX];
    int texture; // the first layer that is a texture, or −1
    int texture_count;
    int base;                    // the base material whose surface the mixed layers use, or −1
    uint32_t colors[LAYERS_MAX]; // colours of the first element: indices into the part's colours
    // whether any colours differ from the first element's colours, or any coordinates from the first texture's
    bool varies;
};

// An element of multiproperties, as indices into the part's colours and texture coordinates.
struct threemf_pair {
    uint32_t color, texcoord;
};

// A reference to an object, with its transform: a component, or an item of the build.
struct threemf_component {
    const char *path; // path of another model part; NULL means the same part
    int32_t id;
    lam_mat4 transform;
    size_t line;
    bool off; // printable="0"
};

// The role of a volume or an object. Only ROLE_PRINTS is drawn.
enum threemf_role { ROLE_PRINTS, MODIFIER, SUPPORT_ENFORCER, SUPPORT_BLOCKER, NEGATIVE, OTHER, SWITCHED_OFF, ROLES };

// A row of a slicer's configuration: an object (`part` is WHOLE_OBJECT), triangles of an object (TRIANGLE_RANGE), or the
// component of an object whose id is `part`.
enum { WHOLE_OBJECT = -1, TRIANGLE_RANGE = 0 };
struct threemf_volume {
    int32_t object, part;
    uint32_t first, last; // triangles
    enum threemf_role role;
    uint32_t extruder; // counted from 1; 0 means the extruder of the object
};

// The group of a triangle without standard properties. index[0] is the number of its filament, counted from 1; 0 means
// the filament of the object.
enum { FILAMENT = 0 };

// A triangle's property group (an id, or FILAMENT) and the index of each corner in the group.
struct threemf_property {
    int32_t group;
    uint32_t index[3];
};

struct threemf_object {
    const char *name;
    int32_t id;
    size_t line;
    int32_t group; // id of the group for triangles without their own group, or 0
    uint32_t index;
    float *positions;
    uint32_t *indices;
    struct threemf_property *properties; // NULL means that no triangle has its own group
    uint32_t vertex_count, triangle_count;
    struct threemf_component *components;
    size_t component_count;
    enum threemf_role role;
    int *meshes;   // per filament of the object: 1 + index in the scene, or 0; NULL if none has been created yet
    bool visiting; // the object is being placed; a component that refers to such an object would form a cycle
};

// A model part.
struct threemf_part {
    const char *path;
    double unit_m; // metres per unit of length
    struct name_table ids;
    struct threemf_rows resources; // struct threemf_resource
    struct threemf_rows colors;    // 4 floats, linear; colour 0 is white, colour 1 is the default material's colour
    struct threemf_rows texcoords; // 2 floats
    struct threemf_rows pairs;     // struct threemf_pair
    struct threemf_rows items;     // struct threemf_component: the build
    // Copies of these lists in the scene's arena, made after the part is read. The part's meshes share the copies.
    const float *scene_colors, *scene_texcoords;
};

struct expat_library;

struct threemf {
    const struct import_source *source;
    struct lam_scene *scene;
    struct arena *scratch;
    lam_error *error;
    struct threemf_rows entries; // of the archive (threemf_package.c)
    struct name_table entry_names;
    struct expat_library *expat;
    struct name_table part_names;
    struct threemf_rows parts;              // struct threemf_part *
    struct threemf_rows pictures;           // struct texture_source: the pictures that were read so far
    uint64_t part_limit;                    // largest size of one part; 0 means no limit
    uint64_t placed;                        // number of components and items that were followed
    size_t flattened;                       // number of instances whose transform is singular
    size_t multiplied_layers;               // number of multiproperties that are drawn as the product of their layers
    size_t beams, sliced;                   // number of beams, and of objects with slices
    struct threemf_rows volumes, filaments; // threemf_slicer.c
    size_t left_out[ROLES];
    bool uncolored; // whether paintings or volumes use filaments without a colour
    bool unknown;   // whether a warning names the first unknown property
    bool damaged;   // whether a warning names the first damaged painting
};

// Reserves space for `count` rows of `size` bytes each. Returns false and fills the error if memory runs out.
bool threemf_reserve(struct threemf *file, struct threemf_rows *rows, size_t size, size_t count);
// Appends a zeroed row to a list. Returns NULL and fills the error if memory runs out.
void *threemf_add(struct threemf *file, struct threemf_rows *rows, size_t size);
void threemf_rows_free(struct threemf *file, struct threemf_rows *rows);
bool threemf_no_memory(struct threemf *file, size_t bytes);

// --- threemf_package.c

// Reads the archive's list of entries.
bool threemf_package_open(struct threemf *file);
void threemf_package_close(struct threemf *file);

// Reads a part of the archive in chunks. `name` may begin with '/'.
typedef bool threemf_chunk_fn(void *user, const void *bytes, size_t size, bool last);
bool threemf_package_read(struct threemf *file, const char *name, threemf_chunk_fn *take, void *user);
// Returns the first name in alphabetical order that ends with `ending`, or NULL.
const char *threemf_package_find(const struct threemf *file, const char *ending);
// Reads a whole part into memory allocated from the scratch arena.
bool threemf_package_read_whole(struct threemf *file, const char *name, const uint8_t **bytes, size_t *size);

// --- the model

// Returns the part with this path, and reads it on first use. Returns NULL and fills the error on failure.
struct threemf_part *threemf_part_at(struct threemf *file, const char *path);
// Returns the resource of a part with this id, or NULL if no resource has this id.
struct threemf_resource *threemf_resource_at(const struct threemf_part *part, int32_t id);

// threemf_properties.c: returns the linear colour of an element of a group.
const float *threemf_color(const struct threemf_part *part, const struct threemf_resource *group, uint32_t index);

// threemf_slicer.c: reads the configurations of PrusaSlicer, Bambu Studio and OrcaSlicer. Damaged configurations cause
// warnings.
bool threemf_slicer_read(struct threemf *file);
// Returns the row of an object of the root part, or NULL. `triangle` is used for TRIANGLE_RANGE.
const struct threemf_volume *threemf_volume_at(const struct threemf *file, const struct threemf_part *from,
                                               int32_t object, int32_t part, uint32_t triangle);
// Returns the index of the filament, counted from 1, that an extruder uses, or 0 if the file names no filaments.
uint32_t threemf_filament(const struct threemf *file, uint32_t extruder);
// Returns the material of a filament, or −1 if the file does not specify its colour.
int threemf_filament_material(const struct threemf *file, uint32_t filament);

// threemf_mesh.c: adds an object's triangles to the scene as a mesh. *mesh is its index, or −1 if there are none.
bool threemf_mesh_make(struct threemf *file, struct threemf_part *part, struct threemf_object *object,
                       uint32_t extruder, int *mesh);
// threemf_build.c: adds an object to the scene for each instance.
bool threemf_build(struct threemf *file, struct threemf_part *root);

#endif
