// option_table.c: every option, once. The help, the man page, the completions and docs/command-line.md are
// made from these rows (help.c, manual.c, completions.c).
#include "options.h"

#include <lambent/check.h>

#define FIELD(name) .field = offsetof(struct options, name)

const char *const group_titles[GROUP_COUNT] = {
    [GROUP_PICTURE] = "Picture",
    [GROUP_VIEW] = "View",
    [GROUP_SHADING] = "Shading",
    [GROUP_WORK] = "Work",
    [GROUP_REPORT] = "Reports",
    [GROUP_DIFF] = "Comparing pictures (diff, check)",
    [GROUP_PLOT] = "Plots (plot)",
    [GROUP_CAPTIONS] = "Captions (compare, plot, materials, check)",
    [GROUP_ABOUT] = "About",
    [GROUP_LIGHTS] = "Lights",
    [GROUP_MATERIALS] = "Materials",
    [GROUP_SHEET] = "Sheets (compare)",
    [GROUP_CHECK] = "Checking shaders (check)",
    [GROUP_SHADER] = "Shaders (shader)",
};

static const struct word sample_words[] = {{"1", 1, NULL}, {"2", 2, NULL},   {"4", 4, NULL},
                                           {"8", 8, NULL}, {"16", 16, NULL}, {NULL, 0, NULL}};

static const struct word contract_words[] = {
    {"auto", LAM_CONTRACT_AUTO, "recognised by the shaders' names"},
    {"lambent", LAM_CONTRACT_LAMBENT, "the names of `lambent shader`"},
    {"pittsburgh", LAM_CONTRACT_PITTSBURGH, "vPosition, model_view, ambient_product ..."},
    {"oregon", LAM_CONTRACT_OREGON, "gl_Vertex, uKa, uColor, uLightX ..."},
    {"nyu", LAM_CONTRACT_NYU, "position, modelViewMatrix, lights[i].lightPosition ..."},
    {NULL, 0, NULL}};

static const struct word light_frame_words[] = {
    {"object", LAM_FRAME_OBJECT, "in object space: the model-view matrix transforms it, like the vertices"},
    {"camera", LAM_FRAME_CAMERA, "in eye space: used as given"},
    {NULL, 0, NULL}};

static const struct word highlight_words[] = {
    {"phong", LAM_REFLECTION_PHONG, "r.v"}, {"blinn-phong", LAM_REFLECTION_BLINN_PHONG, "n.h"}, {NULL, 0, NULL}};

static const struct word compress_words[] = {{"fast", LAM_COMPRESS_FAST, "some milliseconds for a million pixels"},
                                             {"best", LAM_COMPRESS_BEST, "the smallest file, in a second or two"},
                                             {NULL, 0, NULL}};

static const struct word color_words[] = {
    {"srgb", LAM_COLOR_SRGB, "colours of files are decoded, lighting is linear, the picture is encoded"},
    {"raw", LAM_COLOR_RAW, "no conversion either way: what the equations give is what the file holds"},
    {NULL, 0, NULL}};

static const struct word show_words[] = {
    {"ambient", LAM_OUTPUT_AMBIENT, "the ambient term"},
    {"diffuse", LAM_OUTPUT_DIFFUSE, "the diffuse term of all lights"},
    {"specular", LAM_OUTPUT_SPECULAR, "the highlights of all lights"},
    {"emission", LAM_OUTPUT_EMISSION, "what the surface gives by itself"},
    {"reflection", LAM_OUTPUT_REFLECTION, "the environment's mirror image"},
    {"light:NAME", LAM_OUTPUT_LIGHT, "all that one light gives, by its name or its number from 1"},
    {"normals", LAM_OUTPUT_NORMALS, "in eye space: (n + 1)/2"},
    {"tangents", LAM_OUTPUT_TANGENTS, "in eye space: (t + 1)/2"},
    {"depth", LAM_OUTPUT_DEPTH, "distance in front of the eye: near white, far black"},
    {"n.l", LAM_OUTPUT_N_L, "cosine between normal and light: max(n.l, 0)"},
    {"n.h", LAM_OUTPUT_N_H, "cosine between normal and half vector: max(n.h, 0)"},
    {"facing", LAM_OUTPUT_FACING, "front blue, back red"},
    {"ids", LAM_OUTPUT_IDS, "a colour for each triangle"},
    {"coverage", LAM_OUTPUT_COVERAGE, "the share of samples that are covered"},
    {"overdraw", LAM_OUTPUT_OVERDRAW, "how many triangles lie over a pixel: c/(c + 3)"},
    {"clipped", LAM_OUTPUT_CLIPPED, "where the picture leaves 0 to 1: above red, below blue"},
    {"all", LAM_OUTPUT_PICTURE, "the picture, every term and every light, as layers of a .exr"},
    {NULL, 0, NULL}};

static const struct word glsl_words[] = {{"330", LAM_GLSL_330, "OpenGL 3.3"},
                                         {"120", LAM_GLSL_120, "OpenGL 2.1: attribute and varying, no blocks, no flat"},
                                         {"300es", LAM_GLSL_300_ES, "OpenGL ES 3.0, WebGL 2"},
                                         {NULL, 0, NULL}};

static const struct word lights_in_words[] = {
    {"auto", LAM_SHADER_LIGHTS_AUTO, "an array in GLSL 120, else a block"},
    {"array", LAM_SHADER_LIGHTS_ARRAY, "plain uniforms, set one by one: lights[0].position"},
    {"block", LAM_SHADER_LIGHTS_BLOCK, "uniform blocks, std140"},
    {"texture", LAM_SHADER_LIGHTS_TEXTURE, "textures of floats: thousands of lights"},
    {NULL, 0, NULL}};

static const struct word host_words[] = {{"c", 1, NULL}, {NULL, 0, NULL}};

static const struct word view_words[] = {
    {"front", LAM_SIDE_FRONT, "level, from +Z (with Y up)"},
    {"back", LAM_SIDE_BACK, "level, from behind"},
    {"left", LAM_SIDE_LEFT, "level, from the model's left side in the picture (-X)"},
    {"right", LAM_SIDE_RIGHT, "level, from the right (+X)"},
    {"top", LAM_SIDE_TOP, "straight down"},
    {"bottom", LAM_SIDE_BOTTOM, "straight up"},
    {"iso", LAM_SIDE_ISO, "45 degrees to the right, 35.26 above: all three axes equally long"},
    {NULL, 0, NULL}};

static const struct word projection_words[] = {
    {"perspective", 0, "30 degrees high"}, {"orthographic", 1, "parallel, as in a drawing"}, {NULL, 0, NULL}};

static const struct word up_words[] = {{"auto", LAM_UP_AUTO, "by format: Z for STL, Y for the others"},
                                       {"x", LAM_UP_X, NULL},
                                       {"y", LAM_UP_Y, NULL},
                                       {"z", LAM_UP_Z, NULL},
                                       {NULL, 0, NULL}};

static const struct word shading_words[] = {
    {"flat", LAM_SHADING_FLAT, "one colour for each triangle"},
    {"gouraud", LAM_SHADING_GOURAUD, "one colour for each vertex, interpolated"},
    {"smooth", LAM_SHADING_GOURAUD, "another name of gouraud"},
    {"phong", LAM_SHADING_PHONG, "normals interpolated, every pixel lit"},
    {"normal", LAM_SHADING_PHONG, "another name of phong"},
    {NULL, 0, NULL}};

// Filled by option_table_fill.
static struct word reflection_words[LAM_REFLECTION_COUNT + 1];
static char reflection_summary[400];

static const struct word rig_words[] = {
    {"auto", LAM_RIG_AUTO, "the model's own lights, the studio where it has none"},
    {"none", RIG_DARK, "no light but the ambient"},
    {"file", LAM_RIG_NONE, "only the model's own lights"},
    {"studio", LAM_RIG_STUDIO, "key, fill and rim light fixed to the camera, sky and ground"},
    {"headlight", LAM_RIG_HEADLIGHT, "one light from the eye"},
    {"three-point", LAM_RIG_THREE_POINT, "a portrait's key, fill and back light, fixed to the camera"},
    {"lecture", LAM_RIG_LECTURE, "a point light at 1r/2r/3r: ambient 0.1, diffuse and specular 1, attenuation 1/0/0"},
    {NULL, 0, NULL}};

static const struct word stage_words[] = {
    {"application", LAM_STAGE_APPLICATION, "colours are worked out before drawing (flat, gouraud)"},
    {"vertex", LAM_STAGE_VERTEX, "for each vertex (flat, gouraud)"},
    {"fragment", LAM_STAGE_FRAGMENT, "for each fragment (flat, phong)"},
    {NULL, 0, NULL}};

static const struct word device_words[] = {{"auto", DEVICE_AUTO, "the CPU; OpenGL where `--gl-device` asks for one"},
                                           {"cpu", DEVICE_CPU, "the processor: the same bytes everywhere"},
                                           {"gl", DEVICE_GL, "OpenGL 3.3"},
                                           {"gles", DEVICE_GLES, "OpenGL ES 3.0, which is what WebGL 2 has"},
                                           {NULL, 0, NULL}};

static const struct word viewer_words[] = {
    {"local", LAM_VIEWER_LOCAL, "the eye is where the camera is"},
    {"infinite", LAM_VIEWER_INFINITE, "it is infinitely far: the same direction for every point"},
    {NULL, 0, NULL}};

static const struct word flat_normal_words[] = {{"face", LAM_FLAT_NORMAL_FACE, "the triangle's own"},
                                                {"vertex", LAM_FLAT_NORMAL_VERTEX, "its last vertex's, as OpenGL does"},
                                                {NULL, 0, NULL}};

static const struct word cull_words[] = {{"none", LAM_CULL_NONE, "both sides are drawn"},
                                         {"back", LAM_CULL_BACK, NULL},
                                         {"front", LAM_CULL_FRONT, NULL},
                                         {NULL, 0, NULL}};

static const struct word normals_words[] = {{"file", LAM_NORMALS_FILE, "the file's; smooth ones where it has none"},
                                            {"smooth", LAM_NORMALS_SMOOTH, "made smooth whatever the file says"},
                                            {"facet", LAM_NORMALS_FACET, "each triangle's own"},
                                            {NULL, 0, NULL}};

static const struct word sheet_words[] = {
    {"summary", SHEET_SUMMARY,
     "flat, smooth, normal interpolation, reflection (of --environment, else of the sky) and anisotropic"},
    {"terms", SHEET_TERMS, "ambient, diffuse and specular alone; all at shininess 50, at 1000, and at 1000 flat"},
    {"stages", SHEET_STAGES, "lit per vertex and per fragment, the brightest highlight enlarged"},
    {"light", SHEET_LIGHT, "the model in white and in green light, with its own colours and in orange"},
    {"ambient", SHEET_AMBIENT, "ambient and diffuse light white and white, red and white, red and red"},
    {"frames", SHEET_FRAMES, "one light in the world's, the camera's and the model's frame, before and after a turn"},
    {"surfaces", SHEET_SURFACES, "specular, diffuse and translucent"},
    {NULL, 0, NULL}};

static const struct word isa_words[] = {{"auto", LAM_ISA_AUTO, "the widest that this machine has"},
                                        {"scalar", LAM_ISA_SCALAR, "C without vectors"},
                                        {"plain", LAM_ISA_SCALAR, NULL},
                                        {"sse4", LAM_ISA_SSE4, "4 lanes"},
                                        {"avx2", LAM_ISA_AVX2, "8 lanes"},
                                        {"avx512", LAM_ISA_AVX512, "16 lanes"},
                                        {"neon", LAM_ISA_NEON, "4 lanes"},
                                        {NULL, 0, NULL}};

const struct option option_table[] = {
    {"output", 'o', GROUP_PICTURE, "FILE", "MODEL.png",
     "Write to FILE (.png, .ppm, .pfm or .exr), to the folder FILE/, or to standard output (-).",
     "The ending decides the format: `.png` (8 bits, sRGB, with alpha), `.ppm` (8 bits over the "
     "background), `.pfm` and `.exr` (linear floats, premultiplied by alpha; `.exr` needs OpenEXR's "
     "library). `-` writes a PNG to standard output; a "
     "pipe or device whose name has no such ending gets a PNG too. Without this option the picture goes to "
     "the current folder under the model's name with `.png` as its ending (`model.png` when the model "
     "comes from standard input), and a file of that name which lambent did not write is never "
     "overwritten. `-o pictures/`, with a slash at its end, does the same in that folder.",
     .takes_file = true, .store = store_text, FIELD(output), .single = TAKES_OUTPUT},
    {"size", 's', GROUP_PICTURE, "W[xH]", "1024", "Size in pixels: 800 is 800x800; 1920x1080.", NULL,
     .store = store_size, .most = 65535, .single = TAKES_SIZE},
    {"samples", 0, GROUP_PICTURE, "N", "4", "Samples per pixel: 1, 2, 4, 8 or 16.",
     "More samples give smoother edges. Each pixel is lit once for each triangle that it shows.", sample_words,
     .store = store_word, FIELD(samples)},
    {"background", 'b', GROUP_PICTURE, "COLOR", "transparent",
     "Behind the model: white, #rrggbb, #rrggbbaa, r/g/b or transparent.",
     "A colour is `#rgb`, `#rrggbb` or `#rrggbbaa` (sRGB), one of the basic names (`black`, `white`, "
     "`gray`, `silver`, `red`, `green`, `blue`, `yellow`, `cyan`, `magenta`, `orange` and the other colour "
     "names of HTML 4), three or four linear numbers `r/g/b` or `r/g/b/a`, or `transparent`.",
     .store = store_color, FIELD(background)},
    {"color", 0, GROUP_PICTURE, "MODE", "srgb", "How colours become numbers: srgb or raw (no conversion).", NULL,
     color_words, .store = store_word, FIELD(color)},
    {"compress", 0, GROUP_PICTURE, "HOW", "fast", "How PNG files are compressed: fast or best.",
     "`best` makes a file that is about a third smaller and takes a second or two for a million pixels, "
     "`fast` takes some milliseconds. The picture is the same, pixel for pixel; other formats ignore the option. "
     "`best` needs libdeflate, and the bytes of the file depend on its version; those of `fast` depend on nothing "
     "but the picture.",
     compress_words, .store = store_word, FIELD(compress)},
    {"exposure", 0, GROUP_PICTURE, "STOPS", "0",
     "Make the picture brighter or darker: 1 doubles its light, -1 halves it.",
     "The light of the model is multiplied by 2 to the power of STOPS before anything is clamped or encoded, "
     "also with "
     "`--color raw`, in float pictures and in what `--show` gives of the light. The background stays as it "
     "was asked "
     "for.",
     .store = store_number, FIELD(exposure), .least = -100, .most = 100},
    {"show", 0, GROUP_PICTURE, "WHAT", "the picture",
     "A term of the light, one light, or numbers of the surfaces in place of the picture.",
     "The terms `ambient`, `diffuse`, `specular`, `emission` and `reflection` add up to the picture. "
     "`light:key` is what the light named key gives; `light:1` is the first light. `n.l` and `n.h` are of "
     "the "
     "first light that has a direction; `n.l:key` and `n.h:key` name another. The rest are numbers of the "
     "surfaces. `all` writes the picture, every term and every light as layers of one `.exr`. `.pfm` and "
     "`.exr` hold them as they are, 8-bit pictures a code for them, with no sRGB encoding. "
     "`docs/show.md` has the table of all of them.",
     show_words, .store = store_show, FIELD(show)},

    {"save-scene", 0, GROUP_PICTURE, "FILE", NULL, "Also write a scene file (JSON) that gives this picture again.",
     "The file holds what the command line amounts to: the model's name relative to FILE, the camera that "
     "was used, all "
     "lights (those of the rig spelled out), materials, transforms and the options of the picture. `lambent "
     "FILE` then gives "
     "the same bytes. An older FILE is replaced. `docs/scene-file.md` has the format.",
     .takes_file = true, .store = store_text, FIELD(save_scene)},

    {"view", 0, GROUP_VIEW, "SIDE", "three-quarter", "Seen from the front, back, left, right, top, bottom or iso.",
     "Without it the camera stands 30 degrees to the right of the front and 20 degrees above. The model "
     "always fills 92 % of the picture's tighter side. `--azimuth` and `--elevation` change the angles of "
     "a named side.",
     view_words, .store = store_word, FIELD(view)},
    {"azimuth", 0, GROUP_VIEW, "DEGREES", "30", "Camera's turn around the model; 0 is the front, 90 the right.", NULL,
     .store = store_number, FIELD(azimuth_deg), .has_field = offsetof(struct options, has_azimuth), .least = -3600,
     .most = 3600},
    {"elevation", 0, GROUP_VIEW, "DEGREES", "20", "Camera's height; 0 is level, 90 straight above.", NULL,
     .store = store_number, FIELD(elevation_deg), .has_field = offsetof(struct options, has_elevation), .least = -90,
     .most = 90},
    {"zoom", 0, GROUP_VIEW, "FACTOR", "1", "2 shows the model twice as large.", NULL, .store = store_number,
     FIELD(zoom), .least = 0.001, .most = 1000},
    {"projection", 0, GROUP_VIEW, "KIND", "perspective", "How depth is shown: perspective or orthographic.", NULL,
     projection_words, .store = store_word, FIELD(projection)},
    {"up", 0, GROUP_VIEW, "AXIS", "auto", "The model's up axis: x, y, z or auto.",
     "It turns the camera and the lights that go with it; the model's coordinates stay as they are. STL "
     "files are taken as Z up, the habit of printing and CAD; the others as Y up.",
     up_words, .store = store_word, FIELD(up)},
    {"rotate", 0, GROUP_VIEW, "AXIS:DEGREES", NULL, "Turn the model itself about its centre, such as y:30; repeatable.",
     "About x, y or z of the scene, in the order given. The lights stay where they are (but those of the "
     "model's own frame), and "
     "radii are counted by the model as it was; the camera is fitted to what results.",
     .store = store_rotation, FIELD(rotations)},
    {"camera", 0, GROUP_VIEW, "KEYS", "fitted", "An exact camera: eye=x/y/z,target=x/y/z,fovy=30 and more.",
     "Keys, with commas between them and in the model's own coordinates: `eye` (must be given), `target` "
     "(the middle of the model), `up` (the model's up axis), `fovy` (the whole vertical angle in degrees: "
     "30) or `ortho` (parallel projection: model units from the picture's middle to its top), `near` and "
     "`far` (both or neither: fitted). It cannot be used with the other options of this group but `--up`. "
     "The report of `--json` has the camera of any picture in these terms.",
     .store = store_camera, FIELD(camera)},

    {"light", 0, GROUP_LIGHTS, "TYPE[:KEYS]", "the rig's",
     "A light of your own: point:position=2r/1r/3r, spot, directional, ambient, hemisphere or none; "
     "repeatable.",
     "TYPE is `ambient`, `hemisphere`, `point`, `directional` or `spot`; behind a colon stand keys with "
     "commas between "
     "them. Lights of your own take the place of the default ones (the model's, or the studio's); `+TYPE` "
     "adds to them, "
     "and `none` takes all away but the ambient light. Where `--rig` is given, its lights stay.\n"
     "Where it is: `position=x/y/z`, in the model's units or, with r behind each number, in radii of the "
     "sphere "
     "around the model, from its centre (`2r/1r/3r`; left out: 1r/2r/3r). `position=x/y/z/0` is a "
     "directional light from "
     "there. `direction=x/y/z` is the way the light travels, `target=x/y/z` where it aims (left out: a "
     "directional light travels "
     "along 0/0/-1, a spot aims at the model's centre). `frame=world|camera|object|object:NAME` says whose "
     "space that is: the "
     "scene's own, the eye's (x right, y up, looking along -z; a light without a position is at the eye), "
     "the model's as it "
     "was before `--rotate`, or a named object's.\n"
     "What it gives: `color` times `intensity` (1) is its diffuse and specular light; `ambient` (0), "
     "`diffuse` and `specular` "
     "set each alone. Colours are `#rrggbb`, a name, `r/g/b` (linear) or one number. An ambient light takes "
     "`color` or `ambient` "
     "(0.2), a hemisphere light `sky` (0.4), `ground` (0.1) and `up`.\n"
     "How it fades: `attenuation=a/b/c` is 1/(a + b d + c d^2), where b and c may carry r: distance in radii "
     "(`1/2.7r/5r`); `range` (also with r) lets it end there. A spot's cone: `cutoff` (half angle in "
     "degrees, 45) and `exponent`, or "
     "`inner` and `outer` half angles. `name` is for reports.\n"
     "The fields of lights have a table of their own.",
     .store = store_light, FIELD(lights)},
    {"rig", 0, GROUP_LIGHTS, "NAME", "auto",
     "A ready-made set of lights: studio, headlight, three-point, lecture, file (the model's), none or auto.",
     "A named rig takes the place of the model's own lights. docs/lighting/lights.md has the numbers.", rig_words,
     .store = store_word, FIELD(rig), .has_field = offsetof(struct options, has_rig)},
    {"ambient", 0, GROUP_LIGHTS, "COLOR", "0", "Light from everywhere: #rrggbb, r/g/b, a name or one number.", NULL,
     .store = store_light_color, FIELD(ambient)},
    {"show-lights", 0, GROUP_LIGHTS, NULL, NULL,
     "Draw where the lights are: balls, and cones that point the way they shine.",
     "A directional light's marker stands one and a half radii from the model's centre. The markers glow in "
     "the lights' colours; "
     "the view does not move for them.",
     .store = store_switch, FIELD(show_lights)},
    {"light-cutoff", 0, GROUP_LIGHTS, "SHARE", "0.00196",
     "Many lights: how much those too weak for a part of the picture may be worth; 0 evaluates every light "
     "everywhere.",
     "With more than 16 lights, each part of the picture leaves out the weakest ones, as long as all that "
     "they "
     "could add to a channel there, together, stays below this share of the channel's whole range. The "
     "default is "
     "half a step of an 8-bit channel (0.5/255): no byte is off by more than 1. Lights that add exactly "
     "nothing "
     "(behind the surface, beyond their range, outside of their cone) are always left out.",
     .store = store_number, FIELD(light_cutoff), .has_field = offsetof(struct options, has_light_cutoff), .least = 0,
     .most = 1},
    {"light-scale", 0, GROUP_LIGHTS, "FACTOR", "1", "All lights this much brighter (not `--ambient`).", NULL,
     .store = store_number, FIELD(light_scale), .has_field = offsetof(struct options, has_light_scale), .least = 0,
     .most = 1e6},
    {"material", 0, GROUP_MATERIALS, "NAME|KEYS[@WHERE]", "the model's",
     "Another material: gold (see `lambent materials`), or shininess=50,specular=0.5; repeatable.",
     "A name of the classic table, or keys with commas between them, or a name and then keys "
     "(`gold,shininess=80`). What keys leave out stays as the model has it. The keys are the fields of materials, "
     "which "
     "have a table of their own (colours are `#rrggbb`, a name, `r/g/b` or one number); or `color` (ambient and "
     "diffuse) and `specular_color` with the factors `ka`, `kd`, `ks` and `kr`, which multiply ambient, diffuse, "
     "specular and mirrored light (`kr` the specular colour, white where it is left out).\n"
     "`@WHERE` limits it to the objects of that name, else to the parts (OBJ groups, STL solids), else to "
     "the model's materials: "
     "`ruby@handle`. The option may be repeated; a later one wins.",
     .store = store_material, FIELD(materials)},
    {"back-material", 0, GROUP_MATERIALS, "NAME|KEYS[@OBJECT]", "the front's",
     "The material of back faces, as in `--material`; what it leaves out is the front's.", NULL,
     .store = store_material, FIELD(back_materials)},
    {"shininess", 0, GROUP_MATERIALS, "ALPHA", NULL, "The exponent of all highlights: 10 is wide, 1000 sharp.",
     "It takes the place of the materials' own, also of `--material`.", .store = store_number, FIELD(shininess),
     .has_field = offsetof(struct options, has_shininess), .least = 0, .most = 1e30},
    {"opacity", 0, GROUP_MATERIALS, "SHARE", NULL, "Alpha of all materials: 1 is opaque, 0 clear.",
     "It takes the place of the materials' own, also of `--material`; vertex colours may have an alpha "
     "besides.",
     .store = store_number, FIELD(opacity), .has_field = offsetof(struct options, has_opacity), .least = 0, .most = 1},

    {"shading", 0, GROUP_SHADING, "METHOD", "phong", "Where light is worked out: flat, gouraud or phong (each pixel).",
     NULL, shading_words, .store = store_word, FIELD(shading), .has_field = offsetof(struct options, has_shading)},
    {"reflection", 0, GROUP_SHADING, "MODEL", "auto", reflection_summary, NULL, reflection_words, .store = store_word,
     FIELD(reflection)},
    {"stage", 0, GROUP_SHADING, "WHERE", "fragment", "Where lighting is worked out: application, vertex or fragment.",
     "Without `--shading`, application and vertex take gouraud and fragment takes phong. flat goes with all "
     "three, gouraud with "
     "application and vertex, phong with fragment. On this device all stages of a shading method give the "
     "same bytes.",
     stage_words, .store = store_word, FIELD(stage)},
    {"flat-normal", 0, GROUP_SHADING, "SOURCE", "face", "The normal of flat shading: face or vertex (the last one's).",
     NULL, flat_normal_words, .store = store_word, FIELD(flat_normal)},
    {"viewer", 0, GROUP_SHADING, "KIND", "local", "Where the eye is for highlights: local or infinite.", NULL,
     viewer_words, .store = store_word, FIELD(viewer)},
    {"match-highlights", 0, GROUP_SHADING, NULL, NULL,
     "Blinn-Phong takes 4 times the shininess, so that it looks like Phong.", NULL, .store = store_switch,
     FIELD(match_highlights)},
    {"gl1", 0, GROUP_SHADING, NULL, NULL, "As OpenGL 1: vertex colours clamped, shininess to 128, ambient attenuated.",
     "For comparison with old programs: vertex colours are clamped to 0...1 before they are interpolated, "
     "the shininess is at "
     "most 128, and the ambient light of a light fades with it and is narrowed by its cone.",
     .store = store_switch, FIELD(gl1)},
    {"two-sided", 0, GROUP_SHADING, NULL, NULL,
     "Light back faces with the normal turned round, whatever the model says.", NULL, .store = store_switch,
     FIELD(two_sided)},
    {"one-sided", 0, GROUP_SHADING, NULL, NULL, "Light back faces as front faces, with the normal as it is.", NULL,
     .store = store_switch, FIELD(one_sided)},
    {"cull", 0, GROUP_SHADING, "SIDE", "the model's",
     "Leave out the back or front faces of all objects: none, back or front.", NULL, cull_words, .store = store_word,
     FIELD(cull), .has_field = offsetof(struct options, has_cull)},
    {"normals", 0, GROUP_SHADING, "SOURCE", "file", "Whose normals: the file's (file), smooth or facet ones made anew.",
     NULL, normals_words, .store = store_word, FIELD(normals)},
    {"crease-angle", 0, GROUP_SHADING, "DEGREES", "40", "Made normals are split at sharper edges than this.", NULL,
     .store = store_number, FIELD(crease_angle_deg), .least = 0, .most = 180},
    {"segments", 0, GROUP_SHADING, "N[xM]", "the shape's own",
     "Segments of a built-in shape: slices around, and stacks along, such as 64x32.",
     "N is 3 to 16384; `lambent shapes` says what the segments are of each shape. M left out is the shape's "
     "own number. gyroid and metaballs count at most 1024 cells and take no M.",
     .store = store_segments, .most = 16384},
    {"environment", 0, GROUP_SHADING, "IMAGE", "none",
     "What shiny surfaces mirror: an image, six faces, sky or studio.",
     "An image is a cross of six squares (4:3 or 3:4) or equirectangular (2:1), in PNG, JPEG, PPM, PFM or "
     "Radiance (.hdr). Six "
     "faces are files with commas between them in OpenGL's order, `px,nx,py,ny,pz,nz`, all square and of one "
     "size. `sky` and "
     "`studio` are built in (`./sky` is a file). It is seen in materials with a reflectivity only: see "
     "`--reflectivity`. "
     "`docs/lighting/reflection.md` tells how each lies around the model.",
     .takes_file = true, .store = store_text, FIELD(environment)},
    {"environment-rotation", 0, GROUP_SHADING, "DEGREES", "0",
     "Turns the environment about the up axis, counter-clockwise from above.", NULL, .store = store_number,
     FIELD(environment_rotation_deg), .least = -3600, .most = 3600},
    {"reflectivity", 0, GROUP_SHADING, "SHARE", "the materials' own",
     "Share of the environment that every material mirrors: 0.5 or r/g/b.", NULL, .store = store_reflectivity,
     FIELD(reflectivity), .has_field = offsetof(struct options, has_reflectivity), .most = 1000},

    {"threads", 'j', GROUP_WORK, "N", "one for each processor",
     "Threads to work with. The picture does not depend on it.", NULL, .store = store_integer, FIELD(threads),
     .least = 1, .most = 1024},
    {"isa", 0, GROUP_WORK, "NAME", "auto", "Instruction set: scalar, sse4, avx2, avx512, neon or auto.",
     "Every one gives the same bytes; one that this machine or this build does not have is refused (exit 3).",
     isa_words, .store = store_word, FIELD(isa)},
    {"device", 0, GROUP_WORK, "NAME", "auto", "What draws: cpu, gl, gles or auto.",
     "OpenGL gives the same picture within a tolerance (`docs/opengl.md`); where it cannot be had the reason "
     "is told "
     "(exit 3), and nothing else is drawn in its place. `lambent devices` lists what there is.",
     device_words, .store = store_word, FIELD(device)},
    {"gl-device", 0, GROUP_WORK, "N|NAME", "the first usable", "Which OpenGL device, by number or part of its name.",
     "The number is that of `lambent devices`, where hardware stands before software.", .store = store_text,
     FIELD(gl_device)},
    {"repeat", 0, GROUP_WORK, "N", "1", "Draw N frames and report the median one's time.", NULL, .store = store_integer,
     FIELD(repeat), .least = 1, .most = 100000},
    {"time-limit", 0, GROUP_WORK, "SECONDS", "none", "Give up on a model after this time (exit 4).", NULL,
     .store = store_number, FIELD(time_limit_s), .least = 0.001, .most = 1e9},
    {"memory-limit", 0, GROUP_WORK, "BYTES", "none",
     "Give up on a model that needs more, such as 500M or 2Gi (exit 4).",
     "Reading a model and drawing it may each hold this much at once. k, M, G and T are powers of 1000, "
     "Ki, Mi, Gi and Ti of 1024.",
     .store = store_bytes, FIELD(memory_limit_bytes)},

    {"json", 0, GROUP_REPORT, NULL, NULL, "Print a report in JSON, one line for each model.",
     "It goes to standard output, or to standard error when the picture goes to standard output (then "
     "nothing else is written there). It comes in place of the line that tells the file's name, and also "
     "when something fails. Its schema is `docs/report.schema.json`.",
     .store = store_switch, FIELD(json), .single = TAKES_JSON},
    {"verbose", 'v', GROUP_REPORT, NULL, NULL, "Tell on standard error what was read and what each step took.", NULL,
     .store = store_switch, FIELD(verbose)},
    {"quiet", 'q', GROUP_REPORT, NULL, NULL, "Say nothing but errors.", NULL, .store = store_switch, FIELD(quiet),
     .single = TAKES_QUIET},

    {"tolerance", 0, GROUP_DIFF, "STEPS", "0",
     "How far a channel may be off, in steps of 1/255 of the full range; beyond it the exit code is 6.", NULL,
     .store = store_number, FIELD(tolerance), .least = 0, .most = 1e9},
    {"gain", 0, GROUP_DIFF, "FACTOR", "16", "The picture of the difference shows it this many times as large.", NULL,
     .store = store_number, FIELD(gain), .least = 0.001, .most = 1e6},

    {"sheet", 0, GROUP_SHEET, "NAME", "summary",
     "What is compared: summary, terms, stages, light, ambient, frames or surfaces.", NULL, sheet_words,
     .store = store_word, FIELD(sheet)},
    {"across", 0, GROUP_SHEET, "OPTION[=VALUES]", NULL,
     "A row of pictures in place of a sheet: shading, or shininess=10,50,1000; a second makes columns.",
     "OPTION is one of the options above without its dashes. The values stand with commas between them; "
     "those of `light`, "
     "`material` and other options that have commas of their own, with semicolons "
     "(`light=point;directional:color=red,frame=camera`). Left out, they are the words that the option "
     "takes; for `shininess` "
     "10, 50 and 1000 (with `--material specular=0.5` where no material is given), for `light` one of each "
     "type, for `show`, which may be called `term`, the five terms. "
     "Given twice, the first makes the lines of a grid and the second its columns.",
     .store = store_across, FIELD(across)},

    {"to", 0, GROUP_PLOT, "X", "fitted", "The horizontal axis goes from 0 to X: a distance, or degrees.", NULL,
     .store = store_number, FIELD(to), .least = 1e-6, .most = 1e9},

    {"vertex", 0, GROUP_CHECK, "FILE", NULL, "The vertex shader that belongs to the fragment shader.",
     "Without it a correct one is generated, which recognises varyings by name and type (`docs/check.md`).",
     .takes_file = true, .store = store_text, FIELD(vertex)},
    {"contract", 0, GROUP_CHECK, "NAME", "auto",
     "The names that the shaders use: lambent, pittsburgh, oregon, nyu or auto.", NULL, contract_words,
     .store = store_word, FIELD(contract)},
    {"light-frame", 0, GROUP_CHECK, "SPACE", "the contract's", "The space of light positions: object or camera.", NULL,
     light_frame_words, .store = store_word, FIELD(light_frame)},
    {"highlight", 0, GROUP_CHECK, "NAME", "the contract's", "The expected highlight: phong or blinn-phong.", NULL,
     highlight_words, .store = store_word, FIELD(highlight)},
    {"scenes", 0, GROUP_CHECK, "NAMES", "all", "The scenes to use, separated by commas: all,gate,near.", NULL,
     .store = store_text, FIELD(scenes)},
    {"stop-after", 0, GROUP_CHECK, "SECONDS", "10", "The limit of a shader's processor time, for all scenes.",
     "It is the time of all threads together, so other load on the machine does not count; elapsed time may be 20 "
     "times as long.",
     .store = store_number, FIELD(stop_after_s), .least = 0.1, .most = 1e6},
    {"list", 0, GROUP_CHECK, NULL, NULL, "Print the contracts, the scenes and the known mistakes.", NULL,
     .store = store_switch, FIELD(list)},
    {"glsl", 0, GROUP_SHADER, "VERSION", "330", "The language of the shaders: 330, 120 or 300es.",
     "300es may be written as in a shader's first line, \"300 es\".", glsl_words, .store = store_glsl, FIELD(glsl)},
    {"host", 0, GROUP_SHADER, "LANGUAGE", NULL, "Also print code that sets everything the shaders ask for: c.",
     "Functions that compile the sources, tell OpenGL what a vertex is, and set every uniform to the value "
     "that it has in "
     "this picture, with nothing but OpenGL's own calls. With `-o NAME` it is `NAME.c`.",
     host_words, .store = store_word, FIELD(host)},
    {"products", 0, GROUP_SHADER, NULL, NULL,
     "Uniforms are the products ka La, kd Ld and ks Ls, formed before drawing, as in the lectures.", NULL,
     .store = store_switch, FIELD(products)},
    {"lights-in", 0, GROUP_SHADER, "PLACE", "auto", "Where the lights stand: array, block or texture.",
     "None of them has a fixed greatest number of lights; what OpenGL allows an array is the least, a "
     "texture most.",
     lights_in_words, .store = store_word, FIELD(lights_in)},
    {"object", 0, GROUP_SHADER, "N", "all", "Only this object of the scene, counted from 0.",
     "One pair of shaders serves a whole scene, unless some objects have two sides and others one, or some "
     "have tangents for "
     "Kajiya-Kay and others have not.",
     .store = store_integer, FIELD(object), .has_field = offsetof(struct options, has_object), .least = 0, .most = 1e9},

    {"font", 0, GROUP_CAPTIONS, "FILE", "the system's", "The font of captions: a TrueType or OpenType file.",
     "Without it the environment's `LAMBENT_FONT` names one; else the first there is of DejaVu Sans, "
     "Liberation Sans, "
     "Noto Sans, FreeSans and Roboto, where Debian installs them. FreeType draws the letters, which may "
     "differ by a few shades between "
     "its versions; the pictures between them never do. An SVG names DejaVu Sans, and its reader chooses.",
     .takes_file = true, .store = store_text, FIELD(font)},
    {"no-captions", 0, GROUP_CAPTIONS, NULL, NULL, "Draw without words; then no font is needed.", NULL,
     .store = store_switch, FIELD(no_captions)},

    {"version", 0, GROUP_ABOUT, NULL, NULL, "Print the version and what it was built with.", NULL,
     .store = store_switch, FIELD(version)},
    {"help", 'h', GROUP_ABOUT, NULL, NULL, "Print this help.", NULL, .store = store_switch, FIELD(help)},
    {.name = NULL},
};

static char *append(char *to, const char *text)
{
    while (*text)
        *to++ = *text++;
    return to;
}

// Every start of the program runs this: no printf.
void option_table_fill(void)
{
    char *end = append(reflection_summary, "How surfaces answer light:");
    for (int i = 0; i < LAM_REFLECTION_COUNT; i++) {
        const lam_reflection_info *model = lam_reflection_describe((lam_reflection)i);
        reflection_words[i] = (struct word){model->word, i, model->summary};
        if (i > LAM_REFLECTION_AUTO && end - reflection_summary < (int)(sizeof reflection_summary - 60))
            end = append(append(end, i > LAM_REFLECTION_NONE ? ", " : " "), model->word);
    }
    append(end, " or auto.");
}
