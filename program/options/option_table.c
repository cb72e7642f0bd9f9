// option_table.c: defines the table of all options. The help, the man page, the completions and docs/command-line.md
// are generated from it (tools/help).
//
// The file is longer than 600 lines because it contains one row for each option, in the order of the help.
#include "options.h"

#include <lambent/light.h>
#include <lambent/shader.h>

// The limits of --fov in degrees, which also apply to --camera if its only key is fovy.
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
    [GROUP_PRINT] = "Checks for 3D printing (info)",
    [GROUP_SETTINGS] = "Settings (render, explain, shape, config)",
    [GROUP_PLOT] = "Plots (plot)",
    [GROUP_CAPTIONS] = "Captions (compare, sheet, plot, materials, check, explain)",
    [GROUP_ABOUT] = "About",
    [GROUP_LIGHTS] = "Lights",
    [GROUP_MATERIALS] = "Materials",
    [GROUP_SHEET] = "Sheets (compare)",
    [GROUP_CONTACT] = "Contact sheets (sheet)",
    [GROUP_CHECK] = "Checking shaders (check)",
    [GROUP_SHADER] = "Shaders (shader)",
    [GROUP_SHAPE] = "Formulas (shape, explain)",
    [GROUP_FIGURE] = "Figures (explain)",
    [GROUP_EXERCISES] = "Exercises (exercises)",
    [GROUP_VIEWER] = "Viewer (view)",
};

static const struct choice sample_words[] = {{"1", 1, NULL}, {"2", 2, NULL},   {"4", 4, NULL},
                                             {"8", 8, NULL}, {"16", 16, NULL}, {NULL, 0, NULL}};

// The contracts in the folder classroom/check/contracts.
static const struct choice contract_words[] = {
    {"auto", 0, NULL},    {"lambent", 0, NULL},         {"pittsburgh", 0, NULL}, {"oregon", 0, NULL},
    {"nyu", 0, NULL},     {"learnopengl", 0, NULL},     {"angel", 0, NULL},      {"mdn", 0, NULL},
    {"threejs", 0, NULL}, {"learnopengl-pbr", 0, NULL}, {"gltf", 0, NULL},       {"webglfundamentals", 0, NULL},
    {"feup", 0, NULL},    {"stthomas", 0, NULL},        {"chile", 0, NULL},      {"glsl120", 0, NULL},
    {NULL, 0, NULL}};

static const struct choice sandbox_words[] = {{"auto", SANDBOX_AUTO, "use every method that the kernel supports"},
                                              {"require", SANDBOX_REQUIRE, "use all methods, or fail"},
                                              {"off", SANDBOX_OFF, "use no sandbox"},
                                              {NULL, 0, NULL}};

static const struct choice shard_by_words[] = {
    {"name", SHARD_BY_NAME,
     "by the hash of each model's name, so that adding a model does not move other models to another shard"},
    {"list", SHARD_BY_LIST, "into consecutive blocks of one sorted list, so that each shard reads only its own models"},
    {NULL, 0, NULL}};
static const struct choice light_frame_words[] = {
    {"object", LAM_FRAME_OBJECT,
     "object space; Lambent transforms light positions and vertices by the same model-view matrix"},
    {"camera", LAM_FRAME_CAMERA, "eye space; Lambent does not transform light positions"},
    {NULL, 0, NULL}};

static const struct choice highlight_words[] = {
    {"phong", LAM_REFLECTION_PHONG, "r.v"}, {"blinn-phong", LAM_REFLECTION_BLINN_PHONG, "n.h"}, {NULL, 0, NULL}};

// Bits of lam_check_term (lambent/check.h).
static const struct choice term_words[] = {
    {"all", 7, NULL}, {"ambient", 1, NULL}, {"diffuse", 2, NULL}, {"specular", 4, NULL}, {NULL, 0, NULL}};

static const struct choice compress_words[] = {
    {"fast", LAM_COMPRESS_FAST, "compresses a million pixels in a few milliseconds"},
    {"best", LAM_COMPRESS_BEST, "makes the file about a third smaller, but takes a second or two for a million pixels"},
    {NULL, 0, NULL}};

static const struct choice term_words_list[] = {
    {"auto", TERM_AUTO, "kitty, iterm2 or sixel, if the terminal supports one of them and `-o` names no file"},
    {"kitty", TERM_KITTY, "sends the PNG file, for kitty, Ghostty and Konsole"},
    {"iterm2", TERM_ITERM2, "sends the PNG file, for iTerm2 and WezTerm"},
    {"sixel", TERM_SIXEL, "sends 256 colours, for xterm, foot and mlterm; needs libchafa"},
    {"blocks", TERM_BLOCKS, "draws coloured characters, on any terminal; needs libchafa"},
    {"off", TERM_OFF, "shows no picture"},
    {NULL, 0, NULL}};

static const struct choice color_mode_words[] = {
    {"srgb", LAM_COLOR_SRGB,
     "Lambent decodes the colours of files, computes lighting in linear light and encodes the picture"},
    {"raw", LAM_COLOR_RAW, "Lambent converts no colours; the file stores the computed light unchanged"},
    {NULL, 0, NULL}};

static const struct choice glsl_words[] = {
    {"330", LAM_GLSL_330, "OpenGL 3.3"},
    {"120", LAM_GLSL_120, "OpenGL 2.1: uses `attribute` and `varying`; has no uniform blocks and no `flat` inputs"},
    {"300es", LAM_GLSL_300_ES, "OpenGL ES 3.0, WebGL 2"},
    {NULL, 0, NULL}};

static const struct choice style_words[] = {
    {"full", LAM_SHADER_STYLE_FULL, "the library's equations, for every feature"},
    {"lecture", LAM_SHADER_STYLE_LECTURE, "plain code, as in a lecture"},
    {NULL, 0, NULL}};

static const struct choice lights_in_words[] = {
    {"auto", LAM_SHADER_LIGHTS_AUTO, "an array in GLSL 120 and in the lecture style, otherwise a block"},
    {"array", LAM_SHADER_LIGHTS_ARRAY, "plain uniforms, set one by one: lights[0].position"},
    {"block", LAM_SHADER_LIGHTS_BLOCK, "uniform blocks in the std140 layout"},
    {"texture", LAM_SHADER_LIGHTS_TEXTURE, "floating-point textures, for thousands of lights"},
    {NULL, 0, NULL}};

static const struct choice host_words[] = {{"c", 1, NULL}, {NULL, 0, NULL}};

static const struct choice view_words[] = {
    {"three-quarter", LAM_SIDE_THREE_QUARTER, "30 degrees to the right of the front, 20 degrees above the horizon"},
    {"front", LAM_SIDE_FRONT, "from the front (+Z with Y up), level"},
    {"back", LAM_SIDE_BACK, "from behind, level"},
    {"left", LAM_SIDE_LEFT, "from the left (-X), level"},
    {"right", LAM_SIDE_RIGHT, "from the right (+X), level"},
    {"top", LAM_SIDE_TOP, "from above"},
    {"bottom", LAM_SIDE_BOTTOM, "from below"},
    {"iso", LAM_SIDE_ISO, "isometric: 45 degrees to the right of the front, 35.26 degrees above the horizon"},
    {NULL, 0, NULL}};

static const struct choice projection_words[] = {{"perspective", 0, "a vertical field of view of 30 degrees (`--fov`)"},
                                                 {"orthographic", 1, "parallel, as in technical drawings"},
                                                 {NULL, 0, NULL}};

static const struct choice up_words[] = {
    {"auto", LAM_UP_AUTO, "z for STL and 3MF, y for other formats; a scan that lies is turned upright"},
    {"x", LAM_UP_X, NULL},
    {"y", LAM_UP_Y, "the model's front is +Z"},
    {"z", LAM_UP_Z, "the model's front is -Y"},
    {"-x", LAM_UP_NEGATIVE_X, NULL},
    {"-y", LAM_UP_NEGATIVE_Y, "like y, upside down"},
    {"-z", LAM_UP_NEGATIVE_Z, "like z, upside down"},
    {"file", LAM_UP_FILE, "like auto, but nothing is turned"},
    {NULL, 0, NULL}};

// Filled by option_table_fill.
static char reflection_summary[400], output_summary[200];

static const struct choice tone_words[] = {
    {"auto", LAM_TONE_AUTO,
     "khronos-neutral for physical materials, contrast for light grey scans, figures and terrains, soft for other "
     "models that the studio lights, otherwise none"},
    {"none", LAM_TONE_NONE, "no curve: each channel is clipped at 1"},
    {"reinhard", LAM_TONE_REINHARD, "x / (1 + x) for each channel"},
    {"aces", LAM_TONE_ACES, "film-like contrast (Hill's fit of ACES)"},
    {"agx", LAM_TONE_AGX, "soft contrast; bright colours fade to white"},
    {"khronos-neutral", LAM_TONE_KHRONOS_NEUTRAL, "unchanged colours, compressed highlights"},
    {"contrast", LAM_TONE_CONTRAST, "0.4 (x / 0.4)^2 for each channel"},
    {"soft", LAM_TONE_SOFT, "light above 0.85 is compressed, for each channel"},
    {NULL, 0, NULL}};

static const struct choice figure_words[] = {
    {"vectors", FIGURE_VECTORS, "the vectors from the side"},
    {"beam", FIGURE_BEAM, "the area that a beam of the light covers"},
    {"footprint", FIGURE_FOOTPRINT, "the texels that the pixel covers, and the probes of the filter"},
    {NULL, 0, NULL}};

static const struct choice arrange_words[] = {{"row", 0, "side by side, all on one plane"},
                                              {"grid", 1, "in rows and columns"},
                                              {"as-is", 2, "at the coordinates of their files"},
                                              {NULL, 0, NULL}};

static const struct choice captions_words[] = {{"full", CAPTIONS_FULL, "with the options of each picture"},
                                               {"plain", CAPTIONS_PLAIN, "only the captions, for slides"},
                                               {NULL, 0, NULL}};

static const struct choice look_words[] = {
    {"studio", 0, "the default"},
    {"classic", 1, "the former studio, with directional lights and without occlusion"},
    {"catalog", 2, "the studio, a ground plane with a soft shadow, and panes as glass, for web pages"},
    {"technical", 3, "feature edges over pale, flat-shaded faces, for print"},
    {NULL, 0, NULL}};

static const struct choice rig_words[] = {
    {"auto", LAM_RIG_AUTO,
     "the model's own lights; if there are none, the studio (for physical materials, the studio environment)"},
    {"none", RIG_DARK, "only ambient light"},
    {"default", RIG_DEFAULT, "the studio instead of the model's own lights"},
    {"file", LAM_RIG_NONE, "only the model's own lights"},
    {"studio", LAM_RIG_STUDIO, "key, fill and rim lights fixed to the camera, with sky and ground light"},
    {"headlight", LAM_RIG_HEADLIGHT, "one light from the eye"},
    {"three-point", LAM_RIG_THREE_POINT, "key, fill and back lights as in portrait photography, fixed to the camera"},
    {"lecture", LAM_RIG_LECTURE, "a point light at 1r/2r/3r (ambient 0.1, diffuse 1, specular 1, attenuation 1/0/0)"},
    {NULL, 0, NULL}};

static const struct choice turntable_light_words[] = {
    {"camera", TURNTABLE_LIGHT_CAMERA, "lights stay fixed in the picture while the model turns"},
    {"model", TURNTABLE_LIGHT_MODEL, "lights and environment turn with the model, as if the camera circled the model"},
    {NULL, 0, NULL}};

static const struct choice device_words[] = {
    {"auto", DEVICE_AUTO, "OpenGL if `--gl-device` names a device, otherwise the CPU"},
    {"cpu", DEVICE_CPU, "the processor, which draws identical pictures on every machine"},
    {"gl", DEVICE_GL, "OpenGL 3.3"},
    {"gles", DEVICE_GLES, "OpenGL ES 3.0, as in WebGL 2"},
    {NULL, 0, NULL}};

static const struct choice texture_filter_words[] = {
    {"exact", TEXTURE_FILTER_EXACT,
     "the shader filters the textures; the picture differs from the CPU device's picture by at most 1/255"},
    {"hardware", TEXTURE_FILTER_HARDWARE, "the graphics card filters the textures; this is faster and less exact"},
    {NULL, 0, NULL}};

static const struct choice cull_words[] = {{"none", LAM_CULL_NONE, "draw both sides"},
                                           {"back", LAM_CULL_BACK, NULL},
                                           {"front", LAM_CULL_FRONT, NULL},
                                           {NULL, 0, NULL}};

static const struct choice back_face_words[] = {{"two-sided", 0, "lit with the reversed normal"},
                                                {"one-sided", 1, "lit like front faces, with the unchanged normal"},
                                                {NULL, 0, NULL}};

static const struct choice normals_words[] = {
    {"file", LAM_NORMALS_FILE, "the file's normals, or smooth normals if the file contains none"},
    {"smooth", LAM_NORMALS_SMOOTH, "computed smooth normals instead of the file's normals"},
    {"facet", LAM_NORMALS_FACET, "one normal for each triangle"},
    {NULL, 0, NULL}};

static const struct choice sheet_words[] = {
    {"summary", SHEET_SUMMARY,
     "flat, Gouraud and Phong shading, a reflection of the surroundings (the sky, unless you give --reflection-map), "
     "and "
     "an anisotropic highlight"},
    {"terms", SHEET_TERMS,
     "ambient, diffuse and specular alone; all terms together at shininess 50, at shininess 1000, and at shininess "
     "1000 with flat shading"},
    {"stages", SHEET_STAGES, "lighting per vertex and per fragment, with the brightest highlight enlarged"},
    {"light", SHEET_LIGHT, "the model in its own colours and in orange, each under white light and under green light"},
    {"ambient", SHEET_AMBIENT,
     "white ambient and white diffuse light; red ambient and white diffuse light; red ambient and red diffuse light"},
    {"frames", SHEET_FRAMES,
     "one light in the world frame, the camera frame and the model frame, each before and after a rotation"},
    {"surfaces", SHEET_SURFACES, "a specular, a diffuse and a translucent surface"},
    {"filters", SHEET_FILTERS, "the model's textures with nearest, bilinear, trilinear and anisotropic filters"},
    {"truth", SHEET_TRUTH,
     "local lighting, with shadows, with ambient occlusion, and with one, two and eight bounces of light"},
    {NULL, 0, NULL}};

static const struct choice isa_words[] = {
    {"auto", LAM_ISA_AUTO, "the widest instruction set that this machine supports"},
    {"scalar", LAM_ISA_SCALAR, "plain C, without SIMD instructions"},
    {"plain", LAM_ISA_SCALAR, NULL},
    {"sse4", LAM_ISA_SSE4, "4 lanes"},
    {"avx2", LAM_ISA_AVX2, "8 lanes"},
    {"avx512", LAM_ISA_AVX512, "16 lanes"},
    {"neon", LAM_ISA_NEON, "4 lanes"},
    {"wasm", LAM_ISA_WASM, "WebAssembly's SIMD128, 4 lanes"},
    {NULL, 0, NULL}};

struct option option_table[OPTIONS_MAX] = {
    {"output", 'o', GROUP_PICTURE, "FILE", "MODEL.png", output_summary,
     "The extension selects the format; `lambent formats` lists the formats. `-` writes a PNG to standard output. If "
     "the name of a file, pipe or device has no known extension, Lambent writes a PNG too. Without `-o`, Lambent "
     "writes `MODEL.png` to the current folder. If the model comes from standard input, Lambent writes to standard "
     "output if that is a file or a pipe, otherwise to `model.png`. Without `-o`, "
     "Lambent never overwrites a file that another program created. `-o pictures/` (with a slash at the end) writes to "
     "the folder `pictures`, and creates this folder if it is missing. Every command that writes files accepts a "
     "folder in this form. `--out` is an alias of `--output`.\nA file name may contain placeholders in braces: `-o "
     "'thumbs/{dir}/{stem}-{view}.png'`. Lambent replaces the placeholders for each model. `{stem}` is the model's "
     "file name without the extension, `{ext}` is the extension, and `{dir}` is the model's folder (without `..` or a "
     "leading slash). `{view}` is the value of `--view` (the number of a direction, from 0), `{azimuth}` is the "
     "camera's angle in degrees, and `{size}` is the size in pixels (`256` or `256x128`). With "
     "placeholders, Lambent creates missing folders and replaces existing files. If the pictures of two models would "
     "have the same file name, Lambent reports an error before it starts. To write a literal brace, use `{{` or "
     "`}}`.\nWith the extension `.html`, Lambent writes one file that contains the picture and the model. Open the "
     "file in a browser to turn the model and change every option. The page works offline (`docs/web.md`). This format "
     "requires the page built by `make web`.",
     .kind = VALUE_FILE, .brief = "FILE.png, .jpg, .webp, .exr ...; or a FOLDER/", .of_file = true, .store = store_text,
     .alias = "out", .others = "file export directory folder f",
     .also = "outfile out-file save write out-dir=*/ output-dir=*/ outdir=*/ output-folder=*/ format={stem}.* "
             "overwrite=- force-overwrite=-",
     FIELD(picture.output), .single = TAKES_OUTPUT, .not_in = IN_LOOK | IN_JOB | IN_KEY | IN_PAGE},
    {"size", 's', GROUP_PICTURE, "W[xH]", "1024", "The picture's size in pixels: 800, 1920x1080, or a list of sizes.",
     "`render` and `batch` accept up to 16 sizes, such as `1024,256x128`. These commands read each model once and draw "
     "each picture separately, without scaling. If `--view` lists several sides, Lambent draws each side in each size. "
     "Without a pattern in `-o`, Lambent appends the size to the model's name: `bunny-256x128.png`.",
     .several = "sizes", .brief = "pixels: 800, 1920x1080, or a list", .store = store_size,
     .others = "resolutions viewport window dpi ppi",
     .also = "width height=x* resolution res image-size img-size pixels thumbnail thumb window-size", .max = 65535,
     .single = TAKES_SIZE, .not_in = IN_LOOK | IN_KEY},
    {"samples", 0, GROUP_PICTURE, "N", "16 up to 256x256 pixels, 8 up to 512x512, 4 above",
     "Samples per pixel: 1, 2, 4, 8 or 16.",
     "More samples give smoother edges, most visibly in small pictures. On a sheet, the default depends on the size of "
     "each picture. Lambent computes the lighting once per triangle and pixel, regardless of the number of samples.",
     sample_words, .store = store_word, .others = "quality",
     .also = "antialias antialiasing anti-aliasing aa msaa ssaa spp supersampling hq=16 high-quality=16",
     FIELD(draw.samples), .also_in = IN_SHEET},
    {"anisotropy", 0, GROUP_PICTURE, "N", NULL, NULL,
     "A pixel on a slanted surface covers a long, narrow area of the texture. A single texture sample blurs the whole "
     "area. With up to N samples along this area, textures can appear up to N times as sharp. Each pixel takes as many "
     "samples as its area needs.",
     .others = "anisotropic anisotropic-filtering"},
    {"map-filter", 0, GROUP_PICTURE, "NAME", NULL, NULL,
     "The sheet `filters` of `lambent compare` shows all filters side by side (`docs/textures.md`).",
     .others = "mipmap mipmaps bilinear trilinear nearest sampling"},
    {"line-width", 0, GROUP_PICTURE, "PIXELS", NULL, NULL,
     "Lambent draws the lines of OBJ (`l`), PLY (`edge`) and glTF files with the same width at every distance. Lambent "
     "moves lines towards the eye by their width, so that lines on a surface are visible. Lines have no end caps.",
     .others = "linewidth stroke-width thickness"},
    {"point-size", 0, GROUP_PICTURE, "PIXELS", "by the number of points", NULL,
     "Lambent draws the points of OBJ (`p`) and glTF files, and the vertices of PLY files without faces and edges, at "
     "the same size at every distance. The default is 16 % of the picture's shorter side, divided by the square root "
     "of the number of points, but at most 2.5 % of the shorter side. The default is never below 3 pixels. For fewer "
     "than 100 points, the default is never below 8 pixels.",
     .others = "pointsize point-width splat-size"},
    {"background", 'b', GROUP_PICTURE, "COLOR", "transparent",
     "The background: white, #rrggbb, r/g/b, transparent, or environment[:BLUR].",
     "The background fills all pixels that the model does not cover, even with `--show` and on sheets. A colour is "
     "`#rgb`, `#rrggbb` or `#rrggbbaa` (sRGB), three or four linear numbers `r/g/b` or `r/g/b/a`, `transparent`, or a "
     "name. The names are `black`, `white`, `gray`, `silver`, `red`, `green`, `blue`, `yellow`, `cyan`, `magenta`, "
     "`orange` and the other colour names of HTML 4. `environment` shows the environment that lights the model, and "
     "`environment:0.4` blurs it, like in a surface of this roughness (0 to 1). Exposure and tone curve apply to it; "
     "pictures of `--show` are transparent instead.",
     .kind = VALUE_COLOR, .brief = "white, '#dfe6ee', transparent or environment", .store = store_color,
     .also = "bg bgcolor bg-color background-color backdrop transparent=transparent", FIELD(picture.background),
     .also_in = IN_SHEET},
    {"background-environment", 0, GROUP_PICTURE, "BLUR", .now = "background"},
    {"color-mode", 0, GROUP_PICTURE, "MODE", "srgb", "The colour encoding: srgb, or raw (no conversion).", NULL,
     color_mode_words, .store = store_word, .others = "encoding gamma colorspace color-space linear srgb",
     FIELD(picture.color_mode), .also_in = IN_SHEET, .not_in = KEEPS_MODEL},
    {"compress", 0, GROUP_PICTURE, "LEVEL", "fast", "The compression of PNG files: fast or best.",
     "Both levels store the same pixels. The option has no effect on other formats. `best` needs libdeflate, and the "
     "bytes of the file depend on libdeflate's version. With `fast`, the bytes depend only on the picture.",
     compress_words, .store = store_word, .others = "compression level png-compression", FIELD(picture.compress),
     .not_in = IN_PAGE},
    {"quality", 0, GROUP_PICTURE, "N", "90 for JPEG, lossless for WebP",
     "The quality of JPEG and WebP files, 1 to 100.",
     "A lower number gives a smaller file of lower quality. At 90 and above, JPEG files store a colour for every "
     "pixel; below 90, they store one colour for every four pixels. WebP is lossless at 100 and by default. The option "
     "has no effect on other formats. The bytes depend on the version of libjpeg-turbo or libwebp.",
     .store = store_integer, .others = "jpg lossy", .also = "jpeg-quality webp-quality", FIELD(picture.quality),
     .min = 1, .max = 100, .not_in = IN_PAGE},
    {"term", 0, GROUP_PICTURE, "METHOD", "auto",
     "How to show the picture in the terminal: auto, kitty, iterm2, sixel, blocks or off.",
     "If the terminal supports pictures and you omit `-o`, Lambent shows the picture above the line that names the "
     "picture's file. `-o -` shows the picture and writes no file. Lambent recognises kitty, Ghostty, iTerm2 and "
     "WezTerm by their environment variables. For other terminals, Lambent sends a query and waits at most half a "
     "second. If "
     "the picture is wider than the window, Lambent scales the picture down. With `kitty`, `iterm2`, `sixel` or "
     "`blocks`, Lambent shows the picture even if `-o` names a file, provided that its format has 8 bits per channel. "
     "Lambent shows a picture only for a single model, on a terminal, and without `--json`. `auto` shows no picture "
     "with `--quiet`. `sixel` and "
     "`blocks` "
     "need libchafa (Debian's package `libchafa0`). `docs/terminal.md` lists the terminals.",
     term_words_list, .of_file = true, .store = store_word, .single = TAKES_TERM,
     .others = "terminal sixel kitty preview inline", FIELD(picture.term)},
    {"durable", 0, GROUP_PICTURE, NULL, NULL, "Flush each picture and its folder to disk before continuing (fsync).",
     "After a power failure, the disk contains either the complete old picture or the complete new one. Without this "
     "option, the operating system writes pictures to disk within seconds. Even then, most file systems keep either "
     "the old picture or the new one.",
     .of_file = true, .store = store_switch, .others = "fsync sync", FIELD(picture.durable),
     .not_in = IN_JOB | IN_KEY | IN_PAGE},
    {"exposure", 0, GROUP_PICTURE, "STOPS", "0; auto for the lights of a glTF file",
     "The exposure in stops (1 doubles the light, -1 halves the light), or auto.",
     "Lambent multiplies the model's light by 2 to the power of STOPS, before the tone curve and encoding. The "
     "exposure also applies to `--color-mode raw`, to float pictures and to the light terms of `--show`. The "
     "background keeps its colour. If the picture uses the lights of a glTF file (candela, lux), the default is "
     "`auto`. With `auto`, Lambent computes the exposure at which 95 % of the covered pixels have a luminance of at "
     "most 0.8. Lambent rounds this exposure to a third of a stop, and reports the result. `--exposure 0` keeps the "
     "light unchanged. With any exposure, Lambent does not adjust the light for dark and white models (`--brighten`).",
     .store = store_exposure, .others = "brightness", .also = "ev", FIELD(picture.exposure), .min = -100, .max = 100},
    {"tone", 0, GROUP_PICTURE, "CURVE", "auto",
     "The tone curve: none, reinhard, aces, agx, khronos-neutral, contrast or soft.",
     "Lambent applies the tone curve after exposure and before encoding. `auto` selects `khronos-neutral` for pictures "
     "with physical materials, and `contrast` for scans, figures and terrains that are light grey and lit by the "
     "studio. For other models that the studio lights, `auto` selects `soft`, unless a material is unlit or emits "
     "light. For all other pictures, and with `--color-mode raw`, `auto` selects `none`, which clips light at 1. "
     "Lambent applies no curve to floating-point pictures. For the formulas, see `docs/lighting/tone.md`.",
     tone_words, .store = store_word, .others = "tone-curve view-transform",
     .also = "tonemap tone-map tonemapping tone-mapping", FIELD(draw.tone)},
    {"show", 0, GROUP_PICTURE, "QUANTITY", "the picture",
     "Show a term of the light, one light, or a surface quantity instead of the picture.",
     "The terms `ambient`, `diffuse`, `specular`, `emission` and `reflection` add up to the picture. `light:key` shows "
     "the contribution of the light named key, and `light:1` shows the contribution of the first light. `n.l` and "
     "`n.h` use the first light that has a direction; `n.l:key` and `n.h:key` select another light. Other names, such "
     "as `normals` and `depth`, show surface quantities. `all` writes the picture, every term and every light as "
     "layers of one `.exr` file. `.pfm` and `.exr` files store surface quantities unchanged. `docs/show.md` explains "
     "how 8-bit pictures encode these quantities.\n`render` and `batch` also accept a list, such as "
     "`color,depth,normals`, and draw a picture of each quantity; `color` is the usual picture. `{show}` in `-o` is "
     "the "
     "quantity.",
     .several = "shows", .brief = "one term or quantity: diffuse, normals, depth ...", .store = store_show,
     .others = "layer debug term only",
     .also = "aov pass render-pass channel depth=depth mask=coverage silhouette=coverage normals=normals "
             "normal-map=normals unlit=base-color albedo=base-color",
     FIELD(picture.show), .also_in = IN_SHEET, .not_in = IN_LOOK},

    {"depth-scale", 0, GROUP_PICTURE, "NUMBER", NULL,
     "With --show depth: write a PNG with 16 bits that stores the distance times this number; 0 means no surface.",
     "With a model in metres, `--depth-scale 1000` stores millimetres. Without it, a PNG shows the depth in 8 bits, "
     "near is "
     "white; `.exr` and `.pfm` files store the distance itself.",
     .store = store_number, .others = "depth-16", FIELD(picture.depth_scale), .min = 1e-9, .max = 1e9},
    {"save-scene", 0, GROUP_PICTURE, "FILE", NULL, "Also write a scene file (JSON) that reproduces this picture.",
     "The file stores every setting of the picture: the model's path relative to FILE, the camera, all lights "
     "(including the lights of a rig), materials, transforms and picture options. `lambent FILE` then draws an "
     "identical picture. Lambent overwrites FILE if it exists. `docs/scene-file.md` describes the format.",
     .kind = VALUE_FILE, .of_file = true, .store = store_text, .others = "export-scene write-scene",
     FIELD(picture.save_scene), .not_in = IN_LOOK | IN_JOB | IN_KEY | IN_PAGE},

    {"scene", 0, GROUP_MODEL, "NAME|N", "the file's default",
     "The scene to draw from a glTF file with several scenes: its name or number (the first scene is 0).", NULL,
     .store = store_text, .others = "scene-name scene-index", FIELD(model.scene)},
    {"variant", 0, GROUP_MODEL, "NAME|N", "none",
     "The material variant of a glTF file (KHR_materials_variants): its name or number (the first variant is 0).", NULL,
     .store = store_text, .others = "material-variant skin", FIELD(model.variant)},
    {"animation", 0, GROUP_MODEL, "NAME|N", "none",
     "The animation that poses a glTF model: its name or number (the first animation is 0).",
     "Lambent evaluates the animation of nodes, morph target weights and skins at the time given by `--time`. Without "
     "`--time`, the whole animation moves if the name of the picture ends in `.gif` or `.webp`, as with `--sweep "
     "time`.",
     NULL, .store = store_text, .others = "action", .also = "anim animate=0 play=0", FIELD(model.animation)},
    {"time", 0, GROUP_MODEL, "SECONDS", "0", "The time in the animation, in seconds.",
     "Without `--animation`, Lambent uses the file's first animation. Before the first keyframe, Lambent shows the "
     "first pose; after the last keyframe, it shows the last pose.",
     NULL, .store = store_number, FIELD(model.time_s), .has_field = offsetof(struct options, model.has_time),
     .min = -1e9, .max = 1e9, .others = "seconds", .loads = true},
    {"arrange", 0, GROUP_MODEL, "HOW", "row", "How to place the models of `a.stl + b.stl`: row, grid or as-is.",
     "`lambent a.stl + b.stl -o both.png` draws several models in one picture, to scale. Models with another up axis "
     "are "
     "turned to the axis of the first model.",
     arrange_words, .store = store_word, .others = "layout merge combine join", FIELD(model.arrange), .loads = true},
    {"section", 0, GROUP_MODEL, "PLANE", "none",
     "Cut the model by a plane, such as x=0 or z=40%, and close the cut surface; repeatable.",
     "The axis names the side that is removed: `x=0` removes x > 0, and `-x=0` removes x < 0. `x` alone means `x=50%`. "
     "A percentage is a part "
     "of "
     "the model's extent along the axis, from its smallest coordinate. `normal=1/1/0,distance=2.5` is any other plane; "
     "it removes the side to which the normal points. The coordinates refer to the model before `--rotate`. Cut "
     "surfaces have the material of their part, or the colour of `,color=orange`. Lines, points, transparent parts and "
     "surfaces that are not closed are cut, but not closed. `lambent info` prints the area of each section. `none` "
     "shows the whole model of a scene file with sections.",
     .brief = "cut the model: x=0, z=40% ...", .store = store_section, .others = "clipping cutaway cut-away slice",
     .also = "clip cut cross-section", FIELD(model.sections), .also_in = KEEPS_MODEL},
    {"lenient", 0, GROUP_MODEL, NULL, NULL,
     "Draw all geometry that can be read: ignore unknown extensions that a glTF or 3MF file requires.",
     "Without this option, Lambent refuses such a file (exit 3), because the picture could be wrong without the "
     "extension. With this option, Lambent also omits damaged primitives of glTF files, reads later versions of glTF, "
     "and accepts undeclared XML prefixes in 3MF files.",
     .store = store_switch, .others = "force ignore-extensions permissive", FIELD(model.lenient)},
    {"deflection", 0, GROUP_MODEL, "FRACTION", "0.00025",
     "The largest distance of triangles from the exact surface of a STEP, IGES or BREP model, relative to its "
     "diagonal.",
     "The default is a quarter of a pixel in a picture of 1024x1024 pixels that shows the whole model. A smaller "
     "number "
     "gives rounder outlines in larger pictures and close views, and needs more time and triangles.",
     .store = store_number, .others = "tolerance chordal-deviation tessellation", FIELD(model.deflection), .min = 1e-6,
     .max = 0.1, .loads = true},

    {"view", 0, GROUP_VIEW, "SIDE", "three-quarter",
     "The side from which to view the model, or a list of sides: front, back, left, right, top, bottom, iso or "
     "three-quarter; or a number of directions, such as 24.",
     "By default, the camera is 30 degrees to the right of the front and 20 degrees above the horizon. The model fills "
     "92 % of the picture's width or height. `--azimuth` and `--elevation` override the angles of a side.\n`render` "
     "and `batch` also accept lists of sides, such as `front,left,iso`. `24` or `sphere:24` means 24 directions, "
     "evenly "
     "distributed on a sphere, and `ring:8@30` means 8 directions at equal angles, 30 degrees above the horizon. These "
     "commands read each model once. Without a pattern in `-o`, Lambent appends the side, or the number of the "
     "direction, to the model's name: `bunny-front.png`, `bunny-07.png`. For directions, Lambent also writes their "
     "cameras to `transforms.json` (`docs/cameras.md`).",
     view_words, .several = "views", .brief = "front, left, top, iso ...; a list; or a number", .store = store_word,
     .others = "side sides cameras angle angles orientation",
     .also = "top=top bottom=bottom front=front back=back left=left right=right iso=iso isometric=iso",
     FIELD(view.side), .not_in = IN_KEY},
    {"azimuth", 0, GROUP_VIEW, "DEGREES", "30",
     "The camera's angle around the model: 0 is the front, 90 is the right side.",
     "`render` and `batch` also accept a list, such as `0,90,180`, and draw a picture for each angle.",
     .store = store_number, .several = "azimuths", .others = "heading orbit", .also = "yaw", FIELD(view.azimuth_deg),
     .has_field = offsetof(struct options, view.has_azimuth), .min = -3600, .max = 3600},
    {"elevation", 0, GROUP_VIEW, "DEGREES", "20",
     "The camera's angle above the horizon: 0 is level, 90 is straight above.", NULL, .store = store_number,
     .others = "altitude tilt", .also = "pitch", FIELD(view.elevation_deg),
     .has_field = offsetof(struct options, view.has_elevation), .min = -90, .max = 90},
    {"zoom", 0, GROUP_VIEW, "FACTOR", "1", "Magnification: 2 shows the model twice as large.", NULL,
     .store = store_number, .others = "magnification distance margin padding",
     .also = "magnify scale zoom-to-fit=1 fit=1", FIELD(view.zoom), .min = 0.001, .max = 1000},
    {"fov", 0, GROUP_VIEW, "DEGREES", "30", "The camera's vertical field of view, above 0 and below 180.",
     "With a wide angle, Lambent moves the camera closer, so the model still fills the picture. The perspective is "
     "then stronger. `--fov 60` and `--camera fovy=60` are equivalent.",
     .store = store_number, .others = "view-angle perspective-angle focal-length", .also = "field-of-view",
     .alias = "fovy", FIELD(view.fov_deg), .min = FOV_MIN, .max = FOV_MAX},
    {"projection", 0, GROUP_VIEW, "KIND", "perspective", "The projection: perspective or orthographic.", NULL,
     projection_words, .store = store_word, .others = "parallel",
     .also = "ortho=orthographic orthographic=orthographic orthogonal=orthographic perspective=perspective",
     FIELD(view.projection)},
    {"up", 0, GROUP_VIEW, "AXIS", "auto", "The model's up axis: x, y, z, -x, -y, -z, file or auto.",
     "The camera and the lights that are fixed to the camera follow the axis; the model's coordinates do not change. "
     "Lambent reads STL and 3MF files as Z up, as in CAD and 3D printing, and other formats as Y up. Lambent also "
     "reads OBJ and PLY files as Z up if they contain a terrain in the xy plane. `--up auto` also turns a PLY or STL "
     "model upright if it cannot stand on this axis, but on exactly one of the other two, such as a scan that lies on "
     "its back. A warning names the axis. `--up file`, `convert`, `info` and several models joined with ` + ` do not "
     "turn models. Lambent also accepts capital letters and a plus sign (`+Z`).",
     up_words, .brief = "the file's up axis: y, z, -z ...", .store = store_up, .others = "axis",
     .also = "up-axis upaxis z-up=z zup=z y-up=y yup=y", FIELD(view.up), .single = TAKES_UP, .not_in = KEEPS_MODEL},
    {"rotate", 0, GROUP_VIEW, "AXIS:DEGREES", NULL, "Rotate the model about its centre, for example y:30; repeatable.",
     "The axis is the scene's x, y or z axis. Lambent applies rotations in the given order. Lights do not move, except "
     "lights that are fixed to the model. The unit r refers to the size and position of the model before the rotation. "
     "Lambent also fits the camera before the rotation, and moves it back if the model would be cut off at some angle. "
     "The model therefore has the same size and position at every angle. All pictures of a sheet share "
     "this camera.",
     .brief = "rotate the model: y:30", .store = store_rotation, .others = "r turn spin",
     .also = "rot rotation rotate-x=x:* rotate-y=y:* rotate-z=z:*", FIELD(shading.rotations)},
    {"camera", 0, GROUP_VIEW, "KEYS|NAME|N", "fitted",
     "The camera: keys such as eye=x/y/z,target=x/y/z,fovy=30, or the name or number of a camera in the model file.",
     "A value without `=` selects a camera of a glTF file, by its name or number (the first camera is 0). Otherwise, "
     "the value is a list of keys, separated by commas. Positions are in the model's own coordinates. `eye` is "
     "required, unless `fovy` is the only key. By default, `target` is the middle of the model, and `up` is the "
     "model's up axis. In a perspective projection, `fovy` is the full vertical angle in degrees (default: 30). "
     "Without other keys, `--camera fovy=60` and `--fov 60` are equivalent. In a parallel projection, `ortho` is the "
     "distance from the picture's middle to its top, in model units. Give both `near` and `far`, or neither. By "
     "default, Lambent fits both distances to the scene. `fx`, `fy`, `cx` and `cy`, or `K`, are the intrinsics of a "
     "calibrated camera in pixels of the drawn picture, instead of `fovy`. `pose` is the matrix from the camera to the "
     "world, 16 numbers separated by `/`, instead of `eye`, `target` and `up`. With `convention=opencv`, the default, "
     "y "
     "of the pose points down, z points forward, and the centre of the first pixel is at 0, 0. With "
     "`convention=opengl`, y points up, z points backward, and `cx` and `cy` count from the picture's corner. For an "
     "example, see `docs/cameras.md`. You cannot combine this option with `--view`, `--azimuth`, "
     "`--elevation`, `--zoom`, `--fov` or `--projection`. For any picture, `--json` reports the camera under the same "
     "keys.",
     .kind = VALUE_CAMERA, .store = store_camera,
     .others = "intrinsics k camera-matrix calibration extrinsics position near far pose",
     .also = "eye=eye=* camera-position=eye=* look-at=target=* lookat=target=* target=target=*", FIELD(view.camera),
     .min = FOV_MIN, .max = FOV_MAX},

    {"light", 0, GROUP_LIGHTS, "TYPE[:KEYS]", "the rig's",
     "A light, such as point:position=2r/1r/3r, or none; repeatable.",
     "TYPE is `ambient`, `hemisphere`, `point`, `directional` or `spot`, followed by a colon and keys separated by "
     "commas. These lights replace the model's lights, or the studio if the model has no lights. `+TYPE` adds a light "
     "without replacing others, and `none` removes all lights except ambient light. If you also give `--rig`, Lambent "
     "uses the lights of the rig and these lights.\nPosition: `position=x/y/z` is in the model's units. With r after "
     "each number, the position is relative to the centre of the model's bounding sphere, in radii of this sphere. The "
     "default is `1r/2r/3r`, or `1r/-3r/2r` with Z up. `position=x/y/z/0` is a directional light that shines from this "
     "direction. `direction=x/y/z` is the direction in which the light travels, and `target=x/y/z` is the point at "
     "which the light aims. By default, a directional light shines along 0/0/-1, and a spot aims at the model's "
     "centre, or straight ahead in the frame `camera`. `frame=world|camera|view|object|object:NAME` selects the "
     "coordinate frame. `world` is the frame of the "
     "scene. `camera` is the frame of the eye: x points right, y points up, and the eye looks along -z. In this frame, "
     "a light without a position is at the eye. `view` uses the axes of the eye, with the origin at the middle of the "
     "scene's box. `object` is the frame of the model before `--rotate`, and `object:NAME` is the frame of a named "
     "object.\nEmission: `color` times `intensity` is the diffuse and specular light (default: 1). `ambient` (default: "
     "0), `diffuse` and `specular` set each term separately. A colour is `#rrggbb`, a name, `r/g/b` (linear) or one "
     "number. An ambient light uses `color` or `ambient` (default: 0.2). A hemisphere light uses `sky` (default: 0.4), "
     "`ground` (default: 0.1) and `up`.\nFalloff: `attenuation=a/b/c` is 1/(a + b d + c d^2). With r after b and c, "
     "the distance d is in radii (`1/2.7r/5r`). `range` (also with r) is the distance beyond which the light "
     "contributes nothing. The cone of a spot is defined by `cutoff` (half angle in degrees, default: 45) and "
     "`exponent`, or by the half angles `inner` and `outer`. `name` appears in reports.\n`lambent help lights` lists "
     "all keys.",
     .kind = VALUE_LIGHT, .brief = "point, spot, directional ... replace the studio", .store = store_light,
     .others = "l lamp spot point directional lighting", .also = "sun=directional", FIELD(lighting.lights)},
    {"look", 0, GROUP_LIGHTS, "NAME|FILE", "studio",
     "A named set of options: studio, classic, catalog, technical, or your own file.",
     "A look is a file with one option per line. Options on the command line override options of the look. A rig or "
     "lights on the command line replace the look's lights. `lambent looks` lists the built-in looks. `lambent looks "
     "catalog` prints a look's file, which you can copy and edit.",
     look_words, .kind = VALUE_FILE, .store = store_text, .also = "preset style theme", FIELD(lighting.look),
     .not_in = IN_LOOK | IN_KEY | IN_PAGE | KEEPS_MODEL},
    {"rig", 0, GROUP_LIGHTS, "NAME", "auto",
     "A predefined set of lights: studio, headlight, three-point, lecture, default, file, none or auto.",
     "Every rig except `auto` and `file` replaces the model's own lights. `docs/lighting/lights.md` lists the lights "
     "of each rig.",
     rig_words, .store = store_word, .others = "lights light-setup studio", .also = "headlight=headlight",
     FIELD(lighting.rig), .has_field = offsetof(struct options, lighting.has_rig)},
    {"ambient", 0, GROUP_LIGHTS, "COLOR", "0", "Ambient light: #rrggbb, r/g/b, a name or one number.", NULL,
     .kind = VALUE_COLOR, .store = store_opaque_color, .others = "ambient-light", FIELD(lighting.ambient)},
    {"show-lights", 0, GROUP_LIGHTS, NULL, NULL,
     "Draw a marker at each light: a ball, with a cone in the light's direction.",
     "The marker of a directional light is 1.5 bounding-sphere radii from the model's centre. Each marker has the "
     "colour of its light. The markers do not change the camera. Lambent reports markers outside the picture.",
     .store = store_switch, FIELD(shading.show_lights)},
    {"light-cutoff", 0, GROUP_LIGHTS, "SHARE", NULL, NULL,
     "With more than 16 lights, Lambent skips the weakest lights in each region of the picture. Together, the skipped "
     "lights can change a channel by at most this share of the channel's range. The default is half a step of an 8-bit "
     "channel (0.5/255), so no byte changes by more than 1. Lambent always skips lights that contribute nothing: "
     "lights behind the surface, lights out of range, and spot lights whose cone does not reach the surface.",
     .words = NULL, .not_in = IN_LOOK},
    {"ao", 0, GROUP_LIGHTS, "METHOD", NULL, NULL,
     "A recess receives less light from its surroundings than an open face. Occlusion dims ambient, hemisphere and "
     "environment light. Occlusion also dims lights whose key `occluded` is above 0, such as the studio's lights. "
     "Ambient "
     "occlusion requires Phong shading. For the formulas, see `docs/lighting/occlusion.md`.",
     .others = "occlusion gtao hbao", .also = "ambient-occlusion=auto ssao=screen no-ao=off"},
    {"cavity", 0, GROUP_LIGHTS, "SWITCH", NULL, NULL,
     "Cavity shading makes letters, holes, seams and wrinkles visible. Cavity shading measures valleys at a small "
     "radius, and affects the same light as `--ao`. To draw only this effect, use `--show ao --ao off --cavity "
     "on`.",
     .others = "curvature ridges valleys no-cavity"},
    {"specular-aa", 0, GROUP_LIGHTS, "SWITCH", NULL, NULL,
     "If the normals of a mesh or of a normal map vary within a pixel, highlights become jagged streaks that flicker. "
     "Specular antialiasing increases the roughness of such pixels (`docs/lighting/physical.md`).",
     .others = "specular-antialiasing toksvig glitter fireflies no-specular-aa"},
    {"brighten", 0, GROUP_LIGHTS, "SWITCH", NULL, NULL,
     "A black model needs more light than a white model; otherwise, only the outline of the black model is visible. If "
     "the base colours of a model file are dark, Lambent brightens the studio by up to 2.5 stops, so that the "
     "parts of a black model can be told apart. If a physically based "
     "model is white and has no textures, Lambent dims the studio by 5/6 stop, so that edges and holes are visible on "
     "a "
     "white page. `--exposure 0`, `--color` and `--material` disable both adjustments. For the rules, see "
     "`docs/lighting/tone.md`.",
     .others = "auto-exposure dark-models"},
    {"glass", 0, GROUP_LIGHTS, "SWITCH", NULL, NULL,
     "Many files describe a pane of glass as a blended surface. Its reflections then are as weak as its opacity, and "
     "the pane looks like a grey film. With `auto`, physical materials become thin glass if their name contains glass, "
     "window, windscreen or windshield, their opacity is at most 0.6, and no map varies their colour. To turn a whole "
     "model into glass, use `--material glass`.",
     .others = "glass-panes windows panes no-glass=off"},
    {"ao-radius", 0, GROUP_LIGHTS, "SHARE", .others = "occlusion-radius ssao-radius"},
    {"ao-samples", 0, GROUP_LIGHTS, "N", .others = "occlusion-samples ao-rays ray-count"},
    {"light-scale", 0, GROUP_LIGHTS, "FACTOR", "1",
     "Multiply the brightness of all lights, except the light of "
     "`--ambient`.",
     NULL, .store = store_number, .also = "light-intensity light-power intensity", FIELD(lighting.light_scale),
     .has_field = offsetof(struct options, lighting.has_light_scale), .min = 0, .max = 1e6},
    {"material", 0, GROUP_MATERIALS, "NAME|KEYS[@NAME]", "the model's",
     "A material: gold (see `lambent materials`), or shininess=50,specular=0.5; repeatable.",
     "The value is the name of a classic material, keys separated by commas, or a name "
     "followed by keys (`gold,shininess=80`). Under the default lights, `brass`, `bronze`, `chrome`, `copper`, `gold` "
     "and `silver` without keys are physical metals that reflect the studio. `glass` is clear glass (`lambent help "
     "glass`). Properties that you do not list keep the model's values. A colour is `#rrggbb`, a name, `r/g/b` or one "
     "number. `lambent help materials` lists the keys. `color` sets the ambient and diffuse colour. "
     "`specular_color` sets the specular colour. The factors `ka`, `kd` and `ks` multiply the ambient, diffuse and "
     "specular colour. The factor `kr` multiplies `reflectivity`. Without the key `reflectivity`, the reflectivity is "
     "`kr` times `specular_color` (default: white).\n`@NAME` limits the option to the surfaces of that name: "
     "`ruby@handle`. Lambent first looks for objects of that name, and for objects in an assembly (STEP) or below a "
     "node "
     "(glTF) of that name. Then it looks for parts (OBJ groups, STL solids), and then for materials of the model. If "
     "several options match a surface, the last one wins.",
     .kind = VALUE_MATERIAL, .brief = "gold, ruby ... (lambent materials)", .store = store_material,
     .others = "m specular diffuse",
     .also = "mat metallic=metallic=* metalness=metallic=* roughness=roughness=* gold=gold silver=silver chrome=chrome "
             "glass=glass",
     FIELD(material.materials)},
    {"color", 0, GROUP_MATERIALS, "COLOR", "the materials' own", "The colour of the model: red, #ff8800 or r/g/b.",
     "The colour replaces the ambient and diffuse colour of every material, including colours set by `--material`. "
     "Highlights keep their colour. `--color COLOR` is short for `--material color=COLOR`. A colour alone is also a "
     "valid material: `--material '#ff8800@handle'`. For old scripts, `--color raw` means `--color-mode raw`, and "
     "`--color srgb` means `--color-mode srgb`.",
     .kind = VALUE_COLOR, .brief = "the model's colour: red, '#ff8800'", .store = store_opaque_color,
     .others = "c surface-color no-texture", .also = "colour paint tint model-color mesh-color",
     FIELD(material.model_color), .former = "color-mode"},
    {"back-material", 0, GROUP_MATERIALS, "NAME|KEYS[@OBJECT]", "the front's",
     "The material of back faces, with the syntax of `--material`; properties that you do not list keep the front's "
     "values.",
     NULL, .kind = VALUE_MATERIAL, .store = store_material, FIELD(material.back_materials)},
    {"hide", 0, GROUP_MATERIALS, "NAME", NULL, "Hide the objects, parts or materials of this name; repeatable.",
     "Lambent first looks for objects of that name, and for objects in an assembly (STEP) or below a node (glTF) of "
     "that name. Then it looks for parts (OBJ groups, STL solids), and then for surfaces whose material has that name. "
     "Lambent does not draw the hidden surfaces, and they cast no shadows. `lambent info` lists the names.",
     .store = store_texts, .others = "invisible omit remove without", .also = "exclude", FIELD(material.hidden)},
    {"only", 0, GROUP_MATERIALS, "NAME", NULL, "Show only the objects, parts or materials of this name; repeatable.",
     "The camera fits what is shown. The names are those that `--hide` accepts.", .store = store_texts,
     .others = "solo part parts isolate-part show-only", FIELD(material.only), .loads = true},
    {"explode", 0, GROUP_VIEW, "FACTOR", "0", "Move the objects and parts of the model apart; 0.5 is a good start.",
     "Lambent moves each part away from the middle of the model by FACTOR times the distance between both middles. "
     "`z=0.5` moves the parts only along the z axis.",
     .store = store_explode, .others = "explosion explode-view", .also = "exploded=0.5", FIELD(view.explode),
     .loads = true},
    {"shininess", 0, GROUP_MATERIALS, "ALPHA", NULL,
     "The exponent of all highlights: 10 gives wide highlights, 1000 gives sharp highlights.",
     "The value replaces the shininess of every material, including materials set by `--material`.", .now = "material",
     .key = "shininess", .store = store_number, .others = "gloss glossiness specular-exponent exponent",
     FIELD(material.shininess), .has_field = offsetof(struct options, material.has_shininess), .min = 0, .max = 1e30},
    {"opacity", 0, GROUP_MATERIALS, "SHARE", NULL, "The alpha of all materials: 1 is opaque, 0 is clear.",
     "The value replaces the opacity of every material, including materials set by `--material`. The alpha of vertex "
     "colours still multiplies this opacity.",
     .now = "material", .key = "opacity", .store = store_number, .others = "transparency translucency", .also = "alpha",
     FIELD(material.opacity), .has_field = offsetof(struct options, material.has_opacity), .min = 0, .max = 1},

    {"shading", 0, GROUP_SHADING, "METHOD", .brief = "flat, gouraud or phong", .others = "smooth interpolation",
     .also = "flat=flat flat-shading=flat faceted=flat gouraud=gouraud phong=phong",
     .has_field = offsetof(struct options, shading.has_shading)},
    {"reflection", 0, GROUP_SHADING, "MODEL", NULL, reflection_summary,
     .others = "brdf lobe pbr lighting-model reflection-model blinn-phong lambert"},
    {"stage", 0, GROUP_SHADING, "STAGE", "fragment", NULL,
     "If you omit `--shading`, `application` and `vertex` imply Gouraud shading, and `fragment` implies Phong shading. "
     "On the CPU, the stage does not change the picture of a shading method.",
     .others = "per-vertex per-pixel per-fragment"},
    {"flat-normal", 0, GROUP_SHADING, "SOURCE", .words = NULL},
    {"viewer", 0, GROUP_SHADING, "KIND", .words = NULL},
    {"match-highlights", 0, GROUP_SHADING, NULL, .words = NULL},
    {"single-scattering", 0, GROUP_SHADING, NULL, NULL, NULL,
     "Rough metals then look darker, as in renderers without multiple scattering.", .words = NULL},
    {"reference", 0, GROUP_SHADING, "N", NULL, NULL,
     "This option integrates the light numerically, for comparison with the approximation. With 1024 directions, most "
     "results are within 0.5 % of the exact integral; with 4096 directions, within 0.2 %. The directions are the same "
     "at every point and on every machine. Only the CPU device supports this option.",
     .others = "ground-truth importance-samples"},
    {"bounces", 0, GROUP_SHADING, "N", NULL, NULL,
     "Lambent traces paths of light instead of evaluating local lighting. With 1, all light casts shadows: lamps, the "
     "environment, ambient light and emitting surfaces. With 2 and more, surfaces light one another, mirrors show the "
     "model, and glass refracts. A path through glass does not count as a reflection. "
     "`docs/lighting/bounces.md` describes the method. Only the CPU device supports this option.",
     .others = "path-tracing pathtracer global-illumination gi indirect raytrace", .also = "bounce"},
    {"paths", 0, GROUP_SHADING, "N", NULL, NULL,
     "The picture is the mean of these paths, so it contains noise. The same number of paths always gives the same "
     "picture, on every machine.",
     .others = "spp"},
    {"denoise", 0, GROUP_SHADING, "SWITCH", NULL, NULL,
     "The filter compares two pictures of half the paths each, and averages pixels that differ by no more than their "
     "noise, on the same surface. The picture is smooth with few paths, but fine shadows may be blurred. For "
     "measurements, use `--denoise off`.",
     .others = "denoiser no-denoise"},
    {"noise", 0, GROUP_SHADING, "X", NULL, NULL,
     "Each part of the picture (64 by 64 pixels) ends when its noise is small enough, so that dark corners get more "
     "paths than bright walls. 1 is hard to see, 4 is grainy. The filter is then off by default. `--paths` is the "
     "largest number of paths, 65536 by default.",
     .others = "noise-threshold adaptive-threshold"},
    {"stop-after", 0, GROUP_SHADING, "SECONDS", NULL, NULL,
     "The picture depends on the speed of the machine. `--verbose` and reports contain the number of paths; with this "
     "number, `--paths` draws the same picture. Use `--time-limit` for a limit that fails.",
     .others = "time-budget"},
    {"caustics", 0, GROUP_SHADING, NULL, NULL, NULL,
     "Only paths that happen to meet an emitting surface or the environment behind glass find this light, so the "
     "picture needs many paths. Lamps shed no light through glass, also lamps with a radius. Without this option, "
     "glass lets light pass in a straight line after a reflection from a rough surface.",
     .others = "refractive-caustics"},
    {"shadows", 0, GROUP_SHADING, NULL, NULL, NULL,
     "Lambent traces a ray from every lit point to every light, except lights with `shadows=off`. Ambient light, "
     "hemisphere light and the environment cast no shadows. A light with a `radius` casts soft shadows. "
     "`docs/lighting/shadows.md` describes the method and common shadow errors.",
     .others = "raytrace shadow-map", .also = "shadow cast-shadows"},
    {"ground", 0, GROUP_SHADING, "KIND", NULL, NULL,
     "`--ground` without a value means `--ground shadow`. With a ground plane, lights cast shadows on the plane and on "
     "the model. The kind `shadow` draws only the shadows. The background may be transparent. The other kinds are lit "
     "surfaces. The ground plane is perpendicular to the up axis (`--up`) and fades out with distance. The ground "
     "plane is invisible from below. A ground plane requires Phong shading. For pictures, see "
     "`docs/lighting/ground.md`.",
     .kind = VALUE_COLOR, .store = store_ground, .alone = "shadow", .others = "plane base",
     .also = "floor shadow-catcher=shadow no-shadows=off no-shadow=off", FIELD(draw.ground)},
    {"shadow-terminator", 0, GROUP_SHADING, "SWITCH", .others = "terminator shadow-bias"},
    {"shadow-samples", 0, GROUP_SHADING, "N", NULL, NULL,
     "The fraction of unblocked rays is the brightness of the light at that point. With more than 48 rays, "
     "neighbouring pixels share rays, and few rays are traced in full light and full shadow. With up to 48 rays, each "
     "point uses exactly this number, which causes visible banding (`docs/lighting/shadows.md`).",
     .others = "soft-shadow-samples light-samples"},
    {"wireframe", 'w', GROUP_SHADING, NULL, NULL, NULL,
     "`--wireframe width=2,color=red` sets the width in pixels (default: 1) and the colour (default: black). If the "
     "alpha of the colour is below 1, the surfaces show through. Lambent omits edges behind surfaces (see "
     "`--hidden-lines`) and edges that split polygons of OBJ and PLY files into triangles. `--surfaces off` draws only "
     "the lines. Lines are smooth with any value of `--samples`. Lines keep their colour and width in any light, with "
     "any exposure and tone curve, and at any distance. For pictures, see `docs/edges.md`.",
     .keyed = true, .others = "mesh polygons topology", .also = "wire wires mesh-lines show-edges", .loads = true},
    {"wireframe-width", 0, GROUP_SHADING, "PIXELS", .now = "wireframe", .key = "width", .others = "wire-width"},
    {"wireframe-color", 0, GROUP_SHADING, "COLOR", "black", NULL, "If the alpha is below 1, the surfaces show through.",
     .kind = VALUE_COLOR, .store = store_color, .now = "wireframe", .key = "color", .others = "wire-color",
     FIELD(shading.wireframe_color)},
    {"edges", 0, GROUP_SHADING, "KINDS", "none", NULL,
     "At a `crease` edge, two faces meet at an angle larger than `angle`, or more than two faces meet. A `boundary` "
     "edge belongs to only one face. A `silhouette` edge lies between a front-facing and a back-facing face. You can "
     "add the keys `angle` (default: 40 degrees), `width` (default: 1.5 pixels) and `color` (default: black): `--edges "
     "all,width=2,color=red`. If you give only keys, Lambent draws all edges. `--edges all --surfaces off` makes a "
     "technical drawing.",
     .keyed = true, .others = "edge contour toon lineart",
     .also = "outline=all outlines=all feature-edges=all line-art=all", .loads = true},
    {"edge-angle", 0, GROUP_SHADING, "DEGREES", .now = "edges", .key = "angle", .others = "feature-angle sharp-angle"},
    {"edge-width", 0, GROUP_SHADING, "PIXELS", .now = "edges", .key = "width", .others = "outline-width"},
    {"edge-color", 0, GROUP_SHADING, "COLOR", "black", NULL, NULL, .kind = VALUE_COLOR, .store = store_color,
     .now = "edges", .key = "color", .others = "outline-color", FIELD(shading.edge_color)},
    {"hidden-lines", 0, GROUP_SHADING, "STYLE", NULL, NULL,
     "To find the hidden edges, Lambent traces rays from each edge to the eye. This method is exact, so lines along a "
     "surface have no gaps. A surface hides the lines behind it if the surface's opacity is at least 0.5. Glass hides "
     "nothing.",
     .others = "hidden-line dashed see-through xray x-ray"},
    {"surfaces", 0, GROUP_SHADING, "SWITCH", NULL, NULL,
     "With `off`, the invisible surfaces still hide the lines behind them.",
     .others = "faces lines-only no-surfaces hide-surfaces"},
    {"dimensions", 0, GROUP_SHADING, NULL, NULL, NULL,
     "The numbers are in model units, along the axes of the model's file after `--rotate`. Each axis is measured at an "
     "edge "
     "of the box on the outline, and the fitted camera leaves space for it. An axis that points towards the camera is "
     "not measured. For pictures, see `docs/annotations.md`.",
     .others = "measure ruler", .also = "dimension dims measurements"},
    {"scale-bar", 0, GROUP_SHADING, NULL, NULL, NULL,
     "The bar has a length of 1, 2 or 5 times a power of ten model units. With perspective, it is valid at the middle "
     "of "
     "the model; with `--projection orthographic`, everywhere.",
     .also = "scalebar"},
    {"axes", 0, GROUP_SHADING, NULL, NULL, NULL, NULL, .others = "gizmo triad", .also = "axis"},
    {"grid", 0, GROUP_SHADING, NULL, NULL, NULL,
     "The lines are 1, 2 or 5 times a power of ten model units apart, at multiples of this distance. Surfaces hide "
     "them.",
     .others = "floor-grid"},
    {"gl1", 0, GROUP_SHADING, NULL, NULL, NULL,
     "Use this option for comparison with old programs. Lambent then clamps vertex colours to 0...1 before "
     "interpolation, and limits the shininess to 128. Lambent also attenuates the ambient colour of each light with "
     "distance, and limits this colour to the light's cone.",
     .words = NULL},
    {"back-faces", 0, GROUP_SHADING, "KIND", "the model's", "The lighting of back faces: two-sided or one-sided.",
     "`--cull back` omits back faces.", back_face_words, .store = store_back_faces, .others = "backfaces double-sided",
     .also_in = KEEPS_MODEL},
    {"two-sided", 0, GROUP_SHADING, NULL, NULL, "Light back faces with the reversed normal, for every material.", NULL,
     .store = store_switch, .now = "back-faces", FIELD(shading.two_sided)},
    {"one-sided", 0, GROUP_SHADING, NULL, NULL, "Light back faces like front faces, with the unchanged normal.", NULL,
     .store = store_switch, .now = "back-faces", FIELD(shading.one_sided)},
    {"cull", 0, GROUP_SHADING, "SIDE", "the model's",
     "Omit the back or front faces of all objects: none, back or front.", NULL, cull_words, .store = store_word,
     .also = "culling backface-culling=back cull-backfaces=back", FIELD(shading.cull),
     .has_field = offsetof(struct options, shading.has_cull), .also_in = KEEPS_MODEL},
    {"normals", 0, GROUP_SHADING, "SOURCE", "file",
     "The source of normals: the file, or computed smooth or facet normals.", NULL, normals_words, .store = store_word,
     .others = "recompute-normals facet-normals", .also = "smooth=smooth smooth-normals=smooth smooth-shading=smooth",
     FIELD(shading.normals)},
    {"crease-angle", 0, GROUP_SHADING, "DEGREES", "40",
     "At edges sharper than this angle, the faces on the two sides do not share computed normals.", NULL,
     .store = store_number, .others = "smoothing-angle smooth-angle crease autosmooth", FIELD(shading.crease_angle_deg),
     .min = 0, .max = 180, .loads = true},
    {"segments", 0, GROUP_SHADING, "N[xM]", "the shape's own",
     "The segments of a built-in shape: N slices around the axis, and M stacks along the axis.",
     "With `--parametric`, N and M are the numbers of segments along u and v. N alone sets both numbers. The range of "
     "N is 3 to 16384. `lambent shapes` describes the segments of each shape. The default of M depends on the shape. "
     "`gyroid`, `metaballs` and `--implicit` accept only N, the number of cells, up to 1024.",
     .store = store_segments, .others = "subdivisions slices stacks tessellation", .max = 16384, .loads = true},
    {"environment", 0, GROUP_SHADING, "IMAGE", "the model's",
     "Light the model with an environment (HDRI): an image, studio, soft, outdoor ... or none.",
     "An image is either a cross of six squares (4:3 or 3:4) or an equirectangular picture (2:1). Its format is PNG, "
     "JPEG, WebP, BMP, TGA, PPM, PFM, EXR or Radiance (.hdr). Six faces are a list of files, separated by commas, in "
     "OpenGL's order: `px,nx,py,ny,pz,nz`. All faces must be square and have the same size. `studio`, `soft`, "
     "`outdoor`, `night`, `cyclorama` and `sky` are "
     "built in. `none` removes the environment of a scene file. For a model without lights, `none` replaces the "
     "built-in studio environment with the rig's lights. To use a file named `sky`, write `./sky`. The environment "
     "lights classic materials, too, unless `--reflection` names a classic model; it replaces the rig, and is added to "
     "the model's own lights (`docs/lighting/environment.md`). `docs/lighting/reflection.md` describes how Lambent "
     "maps "
     "each kind of environment around the model.",
     .kind = VALUE_ENVIRONMENT, .store = store_environment, .replaces = "reflection-map", .others = "e sky",
     .also = "hdri hdr env environment-map ibl skybox", FIELD(shading.environment)},
    {"reflection-map", 0, GROUP_SHADING, "IMAGE", NULL,
     "An environment that classic materials only reflect, by their reflectivity; values as for --environment.",
     "The lights or the rig light classic materials, and the environment adds kr times the light from the mirrored "
     "direction, as the lectures describe (`docs/lighting/reflection.md`). Set kr with `--material reflectivity=0.5`. "
     "Physical materials are lit as with `--environment`. The last of the two options counts.",
     .kind = VALUE_ENVIRONMENT, .store = store_environment, .replaces = "environment",
     .also = "envmap cubemap cube-map", FIELD(shading.environment)},
    {"environment-rotation", 0, GROUP_SHADING, "DEGREES", "0",
     "Rotate the environment about the up axis, counter-clockwise from above.", NULL, .store = store_number,
     FIELD(shading.environment_rotation_deg), .min = -360000, .max = 360000, .also = "hdri-rotation env-rotation"},
    {"reflectivity", 0, GROUP_SHADING, "SHARE", "the materials' own",
     "The share of the environment that every material reflects: 0.5 or r/g/b.", NULL, .now = "material",
     .key = "reflectivity", .store = store_reflectivity, .others = "mirror reflective", FIELD(material.reflectivity),
     .has_field = offsetof(struct options, material.has_reflectivity), .max = 1000, .also_in = KEEPS_MODEL},

    {"turntable", 0, GROUP_ANIMATION, "N", NULL, "Animate a full turn of the model in N frames (36 without a number).",
     "The model rotates about its up axis in equal steps, counter-clockwise as seen from above. Frame k is identical "
     "to a picture drawn with `--rotate y:A`, where A is k/N of 360 degrees. All frames use the same camera distance "
     "and exposure. By default, or if the name ends in `.png` or `.webp`, Lambent writes all frames to one animated "
     "PNG or WebP that loops forever. With `{frame}` in the name (`-o 'turn/{frame}.png'`), Lambent writes each frame "
     "to a separate file, in any format. `36,light=model` turns the lights with the model, instead of keeping the "
     "lights fixed to the camera. Lights that are fixed to an object always turn with the object. For examples, see "
     "`docs/animation.md`.",
     .store = store_integer, .keyed = true, .alone = "36", .others = "rotate360 animate gif apng",
     .also = "spin turnaround orbit", FIELD(animation.turntable), .min = 2, .max = 100000},
    {"turntable-light", 0, GROUP_ANIMATION, "WITH", "camera",
     "Keep the lights of a turntable with the camera, or turn them with the model: camera or model.", NULL,
     turntable_light_words, .store = store_word, .now = "turntable", .key = "light",
     .others = "turntable-lights spin-light", FIELD(animation.turntable_light)},
    {"sweep", 0, GROUP_ANIMATION, "KEY=FROM..TO", NULL,
     "Animate a number: light.azimuth=0..360, roughness=0..1; repeatable.",
     "KEY is `rotate.x`, `rotate.y`, `rotate.z`, or an option whose value is a number (`azimuth`, `elevation`, `zoom`, "
     "`exposure`, `opacity`, `ambient`, `crease-angle`). KEY may also be a key of `--material` (`roughness`, `kd`, "
     "`roughness@NAME`) or a numeric property of a light: `light.azimuth`, `light.WHICH.azimuth`. WHICH is the light's "
     "name, or its number counted from 1 (`lambent lights`, `--show-lights`). Without WHICH, the sweep applies to the "
     "first light with this key. The keys of a light are `intensity`, `azimuth`, `elevation` and the light's numeric "
     "fields (`diffuse`, `range`, `position.x`; angles in degrees). Azimuth and elevation set the direction from which "
     "the light comes, in the light's own frame. These angles work like the camera's angles: 0 is the front, 90 is the "
     "right side. `time` is the time in a glTF file's animation. `--sweep time`, without a range, covers the whole "
     "animation.\nYou can give more than two values: `light.elevation=10..80..10`. If a sweep returns to its first "
     "value, for example after a full turn, the last frame is one step before that value. The loop is then seamless. "
     "You can combine several sweeps with each other and with `--turntable`. Lambent fits the camera once, to the "
     "first frame. For `azimuth` and `elevation`, the distance of the camera is constant. For `time`, the camera fits "
     "the bounding boxes of all frames. Only `zoom` and `fov` change the camera between frames.",
     .kind = VALUE_SWEPT, .store = store_texts, .others = "animate vary-over-time light-sweep",
     FIELD(animation.sweeps)},
    {"frames", 0, GROUP_ANIMATION, "N", "36", "The number of frames in a sweep.",
     "`--turntable N` overrides this number. For `--sweep time`, the default is the animation's length times `--fps`.",
     .store = store_integer, .others = "frame-count", FIELD(animation.frames), .min = 2, .max = 100000},
    {"fps", 0, GROUP_ANIMATION, "N", "24", "Frames per second of an animation, 0.1 to 240.", NULL,
     .store = store_number, .others = "speed delay", .also = "framerate frame-rate", FIELD(animation.fps), .min = 0.1,
     .max = 240},
    {"stream", 0, GROUP_ANIMATION, NULL, NULL,
     "Write each frame to standard output as a PNG, for a program that encodes videos.",
     "For example, `lambent koala.obj --turntable 48 -b white --stream | ffmpeg -f image2pipe -framerate 24 -i - "
     "-pix_fmt yuv420p turn.mp4`.",
     .store = store_switch, .others = "pipe video mp4 ffmpeg", FIELD(animation.stream), .not_in = IN_JOB},

    {"threads", 'j', GROUP_WORK, "N", "one per processor", "The number of threads. It does not affect the picture.",
     NULL, .store = store_integer, .others = "jobs parallel", .also = "cores cpus", FIELD(work.threads), .min = 1,
     .max = 1024, .single = TAKES_THREADS},
    {"isa", 0, GROUP_WORK, "NAME", "auto", "The instruction set: scalar, sse4, avx2, avx512, neon or auto.",
     "All instruction sets draw identical pictures. Lambent rejects an instruction set that this machine or this build "
     "does not support (exit 3).",
     isa_words, .store = store_word, .others = "simd instruction-set", FIELD(work.isa)},
    {"device", 0, GROUP_WORK, "NAME", "auto", "The rendering device: cpu, gl, gles or auto.",
     "OpenGL draws the same picture within a tolerance (`docs/opengl.md`). If OpenGL is unavailable, the error message "
     "states the reason (exit 3). Lambent does not switch to another device. `lambent devices` lists the devices.",
     device_words, .store = store_word, .others = "d cpu engine gl", .also = "gpu=gl opengl=gl backend renderer",
     FIELD(work.device), .also_in = IN_KEY},
    {"gl-device", 0, GROUP_WORK, "N|NAME", "the first usable",
     "The OpenGL device, given by its number or by a part of its name.",
     "`lambent devices` lists the devices with their numbers, hardware before software.", .store = store_text,
     FIELD(work.gl_device), .also_in = IN_KEY},
    {"texture-filter", 0, GROUP_WORK, "NAME", "exact",
     "How OpenGL filters textures: exact (in the shader) or hardware.",
     "Graphics cards round the weights of their filters, mostly to 1/256, and approximate the level of detail. "
     "`hardware` is therefore faster and less exact (`docs/opengl.md`). The CPU device is always exact and rejects "
     "`hardware`. In the `shader` command, the option selects how the printed shaders read textures.",
     texture_filter_words, .store = store_word, .others = "texture-filtering texturefilter", FIELD(work.texture_filter),
     .also_in = IN_KEY},
    {"repeat", 0, GROUP_WORK, "N", "1", "Draw each picture N times and report the median time.", NULL,
     .store = store_integer, .others = "iterations benchmark bench", FIELD(work.repeat), .min = 1, .max = 100000},
    {"memory-limit", 0, GROUP_LIMITS, "BYTES", "a quarter of the available memory",
     "Stop if a model needs more than this much memory, for example 500M or 2Gi (exit 4).",
     "The limit applies separately to reading and to drawing a model. The memory for textures and decoders counts too. "
     "Lambent checks the limit before it allocates memory. The default is a quarter of the available memory, divided "
     "by the number of models drawn at the same time. The available memory is the smallest of the machine's memory, "
     "the limits of control groups (cgroup v1 and v2), `ulimit -v` and `ulimit -d`. `none` disables the limit. k, M, G "
     "and T are powers of 1000; Ki, Mi, Gi and Ti are powers of 1024. In the `check` command, the limit applies to the "
     "process that draws a shader.",
     .store = store_bytes, .others = "max-memory memory ram", FIELD(limits.memory_limit_bytes), .single = TAKES_MEMORY},
    {"time-limit", 0, GROUP_LIMITS, "SECONDS", "600", "Stop after this many seconds (exit 4); none disables the limit.",
     "The limit applies to the elapsed time for reading, drawing and writing each model. The processor time is limited "
     "to this value times the number of threads (`--threads`). Lambent stops within half a second of the limit. In an "
     "animation, the default applies to each frame; a limit that you set applies to all frames together.",
     .store = store_seconds, .others = "timeout", FIELD(limits.time_limit_s), .min = 0.001, .max = 1e9,
     .single = TAKES_PICTURE_LIMITS},
    {"triangle-limit", 0, GROUP_LIMITS, "N", "by the size of the files",
     "Stop if a model has more triangles than this (exit 4).",
     "Lines and points count as triangles. If several objects share a mesh, its triangles count once for each object. "
     "The default is 50 million plus 100 per byte of the model's files, but at most 200 million. k, M and G are powers "
     "of 1000.",
     .store = store_count, .others = "max-triangles polygon-limit vertex-limit", FIELD(limits.triangle_limit),
     .max = 2147483647},
    {"object-limit", 0, GROUP_LIMITS, "N", "by the size of the files",
     "Stop if a model has more objects than this, instances included (exit 4).",
     "The default is 100000 plus one per byte of the model's files.", .store = store_count,
     .others = "max-objects instance-limit max-instances node-limit", FIELD(limits.object_limit), .max = 2147483647},
    {"layer-limit", 0, GROUP_LIMITS, "N", "by the size of the files",
     "Stop if a picture has more layers per pixel than this, on average (exit 4).",
     "A layer is a translucent or masked surface that covers a pixel. Each light evaluated at a point counts as 1/32 "
     "of a layer, and so does each opaque surface at a pixel. Environment light evaluated at a point counts as one "
     "layer. The default is 40 plus one per 16384 bytes of the model's files. Pictures with fewer than 65536 pixels "
     "count as 65536 pixels. The OpenGL devices ignore this limit.",
     .store = store_count, .others = "max-layers overdraw-limit", FIELD(limits.layer_limit), .max = 2147483647},
    {"expansion-limit", 0, GROUP_LIMITS, "N", "2000",
     "Stop if a model needs more memory than N times the size of its files plus 500 MB (exit 4).",
     "A small file with compressed textures or meshes can expand to a large amount of memory. This option limits the "
     "expansion relative to the file size. `--memory-limit` sets an absolute limit.",
     .store = store_count, .others = "ratio-limit compression-limit bomb", FIELD(limits.expansion_limit),
     .max = 2147483647, .single = TAKES_PICTURE_LIMITS},
    {"pixel-limit", 0, GROUP_LIMITS, "N", "400M",
     "Reject a texture or an environment with more pixels than this (exit 4).",
     "Lambent checks the header before it allocates memory. The width and the height may each be at most 65535 pixels.",
     .store = store_count, .others = "max-pixels texture-limit image-limit", FIELD(limits.pixel_limit),
     .max = 4294836225, .single = TAKES_PICTURE_LIMITS},
    {"file-limit", 0, GROUP_LIMITS, "BYTES", "32G", "Reject files larger than this (exit 4).",
     "The limit applies separately to the model file and to each file that the model refers to.", .store = store_bytes,
     .others = "max-file-size file-size-limit", FIELD(limits.file_limit_bytes), .single = TAKES_PICTURE_LIMITS},
    {"json-depth-limit", 0, GROUP_LIMITS, "N", "256",
     "Reject JSON (glTF and scene files) with deeper nesting than this (exit 4).", NULL, .store = store_integer,
     .others = "max-depth nesting", FIELD(limits.json_depth_limit), .min = 1, .max = 2000},
    {"files-inside", 0, GROUP_LIMITS, NULL, NULL, "Restrict a scene file to files in its own folder.",
     "Use this option for scene files from untrusted sources. Lambent resolves links and `..` before it checks the "
     "folder. All models and pictures must be in the scene file's folder or below it. Files that a model refers to, "
     "such as MTL files, must always be in the model's folder. Files given on the command line may be anywhere.",
     .store = store_switch, FIELD(limits.files_inside), .single = TAKES_FILES, .also_in = IN_KEY},
    {"sandbox", 0, GROUP_LIMITS, "MODE", "auto",
     "Drop all privileges that are not needed to read files. Values: auto, require or off.",
     "In the sandbox, a file that exploits a decoder cannot run programs, open sockets or read other files. The "
     "rendering process can read only the models' folders, the paths given with `--allow-path`, and the system's "
     "libraries and fonts. The rendering process cannot change any file. A small process outside the sandbox writes "
     "the pictures and does nothing else. The sandbox uses two methods of the Linux kernel: Landlock and a seccomp "
     "filter. `auto` uses each method that the kernel supports. `require` fails if a method is missing (exit 3). With "
     "`require`, a scene file may refer only to files in its own folder (as with `--files-inside`) and to files "
     "allowed with `--allow-path`. `-v`, `--json` and `--version` report the methods in use. The sandbox applies to "
     "commands that read models or pictures. `check` and OpenGL need more privileges for the graphics driver. With "
     "`auto`, Lambent therefore runs both without a sandbox. With `auto`, a scene file (`.json`) may refer to files in "
     "any folder, unless you give `--files-inside` or `--allow-path`.",
     sandbox_words, .store = store_word, .others = "seccomp landlock jail", FIELD(limits.sandbox),
     .single = TAKES_PICTURE_LIMITS},
    {"allow-path", 0, GROUP_LIMITS, "DIR", NULL,
     "Allow models to use this file, or the files in this folder; repeatable.",
     "By default, a model may use only the files in its own folder. If the textures are in `../textures`, add "
     "`--allow-path ../textures`. Even with `--files-inside`, scene files may refer to files in the allowed folder. "
     "Links in folders given to `batch` may lead to the allowed folder. In the sandbox, Lambent can also read the "
     "allowed folder. With `--jobs`, all files named in jobs must be in an allowed folder, but models can still use "
     "only the files in their own folders. Pages (`-o FILE.html`) and `view` never include files from other folders.",
     .kind = VALUE_FILE, .store = store_path, .others = "allow", FIELD(limits.allow_paths),
     .single = TAKES_PICTURE_LIMITS},

    {"views", 0, GROUP_BATCH, "SIDES", NULL, "Several sides.", NULL, view_words, .store = store_views, .now = "view",
     FIELD(batch.views), .also_in = IN_JOB},
    {"azimuths", 0, GROUP_BATCH, "DEGREES", NULL, "Several angles.", NULL, .store = store_azimuths, .now = "azimuth",
     FIELD(batch.views), .min = -3600, .max = 3600, .also_in = IN_JOB},
    {"shows", 0, GROUP_BATCH, "QUANTITIES", NULL, "Several quantities.", NULL, .store = store_shows, .now = "show",
     FIELD(batch.shows), .also_in = IN_JOB},
    {"cameras", 0, GROUP_BATCH, "FILE", NULL, "Draw one picture of each model for each camera of a file.",
     "The file is JSON, CSV or the `transforms.json` of NeRF programs. Each row has the keys of `--camera`. If it has "
     "`width` and `height`, the picture has this size, unless you give `--size`. `{view}` in `-o` is the number of the "
     "row, from 0. For the formats, see `docs/cameras.md`.",
     .kind = VALUE_FILE, .store = store_cameras, .others = "poses trajectory camera-file", FIELD(batch.cameras)},
    {"sizes", 0, GROUP_BATCH, "SIZES", NULL, "Several sizes.", NULL, .store = store_sizes, .now = "size",
     FIELD(batch.sizes), .max = 65535, .also_in = IN_JOB},
    {"files-from", 0, GROUP_BATCH, "FILE", NULL, "Draw the models that FILE lists, one per line; repeatable.",
     "`-` is standard input. Names are relative to the current folder, as on the command line. Lambent ignores empty "
     "lines. In `batch`, `@FILE` has the same effect.",
     .kind = VALUE_FILE, .store = store_list, .others = "input-list filelist models-from", FIELD(batch.lists),
     .single = TAKES_MANY},
    {"journal", 0, GROUP_BATCH, "FILE", "none; `batch`: lambent.jsonl in the folder of the pictures",
     "Write a line of JSON for each finished or failed picture.",
     "A line records the model, the picture, the result (`class`, `exit`, `error`), the duration of each step in "
     "milliseconds, the number of triangles and the warnings. The line also records the size of the picture in bytes, "
     "the "
     "picture's hash, a hash for each file that Lambent read, and the key for `--skip-same`. Lambent writes the line "
     "after the picture is complete. `none` writes no journal. `docs/batch.md` describes every field.",
     .kind = VALUE_FILE, .store = store_text, .others = "log record", FIELD(batch.journal)},
    {"resume", 0, GROUP_BATCH, NULL, NULL, "Resume: skip pictures that the journal lists as done.",
     "Without a journal, Lambent draws everything, so you can use the same command to start and to resume a run. "
     "Lambent refuses to resume if the picture options differ from those in the journal. If a run was killed, Lambent "
     "first retries the models that were in progress, each in a separate process.",
     .store = store_switch, .others = "continue restart", FIELD(batch.resume)},
    {"retry-failed", 0, GROUP_BATCH, "N", "0", "Retry a picture that failed, at most N times.",
     "Lambent retries failed pictures at the end of the run. With `--resume`, Lambent also retries failures of earlier "
     "runs. Each line of the journal counts as one attempt. At the end, Lambent lists the models that still fail.",
     .store = store_integer, .others = "retries retry attempts", FIELD(batch.retry_failed), .max = 1000},
    {"failures-ok", 0, GROUP_BATCH, NULL, NULL,
     "Exit with 0 even if models fail, provided that the journal records each result.",
     "This does not apply to failures of the machine, such as a full disk: the exit code is then 7, and `--resume` "
     "draws "
     "these pictures again. "
     "Open MPI stops all ranks if one rank exits with a code other than 0. Other schedulers repeat a task that exits "
     "with such a code. The journal and the messages still report the failures. If a run ends early, for example after "
     "a wrong option or an interrupt, the command still exits with an error code.",
     .store = store_switch, .others = "keep-going ignore-failures ignore-errors", FIELD(batch.failures_ok),
     .single = TAKES_MANY},
    {"skip-same", 0, GROUP_BATCH, NULL, NULL, "Skip pictures whose files and options match the journal.",
     "Lambent skips a picture if the picture's hash and key match the journal. The key is a hash of three inputs: all "
     "files that Lambent looked for while reading the model (including textures and material libraries), all options "
     "with their defaults, and the program's version.",
     .store = store_switch, .others = "incremental update changed newer cache", FIELD(batch.skip_same)},
    {"isolate", 0, GROUP_BATCH, NULL, NULL, "Draw each model in a separate process.",
     "If a model crashes the process or exhausts the memory, only that model fails. The journal records the class "
     "`crashed`, and the run continues.",
     .store = store_switch, .others = "process fork sandbox-process", FIELD(batch.isolate), .single = TAKES_MANY},
    {"shard", 0, GROUP_BATCH, "K/N", "1/1",
     "Divide the models into N shards and draw only shard K (1 to N); other machines draw the other shards.",
     "A model's shard depends only on the model's path, so adding a model does not move other models. `auto` reads K "
     "from SLURM_ARRAY_TASK_ID or OMPI_COMM_WORLD_RANK, and N from the corresponding count. `auto/N` reads K from "
     "these variables or from JOB_COMPLETION_INDEX (Kubernetes). If these variables are ambiguous, Lambent reports an "
     "error. Without this option, Lambent ignores the variables. Each shard writes its own journal and page, with "
     "names such as `lambent-2-of-4.jsonl` (`docs/batch.md`). `lambent journal` summarises these journals.",
     .store = store_text, .others = "part slice partition split array distribute", FIELD(batch.shard)},
    {"shard-by", 0, GROUP_BATCH, "ORDER", "name", "How `--shard` divides the models: by name or by list.",
     "With `name`, each shard reads all names, which takes a second or two for a million models. With `list`, a shard "
     "reads only the K-th of N equal parts of one list (`@FILE`). The list must be sorted by the names of the pictures "
     "(`LC_ALL=C sort`), so that Lambent can check that no two pictures share a name. If the list changes, models move "
     "to other shards, and `--resume` reports an error.",
     shard_by_words, .store = store_word, .others = "partition split-by", FIELD(batch.shard_by)},
    {"jobs", 0, GROUP_BATCH, "-", NULL, "`batch`: Read one JSON job per line, and answer each job with a line of JSON.",
     "This option is for servers: one process draws all jobs until standard input ends (`docs/worker.md`). A job "
     "contains an `id`, a `model` or its bytes, `options`, and an `output`. Without `output`, the answer contains the "
     "picture. Lambent reads and writes files only inside the folders given with `--allow-path`. The options on the "
     "command line apply to every job. Lambent adds a job's own options after these options. Instead of `-`, you can "
     "give a file or a pipe.",
     .kind = VALUE_FILE, .store = store_jobs, .others = "worker server daemon serve", FIELD(batch.jobs)},
    {"list", 0, GROUP_BATCH, "FILE", NULL,
     "`batch`: Draw the pictures of a list, FILE.csv or FILE.jsonl, and answer each with a line of JSON.",
     "Each row is a picture. The column `model` names its model and `output` its file. All other columns are options "
     "of "
     "the picture, such as `size`, `view` or `material`. The first line of CSV names the columns. An empty field "
     "leaves "
     "the option out; `true` gives an option without a value. Messages name the line. Everything else is as for "
     "`--jobs`: give `--allow-path` for the folders of models and pictures.",
     .kind = VALUE_FILE, .store = store_pictures, .others = "catalogue csv", FIELD(batch.jobs)},
    {"ahead", 0, GROUP_BATCH, "N", "twice the number of models drawn at once",
     "The maximum number of waiting jobs. When this many jobs are waiting, Lambent pauses reading.", NULL,
     .store = store_integer, .others = "queue backlog queue-length", FIELD(batch.ahead), .min = 1, .max = 100000},
    {"line-limit", 0, GROUP_BATCH, "BYTES", "64M", "The maximum line length for `--jobs`; a longer line is an error.",
     "A line can include the bytes of a model. Base64 needs four bytes for every three bytes of the model. The models "
     "of waiting jobs use at most twice this amount of memory.",
     .store = store_bytes, .others = "line-length job-limit", FIELD(batch.line_limit_bytes)},
    {"report", 0, GROUP_BATCH, "FILE.html", NULL, "Also write an HTML page that shows all pictures, failures first.",
     "Lambent writes the thumbnails to the folder FILE-files next to the page. The page needs only this folder, and no "
     "network. Without `-o`, `lambent batch` writes the pictures and the journal to the folder FILE-pictures.",
     .kind = VALUE_FILE, .store = store_text, .others = "contact-sheet html gallery page", FIELD(batch.report_page),
     .single = TAKES_REPORT},

    {"json", 0, GROUP_REPORT, NULL, NULL, "Print a report in JSON, one line for each model.",
     "Lambent prints the report to standard output, instead of the line with the file's name. If the picture goes to "
     "standard output, Lambent prints the report, and nothing else, to standard error. Lambent prints a report even "
     "if the command fails. The schema is `docs/report.schema.json`. For `compare`, the report contains the caption "
     "and the options of each picture.",
     .brief = "print a report for other programs", .store = store_switch, .others = "stats info", FIELD(report.json),
     .single = TAKES_JSON},
    {"dry-run", 0, GROUP_REPORT, NULL, NULL,
     "List the pictures that the command would write, without drawing or writing them.",
     "Lambent reads and checks the models and the options, and checks whether it can write each picture. For each "
     "model, Lambent prints the name and size of the picture, whether the picture would overwrite a file, the camera, "
     "the device and the options on the command line. With `--json`, the report contains `planned` instead of `image`. "
     "Errors and exit codes are the same as without `--dry-run`.",
     .store = store_switch, .others = "plan simulate no-write preview what-if check-only", FIELD(report.dry_run)},
    {"verbose", 'v', GROUP_REPORT, NULL, NULL,
     "Print the name of each file that Lambent reads, and the duration of each step, to standard error.", NULL,
     .store = store_switch, FIELD(report.verbose), .also = "debug"},
    {"quiet", 'q', GROUP_REPORT, NULL, NULL, "Print only errors.", NULL, .store = store_switch, .also = "silent",
     FIELD(report.quiet), .single = TAKES_QUIET},

    {"tolerance", 0, GROUP_DIFF, "STEPS", "0", "The largest allowed difference per channel, in steps of 1/255.",
     "If a difference is larger, the exit code is 6.", .store = store_number, .others = "threshold epsilon",
     FIELD(diff.tolerance), .min = 0, .max = 1e9},
    {"gain", 0, GROUP_DIFF, "FACTOR", "16", "Amplify the difference picture by this factor.", NULL,
     .store = store_number, .others = "amplify", FIELD(diff.gain), .min = 0.001, .max = 1e6},

    {"check", 0, GROUP_HASH, "FILE", NULL,
     "Compare the pictures with the hashes in FILE; if a picture differs, the exit code is 6.",
     "Lambent lists changed models, new models, and missing models (models in FILE that you did not give). If you give "
     "no models, Lambent draws the models listed in FILE. If FILE was made with another version or with other options, "
     "Lambent reports this first.",
     .kind = VALUE_FILE, .store = store_text, .others = "verify compare-with against", FIELD(hash.check)},
    {"update", 0, GROUP_HASH, NULL, NULL,
     "With `--check`, write the new hashes to the file, and draw a sheet of the changed pictures.",
     "Lambent writes the sheet next to the file: `pictures-changes.png` for `pictures.hash`. For each of the first 40 "
     "changed models, the sheet shows the old picture, the new picture and the difference between them. The old "
     "picture is available only if `--pictures` stored it, because a hash does not contain the picture.",
     .store = store_switch, .others = "renew accept bless", FIELD(hash.update)},
    {"pictures", 0, GROUP_HASH, "DIR", NULL,
     "Store the pictures in this folder, so that the next `--update` can show them as old pictures on the sheet.",
     "Each picture is a PNG file named after its model: `DIR/models/koala.obj.png`. Commands with `-o` or `--update` "
     "write the pictures. `--update` also reads the pictures of the earlier run. The folder need not be in the "
     "repository; a CI cache is sufficient.",
     .kind = VALUE_FILE, .store = store_text, .others = "keep cache-dir baseline", FIELD(hash.pictures)},

    {"thumbnail", 0, GROUP_CONVERT, NULL, NULL, "Put a picture of the model into the GLB file.",
     "The picture is identical to the picture that `lambent MODEL -s 512` draws. The property `asset.thumbnail` stores "
     "the index of the picture in `images`, as in the draft of glTF 2.1. Programs that do not support this property "
     "ignore it.",
     .store = store_switch, .others = "preview icon", FIELD(convert.thumbnail)},

    {"print", 0, GROUP_PRINT, NULL, NULL,
     "Check whether the model can be printed: holes, edges with too many faces, faces that are turned.",
     "Lambent lists the largest holes with their places, the area of overhangs and the centre of mass. The exit code "
     "is 6 if "
     "the model cannot be printed as it is.",
     .store = store_switch, .also = "check printable watertight manifold check-mesh", FIELD(print.wanted)},
    {"overhang", 0, GROUP_PRINT, "DEGREES", "45",
     "The angle from the vertical above which `--print` counts a face as an overhang.", NULL, .store = store_number,
     FIELD(print.overhang_deg), .max = 90},

    {"sheet", 0, GROUP_SHEET, "NAME", "summary",
     "The sheet: summary, terms, stages, light, ambient, frames or surfaces.", NULL, sheet_words, .store = store_word,
     .alone = "summary", .others = "layout", FIELD(sheet.name)},
    {"captions", 0, GROUP_SHEET, "STYLE", "full", "Whether the captions of a sheet contain options: full or plain.",
     NULL, captions_words, .store = store_word, FIELD(captions.style)},
    {"title", 0, GROUP_SHEET, "TEXT", NULL,
     "The title of a sheet, a plot or a figure, in any language; '' omits the title.",
     "An SVG file stores titles and captions as text, so the viewer provides the fonts, supports right-to-left "
     "languages and can read the text aloud. In a PNG file, Lambent draws each letter separately, from left to right. "
     "The default font covers Latin, Greek and Cyrillic. For Chinese, Japanese and Korean, give a font that covers "
     "these scripts (`--font`). For scripts that run from right to left or join letters, write an SVG file.",
     .store = store_text, .single = TAKES_TITLE, .others = "heading name header", FIELD(captions.title)},
    {"caption", 0, GROUP_SHEET, "TEXT", NULL,
     "The caption of the next picture on the sheet, in any language; repeatable.", NULL, .store = store_texts,
     .others = "captions label labels", FIELD(captions.texts)},
    {"across", 0, GROUP_SHEET, "OPTION[=VALUES]", NULL,
     "Draw a row with one picture per value of an option (shading, or shininess=10,50,1000). A second --across makes a "
     "grid.",
     "OPTION is the name of an option for pictures, without the leading dashes, or of a field of materials "
     "(`emission=0,0.2`). A switch such as `match-highlights` has no values. Separate the values by commas. If the "
     "values themselves contain commas, as for `light` and `material`, separate the values by semicolons "
     "(`light=point;directional:color=red,frame=camera`). By default, the values are all names that the option "
     "accepts. The default values of `shininess` are 10, 50 and 1000. `light` draws one light of each type by default, "
     "and `show` (also called `term`) draws the five terms. If you give `--across` twice, the first defines the rows "
     "of a grid, and the second defines the columns. `mistake=A,B` uses OpenGL to draw one picture for each mistake, "
     "next to the correct picture and the difference between the two. `lambent shader --mistake list` lists the known "
     "mistakes. `mistake` alone draws all mistakes that are visible in the scene.",
     .kind = VALUE_VARIED, .store = store_across, .others = "vary rows", FIELD(sheet.across)},

    {"columns", 0, GROUP_CONTACT, "N", "fitted", "The number of columns of a contact sheet.", NULL,
     .store = store_integer, FIELD(contact.columns), .min = 1, .max = 100},
    {"per-page", 0, GROUP_CONTACT, "N", "60",
     "The number of models on one page of a contact sheet. Several pages are numbered: sheet-1.png.", NULL,
     .store = store_integer, FIELD(contact.per_page), .min = 1, .max = 1000},
    {"to-scale", 0, GROUP_CONTACT, NULL, NULL,
     "Draw all models of a contact sheet to one scale. Without it, each model fills its picture.", NULL,
     .store = store_switch, .others = "scale true-size", FIELD(contact.to_scale)},

    {"to", 0, GROUP_PLOT, "X", "fitted", "The right end of the horizontal axis: a distance, or an angle in degrees.",
     NULL, .store = store_number, FIELD(plot.to), .min = 1e-6, .max = 1e9},

    {"count", 0, GROUP_EXERCISES, "N", "20", "The number of exercises.", NULL, .store = store_integer,
     FIELD(exercises.count), .min = 1, .max = 999},
    {"seed", 0, GROUP_EXERCISES, "N", "1",
     "The number that chooses the exercises: the same seed gives the same exercises.", NULL, .store = store_integer,
     FIELD(exercises.seed), .max = 1e9},
    {"vertex", 0, GROUP_CHECK, "FILE", NULL, "The vertex shader for the fragment shader.",
     "Without this option, Lambent recognises the varyings by name and type, and generates a correct vertex shader for "
     "them (`docs/check.md`).",
     .kind = VALUE_FILE, .store = store_text, FIELD(check.vertex)},
    {"contract", 0, GROUP_CHECK, "NAME", "auto",
     "The contract that defines the shaders' variables: a built-in contract's name, or a file.",
     "`auto` recognises a built-in contract by the names of its variables. If no contract fits, Lambent infers the "
     "role of each input from its use in the shader. `auto` never selects `chile` or `glsl120`; to use one of these "
     "contracts, give its name. `--list` prints the contracts. You can also write your own contract in JSON "
     "(`docs/check/contract-file.md`).",
     contract_words, .kind = VALUE_FILE, .store = store_text, FIELD(check.contract)},
    {"light-frame", 0, GROUP_CHECK, "SPACE", "the contract's", "The space of light positions: object or camera.", NULL,
     light_frame_words, .store = store_word, FIELD(check.light_frame)},
    {"highlight", 0, GROUP_CHECK, "NAME", "the contract's", "The expected highlight: phong or blinn-phong.", NULL,
     highlight_words, .store = store_word, FIELD(check.highlight)},
    {"terms", 0, GROUP_CHECK, "NAMES", "as declared", "The expected terms: ambient,diffuse,specular or all.",
     "By default, Lambent expects a term if the shaders declare an input for this term. For example, Lambent expects a "
     "highlight only if the shaders declare a specular colour. If the shaders do not declare an expected colour, "
     "Lambent uses white.",
     term_words, .store = store_words, FIELD(check.terms)},
    {"scenes", 0, GROUP_CHECK, "NAMES", "all", "The scenes, separated by commas: all,gate,near.", NULL,
     .store = store_text, FIELD(check.scenes)},
    {"stop-after", 0, GROUP_CHECK, "SECONDS", "10", "Limit the processor time of a shader.",
     "The limit applies to all scenes together. Lambent adds up the processor time of all threads, so other programs "
     "on the machine do not affect the result. The elapsed time may be up to 20 times as long.",
     .store = store_number, FIELD(check.stop_after_s), .min = 0.1, .max = 1e6},
    {"search-limit", 0, GROUP_CHECK, "PICTURES", "10000", "Stop the search after drawing this many pictures.",
     "If the search finds no set of mistakes that explains the picture, the report states how many sets Lambent tried "
     "and whether the search stopped at this limit.",
     .store = store_integer, .others = "effort budget tries", FIELD(check.search_limit), .min = 1, .max = 1000000000},
    {"class", 0, GROUP_CHECK, "FOLDER", NULL, "Check every submission in a folder.",
     "A submission is a sub-folder with one fragment shader, at most one vertex shader and possibly other files. In "
     "the top folder, and in sub-folders with more shaders, each fragment shader forms one submission with the vertex "
     "shader of the same name. With `-o FOLDER/`, Lambent writes a page for the whole class, `index.html`, and a sheet "
     "for each submission.",
     .kind = VALUE_FILE, .store = store_text, FIELD(check.class_folder)},
    {"csv", 0, GROUP_CHECK, "FILE", NULL, "Write a CSV line for each shader.",
     "The line contains the points and the mistakes.", .kind = VALUE_FILE, .store = store_text,
     .others = "grades marks table", FIELD(check.csv)},
    {"moodle", 0, GROUP_CHECK, "FILE", NULL, "Write grades as a Moodle worksheet (CSV).",
     "Lambent recognises the folder names that Moodle makes from the names of the participants.", .kind = VALUE_FILE,
     .store = store_text, FIELD(check.moodle)},
    {"gradescope", 0, GROUP_CHECK, "FILE", NULL, "Write one submission's results.json for Gradescope.", NULL,
     .kind = VALUE_FILE, .store = store_text, FIELD(check.gradescope)},
    {"submitty", 0, GROUP_CHECK, "FILE", NULL, "Write one submission's result for Submitty.",
     "Submitty reads this file as validation_results.json.", .kind = VALUE_FILE, .store = store_text,
     FIELD(check.submitty)},
    {"write-contract", 0, GROUP_CHECK, "FILE", NULL, "Write a commented contract for the shaders.",
     "If Lambent recognises a contract, the file contains that contract. Otherwise, Lambent infers the role of each "
     "input from the shader and writes these roles to the file. Correct the file, then check with `--contract FILE` "
     "(`docs/check/contract-file.md`).",
     .kind = VALUE_FILE, .store = store_text, FIELD(check.write_contract)},
    {"role", 0, GROUP_CHECK, "NAME=ROLE", NULL, "State the role of an input, such as observer=eye; repeatable.",
     "The roles are light, direction (to the light), -direction (from the light), axis, -axis, eye, factor, and the "
     "roles of matrices that `--explain-roles` names. Lambent finds the other roles. The option is for shaders whose "
     "names fit no contract; a contract states all roles.",
     .store = store_texts, .others = "meaning semantic", FIELD(check.roles)},
    {"explain-roles", 0, GROUP_CHECK, NULL, NULL, "Print the role of each input, and the reason.", NULL,
     .store = store_switch, FIELD(check.explain_roles)},
    {"list", 0, GROUP_CHECK, NULL, NULL, "Print the contracts, the scenes and the known mistakes.", NULL,
     .store = store_switch, FIELD(check.list)},
    {"glsl", 0, GROUP_SHADER, "VERSION", "330", "The version of GLSL: 330, 120 or 300es.",
     "Lambent also accepts \"300 es\", as in the first line of a shader.", glsl_words, .store = store_glsl,
     .others = "glsl-version shader-version", FIELD(shader.glsl)},
    {"host", 0, GROUP_SHADER, "LANGUAGE", NULL,
     "Also print code, in this language, that sets all inputs of the shaders: c.",
     "The code compiles the sources, describes the vertex layout to OpenGL and sets every uniform to its value in this "
     "picture. The code calls only OpenGL. `-o NAME` writes the code to `NAME.c`.",
     host_words, .store = store_word, FIELD(shader.host)},
    {"products", 0, GROUP_SHADER, NULL, NULL,
     "Pass the products ka La, kd Ld and ks Ls as uniforms. This is common in lectures.", NULL, .store = store_switch,
     FIELD(shader.products)},
    {"lights-in", 0, GROUP_SHADER, "STORAGE", "auto", "How the shaders store the lights: array, block or texture.",
     "Lambent sets no maximum number of lights. OpenGL's limit is lowest for an array, higher for a block, and highest "
     "for a texture.",
     lights_in_words, .store = store_word, FIELD(shader.lights_in)},
    {"style", 0, GROUP_SHADER, "STYLE", "full", "The style of the shaders: full or lecture.",
     "The lecture style uses symbols that are common in lectures: N, L, V, R, H, ka, kd, ks. For `lambert`, `phong`, "
     "`blinn-phong`, "
     "`kajiya-kay`, `toon` and `gooch`, with any lights and any shading, the uniforms and the picture are the same as "
     "in the full "
     "style. Lambent rejects textures and other reflection models in this style. With `--stage application`, Lambent "
     "also prints a C function that computes the lighting of the vertices. See `docs/teaching.md`.",
     style_words, .store = store_word, FIELD(shader.style)},
    {"mistake", 0, GROUP_SHADER, "NAME", NULL,
     "Introduce a known mistake into shaders of the lecture style; `list` prints the known mistakes.",
     "`no-gate+no-ambient` introduces two. `lambent check` reports the mistakes, and `lambent exercises` makes "
     "exercises of them. `lambent "
     "compare MODEL "
     "--across mistake=A,B` shows the effect of mistakes. `--mistake list --json` prints the list for programs.",
     .store = store_text, .others = "error bug fault wrong", FIELD(shader.mistake)},
    {"parametric", 0, GROUP_SHAPE, "FORMULAS", NULL,
     "A surface over u and v: 'x = ...; y = ...; z = ...'; definitions may come first.",
     "`a = 2; x = (a + cos(v))*cos(u); y = (a + cos(v))*sin(u); z = sin(v)` is a torus. Formulas support `+ - * / ^`, "
     "parentheses, `pi`, `tau`, `e`, and these functions: sin cos tan asin acos atan atan2 sinh cosh tanh exp log sqrt "
     "cbrt abs sign floor mod min max hypot pow. Normals come from symbolic derivatives. z is up, as in textbooks, "
     "unless you give `--up`. `docs/shapes.md` describes the language and gives examples.",
     .store = store_text, .others = "formula formulas surface equation", FIELD(shape.parametric), .loads = true},
    {"u", 0, GROUP_SHAPE, "FROM..TO", "0..2pi", "The range of u: two constant expressions.", NULL, .store = store_text,
     .others = "u-range", FIELD(shape.u_range), .loads = true},
    {"v", 0, GROUP_SHAPE, "FROM..TO", "0..2pi", "The range of v: two constant expressions.", NULL, .store = store_text,
     .others = "v-range", FIELD(shape.v_range), .loads = true},
    {"implicit", 0, GROUP_SHAPE, "FORMULA", NULL,
     "The surface on which an expression of x, y and z is zero: 'x^2+y^2+z^2-1'.",
     "The expression is negative inside the surface. You can also write an equation: `x^2+y^2+z^2 = 1` is the same "
     "surface. Definitions may precede the expression: `a = 2; (sqrt(x^2+y^2)-a)^2 + z^2 - 1`. The language is the "
     "same as in `--parametric`. Normals come from the symbolic gradient. `--segments` sets the number of cells along "
     "the longest side of the box around the surface (default: 96).",
     .store = store_text, .others = "implicit-surface isosurface level-set marching-cubes sdf", FIELD(shape.implicit),
     .loads = true},
    {"x", 0, GROUP_SHAPE, "FROM..TO", "around the surface",
     "The range of x in which Lambent draws an implicit surface.",
     "Give two constant expressions. By default, Lambent searches for the surface in -4..4. If the surface is closed "
     "only in -16..16, Lambent uses that range.",
     .store = store_text, .others = "x-range box bounds", FIELD(shape.x_range), .loads = true},
    {"y", 0, GROUP_SHAPE, "FROM..TO", "around the surface", "The range of y, as for `--x`.", NULL, .store = store_text,
     .others = "y-range", FIELD(shape.y_range), .loads = true},
    {"z", 0, GROUP_SHAPE, "FROM..TO", "around the surface", "The range of z, as for `--x`.", NULL, .store = store_text,
     .others = "z-range", FIELD(shape.z_range), .loads = true},
    {"flip", 0, GROUP_SHAPE, NULL, NULL, "Swap front and back faces.",
     "By default, the front of a parametric surface is the side to which the cross product of the derivatives with "
     "respect to u and v points. The front of an implicit surface is the side to which the gradient points.",
     .store = store_switch, .others = "flip-normals invert-normals", FIELD(shading.flip), .loads = true},
    {"object", 0, GROUP_SHADER, "N", "all", "Print the shaders for only one object of the scene, counted from 0.",
     "One pair of shaders usually works for the whole scene. Exceptions are scenes in which only some objects are "
     "two-sided, or only some have tangents for Kajiya-Kay.",
     .store = store_integer, FIELD(shader.object), .has_field = offsetof(struct options, shader.has_object), .min = 0,
     .max = 1e9},

    {"port", 0, GROUP_VIEWER, "N", "any free port", "The port of 127.0.0.1 that the viewer listens on.", NULL,
     .store = store_integer, FIELD(viewer.port), .min = 1, .max = 65535},
    {"idle", 0, GROUP_VIEWER, "MINUTES", "30", "Stop if no page has been open for this many minutes.", NULL,
     .store = store_number, .others = "idle-timeout", FIELD(viewer.idle_minutes),
     .has_field = offsetof(struct options, viewer.has_idle), .min = 0.001, .max = 1e6},
    {"no-open", 0, GROUP_VIEWER, NULL, NULL, "Print the address, but do not open a browser.",
     "Without a display, Lambent never opens a browser.", .store = store_switch, .others = "no-browser headless",
     FIELD(viewer.no_open)},

    {"font", 0, GROUP_CAPTIONS, "FILE", "the system's", "The font of captions: a TrueType or OpenType file.",
     "By default, Lambent uses the font that the environment variable `LAMBENT_FONT` names. If this variable is not "
     "set, Lambent uses the first of these fonts that it finds in Debian's font folders: DejaVu Sans, Liberation Sans, "
     "Noto Sans, FreeSans, Roboto. FreeType draws the letters. With another version of FreeType, the letters may look "
     "slightly different. The pictures on the sheet do not change. An SVG file requests DejaVu Sans, but the "
     "viewer may use another font.",
     .kind = VALUE_FILE, .store = store_text, .others = "typeface", FIELD(captions.font)},
    {"figure", 0, GROUP_FIGURE, "NAME", "vectors", "The small figure of `explain -o`, below the picture.", NULL,
     figure_words, .store = store_word, FIELD(captions.figure)},
    {"no-captions", 0, GROUP_CAPTIONS, NULL, NULL, "Omit all text. Lambent then needs no font.", NULL,
     .store = store_switch, .others = "no-text no-labels", FIELD(captions.no_captions)},

    {"config", 0, GROUP_SETTINGS, "FILE", "lambent.json in the user's configuration folder",
     "The settings file. It uses the keys of scene files and replaces the default picture settings.",
     "Lambent reads `$XDG_CONFIG_HOME/lambent/lambent.json` or `~/.config/lambent/lambent.json`, if this file exists "
     "and the environment variable `CI` is not set. Lambent never reads a settings file from a model's folder. Looks "
     "and options on the command line override settings. Lambent does not apply settings to scene files. `lambent "
     "config` prints the current settings, and `docs/settings.md` describes the file.",
     .kind = VALUE_FILE, .store = store_text, .others = "settings preferences rc conf configuration",
     FIELD(settings.file)},
    {"no-config", 0, GROUP_SETTINGS, NULL, NULL, "Ignore the user's settings file.", NULL, .store = store_switch,
     .others = "no-settings norc defaults", FIELD(settings.none)},

    {"version", 0, GROUP_ABOUT, NULL, NULL, "Print the version and the build information.", NULL, .store = store_switch,
     .others = "V", FIELD(report.version)},
    {"help", 'h', GROUP_ABOUT, NULL, NULL, "Print the complete help; -h prints only the most common options.",
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
}
