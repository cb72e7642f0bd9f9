// lambent/section.h: planes that cut a scene, as in technical drawings (docs/sections.md).
#ifndef LAMBENT_SECTION_H
#define LAMBENT_SECTION_H

#include "scene.h"

#ifdef __cplusplus
extern "C" {
#endif

// The maximum number of sections of a scene.
enum { LAM_SECTIONS_MAX = 8 };

// A plane that removes everything on the side to which its normal points.
typedef struct lam_section {
    // Any length except 0; in the axes of the scene before lam_scene_transform and lam_scene_rotate.
    lam_vec3 normal;
    // The distance of the plane from the origin along the unit normal, in the model's units, or, if `relative` is true,
    // as a fraction (0..1) of the model's extent along the normal.
    double distance;
    bool relative; // whether `distance` is a fraction
    // The colour of the cut surfaces, as a material's `diffuse`. Alpha 0, the default: the cut part's own material.
    lam_rgba color;
    LAM_RESERVED(4);
} lam_section;

// Parses a section: `x=0`, `x` (the same as `x=50%`), `-z=40%` or `normal=1/1/0,distance=2.5`, optionally followed by `,color=red`. The axis names
// the removed side: `x=0` removes x > 0, and `-x=0` removes x < 0. Returns false on failure: LAM_BAD_ARGUMENT.
LAM_API bool lam_section_parse(const char *text, lam_color_mode mode, lam_section *section, lam_error *error);

// Cuts all objects of the scene, and closes the cut surfaces. `count` is 0..LAM_SECTIONS_MAX; 0 restores the whole
// objects. A call replaces the sections of an earlier call. Objects that are added or moved afterwards are not cut. Cut
// surfaces are parts of the mesh, with the name of the part that they close. Outlines that are not closed, lines,
// points and transparent parts are cut, but have no cut surface; the scene gets one warning for each kind, and one for
// a plane that removes nothing. `control` may be NULL. On failure, the call changes nothing: LAM_BAD_ARGUMENT (the
// sections remove everything), LAM_LIMIT, LAM_CANCELLED.
LAM_API bool lam_scene_set_sections(lam_scene *scene, const lam_section *sections, int count,
                                    const lam_control *control, lam_error *error);

// Returns the section with this index, or NULL past the end. The pointer is valid until the next call of
// lam_scene_set_sections.
LAM_API const lam_section *lam_scene_section(const lam_scene *scene, int index);

// Returns the area that a section closes, in squared units of the scene. Overlapping parts are counted once. Later
// sections cut this area further, but do not change the result. Returns 0 past the end.
LAM_API double lam_scene_section_area(const lam_scene *scene, int index);

#ifdef __cplusplus
}
#endif
#endif
