// opengl_shader.c: makes shaders for Blinn-Phong reflection with point lights and attenuation, as in a plain OpenGL 3.3
// program. Lighting is evaluated in world space, so that lights need no transform.
#include "opengl_shader.h"

#include <stdio.h>
#include <stdlib.h>

static const char head[] = "#version 330 core\n"
                           "uniform vec3 eye, ambient;\n"
                           "uniform float shininess;\n";
static const char vertex_head[] = "uniform mat4 to_clip;\n"
                                  "layout(location = 0) in vec3 position;\n"
                                  "layout(location = 1) in vec3 normal;\n"
                                  "invariant gl_Position;\n";

static void loop_of_lights(FILE *text, const struct gl_scene *scene)
{
    fprintf(text,
            "struct light { vec4 position, diffuse, specular, attenuation; };\n"
            "layout(std140) uniform lights { light all[%d]; };\n"
            "vec3 lit(vec3 p, vec3 n)\n"
            "{\n"
            "    vec3 sum = ambient, v = normalize(eye - p);\n"
            "    for (int i = 0; i < %d; i++) {\n"
            "        vec3 to = all[i].position.xyz - p;\n"
            "        float d2 = dot(to, to), scale = inversesqrt(d2);\n"
            "        vec3 l = to * scale;\n"
            "        float nl = dot(n, l);\n"
            "        vec3 a = all[i].attenuation.xyz;\n"
            "        float fade = 1.0 / (a.x + a.y * d2 * scale + a.z * d2);\n"
            "        float nh = max(dot(n, normalize(l + v)), 0.0);\n"
            "        float highlight = nl > 0.0 ? pow(nh, shininess) : 0.0;\n"
            "        sum += fade * (all[i].diffuse.xyz * max(nl, 0.0) + all[i].specular.xyz * highlight);\n"
            "    }\n"
            "    return sum;\n"
            "}\n",
            scene->light_count, scene->light_count);
}

// Computes x to the power of the shininess by repeated squaring, with a multiplication for each set bit.
static void power_by_squarings(FILE *text, int exponent)
{
    fprintf(text, "float highlight_of(float x)\n{\n    float y = 1.0;\n");
    for (int rest = exponent; rest; rest >>= 1) {
        if (rest & 1)
            fprintf(text, "    y *= x;\n");
        if (rest > 1)
            fprintf(text, "    x *= x;\n");
    }
    fprintf(text, "    return y;\n}\n");
}

static void written_lights(FILE *text, const struct gl_scene *scene)
{
    power_by_squarings(text, scene->shininess);
    fprintf(text, "vec3 lit(vec3 p, vec3 n)\n{\n    vec3 sum = ambient, v = normalize(eye - p), to, l;\n"
                  "    float d2, scale, nl, fade, highlight;\n");
    for (int i = 0; i < scene->light_count; i++) {
        const struct point_light *light = &scene->lights[i];
        const float *p = light->position, *d = light->diffuse, *s = light->specular, *a = light->attenuation;
        fprintf(text,
                "    to = vec3(%.9e, %.9e, %.9e) - p;\n"
                "    d2 = dot(to, to); scale = inversesqrt(d2); l = to * scale; nl = dot(n, l);\n"
                "    fade = 1.0 / (%.9e + %.9e * d2 * scale + %.9e * d2);\n"
                "    highlight = nl > 0.0 ? highlight_of(max(dot(n, normalize(l + v)), 0.0)) : 0.0;\n"
                "    sum += fade * (vec3(%.9e, %.9e, %.9e) * max(nl, 0.0) + vec3(%.9e, %.9e, %.9e) * "
                "highlight);\n",
                (double)p[0], (double)p[1], (double)p[2], (double)a[0], (double)a[1], (double)a[2], (double)d[0],
                (double)d[1], (double)d[2], (double)s[0], (double)s[1], (double)s[2]);
    }
    fprintf(text, "    return sum;\n}\n");
}

static void lighting(FILE *text, const struct gl_scene *scene, struct form form)
{
    if (form.written_out)
        written_lights(text, scene);
    else
        loop_of_lights(text, scene);
}

struct text {
    FILE *file;
    char *bytes;
    size_t size;
};

static void begin(struct text *text)
{
    text->file = open_memstream(&text->bytes, &text->size);
    if (!text->file) {
        perror("opengl: shader");
        exit(1);
    }
    fputs(head, text->file);
}

static char *end(struct text *text)
{
    fclose(text->file);
    return text->bytes;
}

char *vertex_shader(const struct gl_scene *scene, struct form form)
{
    struct text text;
    begin(&text);
    fputs(vertex_head, text.file);
    if (scene->shading == PHONG) {
        fprintf(text.file, "out vec3 at, n;\nvoid main() { at = position; n = normal; gl_Position = to_clip "
                           "* vec4(position, 1.0); }\n");
    } else if (scene->shading == FLAT && form.derivatives) {
        fprintf(text.file, "out vec3 at;\nflat out vec3 last;\n"
                           "void main() { at = last = position; gl_Position = to_clip * vec4(position, 1.0); }\n");
    } else {
        lighting(text.file, scene, form);
        fprintf(text.file,
                "%sout vec3 color;\nvoid main() { color = lit(position, normal); gl_Position = to_clip * "
                "vec4(position, 1.0); }\n",
                scene->shading == FLAT ? "flat " : "");
    }
    return end(&text);
}

char *fragment_shader(const struct gl_scene *scene, struct form form)
{
    struct text text;
    begin(&text);
    fprintf(text.file, "out vec4 pixel;\n");
    if (scene->shading == PHONG) {
        lighting(text.file, scene, form);
        fprintf(text.file, "in vec3 at, n;\nvoid main() { pixel = vec4(lit(at, normalize(n)), 1.0); }\n");
    } else if (scene->shading == FLAT && form.derivatives) {
        lighting(text.file, scene, form);
        fprintf(text.file, "in vec3 at;\nflat in vec3 last;\n"
                           "void main() { pixel = vec4(lit(last, normalize(cross(dFdx(at), dFdy(at)))), 1.0); }\n");
    } else {
        fprintf(text.file, "%sin vec3 color;\nvoid main() { pixel = vec4(color, 1.0); }\n",
                scene->shading == FLAT ? "flat " : "");
    }
    return end(&text);
}

char *depth_vertex_shader(void)
{
    struct text text;
    begin(&text);
    fputs(vertex_head, text.file);
    fprintf(text.file, "void main() { gl_Position = to_clip * vec4(position, 1.0); }\n");
    return end(&text);
}

char *depth_fragment_shader(void)
{
    struct text text;
    begin(&text);
    fprintf(text.file, "void main() {}\n");
    return end(&text);
}
