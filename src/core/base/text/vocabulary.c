// vocabulary.c: computes the edit distance between a typed word and a known name, and lists synonyms.
#include <lambent/base.h>

#include <stddef.h>
#include <string.h>

enum { LENGTH_MAX = 63 };

// Common synonyms, separated by spaces, in lower case with '-' between words. The command line accepts a synonym of a
// value (program/help/synonyms.c); elsewhere, the error message suggests the name. If a name occurs in several rows, only the rows for the
// current context are used.
static const struct {
    const char *word, *others;
} vocabulary[] = {
    // Lights and their keys.
    {"ambient", "global"},
    {"directional", "sun sunlight distant direct parallel infinite dir"},
    {"hemisphere", "hemi hemispheric sky skylight dome environment"},
    {"point", "omni omnidirectional bulb lamp positional pointlight"},
    {"spot", "spotlight cone torch flashlight"},
    {"position", "pos location place origin from at"},
    {"direction", "dir axis"},
    {"target", "aim at to center centre lookat look-at interest"},
    {"color", "rgb"},
    {"intensity", "power strength brightness energy"},
    {"attenuation", "falloff decay fade"},
    {"range", "radius distance"},
    {"cutoff", "angle half-angle cone-angle"},
    {"exponent", "concentration focus"},
    {"inner", "penumbra"},
    {"frame", "space"},
    // Materials and their keys.
    {"diffuse", "albedo base base-color basecolor matte"},
    {"specular", "spec highlight highlights"},
    {"emission", "emissive emit glow ke"},
    {"shininess", "gloss glossiness ns exponent hardness smoothness"},
    {"transparent", "none clear"},
    {"white-plastic", "plastic"},
    {"black-rubber", "rubber"},
    {"chrome", "metal steel iron aluminium aluminum"},
    {"opacity", "alpha transparency dissolve d tr"},
    {"reflectivity", "mirror reflective reflection kr"},
    {"roughness_angle", "roughness sigma"},
    {"fibre", "fiber hair thread"},
    // Cameras.
    {"fovy", "fov field-of-view angle"},
    {"eye", "position pos from camera"},
    {"ortho", "orthographic scale half-height"},
    {"near", "znear"},
    {"far", "zfar"},
    {"perspective", "persp"},
    {"orthographic", "ortho parallel"},
    {"three-quarter", "3/4 default"},
    {"iso", "isometric"},
    {"front", "forward"},
    {"back", "rear behind"},
    {"right", "side"},
    {"top", "above plan"},
    {"bottom", "below under underneath"},
    // Shading and reflection methods.
    {"flat", "per-face facet faceted face faces polygon per-polygon per-triangle constant"},
    {"gouraud", "per-vertex vertex vertices"},
    {"phong", "per-pixel per-fragment pixel fragment"},
    {"ggx", "pbr microfacet physical cook-torrance trowbridge-reitz"},
    {"lambert", "lambertian diffuse matt matte"},
    {"blinn-phong", "blinn modified-phong half-vector"},
    {"kajiya-kay", "kajiya hair anisotropic threads"},
    {"oren-nayar", "oren rough"},
    {"toon", "cel cartoon"},
    {"gooch", "warm-cool cool-to-warm"},
    {"none", "off no unlit"},
    {"application", "app cpu host"},
    {"vertex", "per-vertex"},
    {"fragment", "pixel per-pixel per-fragment"},
    {"infinite", "distant"},
    {"facet", "flat face faces faceted"},
    {"smooth", "interpolated soft vertex"},
    {"file", "original own model"},
    // Rigs and environments.
    {"headlight", "flash head camera"},
    {"three-point", "3-point three-points 3point portrait"},
    {"studio", "default"},
    // Outputs.
    {"n.l", "ndotl n-dot-l nl dot cosine"},
    {"n.h", "ndoth n-dot-h nh"},
    {"normals", "normal n"},
    {"tangents", "tangent t"},
    {"depth", "z zbuffer z-buffer distance"},
    {"reflection", "mirror"},
    {"facing", "backface backfaces back-faces winding sides culling"},
    {"ids", "id triangles primitives faces"},
    {"coverage", "mask alpha silhouette matte"},
    {"clipped", "clip clipping overexposed gamut"},
    {"raw", "linear none off"},
    {"srgb", "gamma encoded"},
    {"best", "max maximum smallest high"},
    {"fast", "low quick"},
    {"aces", "filmic film"},
    {"auto", "on yes automatic"},
    // Devices.
    {"cpu", "software processor"},
    {"gl", "opengl gpu"},
    {"gles", "opengles opengl-es es webgl"},
    // Shapes.
    {"sphere", "ball globe"},
    {"torus", "donut doughnut ring"},
    {"plane", "quad square ground floor"},
    {"cube", "box"},
    {"cylinder", "tube"},
    {"torus-knot", "knot trefoil"},
    {"teapot", "utah"},
};

// Converts a word to lower case, and replaces '_' and ' ' with '-'. Returns false if the word is too long.
static bool simplify(const char *word, char out[LENGTH_MAX + 1])
{
    size_t length = strnlen(word, LENGTH_MAX + 1);
    if (length > LENGTH_MAX)
        return false;
    for (size_t i = 0; i <= length; i++)
        out[i] = word[i] >= 'A' && word[i] <= 'Z'   ? (char)(word[i] + 32)
                 : word[i] == '_' || word[i] == ' ' ? '-'
                                                    : word[i];
    return true;
}

static bool is_listed(const char *word, const char *list)
{
    for (size_t length; *list; list += length + (list[length] == ' ')) {
        length = strcspn(list, " ");
        if (strlen(word) == length && memcmp(list, word, length) == 0)
            return true;
    }
    return false;
}

int lam_word_distance(const char *typed, const char *word)
{
    char a[LENGTH_MAX + 1], b[LENGTH_MAX + 1];
    if (!simplify(typed, a) || !simplify(word, b))
        return LENGTH_MAX;
    if (strcmp(a, b) == 0)
        return 0;
    for (size_t i = 0; i < sizeof vocabulary / sizeof *vocabulary; i++)
        if (strcmp(vocabulary[i].word, word) == 0 && is_listed(a, vocabulary[i].others))
            return 0;
    bool beginning = strlen(a) >= 3 && strncmp(a, b, strlen(a)) == 0;
    return beginning ? 1 : lam_edit_distance(a, b);
}
