// lambent/words.h: parses materials and lights from text, in the form of the options of `lambent`.
//
// A text is at most 1023 bytes long. Errors are LAM_BAD_ARGUMENT, and the sentence states the text that was found and
// the text that was expected. lam_color_parse (scene.h) and lam_camera_parse (camera.h) are similar.
#ifndef LAMBENT_WORDS_H
#define LAMBENT_WORDS_H

#include "camera.h"
#include "device.h"
#include "light.h"
#include "material.h"

#ifdef __cplusplus
extern "C" {
#endif

// Changes a material as a text specifies:
//   ruby                   becomes a named material (lam_material_name), or "glass": clear, smooth glass
//   shininess=9,ks=0.5     changes fields: the keys of scene files, with their ranges (lam_material_field)
//   gold,opacity=0.5       both, the name first
//   ambient=diffuse        returns as much ambient light as diffuse light; also the default if `diffuse` is given for a
//                          material that still has the ambient and diffuse colour of lam_material_default
//   #ff8800                is short for color=#ff8800; also a colour's name that no material has, or r/g/b
// Colours have the forms of lam_color_parse, or are one number for all three channels. The factors ka, kd and ks
// multiply ambient, diffuse and specular. `color` sets ambient and diffuse, and `specular_color` sets specular. kr sets
// reflectivity to kr times `specular_color` (default: white). Returns false on failure and leaves the material
// unchanged.
LAM_API bool lam_material_parse(const char *text, lam_color_mode mode, lam_material *material, lam_error *error);

// Returns the words for the physical metal of a classic metal's name, such as "diffuse=…,metallic=1,roughness=0.2", or NULL
// if the material is not a metal.
LAM_API const char *lam_material_metal(lam_material_id id);

// Replaces each metal of a scene that was read by its name alone (lam_material.metal) by the physical metal, if the built-in
// studio environment lights the picture: the scene has no lights, and `draw` chooses sRGB colours and neither a rig, a
// shading, a stage, a reflection model nor `gl1`. lam_render and the program call it. Fails with LAM_LIMIT.
LAM_API bool lam_scene_mirror_metals(lam_scene *scene, const lam_draw_params *draw, lam_error *error);

// Returns the key of lam_material_parse with this index (from 0), or NULL if the index is out of range.
LAM_API const char *lam_material_key(int index);

// Parameters of lam_scene_add_light_text. Zero is the default of each field.
typedef struct lam_light_text_params {
    lam_color_mode color; // encoding of hexadecimal colours and names
    // The camera that lights in the camera's frame refer to, for their targets and radii. NULL: lam_camera_default().
    const lam_camera *camera;
    // The origin of positions in `r`; used only if `radius` is not 0.
    lam_vec3 centre;
    // The length `r`. 0: radius and centre of lam_scene_sphere for the whole scene.
    double radius;
    LAM_RESERVED(8);
} lam_light_text_params;

// Adds a light to a scene as described by text such as "spot:position=-2r/3r/2r,cutoff=20,color=#ffeecc":
//  ambient, hemisphere, point, directional or spot, then after ':' the keys of scene files (lam_light_field), and
//  target=x/y/z           the point that it shines at; for a spot without a direction, the centre of the scene (in the
//                         camera's frame: straight ahead)
//  position=x/y/z/w       w = 0: a directional light from there; otherwise x/w, y/w, z/w
//  color=…,intensity=…    diffuse and specular at once; ambient, sky and ground of their types
//  frame=world|camera|view|object|object:NAME, name=…; object: the frame of the first model
// Angles are in degrees. A number with r, "2r", is in radii of the scene's sphere: positions and targets are relative
// to its centre; ranges, and the second and third number of an attenuation, are lengths. A point or spot light without
// a position is at 1r/2r/3r (rotated to the scene's up axis), or at the eye in the camera's frame.
//
// Returns the light's index, or −1 on failure. `params` may be NULL. If `scene` is NULL, the text is checked, and 0 is
// returned.
LAM_API int lam_scene_add_light_text(lam_scene *scene, const char *text, const lam_light_text_params *params,
                                     lam_error *error);

// Returns the key of lam_scene_add_light_text with this index (from 0) for lights of a type, or NULL if the index is
// out of range.
LAM_API const char *lam_light_key(lam_light_type type, int index);

#ifdef __cplusplus
}
#endif
#endif
