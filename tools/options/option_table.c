// option_table.c: every option, once. The help, the man page, the completions and docs/command-line.md are generated
// from these rows (tools/help).
//
// Longer than 600 lines: one row for each option, in the order of the help.
#include "options.h"

#include <lambent/check.h>

// Degrees of --fov, and of --camera with fovy alone.
#define FOV_MIN 0.1
#define FOV_MAX 179.9

#define FIELD(name) .field = offsetof(struct options, name)

const char *const group_titles[GROUP_COUNT] = {
    [GROUP_PICTURE] = "Picture",
    [GROUP_MODEL] = "Model files",
    [GROUP_VIEW] = "View",
    [GROUP_SHADING] = "Shading",
    [GROUP_ANIMATION] = "Animations",
    [GROUP_WORK] = "Work",
    [GROUP_LIMITS] = "Limits",
    [GROUP_BATCH] = "Many models (render, batch)",
    [GROUP_REPORT] = "Reports",
    [GROUP_DIFF] = "Comparing pictures (diff, check)",
    [GROUP_HASH] = "Hashes of pictures (hash)",
    [GROUP_CONVERT] = "Models in another format (convert)",
    [GROUP_PLOT] = "Plots (plot)",
    [GROUP_CAPTIONS] = "Captions (compare, plot, materials, check, explain)",
    [GROUP_ABOUT] = "About",
    [GROUP_LIGHTS] = "Lights",
    [GROUP_MATERIALS] = "Materials",
    [GROUP_SHEET] = "Sheets (compare)",
    [GROUP_CHECK] = "Checking shaders (check)",
    [GROUP_SHADER] = "Shaders (shader)",
    [GROUP_SHAPE] = "Formulas (shape)",
    [GROUP_VIEWER] = "Viewer (view)",
};

static const struct word sample_words[] = {{"1", 1, NULL}, {"2", 2, NULL},   {"4", 4, NULL},
                                           {"8", 8, NULL}, {"16", 16, NULL}, {NULL, 0, NULL}};

// Filled by option_table_fill: auto, and the contracts that are built in.
enum { CONTRACT_WORDS_MAX = 24 };
static struct word contract_words[CONTRACT_WORDS_MAX] = {{"auto", 0, NULL}};

static const struct word sandbox_words[] = {{"auto", SANDBOX_AUTO, "what the kernel has"},
                                            {"require", SANDBOX_REQUIRE, "all of it, or an error"},
                                            {"off", SANDBOX_OFF, "none"},
                                            {NULL, 0, NULL}};

static const struct word shard_by_words[] = {
    {"name", SHARD_BY_NAME, "from the hash of a model's name: one that is added moves no other"},
    {"list", SHARD_BY_LIST, "consecutive models of one sorted list: a shard reads only its part"},
    {NULL, 0, NULL}};
static const struct word light_frame_words[] = {
    {"object", LAM_FRAME_OBJECT, "in object space: the model-view matrix transforms it, like the vertices"},
    {"camera", LAM_FRAME_CAMERA, "in eye space: used as given"},
    {NULL, 0, NULL}};

static const struct word highlight_words[] = {
    {"phong", LAM_REFLECTION_PHONG, "r.v"}, {"blinn-phong", LAM_REFLECTION_BLINN_PHONG, "n.h"}, {NULL, 0, NULL}};

static const struct word term_words[] = {{"all", LAM_CHECK_TERM_ALL, NULL},
                                         {"ambient", LAM_CHECK_TERM_AMBIENT, NULL},
                                         {"diffuse", LAM_CHECK_TERM_DIFFUSE, NULL},
                                         {"specular", LAM_CHECK_TERM_SPECULAR, NULL},
                                         {NULL, 0, NULL}};

static const struct word compress_words[] = {{"fast", LAM_COMPRESS_FAST, "some milliseconds for a million pixels"},
                                             {"best", LAM_COMPRESS_BEST, "the smallest file, in a second or two"},
                                             {NULL, 0, NULL}};

static const struct word term_words_list[] = {
    {"auto", TERM_AUTO, "where no file is named, and the terminal has one of the next three"},
    {"kitty", TERM_KITTY, "the PNG itself: kitty, Ghostty, Konsole"},
    {"iterm2", TERM_ITERM2, "the PNG itself: iTerm2, WezTerm"},
    {"sixel", TERM_SIXEL, "256 colours: xterm, foot, mlterm; needs libchafa"},
    {"blocks", TERM_BLOCKS, "characters in colour, on any terminal; needs libchafa"},
    {"off", TERM_OFF, "never"},
    {NULL, 0, NULL}};

static const struct word color_mode_words[] = {
    {"srgb", LAM_COLOR_SRGB, "colours of files are decoded, lighting is linear, the picture is encoded"},
    {"raw", LAM_COLOR_RAW, "no conversion either way: the file holds the results of the equations"},
    {NULL, 0, NULL}};

static const struct word show_words[] = {
    {"ambient", LAM_OUTPUT_AMBIENT, "the ambient term"},
    {"diffuse", LAM_OUTPUT_DIFFUSE, "the diffuse term of all lights"},
    {"specular", LAM_OUTPUT_SPECULAR, "the highlights of all lights"},
    {"emission", LAM_OUTPUT_EMISSION, "the light that the surface emits"},
    {"reflection", LAM_OUTPUT_REFLECTION, "the reflection of the environment"},
    {"light:NAME", LAM_OUTPUT_LIGHT, "the contribution of one light, by its name or its number from 1"},
    {"normals", LAM_OUTPUT_NORMALS, "in eye space: (n + 1)/2"},
    {"tangents", LAM_OUTPUT_TANGENTS, "in eye space: (t + 1)/2"},
    {"depth", LAM_OUTPUT_DEPTH, "distance in front of the eye: the model's nearest point white, its farthest black"},
    {"n.l", LAM_OUTPUT_N_L, "cosine between normal and light: max(n.l, 0)"},
    {"n.h", LAM_OUTPUT_N_H, "cosine between normal and half vector: max(n.h, 0)"},
    {"facing", LAM_OUTPUT_FACING, "front blue, back red"},
    {"ids", LAM_OUTPUT_IDS, "a colour for each triangle"},
    {"coverage", LAM_OUTPUT_COVERAGE, "the fraction of covered samples"},
    {"overdraw", LAM_OUTPUT_OVERDRAW, "the number of triangles over a pixel: c/(c + 3)"},
    {"clipped", LAM_OUTPUT_CLIPPED, "pixels outside 0 to 1: above red, below blue"},
    {"base-color", LAM_OUTPUT_BASE_COLOR, "the base or diffuse colour, with maps and vertex colours"},
    {"roughness", LAM_OUTPUT_ROUGHNESS, "of physical materials"},
    {"metallic", LAM_OUTPUT_METALLIC, "of physical materials"},
    {"occlusion", LAM_OUTPUT_OCCLUSION, "of an occlusion map"},
    {"lod", LAM_OUTPUT_LOD, "level of detail of the base colour's map: level / 10"},
    {"ao", LAM_OUTPUT_AMBIENT_OCCLUSION, "ambient occlusion: white where all light from around arrives"},
    {"all", LAM_OUTPUT_PICTURE, "the picture, every term and every light, as layers of a .exr"},
    {NULL, 0, NULL}};

static const struct word glsl_words[] = {{"330", LAM_GLSL_330, "OpenGL 3.3"},
                                         {"120", LAM_GLSL_120, "OpenGL 2.1: attribute and varying, no blocks, no flat"},
                                         {"300es", LAM_GLSL_300_ES, "OpenGL ES 3.0, WebGL 2"},
                                         {NULL, 0, NULL}};

static const struct word style_words[] = {
    {"full", LAM_SHADER_STYLE_FULL, "the library's equations, for all that it draws"},
    {"lecture", LAM_SHADER_STYLE_LECTURE, "plain lines, as a lecture shows them"},
    {NULL, 0, NULL}};

static const struct word lights_in_words[] = {
    {"auto", LAM_SHADER_LIGHTS_AUTO, "an array in GLSL 120 and in the lecture style, else a block"},
    {"array", LAM_SHADER_LIGHTS_ARRAY, "plain uniforms, set one by one: lights[0].position"},
    {"block", LAM_SHADER_LIGHTS_BLOCK, "uniform blocks, std140"},
    {"texture", LAM_SHADER_LIGHTS_TEXTURE, "textures of floats: thousands of lights"},
    {NULL, 0, NULL}};

static const struct word host_words[] = {{"c", 1, NULL}, {NULL, 0, NULL}};

static const struct word view_words[] = {
    {"three-quarter", LAM_SIDE_THREE_QUARTER, "30 degrees to the right of the front, 20 above"},
    {"front", LAM_SIDE_FRONT, "level, from +Z (with Y up)"},
    {"back", LAM_SIDE_BACK, "level, from behind"},
    {"left", LAM_SIDE_LEFT, "level, from the model's left side in the picture (-X)"},
    {"right", LAM_SIDE_RIGHT, "level, from the right (+X)"},
    {"top", LAM_SIDE_TOP, "straight down"},
    {"bottom", LAM_SIDE_BOTTOM, "straight up"},
    {"iso", LAM_SIDE_ISO, "45 degrees to the right, 35.26 above: all three axes equally long"},
    {NULL, 0, NULL}};

static const struct word projection_words[] = {{"perspective", 0, "a vertical field of view of 30 degrees (`--fov`)"},
                                               {"orthographic", 1, "parallel, as in a drawing"},
                                               {NULL, 0, NULL}};

static const struct word up_words[] = {{"auto", LAM_UP_AUTO, "by format: z for STL and 3MF, y for the others"},
                                       {"x", LAM_UP_X, NULL},
                                       {"y", LAM_UP_Y, "the model's front is +Z"},
                                       {"z", LAM_UP_Z, "the model's front is -Y"},
                                       {"-x", LAM_UP_NEGATIVE_X, NULL},
                                       {"-y", LAM_UP_NEGATIVE_Y, "like y, upside down"},
                                       {"-z", LAM_UP_NEGATIVE_Z, "like z, upside down"},
                                       {NULL, 0, NULL}};

// Filled by option_table_fill.
static char reflection_summary[400], output_summary[200];

static const struct word tone_words[] = {
    {"auto", LAM_TONE_AUTO, "khronos-neutral for physical materials, else none"},
    {"none", LAM_TONE_NONE, "each channel is cut off at 1"},
    {"reinhard", LAM_TONE_REINHARD, "x / (1 + x), each channel by itself"},
    {"aces", LAM_TONE_ACES, "film-like contrast: Hill's fit of ACES"},
    {"agx", LAM_TONE_AGX, "soft contrast; bright colours fade to white"},
    {"khronos-neutral", LAM_TONE_KHRONOS_NEUTRAL, "colours as they are, highlights compressed"},
    {NULL, 0, NULL}};

static const struct word look_words[] = {
    {"studio", 0, "the default"},
    {"classic", 1, "the former studio: directional lights, no occlusion"},
    {"catalog", 2, "the studio over a ground that catches a soft shadow, for a page"},
    {"technical", 3, "feature edges over light flat faces, for print"},
    {NULL, 0, NULL}};

static const struct word rig_words[] = {
    {"auto", LAM_RIG_AUTO, "the model's own lights; if it has none the studio, for glTF the studio environment"},
    {"none", RIG_DARK, "no light but the ambient"},
    {"default", RIG_DEFAULT, "the studio of models without lights, in place of the model's own lights"},
    {"file", LAM_RIG_NONE, "only the model's own lights"},
    {"studio", LAM_RIG_STUDIO, "key, fill and rim light fixed to the camera, sky and ground"},
    {"headlight", LAM_RIG_HEADLIGHT, "one light from the eye"},
    {"three-point", LAM_RIG_THREE_POINT, "a portrait's key, fill and back light, fixed to the camera"},
    {"lecture", LAM_RIG_LECTURE, "a point light at 1r/2r/3r: ambient 0.1, diffuse and specular 1, attenuation 1/0/0"},
    {NULL, 0, NULL}};

static const struct word turntable_light_words[] = {
    {"camera", TURNTABLE_LIGHT_CAMERA, "lights stand still in the picture, and the model turns below them"},
    {"model", TURNTABLE_LIGHT_MODEL, "lights and environment turn with the model, as if the camera went around it"},
    {NULL, 0, NULL}};

static const struct word device_words[] = {{"auto", DEVICE_AUTO, "the CPU; OpenGL if `--gl-device` names a device"},
                                           {"cpu", DEVICE_CPU, "the processor: the same bytes everywhere"},
                                           {"gl", DEVICE_GL, "OpenGL 3.3"},
                                           {"gles", DEVICE_GLES, "OpenGL ES 3.0, as in WebGL 2"},
                                           {NULL, 0, NULL}};

static const struct word texture_filter_words[] = {
    {"exact", TEXTURE_FILTER_EXACT, "the shader filters: the CPU device's picture within 1/255"},
    {"hardware", TEXTURE_FILTER_HARDWARE, "the graphics card filters: faster, less exact"},
    {NULL, 0, NULL}};

static const struct word cull_words[] = {{"none", LAM_CULL_NONE, "both sides are drawn"},
                                         {"back", LAM_CULL_BACK, NULL},
                                         {"front", LAM_CULL_FRONT, NULL},
                                         {NULL, 0, NULL}};

static const struct word normals_words[] = {{"file", LAM_NORMALS_FILE, "the file's; smooth ones if it has none"},
                                            {"smooth", LAM_NORMALS_SMOOTH, "computed, even if the file has normals"},
                                            {"facet", LAM_NORMALS_FACET, "one for each triangle"},
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

static const struct word isa_words[] = {{"auto", LAM_ISA_AUTO, "the widest that this machine supports"},
                                        {"scalar", LAM_ISA_SCALAR, "C without vectors"},
                                        {"plain", LAM_ISA_SCALAR, NULL},
                                        {"sse4", LAM_ISA_SSE4, "4 lanes"},
                                        {"avx2", LAM_ISA_AVX2, "8 lanes"},
                                        {"avx512", LAM_ISA_AVX512, "16 lanes"},
                                        {"neon", LAM_ISA_NEON, "4 lanes"},
                                        {"wasm", LAM_ISA_WASM, "WebAssembly's SIMD128, 4 lanes"},
                                        {NULL, 0, NULL}};

struct option option_table[OPTIONS_MAX] = {
    {"output", 'o', GROUP_PICTURE, "FILE", "MODEL.png", output_summary,
     "The extension selects the format; `lambent formats` says which numbers each holds. `-` writes a PNG to standard "
     "output; a pipe or device whose name has no such extension also gets a PNG, and so does a file whose name has no "
     "extension at all. Without this "
     "option the picture is written to the current folder under the model's name with the extension `.png` "
     "(`model.png` if the model comes from standard input); a file of that name that lambent did not write is "
     "never overwritten. `-o pictures/`, with a trailing slash, does the same in that folder, and makes it if it "
     "is missing; every command that writes files takes it. `--out` is another name of the option.\n"
     "A name with words in braces is a pattern, which each model fills in: `-o 'thumbs/{dir}/{stem}-{view}.png'`. "
     "`{stem}` is the model's file name without its ending, `{ext}` that ending, `{dir}` its folder (without `..` and "
     "a leading slash), "
     "`{view}` the word of `--view`, `{size}` the size in pixels, `256` or `256x128`. Missing folders are made, and "
     "existing files replaced. Two models whose pictures would have one name are an error before the start. `{{` "
     "and `}}` are braces.\n"
     "`.html` writes a page in one file that shows the picture, with the model in it: who opens it turns the model and "
     "changes every option of the picture, without a network (`docs/web.md`). It needs the page that `make web` "
     "builds.",
     .kind = VALUE_FILE, .brief = "FILE.png, .jpg, .webp, .exr ...; or a FOLDER/", .of_file = true, .store = store_text,
     .alias = "out", .others = "outfile file format export save write out-dir outdir directory folder f",
     FIELD(picture.output), .single = TAKES_OUTPUT},
    {"size", 's', GROUP_PICTURE, "W[xH]", "1024", "The picture's size in pixels: 800 is 800x800; 1920x1080.",
     "`render` and `batch` take several sizes, at most 16, such as `1024,256x128`: each model is read once, and each "
     "picture is drawn on its own and never scaled. With several sides (`--view`) every side is drawn in every size. "
     "Without a pattern in `-o` the size follows the model's name: `bunny-256x128.png`.",
     .several = "sizes", .brief = "pixels: 800, or 1920x1080", .store = store_size,
     .others = "resolution resolutions thumbnails width height dimensions pixels viewport window", .max = 65535,
     .single = TAKES_SIZE},
    {"samples", 0, GROUP_PICTURE, "N", "16 up to 256x256 pixels, 8 up to 512x512, 4 above",
     "Samples per pixel: 1, 2, 4, 8 or 16.",
     "More samples give smoother edges, which matters most in small pictures; each picture of a sheet has the samples "
     "of "
     "its own size. Each triangle that covers part of a pixel is lit once in that pixel.",
     sample_words, .store = store_word,
     .others = "antialias antialiasing anti-aliasing aa msaa supersampling ssaa quality spp", FIELD(draw.samples)},
    {"anisotropy", 0, GROUP_PICTURE, "N", NULL, NULL,
     "Each pixel sees a texture through a footprint that is long where the surface turns away. One probe has the size "
     "of its "
     "longer axis, which blurs the shorter one; N probes along the longer axis are as sharp as N times that.",
     .others = "anisotropic anisotropic-filtering"},
    {"line-width", 0, GROUP_PICTURE, "PIXELS", NULL, NULL,
     "Lines of OBJ (`l`), PLY (`edge`) and glTF files are as wide at every distance. They lie nearer than their "
     "vertices by "
     "their width, so that lines on a surface are seen, and end without caps.",
     .others = "linewidth stroke-width thickness"},
    {"point-size", 0, GROUP_PICTURE, "PIXELS", "by their number", NULL,
     "Points of OBJ (`p`) and glTF files, and the vertices of PLY files without faces and edges, are as large at every "
     "distance. By default: 3 pixels or more, and at least 8 if there are fewer than 100.",
     .others = "pointsize point-width splat-size"},
    {"background", 'b', GROUP_PICTURE, "COLOR", "transparent",
     "The background: white, #rrggbb, #rrggbbaa, r/g/b or transparent.",
     "It lies wherever the model does not, in pictures of `--show` too, and behind each picture of a sheet. The sheets "
     "of `compare` and `materials` are white by default. "
     "A colour is `#rgb`, `#rrggbb` or `#rrggbbaa` (sRGB), one of the basic names (`black`, `white`, "
     "`gray`, `silver`, `red`, `green`, `blue`, `yellow`, `cyan`, `magenta`, `orange` and the other colour "
     "names of HTML 4), three or four linear numbers `r/g/b` or `r/g/b/a`, or `transparent`.",
     .kind = VALUE_COLOR, .brief = "white, '#dfe6ee' or transparent", .store = store_color,
     .others = "bg background-color backdrop transparent", FIELD(picture.background)},
    {"color-mode", 0, GROUP_PICTURE, "MODE", "srgb", "The colour encoding: srgb, or raw (no conversion).", NULL,
     color_mode_words, .store = store_word, .others = "encoding gamma colorspace color-space linear srgb",
     FIELD(picture.color_mode)},
    {"compress", 0, GROUP_PICTURE, "HOW", "fast", "The compression of PNG files: fast or best.",
     "`best` makes a file that is about a third smaller and takes a second or two for a million pixels; `fast` "
     "takes some milliseconds. The pixels are the same; other formats ignore the option. `best` needs "
     "libdeflate, and the bytes of the file depend on its version; with `fast` they depend on the picture "
     "alone.",
     compress_words, .store = store_word, .others = "compression level png-compression", FIELD(picture.compress)},
    {"quality", 0, GROUP_PICTURE, "N", "90 of JPEG; WebP without loss", "The quality of JPEG and WebP files, 1 to 100.",
     "A lower number makes a smaller file that is further from the picture. JPEG keeps the colours of every pixel from "
     "90 on, and those of every four below. WebP is lossless without the option and with 100. Other formats ignore "
     "it. The bytes depend on the version of the library that makes them, libjpeg-turbo or libwebp.",
     .store = store_integer, .others = "jpeg-quality webp-quality jpg lossy", FIELD(picture.quality), .min = 1,
     .max = 100},
    {"term", 0, GROUP_PICTURE, "HOW", "auto", "Show the picture in the terminal as well: how, or off.",
     "A single picture without `-o` appears in a terminal that shows pictures, above the line that names its file, "
     "which "
     "is written as always; `-o -` shows it and writes no file. kitty, Ghostty, iTerm2 and WezTerm are known by the "
     "environment; others are asked, for at most half a second. The picture becomes smaller where the window is. With "
     "a word "
     "other than `auto` the picture appears beside any `-o FILE` of 8 bits too. Nothing of this is sent where standard "
     "output is not a terminal, with `--json` or `--quiet`, or for several models. Sixels and blocks need libchafa "
     "(Debian's package `libchafa0`). `docs/terminal.md` says how a terminal is known.",
     term_words_list, .of_file = true, .store = store_word, .single = TAKES_TERM,
     .others = "terminal sixel kitty preview inline", FIELD(picture.term)},
    {"durable", 0, GROUP_PICTURE, NULL, NULL, "Go on only when a picture and its name are on the disk (fsync).",
     "After a loss of power the old picture is there or the new one, whole. Without the option the system writes them "
     "within seconds, and the same holds on most file systems.",
     .of_file = true, .store = store_switch, .others = "fsync sync", FIELD(picture.durable)},
    {"exposure", 0, GROUP_PICTURE, "STOPS", "0; auto for the lights of a glTF file",
     "Make the picture brighter or darker: 1 doubles its light, -1 halves it; or auto.",
     "The light of the model is multiplied by 2 to the power of STOPS before the tone curve and encoding, also with "
     "`--color-mode raw`, in float pictures and in the light terms of `--show`. The background keeps its colour. "
     "`auto`, the "
     "default where the lights of a glTF file (candela, lux) light it, takes the thirds of a stop at which 95 % of the "
     "covered pixels are at most as bright as 0.8, and reports them; `--exposure 0` takes the light as it is.",
     .store = store_exposure, .others = "brightness ev", FIELD(picture.exposure), .min = -100, .max = 100},
    {"tone", 0, GROUP_PICTURE, "CURVE", "auto", "The tone curve: none, reinhard, aces, agx or khronos-neutral.",
     "It follows exposure and precedes encoding. `auto` is `khronos-neutral` for pictures with physical materials, and "
     "`none`, which cuts light off at 1, for all others and with `--color-mode raw`. Float pictures hold the light "
     "itself. "
     "`docs/lighting/tone.md` has the formulas.",
     tone_words, .store = store_word, .others = "tonemap tone-map tonemapping tone-mapping tone-curve view-transform",
     FIELD(draw.tone)},
    {"show", 0, GROUP_PICTURE, "WHAT", "the picture",
     "Show a term of the light, one light, or a surface quantity instead of the picture.",
     "The terms `ambient`, `diffuse`, `specular`, `emission` and `reflection` add up to the picture. "
     "`light:key` is the contribution of the light named key, `light:1` that of the first light. `n.l` and "
     "`n.h` use the first light that has a direction; `n.l:key` and `n.h:key` name another. The other words "
     "show surface quantities. `all` writes the picture, every term and every light as layers of one `.exr`. "
     "`.pfm` and `.exr` store the values unchanged; 8-bit pictures store an encoding of them, without the sRGB "
     "curve. `docs/show.md` has the complete table.",
     show_words, .brief = "one term or quantity: diffuse, normals, depth ...", .store = store_show,
     .others = "unlit pass aov channel layer debug term only", FIELD(picture.show)},

    {"save-scene", 0, GROUP_PICTURE, "FILE", NULL, "Also write a scene file (JSON) that reproduces this picture.",
     "The file stores the result of the command line: the model's path relative to FILE, the camera, all lights "
     "(those of the rig written out), materials, transforms and the picture's options. `lambent FILE` then "
     "writes the same bytes. An existing FILE is replaced. `docs/scene-file.md` describes the format.",
     .kind = VALUE_FILE, .of_file = true, .store = store_text, .others = "export-scene write-scene",
     FIELD(picture.save_scene)},

    {"scene", 0, GROUP_MODEL, "NAME|N", "the file's default",
     "The scene of a glTF file that has several: its name, or its number from 0.", NULL, .store = store_text,
     .others = "scene-name scene-index", FIELD(model.scene)},
    {"variant", 0, GROUP_MODEL, "NAME|N", "none",
     "The variant of a glTF file's materials (KHR_materials_variants): its name, or its number from 0.", NULL,
     .store = store_text, .others = "material-variant skin", FIELD(model.variant)},
    {"animation", 0, GROUP_MODEL, "NAME|N", "none",
     "The animation of a glTF file whose pose is drawn: its name, or its number from 0.",
     "Nodes, weights of morph targets and skins are posed as the animation has them at `--time`.", NULL,
     .store = store_text, .others = "anim clip action", FIELD(model.animation)},
    {"time", 0, GROUP_MODEL, "SECONDS", "0",
     "The moment of `--animation`; of the file's first animation without that option.",
     "Before the first and after the last key, that key's pose is held.", NULL, .store = store_number,
     FIELD(model.time_s), .has_field = offsetof(struct options, model.has_time), .min = -1e9, .max = 1e9,
     .others = "seconds", .loads = true},
    {"lenient", 0, GROUP_MODEL, NULL, NULL, "Read glTF and 3MF files that require unknown extensions, without them.",
     "Without this option such a file is refused (exit 3), since its picture may lack what the extension describes. "
     "Index values that glTF reserves (primitive restart), and XML prefixes that a 3MF file does not declare, are "
     "accepted "
     "as well.",
     .store = store_switch, .others = "force ignore-extensions permissive", FIELD(model.lenient)},

    {"view", 0, GROUP_VIEW, "SIDE", "three-quarter",
     "The side to view from: front, back, left, right, top, bottom, iso or three-quarter.",
     "By default the camera stands 30 degrees to the right of the front and 20 degrees above. The model always "
     "fills 92 % of the picture's tighter side. `--azimuth` and `--elevation` change the angles of a named "
     "side.\n"
     "`render` and `batch` take several sides, at most 16, such as `front,left,iso`: each model is read once and drawn "
     "from each. Without a pattern in `-o` the side follows the model's name: `bunny-front.png`.",
     view_words, .several = "views", .brief = "front, back, left, right, top, bottom or iso", .store = store_word,
     .others = "side sides cameras angle angles orientation front back left right top bottom isometric",
     FIELD(view.side)},
    {"azimuth", 0, GROUP_VIEW, "DEGREES", "30", "The camera's angle around the model; 0 is the front, 90 the right.",
     NULL, .store = store_number, .others = "yaw heading orbit", FIELD(view.azimuth_deg),
     .has_field = offsetof(struct options, view.has_azimuth), .min = -3600, .max = 3600},
    {"elevation", 0, GROUP_VIEW, "DEGREES", "20",
     "The camera's angle above the horizon; 0 is level, 90 straight above.", NULL, .store = store_number,
     .others = "pitch altitude tilt", FIELD(view.elevation_deg),
     .has_field = offsetof(struct options, view.has_elevation), .min = -90, .max = 90},
    {"zoom", 0, GROUP_VIEW, "FACTOR", "1", "Magnification; 2 shows the model twice as large.", NULL,
     .store = store_number, .others = "scale magnify magnification distance", FIELD(view.zoom), .min = 0.001,
     .max = 1000},
    {"fov", 0, GROUP_VIEW, "DEGREES", "30", "The fitted camera's vertical field of view, above 0 and below 180.",
     "A wide angle brings the camera closer, so that near parts of the model look larger beside far ones; the model "
     "fills the "
     "picture as before. `--camera fovy=60` is the same.",
     .store = store_number, .others = "field-of-view view-angle perspective-angle focal-length", .alias = "fovy",
     FIELD(view.fov_deg), .min = FOV_MIN, .max = FOV_MAX},
    {"projection", 0, GROUP_VIEW, "KIND", "perspective", "The projection: perspective or orthographic.", NULL,
     projection_words, .store = store_word, .others = "ortho orthographic perspective parallel",
     FIELD(view.projection)},
    {"up", 0, GROUP_VIEW, "AXIS", "auto", "The model's up axis: x, y, z, -x, -y, -z or auto.",
     "The camera and the lights attached to it follow the axis; the model's coordinates do not change. STL "
     "and 3MF files are read as Z up, as in CAD and 3D printing; other formats as Y up, except terrains that lie in "
     "the plane of x and y. Capitals and a plus (`+Z`) are "
     "accepted.",
     up_words, .brief = "what is up in the file: y, z, -z ...", .store = store_up,
     .others = "up-axis upaxis z-up y-up zup yup axis", FIELD(view.up), .single = TAKES_UP},
    {"rotate", 0, GROUP_VIEW, "AXIS:DEGREES", NULL, "Turn the model about its centre, such as y:30; repeatable.",
     "The axis is x, y or z of the scene; turns are applied in the order given. Lights stay where they are "
     "(except those in the model's frame), and radii refer to the model before the turn. One camera serves every "
     "angle, so that the model does not jump in size or place: that of the model before the turn or, where a turn "
     "about the axis would cut the model, one farther away. All pictures of a sheet share it.",
     .brief = "turn the model: y:30", .store = store_rotation, .others = "r rotation turn spin",
     FIELD(shading.rotations)},
    {"camera", 0, GROUP_VIEW, "KEYS|NAME|N", "fitted",
     "An exact camera: eye=x/y/z,target=x/y/z,fovy=30 and more; or one of the file's, by name or number.",
     "A text without `=` names a camera of the model's file (glTF), or gives its number from 0. Otherwise keys are "
     "separated by commas and use the model's own coordinates: `eye` (required), `target` (default: "
     "the middle of the model), `up` (the model's up axis), `fovy` (the full vertical angle in degrees: 30; alone it "
     "is `--fov`) or "
     "`ortho` (parallel projection: model units from the picture's middle to its top), `near` and `far` (both "
     "or neither; fitted by default). The option cannot be combined with `--view`, `--azimuth`, `--elevation`, "
     "`--zoom`, `--fov` or `--projection`. `--json` reports the camera of any picture in these terms.",
     .kind = VALUE_CAMERA, .store = store_camera, .others = "eye position lookat look-at near far", FIELD(view.camera),
     .min = FOV_MIN, .max = FOV_MAX},

    {"light", 0, GROUP_LIGHTS, "TYPE[:KEYS]", "the rig's",
     "A light: point:position=2r/1r/3r, spot, directional, ambient, hemisphere or none; repeatable.",
     "TYPE is `ambient`, `hemisphere`, `point`, `directional` or `spot`, followed by a colon and keys separated "
     "by commas. These lights replace the default ones (the model's, or the studio's); `+TYPE` adds to them, "
     "and `none` removes all but the ambient light. With `--rig`, the rig's lights stay.\n"
     "Position: `position=x/y/z` is in the model's units or, with r after each number, in radii of the model's "
     "bounding sphere, from its centre (default: `1r/2r/3r`; `1r/-3r/2r` with Z up). `position=x/y/z/0` is a "
     "directional light from "
     "there. `direction=x/y/z` is the direction in which the light travels, and `target=x/y/z` the point at "
     "which it aims (by default a directional light travels along 0/0/-1, and a spot aims at the model's "
     "centre). `frame=world|camera|view|object|object:NAME` selects the coordinate frame: the scene's, the eye's (x "
     "right, y up, looking along -z; a light without a position is at the eye), the eye's axes from the middle of the "
     "scene's box, the model's "
     "before `--rotate`, "
     "or a named object's.\n"
     "Emission: `color` times `intensity` (1) is the diffuse and specular light; `ambient` (0), `diffuse` and "
     "`specular` set each alone. A colour is `#rrggbb`, a name, `r/g/b` (linear) or one number. An ambient "
     "light has `color` or `ambient` (0.2), a hemisphere light `sky` (0.4), `ground` (0.1) and `up`.\n"
     "Falloff: `attenuation=a/b/c` is 1/(a + b d + c d^2), where b and c may carry r: distance in radii "
     "(`1/2.7r/5r`); `range` (also with r) is the distance at which the light ends. A spot's cone has `cutoff` "
     "(half angle in degrees, 45) and `exponent`, or `inner` and `outer` half angles. `name` appears in "
     "reports.\n"
     "`lambent help lights` lists all keys.",
     .kind = VALUE_LIGHT, .brief = "point, spot, directional ... in place of the studio", .store = store_light,
     .others = "l lamp sun spot point directional lighting", FIELD(lighting.lights)},
    {"look", 0, GROUP_LIGHTS, "NAME|FILE", "studio",
     "A named set of options: studio, classic, catalog, technical, or a file of your own.",
     "A look is a file of options, one in a line. Options on the command line override its own; a rig or lights there "
     "replace its "
     "rig and lights. `lambent looks` lists those that are built in, and `lambent looks catalog` prints one to start "
     "from.",
     look_words, .kind = VALUE_FILE, .store = store_text, .others = "preset style theme", FIELD(lighting.look)},
    {"rig", 0, GROUP_LIGHTS, "NAME", "auto",
     "A predefined set of lights: studio, headlight, three-point, lecture, default, file, none or auto.",
     "A named rig replaces the model's own lights. `docs/lighting/lights.md` lists the numbers.", rig_words,
     .brief = "a set of lights: studio, headlight, three-point ...", .store = store_word,
     .others = "lights light-setup studio headlight", FIELD(lighting.rig),
     .has_field = offsetof(struct options, lighting.has_rig)},
    {"ambient", 0, GROUP_LIGHTS, "COLOR", "0", "Ambient light: #rrggbb, r/g/b, a name or one number.", NULL,
     .kind = VALUE_COLOR, .store = store_opaque_color, .others = "ambient-light", FIELD(lighting.ambient)},
    {"show-lights", 0, GROUP_LIGHTS, NULL, NULL,
     "Draw markers at the lights: balls, with cones along the light's direction.",
     "The marker of a directional light stands one and a half radii from the model's centre. Markers glow in "
     "the colours of their lights; the camera is not fitted to them, and markers outside of the "
     "picture are named.",
     .store = store_switch, FIELD(shading.show_lights)},
    {"light-cutoff", 0, GROUP_LIGHTS, "SHARE", NULL, NULL,
     "With more than 16 lights, each part of the picture skips its weakest ones, as long as their greatest "
     "possible sum in a channel stays below this share of the channel's full range. The default is half a step "
     "of an 8-bit channel (0.5/255): no byte is off by more than 1. Lights that contribute exactly nothing "
     "(behind the surface, beyond their range, outside their cone) are always skipped.",
     .words = NULL},
    {"ao", 0, GROUP_LIGHTS, "HOW", NULL, NULL,
     "Light from all around reaches a recess less than an open face. Occlusion dims ambient, hemisphere and "
     "environment "
     "light and the share `occluded` of other lights, of which the studio's lights have one and lights by hand none. "
     "It "
     "needs Phong shading. `docs/lighting/occlusion.md` has the formulas.",
     .others = "ambient-occlusion occlusion ssao gtao hbao no-ao"},
    {"cavity", 0, GROUP_LIGHTS, "HOW", NULL, NULL,
     "Letters, holes, seams and wrinkles become visible: ambient occlusion at a small radius, and the same measure for "
     "ridges. It changes the light that `--ao` dims. `--show ao --ao off --cavity on` shows it alone.",
     .others = "curvature ridges valleys no-cavity"},
    {"ao-radius", 0, GROUP_LIGHTS, "SHARE", .others = "occlusion-radius ssao-radius"},
    {"ao-samples", 0, GROUP_LIGHTS, "N", .others = "occlusion-samples ao-rays ray-count"},
    {"light-scale", 0, GROUP_LIGHTS, "FACTOR", "1", "Multiply the brightness of all lights except `--ambient`.", NULL,
     .store = store_number, .others = "intensity light-intensity light-power", FIELD(lighting.light_scale),
     .has_field = offsetof(struct options, lighting.has_light_scale), .min = 0, .max = 1e6},
    {"material", 0, GROUP_MATERIALS, "NAME|KEYS[@WHERE]", "the model's",
     "A material: gold (see `lambent materials`), or shininess=50,specular=0.5; repeatable.",
     "A name of the classic table, whose colours are sRGB, keys separated by commas, or a name followed by keys "
     "(`gold,shininess=80`). Under the default lights `brass`, `bronze`, `chrome`, `copper`, `gold` and `silver` alone "
     "are "
     "physical metals that mirror the studio. "
     "Fields without a key keep the model's values. The keys are the fields that `lambent help materials` lists "
     "(colours "
     "are `#rrggbb`, a name, `r/g/b` or one number); or `color` (ambient and diffuse) and `specular_color` with "
     "the factors `ka`, `kd`, `ks` and `kr`, which multiply ambient, diffuse, specular and mirrored light (`kr` "
     "multiplies the specular colour, white by default).\n"
     "`@WHERE` limits the option to the objects of that name, else to the parts (OBJ groups, STL solids), else "
     "to the model's materials: `ruby@handle`. Of several options for one surface, the last one wins.",
     .kind = VALUE_MATERIAL, .brief = "gold, ruby ... (lambent materials)", .store = store_material,
     .others = "m mat specular diffuse", FIELD(material.materials)},
    {"color", 0, GROUP_MATERIALS, "COLOR", "the materials' own", "The colour of the model: red, #ff8800 or r/g/b.",
     "It replaces the ambient and diffuse colour of every material, including those of `--material`; highlights keep "
     "theirs. It is short for `--material color=COLOR`, and a colour alone is a material too: "
     "`--material '#ff8800@handle'`. (`--color raw` and `--color srgb` still mean `--color-mode`.)",
     .kind = VALUE_COLOR, .brief = "of the model: red, '#ff8800'", .store = store_opaque_color,
     .others = "c paint tint albedo model-color mesh-color surface-color", FIELD(material.model_color),
     .former = "color-mode"},
    {"back-material", 0, GROUP_MATERIALS, "NAME|KEYS[@OBJECT]", "the front's",
     "The material of back faces, as in `--material`; fields without a key are the front's.", NULL,
     .kind = VALUE_MATERIAL, .store = store_material, FIELD(material.back_materials)},
    {"shininess", 0, GROUP_MATERIALS, "ALPHA", NULL, "The exponent of all highlights: 10 is wide, 1000 sharp.",
     "It replaces the shininess of every material, including those of `--material`.", .store = store_number,
     .others = "gloss glossiness specular-exponent exponent", FIELD(material.shininess),
     .has_field = offsetof(struct options, material.has_shininess), .min = 0, .max = 1e30},
    {"opacity", 0, GROUP_MATERIALS, "SHARE", NULL, "The alpha of all materials: 1 is opaque, 0 is clear.",
     "It replaces the opacity of every material, including those of `--material`; vertex colours may contribute "
     "an alpha as well.",
     .store = store_number, .others = "alpha transparency translucency", FIELD(material.opacity),
     .has_field = offsetof(struct options, material.has_opacity), .min = 0, .max = 1},

    {"shading", 0, GROUP_SHADING, "METHOD", .brief = "flat, gouraud or phong",
     .others = "flat smooth gouraud phong interpolation", .has_field = offsetof(struct options, shading.has_shading)},
    {"reflection", 0, GROUP_SHADING, "MODEL", NULL, reflection_summary,
     .others = "brdf lobe pbr lighting-model reflection-model blinn-phong lambert"},
    {"stage", 0, GROUP_SHADING, "WHERE", "fragment", NULL,
     "Without `--shading`, application and vertex imply gouraud, and fragment implies phong. flat works with "
     "all three, gouraud with application and vertex, phong with fragment. On the CPU all stages of a shading "
     "method give the same bytes.",
     .others = "per-vertex per-pixel per-fragment"},
    {"flat-normal", 0, GROUP_SHADING, "SOURCE", .words = NULL},
    {"viewer", 0, GROUP_SHADING, "KIND", .words = NULL},
    {"match-highlights", 0, GROUP_SHADING, NULL, .words = NULL},
    {"single-scattering", 0, GROUP_SHADING, NULL, NULL, NULL,
     "Rough metals are darker then, as in renderers that leave it out.", .words = NULL},
    {"reference", 0, GROUP_SHADING, "N", NULL, NULL,
     "The picture's environment light is an approximation, the split sum; this is the integral that it stands for, to "
     "compare with. "
     "1024 directions are mostly within 0.5 % of it, 4096 within 0.2 %. The directions are the same at every point "
     "and on every machine. CPU only.",
     .others = "ground-truth importance-samples"},
    {"shadows", 0, GROUP_SHADING, NULL, NULL, NULL,
     "Exact: a ray from every lit point to every light whose key `shadows` is not off. Ambient and hemisphere light "
     "and the environment cast none. A light with a `radius` has soft shadows. `docs/lighting/shadows.md` describes "
     "what decides, and the mistakes that shadows are known for.",
     .others = "shadow cast-shadows raytrace shadow-map"},
    {"ground", 0, GROUP_SHADING, "WHAT", NULL, NULL,
     "Lights cast shadows then, on the ground and on the model. A `shadow` ground is clear but for them, over any "
     "background or "
     "none; the others are lit. It lies across the up axis (`--up`), fades out at a distance, is not seen from below "
     "and "
     "does not count for the camera's fit. It needs Phong shading. `docs/lighting/ground.md` has pictures.",
     .kind = VALUE_COLOR, .store = store_ground, .alone = "shadow", .others = "floor plane shadow-catcher base grid",
     FIELD(draw.ground)},
    {"shadow-terminator", 0, GROUP_SHADING, "SWITCH", .others = "terminator shadow-bias"},
    {"shadow-samples", 0, GROUP_SHADING, "N", NULL, NULL,
     "The share of them that nothing blocks is the share of the light that arrives. Above 48, points in full light or "
     "full shadow get 48 rays. Fewer are faster, and show steps.",
     .others = "soft-shadow-samples light-samples"},
    {"wireframe", 'w', GROUP_SHADING, NULL, NULL, NULL,
     "Edges behind surfaces are left out (`--hidden-lines`), and so are those that cut the polygons of OBJ and PLY "
     "files "
     "into triangles. `--surfaces off` draws the lines alone. Lines are smooth whatever `--samples` says, and keep "
     "their "
     "colour and width: light, exposure, tone and distance do not change them. `docs/edges.md` has pictures.",
     .others = "wire mesh mesh-lines show-edges polygons topology", .loads = true},
    {"wireframe-width", 0, GROUP_SHADING, "PIXELS", .others = "wire-width"},
    {"wireframe-color", 0, GROUP_SHADING, "COLOR", "black", NULL, "An alpha below 1 lets the surfaces through.",
     .kind = VALUE_COLOR, .store = store_color, .others = "wire-color", FIELD(shading.wireframe_color)},
    {"edges", 0, GROUP_SHADING, "KINDS", "none", NULL,
     "`crease`: two faces meet at more than `--edge-angle`, or more than two faces meet; `boundary`: a surface ends; "
     "`silhouette`: one of its two faces is seen from the front and the other from behind. "
     "`--edges all --surfaces off` is a technical drawing.",
     .others = "edge feature-edges outline outlines contour toon lineart line-art", .loads = true},
    {"edge-angle", 0, GROUP_SHADING, "DEGREES", .others = "feature-angle sharp-angle"},
    {"edge-width", 0, GROUP_SHADING, "PIXELS", .others = "outline-width"},
    {"edge-color", 0, GROUP_SHADING, "COLOR", "black", NULL, NULL, .kind = VALUE_COLOR, .store = store_color,
     .others = "outline-color", FIELD(shading.edge_color)},
    {"hidden-lines", 0, GROUP_SHADING, "HOW", NULL, NULL,
     "What is hidden is decided by rays from each edge to the eye: exact, so that no line is broken where it runs "
     "along a "
     "surface. A surface hides what is behind it where its opacity is at least 0.5, and glass hides nothing.",
     .others = "hidden-line dashed see-through xray x-ray"},
    {"surfaces", 0, GROUP_SHADING, "SWITCH", NULL, NULL, "Surfaces that are not drawn hide lines all the same.",
     .others = "faces lines-only no-surfaces hide-surfaces"},
    {"gl1", 0, GROUP_SHADING, NULL, NULL, NULL,
     "For comparison with old programs: vertex colours are clamped to 0...1 before interpolation, the shininess "
     "is at most 128, and the ambient light of a light is attenuated and limited to its cone.",
     .words = NULL},
    {"two-sided", 0, GROUP_SHADING, NULL, NULL, "Light back faces with the reversed normal, whatever the model says.",
     NULL, .store = store_switch, FIELD(shading.two_sided)},
    {"one-sided", 0, GROUP_SHADING, NULL, NULL, "Light back faces like front faces, with the unchanged normal.", NULL,
     .store = store_switch, FIELD(shading.one_sided)},
    {"cull", 0, GROUP_SHADING, "SIDE", "the model's",
     "Omit the back or front faces of all objects: none, back or front.", NULL, cull_words, .store = store_word,
     .others = "culling backface-culling", FIELD(shading.cull),
     .has_field = offsetof(struct options, shading.has_cull)},
    {"normals", 0, GROUP_SHADING, "SOURCE", "file",
     "The source of normals: the file, or computed smooth or facet normals.", NULL, normals_words, .store = store_word,
     .others = "recompute-normals smooth-normals facet-normals", FIELD(shading.normals)},
    {"crease-angle", 0, GROUP_SHADING, "DEGREES", "40", "Computed normals are split at edges sharper than this.", NULL,
     .store = store_number, .others = "smoothing-angle smooth-angle crease autosmooth", FIELD(shading.crease_angle_deg),
     .min = 0, .max = 180, .loads = true},
    {"segments", 0, GROUP_SHADING, "N[xM]", "the shape's own",
     "Segments of a built-in shape: slices around and stacks along, such as 64x32.",
     "Of `--parametric`: along u and along v; N alone is for both. N is 3 to 16384; `lambent shapes` describes the "
     "segments of each shape. The default of M depends on the "
     "shape. gyroid, metaballs and surfaces of `--implicit` have at most 1024 cells and take no M.",
     .store = store_segments, .others = "subdivisions slices stacks tessellation", .max = 16384, .loads = true},
    {"environment", 0, GROUP_SHADING, "IMAGE", "none",
     "The surroundings that shiny surfaces mirror: an image, six faces, sky or studio.",
     "An image is a cross of six squares (4:3 or 3:4) or equirectangular (2:1), in PNG, JPEG, WebP, BMP, "
     "TGA, PPM, PFM, EXR or Radiance (.hdr). Six faces are files separated by commas in OpenGL's order, "
     "`px,nx,py,ny,pz,nz`, all "
     "square and of one size. `sky` and `studio` are built in (`./sky` is a file). Only materials with a "
     "reflectivity show the environment: see `--reflectivity`. `docs/lighting/reflection.md` describes how each "
     "kind surrounds the model.",
     .kind = VALUE_ENVIRONMENT, .store = store_text,
     .others = "e env envmap environment-map hdri hdr ibl sky skybox cubemap", FIELD(shading.environment)},
    {"environment-rotation", 0, GROUP_SHADING, "DEGREES", "0",
     "Turn the environment about the up axis, counter-clockwise from above.", NULL, .store = store_number,
     FIELD(shading.environment_rotation_deg), .min = -3600, .max = 3600},
    {"reflectivity", 0, GROUP_SHADING, "SHARE", "the materials' own",
     "The share of the environment that every material mirrors: 0.5 or r/g/b.", NULL, .store = store_reflectivity,
     .others = "mirror reflective", FIELD(material.reflectivity),
     .has_field = offsetof(struct options, material.has_reflectivity), .max = 1000},

    {"turntable", 0, GROUP_ANIMATION, "N", NULL, "An animation of a full turn of the model, in N frames.",
     "The model turns about its up axis in equal steps, counter-clockwise from above; frame k is the picture of "
     "`--rotate y:` k 360/N. The camera's distance and the exposure are the same in all frames. With a name that ends "
     "in "
     "`.png` or `.webp`, and by default, all frames go into one animated PNG or WebP, which loops for ever; with "
     "`{frame}` in the name each frame is a picture of its own, `-o 'turn/{frame}.png'`, in any format. "
     "`docs/animation.md` has examples.",
     .store = store_integer, .others = "spin turnaround orbit rotate360 animate gif apng", FIELD(animation.turntable),
     .min = 2, .max = 100000},
    {"turntable-light", 0, GROUP_ANIMATION, "WITH", "camera",
     "Whether a turntable's lights stay with the camera or turn with the model: camera or model.",
     "Lights in the frame of an object or the model turn with it in either case.", turntable_light_words,
     .store = store_word, .others = "turntable-lights spin-light", FIELD(animation.turntable_light)},
    {"sweep", 0, GROUP_ANIMATION, "KEY=FROM..TO", NULL,
     "An animation in which a number changes: light.azimuth=0..360, roughness=0..1; repeatable.",
     "KEY is an option whose value is a number (`azimuth`, `elevation`, `zoom`, `exposure`, `opacity`, `ambient`, "
     "`crease-angle`), `rotate.x`, `rotate.y` or `rotate.z`, a key of `--material` (`roughness`, `kd`, also "
     "`roughness@WHERE`), or a number of a light: `light.azimuth`, `light.WHICH.azimuth`, where WHICH is the light's "
     "name "
     "or its number from 1 (`lambent lights`, `--show-lights`), by default the first that has the number. A light's "
     "numbers are its fields (`diffuse`, `range`, `position.x`; "
     "angles in degrees), `intensity`, which multiplies its light, and `azimuth` and `elevation` of where it comes "
     "from, "
     "in its own frame as those of the camera are: 0 is the front, 90 the right. `time` is the time of a glTF file's "
     "animation; without numbers, its whole length.\n"
     "More stops may follow: `light.elevation=10..80..10`. Where a sweep ends as it begins, at a whole turn of an "
     "angle "
     "too, the last frame comes one step before, so that the loop runs through. Several sweeps run together, along "
     "with "
     "`--turntable`. The camera is fitted once: to the first frame, for `azimuth` and `elevation` so that all frames "
     "have "
     "one distance, for `time` to the box of all frames; only `zoom` and `fov` change it.",
     .kind = VALUE_SWEPT, .store = store_texts, .others = "animate vary-over-time light-sweep",
     FIELD(animation.sweeps)},
    {"frames", 0, GROUP_ANIMATION, "N", "36", "The number of frames of `--sweep`.",
     "`--turntable` states its own. For `--sweep time` alone it is by default the animation's length times `--fps`.",
     .store = store_integer, .others = "frame-count", FIELD(animation.frames), .min = 2, .max = 100000},
    {"fps", 0, GROUP_ANIMATION, "N", "24", "Frames a second of an animation, 0.1 to 240.", NULL, .store = store_number,
     .others = "frame-rate framerate speed delay", FIELD(animation.fps), .min = 0.1, .max = 240},

    {"threads", 'j', GROUP_WORK, "N", "one for each processor",
     "The number of threads; the picture does not depend on it.", NULL, .store = store_integer,
     .others = "jobs cores cpus parallel", FIELD(work.threads), .min = 1, .max = 1024, .single = TAKES_THREADS},
    {"isa", 0, GROUP_WORK, "NAME", "auto", "The instruction set: scalar, sse4, avx2, avx512, neon or auto.",
     "All give the same bytes; one that this machine or this build lacks is refused (exit 3).", isa_words,
     .store = store_word, .others = "simd instruction-set", FIELD(work.isa)},
    {"device", 0, GROUP_WORK, "NAME", "auto", "The device that draws: cpu, gl, gles or auto.",
     "OpenGL gives the same picture within a tolerance (`docs/opengl.md`). If it is not available, the error "
     "gives the reason (exit 3), and no other device takes its place. `lambent devices` lists the devices.",
     device_words, .store = store_word, .others = "d gpu cpu backend renderer engine opengl gl", FIELD(work.device)},
    {"gl-device", 0, GROUP_WORK, "N|NAME", "the first usable", "The OpenGL device, by number or part of its name.",
     "`lambent devices` lists the numbers, hardware before software.", .store = store_text, FIELD(work.gl_device)},
    {"texture-filter", 0, GROUP_WORK, "NAME", "exact", "What filters textures with OpenGL: exact or hardware.",
     "Graphics cards round the weights of their filters, mostly to 1/256, and approximate the level of detail: "
     "`hardware` is "
     "faster, and `docs/opengl.md` has its difference. The CPU device is always exact, and refuses `hardware`. Of "
     "`shader` it "
     "is how the printed shaders read textures.",
     texture_filter_words, .store = store_word, .others = "texture-filtering texturefilter",
     FIELD(work.texture_filter)},
    {"repeat", 0, GROUP_WORK, "N", "1", "Draw N frames and report the median time.", NULL, .store = store_integer,
     .others = "iterations benchmark bench", FIELD(work.repeat), .min = 1, .max = 100000},
    {"memory-limit", 0, GROUP_LIMITS, "BYTES", "a quarter",
     "Give up on a model that needs more memory, such as 500M or 2Gi (exit 4).",
     "Reading a model and drawing it may each use this much at once, pictures and decoders included; it is counted "
     "before it is taken. By default it is a quarter of what this process may use: the smallest of the machine's "
     "memory, the limits of its control groups (cgroup v1 and v2) and its own (`ulimit -v`, `ulimit -d`), divided "
     "among the models that are worked on at the same time. `none` takes the limit away. k, M, G and T are powers of "
     "1000; Ki, Mi, Gi and Ti of 1024. For `check` it is what the process that draws a shader may use.",
     .store = store_bytes, .others = "max-memory memory ram", FIELD(limits.memory_limit_bytes), .single = TAKES_MEMORY},
    {"time-limit", 0, GROUP_LIMITS, "SECONDS", "600", "Give up on a model after this time (exit 4); none: never.",
     "The time is that of a clock on the wall, for each model: reading, drawing and writing together. Times the number "
     "of threads (`--threads`), it bounds the processor time as well. A picture ends within half a second of it. In an "
     "animation the default counts for each frame, and a time that is given for all of them.",
     .store = store_seconds, .others = "timeout", FIELD(limits.time_limit_s), .min = 0.001, .max = 1e9,
     .single = TAKES_PICTURE_LIMITS},
    {"triangle-limit", 0, GROUP_LIMITS, "N", "by the files' size", "Give up on a model of more triangles (exit 4).",
     "Lines and points count too, and each object counts the triangles of its mesh. The default is 50 million and 100 "
     "for each byte of the model's files, at most 200 million. k, M and G are powers of 1000.",
     .store = store_count, .others = "max-triangles polygon-limit vertex-limit", FIELD(limits.triangle_limit),
     .max = 2147483647},
    {"object-limit", 0, GROUP_LIMITS, "N", "by the files' size",
     "Give up on a model of more objects, instances included (exit 4).",
     "The default is 100000 and one for each byte of the model's files.", .store = store_count,
     .others = "max-objects instance-limit max-instances node-limit", FIELD(limits.object_limit), .max = 2147483647},
    {"layer-limit", 0, GROUP_LIMITS, "N", "by the files' size",
     "Give up on a picture with more layers over its pixels, on average (exit 4).",
     "A layer is a translucent or masked surface over a pixel. 32 lights that light a point count as one, and so do "
     "32 opaque surfaces behind each other, and the light of an environment on a surface. The default is 40 and one "
     "for each 16384 bytes of the model's files. Pictures of fewer than 65536 pixels count as so large. OpenGL does "
     "not count them.",
     .store = store_count, .others = "max-layers overdraw-limit", FIELD(limits.layer_limit), .max = 2147483647},
    {"expansion-limit", 0, GROUP_LIMITS, "N", "2000",
     "Give up on a model that takes more memory than N times the size of its files, and 500 MB (exit 4).",
     "It bounds what small files unfold to: compressed pictures and meshes, and numbers that a file does not hold. "
     "`--memory-limit` bounds memory whatever the size of the files.",
     .store = store_count, .others = "ratio-limit compression-limit bomb", FIELD(limits.expansion_limit),
     .max = 2147483647, .single = TAKES_PICTURE_LIMITS},
    {"pixel-limit", 0, GROUP_LIMITS, "N", "400M",
     "Refuse to read a picture of more pixels: a texture, an environment (exit 4).",
     "A file's header is looked at before memory is taken. A side has at most 65535 pixels in any case.",
     .store = store_count, .others = "max-pixels texture-limit image-limit", FIELD(limits.pixel_limit),
     .max = 4294836225, .single = TAKES_PICTURE_LIMITS},
    {"file-limit", 0, GROUP_LIMITS, "BYTES", "32G", "Refuse to read a larger file (exit 4).",
     "Each file counts by itself: the model, and what it names.", .store = store_bytes,
     .others = "max-file-size file-size-limit", FIELD(limits.file_limit_bytes), .single = TAKES_PICTURE_LIMITS},
    {"json-depth-limit", 0, GROUP_LIMITS, "N", "256",
     "Refuse JSON whose lists and objects are nested deeper: glTF and scene files (exit 4).", NULL,
     .store = store_integer, .others = "max-depth nesting", FIELD(limits.json_depth_limit), .min = 1, .max = 2000},
    {"files-inside", 0, GROUP_LIMITS, NULL, NULL, "Let a scene file name only files of its own folder.",
     "For scene files from strangers: the models and pictures that one names must lie in its own folder or below "
     "it, wherever links and `..` lead, so that it cannot show other files. The files that a model names (MTL) "
     "lie in the model's folder in any case, and files named on the command line may lie anywhere.",
     .store = store_switch, FIELD(limits.files_inside), .single = TAKES_FILES},
    {"sandbox", 0, GROUP_LIMITS, "MODE", "auto", "Whether the program gives up what reading a file does not need.",
     "With it a file that finds a mistake in a decoder cannot run programs, open sockets, or read other files: only "
     "the folders of the models and those of `--allow-path` are read, besides the system's libraries and fonts. It "
     "can change no file: a small process outside of the sandbox writes the pictures, and nothing but them. The "
     "sandbox is made of Linux's Landlock and a seccomp filter. `auto` "
     "takes what the kernel has; `require` fails where it lacks one of them (exit 3), and lets scene files name only "
     "files of their folder (`--files-inside`) or of `--allow-path`. `-v`, `--json` and `--version` say what holds. "
     "Commands that read models or pictures have it; `check` and OpenGL do not, since drivers need what it takes "
     "away: with `auto` it is off there. A scene file (`.json`) may name files anywhere with `auto`, unless "
     "`--files-inside` or `--allow-path` is given.",
     sandbox_words, .store = store_word, .others = "seccomp landlock jail", FIELD(limits.sandbox),
     .single = TAKES_PICTURE_LIMITS},
    {"allow-path", 0, GROUP_LIMITS, "DIR", NULL, "Let models name files in this folder, or this file; may be repeated.",
     "A model reads files of its own folder alone: for textures in `../textures` give `--allow-path ../textures`. "
     "Scene files with "
     "`--files-inside` and links in a folder of `batch` may lead there too. The sandbox lets this folder be read. "
     "With "
     "`--jobs` it holds the files of jobs, whose models still read their own folders; pages and `view` have no files "
     "of other "
     "folders.",
     .kind = VALUE_FILE, .store = store_path, .others = "allow", FIELD(limits.allow_paths),
     .single = TAKES_PICTURE_LIMITS},

    {"views", 0, GROUP_BATCH, "SIDES", NULL, "Several sides.", NULL, view_words, .store = store_views, .now = "view",
     FIELD(batch.views)},
    {"sizes", 0, GROUP_BATCH, "SIZES", NULL, "Several sizes.", NULL, .store = store_sizes, .now = "size",
     FIELD(batch.sizes), .max = 65535},
    {"files-from", 0, GROUP_BATCH, "FILE", NULL, "Draw the models that FILE names, one on each line; repeatable.",
     "`-` is standard input. Names are those of the current folder, as on the command line; empty lines count for "
     "nothing. `batch` takes `@FILE` for the same.",
     .kind = VALUE_FILE, .store = store_list, .others = "input-list filelist models-from", FIELD(batch.lists),
     .single = TAKES_MANY},
    {"journal", 0, GROUP_BATCH, "FILE", "none; `batch`: lambent.jsonl in the pictures' folder",
     "Write a line of JSON for each picture that is done or has failed.",
     "A line has the model, the picture, the outcome (`class`, `exit`, `error`), the milliseconds of each step, the "
     "triangles, the warnings, the picture's bytes and hash, the files that were read and their hashes, and the key "
     "of `--skip-same`. It is written after the picture is in its place. `none` writes no journal. `docs/batch.md` has "
     "every field.",
     .kind = VALUE_FILE, .store = store_text, .others = "log record", FIELD(batch.journal)},
    {"resume", 0, GROUP_BATCH, NULL, NULL, "Go on where the journal ends: pictures that it has are not drawn again.",
     "Without a journal everything is drawn, so that one command line starts and goes on. Refused where the options of "
     "the picture are not the journal's. Models that were being drawn when a run was killed are drawn first, each in "
     "a process of its own.",
     .store = store_switch, .others = "continue restart", FIELD(batch.resume)},
    {"retry-failed", 0, GROUP_BATCH, "N", "0", "Try a picture that failed again, at most N times.",
     "They are tried at the end of the run, and with `--resume` also those that failed in earlier runs; a line of the "
     "journal counts as one try. What still fails is named at the end.",
     .store = store_integer, .others = "retries retry attempts", FIELD(batch.retry_failed), .max = 1000},
    {"failures-ok", 0, GROUP_BATCH, NULL, NULL, "Exit with 0 although models failed, if each has its outcome.",
     "Open MPI stops all ranks if one exits with another code, and other engines repeat its task. The failures are in "
     "the journal and in the messages. A run that did not reach every model still exits with its code: a wrong "
     "option, a journal that cannot be written, an interrupt.",
     .store = store_switch, .others = "keep-going ignore-failures ignore-errors", FIELD(batch.failures_ok),
     .single = TAKES_MANY},
    {"skip-same", 0, GROUP_BATCH, NULL, NULL, "Draw only what has changed since the journal was written.",
     "A picture is left as it is if it still has the journal's hash, and its key is the journal's: a hash of all files "
     "that reading the model looked for (textures and material libraries too), the options with their defaults, and "
     "the program's version.",
     .store = store_switch, .others = "incremental update changed newer cache", FIELD(batch.skip_same)},
    {"isolate", 0, GROUP_BATCH, NULL, NULL, "Draw each model in a process of its own.",
     "A model that crashes or uses up the memory costs one line of the journal, of the class `crashed`, and the others "
     "go on.",
     .store = store_switch, .others = "process fork sandbox-process", FIELD(batch.isolate), .single = TAKES_MANY},
    {"shard", 0, GROUP_BATCH, "K/N", "1/1",
     "Draw the K-th of N parts of the models (from 1), beside other machines that draw the others.",
     "Which part a model belongs to follows from its path alone: one that is added moves no other. `auto` takes K and "
     "N "
     "from SLURM_ARRAY_TASK_ID or OMPI_COMM_WORLD_RANK and their counts; `auto/N` takes K from them or from "
     "JOB_COMPLETION_INDEX (Kubernetes). Where they leave a doubt, nothing is drawn; without this option they count "
     "for "
     "nothing. The journal and the page of each part have names of their own: `lambent-2-of-4.jsonl` "
     "(`docs/batch.md`), and `lambent journal` sums them up.",
     .store = store_text, .others = "part slice partition split array distribute", FIELD(batch.shard)},
    {"shard-by", 0, GROUP_BATCH, "HOW", "name", "How `--shard` divides the models: by name or list.",
     "With `name` each shard reads all names, which takes a second or two for a million. With `list` it reads the K-th "
     "of N parts of one list (`@FILE`), by its bytes. The models must be in the order of the names of their pictures "
     "(`LC_ALL=C sort`), so that no two pictures can have one name. If the list changes, models move to other shards: "
     "`--resume` is refused then.",
     shard_by_words, .store = store_word, .others = "partition split-by", FIELD(batch.shard_by)},
    {"jobs", 0, GROUP_BATCH, "-", NULL, "`batch`: Take jobs, a line of JSON each, and answer each with a line of JSON.",
     "For servers: one process draws whatever comes until its standard input ends (`docs/worker.md`). A job has an "
     "`id`, a "
     "`model` or its bytes, `options`, and an `output`, without which the picture is part of the answer. Files are "
     "read and "
     "written only below the folders of `--allow-path`. The options of the command line are those of every job, before "
     "its "
     "own. A file or a pipe takes the place of `-`.",
     .kind = VALUE_FILE, .store = store_jobs, .others = "worker server daemon serve", FIELD(batch.jobs)},
    {"ahead", 0, GROUP_BATCH, "N", "twice as many as are drawn at once",
     "How many jobs may wait; then no more lines are read.", NULL, .store = store_integer,
     .others = "queue backlog queue-length", FIELD(batch.ahead), .min = 1, .max = 100000},
    {"line-limit", 0, GROUP_BATCH, "BYTES", "64M",
     "The largest line of `--jobs`; a longer one is an error, and is not kept.",
     "Lines are as long as the models in them: base64 takes four bytes for three. Jobs that wait hold at most twice as "
     "much "
     "of models.",
     .store = store_bytes, .others = "line-length job-limit", FIELD(batch.line_limit_bytes)},
    {"report", 0, GROUP_BATCH, "FILE.html", NULL, "Also write a page of all pictures, failures first.",
     "Thumbnails go to the folder FILE-files beside it. It needs no other file and no network.", .kind = VALUE_FILE,
     .store = store_text, .others = "contact-sheet html gallery page", FIELD(batch.report_page),
     .single = TAKES_REPORT},

    {"json", 0, GROUP_REPORT, NULL, NULL, "Print a report in JSON, one line for each model.",
     "The report goes to standard output, or to standard error when the picture goes to standard output (then "
     "nothing else is written there). It replaces the line with the file's name, and is printed on failure as "
     "well. Its schema is `docs/report.schema.json`. Of `compare` it has the caption of each picture and the words "
     "that draw it.",
     .brief = "print a report for other programs", .store = store_switch, .others = "stats info", FIELD(report.json),
     .single = TAKES_JSON},
    {"dry-run", 0, GROUP_REPORT, NULL, NULL, "Print what would be drawn and written, and write nothing.",
     "Models are read and checked, and so are the options and whether each picture can be written; nothing is drawn. "
     "Printed for each model: the picture with its size and whether it replaces a file, the camera, the device, and "
     "the "
     "options of the command line. With `--json` the report has `planned` in place of `image`. What drawing would "
     "refuse is an error with the same exit code.",
     .store = store_switch, .others = "plan simulate no-write preview what-if check-only", FIELD(report.dry_run)},
    {"verbose", 'v', GROUP_REPORT, NULL, NULL, "Print on standard error what was read and the time of each step.", NULL,
     .store = store_switch, FIELD(report.verbose)},
    {"quiet", 'q', GROUP_REPORT, NULL, NULL, "Print nothing but errors.", NULL, .store = store_switch,
     .others = "silent", FIELD(report.quiet), .single = TAKES_QUIET},

    {"tolerance", 0, GROUP_DIFF, "STEPS", "0",
     "The largest allowed difference of a channel, in steps of 1/255; above it the exit code is 6.", NULL,
     .store = store_number, .others = "threshold epsilon", FIELD(diff.tolerance), .min = 0, .max = 1e9},
    {"gain", 0, GROUP_DIFF, "FACTOR", "16", "The factor that amplifies the picture of the difference.", NULL,
     .store = store_number, .others = "amplify", FIELD(diff.gain), .min = 0.001, .max = 1e6},

    {"check", 0, GROUP_HASH, "FILE", NULL, "Compare with the hashes in FILE; the exit code is 6 if they differ.",
     "Names each model that has changed, that is missing (it is in the file, and not among the models) or that is new. "
     "Without "
     "models on the command line it draws those of the file. If the version or the options of the file are others, it "
     "says so first.",
     .kind = VALUE_FILE, .store = store_text, .others = "verify compare-with against", FIELD(hash.check)},
    {"update", 0, GROUP_HASH, NULL, NULL,
     "With `--check`: write the new hashes to the file, with a sheet of what changed.",
     "The sheet lies beside the file: `pictures-changes.png` for `pictures.hash`, with the old picture, the new one "
     "and "
     "their difference for the first 40 models that changed. A hash cannot be turned back into a picture: the old one "
     "is "
     "shown if `--pictures` kept it.",
     .store = store_switch, .others = "renew accept bless", FIELD(hash.update)},
    {"pictures", 0, GROUP_HASH, "DIR", NULL, "Keep the pictures in this folder, for the sheet of the next `--update`.",
     "Each is a PNG with the name of its model: `DIR/models/koala.obj.png`. Written with `-o` and with `--update`, "
     "read "
     "by "
     "`--update`. It need not be in the repository: a cache of the continuous integration will do.",
     .kind = VALUE_FILE, .store = store_text, .others = "keep cache-dir baseline", FIELD(hash.pictures)},

    {"thumbnail", 0, GROUP_CONVERT, NULL, NULL, "Put a picture of the model into the GLB file.",
     "512x512 pixels, as `lambent MODEL` draws it, in `asset.thumbnail`: an index into `images`, from the draft of "
     "glTF 2.1. "
     "Programs that do not know it ignore it.",
     .store = store_switch, .others = "preview icon", FIELD(convert.thumbnail)},

    {"sheet", 0, GROUP_SHEET, "NAME", "summary",
     "The sheet: summary, terms, stages, light, ambient, frames or surfaces.", NULL, sheet_words, .store = store_word,
     .others = "layout", FIELD(sheet.name)},
    {"title", 0, GROUP_SHEET, "TEXT", NULL, "The title of a sheet, a plot or a figure, in any language; '' for none.",
     "In an SVG text stays text: the viewer has the fonts, writes from right to left where a language does, and reads "
     "it aloud. "
     "A PNG has the letters of the font (`--font`), one after the other: Latin, Greek and Cyrillic with the default "
     "one, Chinese, "
     "Japanese and Korean with a font that has them. Scripts that are written from right to left or join their letters "
     "need an SVG.",
     .store = store_text, .single = TAKES_TITLE, .others = "heading name header", FIELD(captions.title)},
    {"caption", 0, GROUP_SHEET, "TEXT", NULL,
     "The caption of a sheet's next picture, in any language, in place of its own; may be repeated.", NULL,
     .store = store_texts, .others = "captions label labels", FIELD(captions.texts)},
    {"across", 0, GROUP_SHEET, "OPTION[=VALUES]", NULL,
     "A row of pictures: shading, or shininess=10,50,1000; a second --across makes columns.",
     "OPTION is one of the options above without its dashes. Values are separated by commas, or by semicolons "
     "if they contain commas, as those of `light` and `material` do "
     "(`light=point;directional:color=red,frame=camera`). The default values are the words of the option; for "
     "`shininess` 10, 50 and 1000, for `light` one light of each type, for `show`, also called `term`, the five "
     "terms. If the option is given twice, the first makes the rows of a grid and the second its columns. "
     "`mistake=A,B`, or `mistake` for all that the scene can show, draws shaders with known mistakes beside the right "
     "one, by "
     "OpenGL, with their differences (`lambent shader --mistake list`).",
     .kind = VALUE_VARIED, .store = store_across, .others = "vary grid columns rows", FIELD(sheet.across)},

    {"to", 0, GROUP_PLOT, "X", "fitted", "The right end of the horizontal axis: a distance, or degrees.", NULL,
     .store = store_number, FIELD(plot.to), .min = 1e-6, .max = 1e9},

    {"vertex", 0, GROUP_CHECK, "FILE", NULL, "The vertex shader that belongs to the fragment shader.",
     "Without it a correct one is generated, which recognises varyings by name and type (`docs/check.md`).",
     .kind = VALUE_FILE, .store = store_text, FIELD(check.vertex)},
    {"contract", 0, GROUP_CHECK, "NAME", "auto", "The names that the shaders use: a contract's name, or its file.",
     "`auto` recognises the built-in contracts by their names, and else the use of each input; `--list` prints them. A "
     "file "
     "of your own is JSON (`docs/check/contract-file.md`).",
     contract_words, .kind = VALUE_FILE, .store = store_text, FIELD(check.contract)},
    {"light-frame", 0, GROUP_CHECK, "SPACE", "the contract's", "The space of light positions: object or camera.", NULL,
     light_frame_words, .store = store_word, FIELD(check.light_frame)},
    {"highlight", 0, GROUP_CHECK, "NAME", "the contract's", "The expected highlight: phong or blinn-phong.", NULL,
     highlight_words, .store = store_word, FIELD(check.highlight)},
    {"terms", 0, GROUP_CHECK, "NAMES", "as declared",
     "The terms that the exercise asks for: all, or some of ambient,diffuse,specular.",
     "By default a term is asked for if the shaders declare one of its names: without a specular colour no highlight "
     "is expected. A colour that is asked for and not declared is white.",
     term_words, .store = store_words, FIELD(check.terms)},
    {"scenes", 0, GROUP_CHECK, "NAMES", "all", "The scenes to use, separated by commas: all,gate,near.", NULL,
     .store = store_text, FIELD(check.scenes)},
    {"stop-after", 0, GROUP_CHECK, "SECONDS", "10", "The limit of a shader's processor time, for all scenes.",
     "It is the time of all threads together, so other load on the machine does not count; elapsed time may be 20 "
     "times as long.",
     .store = store_number, FIELD(check.stop_after_s), .min = 0.1, .max = 1e6},
    {"search-limit", 0, GROUP_CHECK, "PICTURES", "10000",
     "The search for mistakes ends after so many pictures of them and of sets of them.",
     "Where no set is found, the report says how many were tried, and whether the search ended at this limit.",
     .store = store_integer, .others = "effort budget tries", FIELD(check.search_limit), .min = 1, .max = 1000000000},
    {"class", 0, GROUP_CHECK, "FOLDER", NULL, "Check every submission in a folder.",
     "A submission is a sub-folder with one fragment shader, at most one vertex shader, and whatever else; elsewhere a "
     "fragment shader and the vertex shader of the same name beside it. With `-o FOLDER/` there is a page for the "
     "whole class, `index.html`, and a sheet of each submission.",
     .kind = VALUE_FILE, .store = store_text, FIELD(check.class_folder)},
    {"csv", 0, GROUP_CHECK, "FILE", NULL, "A line for each shader: points and mistakes.", NULL, .kind = VALUE_FILE,
     .store = store_text, .others = "grades marks table", FIELD(check.csv)},
    {"moodle", 0, GROUP_CHECK, "FILE", NULL, "Grades as a worksheet of Moodle (CSV).",
     "Folders that Moodle names after their participants are recognised.", .kind = VALUE_FILE, .store = store_text,
     FIELD(check.moodle)},
    {"gradescope", 0, GROUP_CHECK, "FILE", NULL, "One submission's results.json for Gradescope.", NULL,
     .kind = VALUE_FILE, .store = store_text, FIELD(check.gradescope)},
    {"submitty", 0, GROUP_CHECK, "FILE", NULL, "One submission's result for Submitty.",
     "The file is its validation_results.json.", .kind = VALUE_FILE, .store = store_text, FIELD(check.submitty)},
    {"write-contract", 0, GROUP_CHECK, "FILE", NULL, "Write a commented contract for the shaders.",
     "It is the contract that was recognised, or the roles that the inputs have by their use: correct it, and check "
     "with `--contract FILE` (`docs/check/contract-file.md`).",
     .kind = VALUE_FILE, .store = store_text, FIELD(check.write_contract)},
    {"list", 0, GROUP_CHECK, NULL, NULL, "Print the contracts, the scenes and the known mistakes.", NULL,
     .store = store_switch, FIELD(check.list)},
    {"glsl", 0, GROUP_SHADER, "VERSION", "330", "The version of GLSL: 330, 120 or 300es.",
     "The form of a shader's first line, \"300 es\", works as well.", glsl_words, .store = store_glsl,
     .others = "glsl-version shader-version", FIELD(shader.glsl)},
    {"host", 0, GROUP_SHADER, "LANGUAGE", NULL, "Also print code that sets all inputs of the shaders: c.",
     "The code compiles the sources, describes the vertex layout to OpenGL and sets every uniform to its value "
     "in this picture, with OpenGL's own calls only. With `-o NAME` it is written to `NAME.c`.",
     host_words, .store = store_word, FIELD(shader.host)},
    {"products", 0, GROUP_SHADER, NULL, NULL,
     "Pass the products ka La, kd Ld and ks Ls as uniforms, as in the lectures.", NULL, .store = store_switch,
     FIELD(shader.products)},
    {"lights-in", 0, GROUP_SHADER, "PLACE", "auto", "Where the shaders store the lights: array, block or texture.",
     "None has a fixed maximum number of lights; OpenGL allows the fewest in an array and the most in a "
     "texture.",
     lights_in_words, .store = store_word, FIELD(shader.lights_in)},
    {"style", 0, GROUP_SHADER, "STYLE", "full", "How the shaders are written: full or lecture.",
     "The lecture style has the names of the blackboard: N, L, V, R, H, ka, kd, ks. Its uniforms and its picture are "
     "those of the full style, for lambert, phong, blinn-phong and kajiya-kay with any lights and any shading; "
     "textures and other reflection models are refused. With `--stage application` a C function that lights the "
     "vertices comes with the shaders. See `docs/teaching.md`.",
     style_words, .store = store_word, FIELD(shader.style)},
    {"mistake", 0, GROUP_SHADER, "NAME", NULL,
     "Introduce a known mistake into shaders of the lecture style; `list` lists them.",
     "For the exercise \"find the mistake\": `lambent check` names it. `lambent compare MODEL --across mistake=A,B` "
     "shows what "
     "mistakes look like. `--mistake list --json` prints the list for programs.",
     .store = store_text, .others = "error bug fault wrong", FIELD(shader.mistake)},
    {"parametric", 0, GROUP_SHAPE, "FORMULAS", NULL,
     "A surface over u and v: 'x = ...; y = ...; z = ...', with definitions before them.",
     "`a = 2; x = (a + cos(v))*cos(u); y = (a + cos(v))*sin(u); z = sin(v)` is a torus. Formulas have `+ - * / ^`, "
     "parentheses, `pi`, `tau`, `e`, and the functions sin cos tan asin acos atan atan2 sinh cosh tanh exp log sqrt "
     "cbrt "
     "abs sign floor mod min max hypot pow. Normals come from symbolic derivatives. z is up, as in books, unless "
     "`--up` "
     "says otherwise. `docs/shapes.md` describes the language and has examples.",
     .store = store_text, .others = "formula formulas surface equation", FIELD(shape.parametric), .loads = true},
    {"u", 0, GROUP_SHAPE, "FROM..TO", "0..2pi", "The range of u, two constant expressions.", NULL, .store = store_text,
     .others = "u-range", FIELD(shape.u_range), .loads = true},
    {"v", 0, GROUP_SHAPE, "FROM..TO", "0..2pi", "The range of v, two constant expressions.", NULL, .store = store_text,
     .others = "v-range", FIELD(shape.v_range), .loads = true},
    {"implicit", 0, GROUP_SHAPE, "FORMULA", NULL,
     "The surface where an expression of x, y and z is zero: 'x^2+y^2+z^2-1'.",
     "The expression is negative inside; `x^2+y^2+z^2 = 1` is the same surface. Definitions stand before it, `a = 2; "
     "(sqrt(x^2+y^2)-a)^2 + z^2 - 1`, in the language of `--parametric`. Normals are the symbolic gradient. "
     "`--segments` "
     "is the number of cells along the longest side of the box around the surface, 96 by default.",
     .store = store_text, .others = "implicit-surface isosurface level-set marching-cubes sdf", FIELD(shape.implicit),
     .loads = true},
    {"x", 0, GROUP_SHAPE, "FROM..TO", "around the surface", "The range of x that an implicit surface is cut at.",
     "Two constant expressions. By default the surface is searched for in -4..4, and in -16..16 if it is not closed in "
     "-4..4 and closed there.",
     .store = store_text, .others = "x-range box bounds", FIELD(shape.x_range), .loads = true},
    {"y", 0, GROUP_SHAPE, "FROM..TO", "around the surface", "The range of y.", NULL, .store = store_text,
     .others = "y-range", FIELD(shape.y_range), .loads = true},
    {"z", 0, GROUP_SHAPE, "FROM..TO", "around the surface", "The range of z.", NULL, .store = store_text,
     .others = "z-range", FIELD(shape.z_range), .loads = true},
    {"flip", 0, GROUP_SHAPE, NULL, NULL, "Turn the surface's front and back round.",
     "The front is the side to which the derivative by u, cross the derivative by v, points, or the gradient of an "
     "implicit surface; with this option the other one.",
     .store = store_switch, .others = "flip-normals invert-normals", FIELD(shading.flip), .loads = true},
    {"object", 0, GROUP_SHADER, "N", "all", "Only this object of the scene, counted from 0.",
     "One pair of shaders serves a whole scene, unless only some of its objects are two-sided, or only some "
     "have tangents for Kajiya-Kay.",
     .store = store_integer, FIELD(shader.object), .has_field = offsetof(struct options, shader.has_object), .min = 0,
     .max = 1e9},

    {"port", 0, GROUP_VIEWER, "N", "any that is free", "The port of 127.0.0.1 that the viewer listens on.", NULL,
     .store = store_integer, FIELD(viewer.port), .min = 1, .max = 65535},
    {"idle", 0, GROUP_VIEWER, "MINUTES", "30", "End when no page has been open for so long.", NULL,
     .store = store_number, .others = "idle-timeout", FIELD(viewer.idle_minutes),
     .has_field = offsetof(struct options, viewer.has_idle), .min = 0.001, .max = 1e6},
    {"no-open", 0, GROUP_VIEWER, NULL, NULL, "Print the address, and open no browser.",
     "Without a display none is opened either.", .store = store_switch, .others = "no-browser headless",
     FIELD(viewer.no_open)},

    {"font", 0, GROUP_CAPTIONS, "FILE", "the system's", "The font of captions: a TrueType or OpenType file.",
     "By default the environment's `LAMBENT_FONT` names the font, else it is the first that is installed of "
     "DejaVu Sans, Liberation Sans, Noto Sans, FreeSans and Roboto, where Debian puts them. FreeType draws the "
     "letters, which may differ by a few shades between its versions; the pictures on the sheet never do. An "
     "SVG names DejaVu Sans, and its viewer selects the font.",
     .kind = VALUE_FILE, .store = store_text, .others = "typeface", FIELD(captions.font)},
    {"no-captions", 0, GROUP_CAPTIONS, NULL, NULL, "Draw without text; no font is needed.", NULL, .store = store_switch,
     .others = "no-text no-labels", FIELD(captions.no_captions)},

    {"version", 0, GROUP_ABOUT, NULL, NULL, "Print the version and the build information.", NULL, .store = store_switch,
     .others = "V", FIELD(report.version)},
    {"help", 'h', GROUP_ABOUT, NULL, NULL, "Print all of this help; -h prints what most people need.",
     "`lambent help TOPIC` explains a subject, a command or an option.", .store = store_switch, .others = "? usage",
     FIELD(report.help), .letter_field = offsetof(struct options, report.brief_help)},
};
static char *append(char *to, const char *text)
{
    while (*text)
        *to++ = *text++;
    return to;
}

// Runs at every start of the program, so it avoids printf.
void option_table_fill(void)
{
    option_settings_fill(option_table);
    char *end = append(reflection_summary, "The reflection model:");
    for (int i = 0; i < LAM_REFLECTION_COUNT; i++) {
        const lam_reflection_info *model = lam_reflection_describe((lam_reflection)i);
        if (i > LAM_REFLECTION_AUTO && end - reflection_summary < (int)(sizeof reflection_summary - 60))
            end = append(append(end, i > LAM_REFLECTION_NONE ? ", " : " "), model->word);
    }
    append(end, " or auto.");
    end = append(output_summary, "Write to FILE (");
    const char *name;
    for (int i = 0; (name = lam_image_format_name(i)); i++)
        if (lam_image_format_written(i) && end - output_summary < (int)sizeof output_summary - 100)
            end = append(append(end, i ? ", ." : "."), name);
    append(end, "; or .html), to the folder FILE/, or to standard output (-).");
    for (int i = 0; lam_check_contract_shipped(i) && i + 2 < CONTRACT_WORDS_MAX; i++)
        contract_words[i + 1].name = lam_check_contract_shipped(i);
}
