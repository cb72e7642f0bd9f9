// shader_host.c: prints the C code of `lambent shader --host c`: OpenGL calls that set every uniform to the scene's
// value.
#include "foreign.h"
#include "json.h"
#include "shader.h"

#include <ctype.h>
#include <string.h>

void shader_numbers(FILE *file, const float *values, int count, bool code)
{
    for (int i = 0; i < count; i++) {
        char text[32];
        shortest_float(values[i], text);
        fprintf(file, "%s%s%s", i ? ", " : "", text, code && strpbrk(text, ".e") ? "f" : "");
    }
}

static void identifier(FILE *file, const char *name)
{
    for (; *name; name++)
        if (*name == ']')
            continue;
        else
            putc(isalnum((unsigned char)*name) ? *name : '_', file);
}

// --- single uniforms

// Returns true for single uniforms and for the first element of an array. The first element's comment describes the
// whole array.
static bool is_first(const lam_shader_uniform *u)
{
    const char *bracket = strchr(u->name, '[');
    return !bracket || strncmp(bracket, "[0]", 3) == 0;
}

static void set_uniform(FILE *file, const lam_shader_uniform *u)
{
    if (is_first(u))
        fprintf(file, "    // %s\n", u->meaning);
    static const struct setter {
        const char *type, *call, *transposed;
    } setters[] = {{"float", "glUniform1fv", ""},
                   {"vec3", "glUniform3fv", ""},
                   {"vec4", "glUniform4fv", ""},
                   {"mat3", "glUniformMatrix3fv", "GL_FALSE, "},
                   {"mat4", "glUniformMatrix4fv", "GL_FALSE, "}};
    if (strcmp(u->type, "int") == 0) {
        fprintf(file, "    glUniform1i(glGetUniformLocation(program, \"%s\"), %d);\n", u->name, (int)u->value[0]);
        return;
    }
    fprintf(file, "    static const GLfloat ");
    identifier(file, u->name);
    fprintf(file, "[%d] = {", u->count);
    shader_numbers(file, u->value, u->count, true);
    fprintf(file, "};\n");
    const struct setter *setter = setters;
    while (strcmp(setter->type, u->type) != 0)
        setter++;
    fprintf(file, "    %s(glGetUniformLocation(program, \"%s\"), 1, %s", setter->call, u->name, setter->transposed);
    identifier(file, u->name);
    fprintf(file, ");\n");
}

// --- blocks

static bool same_block(const lam_shader_uniform *a, const lam_shader_uniform *b)
{
    return a->block && b->block && strcmp(a->block, b->block) == 0;
}

// Prints the values of one block with its padding. Returns the index after the last uniform of the block.
static int block_numbers(FILE *file, const lam_shader_uniform *list, int count, int first)
{
    int at = 0, i = first;
    fprintf(file, "    static const GLfloat %s[] = {\n", list[first].block);
    for (; i < count && same_block(&list[first], &list[i]); i++) {
        fprintf(file, "        ");
        for (; at < list[i].offset; at += 4)
            fprintf(file, "0, ");
        shader_numbers(file, list[i].value, list[i].count, true);
        fprintf(file, ", // %s%s%s\n", list[i].name, is_first(&list[i]) ? ": " : "",
                is_first(&list[i]) ? list[i].meaning : "");
        at += 4 * list[i].count;
    }
    if (at % 16) {
        fprintf(file, "        ");
        for (; at % 16; at += 4)
            fprintf(file, "0, ");
        fprintf(file, "// padding to a whole vec4\n");
    }
    fprintf(file, "    };\n");
    return i;
}

static const char *const block_names[] = {"Lights", "Products", "BackProducts", "Materials"};

static int binding_of(const char *block)
{
    int binding = 0;
    while (strcmp(block_names[binding], block) != 0)
        binding++;
    return binding == 3 ? 1 : binding; // a shader contains Materials or Products, but not both
}

// Returns whether a uniform is the sampler of a material's map. The program that uses the printed code must load the
// picture.
static bool is_map(const lam_shader_uniform *u)
{
    return !u->count && strcmp(u->type, "sampler2D") == 0 && strcmp(u->name, "light_list") != 0 &&
           strcmp(u->name, "product_list") != 0 && strcmp(u->name, "environment_light") != 0;
}

// Prints a comment about the map's picture.
static void write_map(FILE *file, const lam_shader_uniform *u, int unit)
{
    if (!u->map) {
        fprintf(file, "    // %s: this draw has no such map, and reads 1 whatever is bound to unit %d\n", u->name,
                unit);
        return;
    }
    const char *name = lam_texture_name(u->map->texture);
    fprintf(file, "    // LEFT OUT: %s is the picture ", u->name);
    print_foreign(file, FOREIGN_COMMENT, FOREIGN(name ? name : "in the model"));
    fprintf(file, ", %dx%d, %s: bind it with glActiveTexture(GL_TEXTURE0 + %d)\n",
            lam_texture_width(u->map->texture, 0), lam_texture_height(u->map->texture, 0),
            lam_texture_values_of(u->map->texture) == LAM_TEXTURE_COLOR ? "sRGB colours, to be made linear" : "numbers",
            unit);
}

static void set_all(FILE *file, const lam_shader_uniform *list, int count)
{
    int unit = 2, map_unit = 4; // units 0 and 1 are for the lists of lights, 2 and 3 for the environment and its light
    for (int i = 0; i < count;) {
        const lam_shader_uniform *u = &list[i];
        if (u->block) {
            i = block_numbers(file, list, count, i);
            fprintf(file, "    set_block(program, \"%s\", %d, %s, sizeof %s);\n", u->block, binding_of(u->block),
                    u->block, u->block);
            continue;
        }
        bool lights = strcmp(u->name, "light_list") == 0;
        if (!u->count && (lights || strcmp(u->name, "product_list") == 0)) {
            fprintf(file, "    set_list(program, \"%s\", %d, %s, %s_texels);\n", u->name, !lights, u->name, u->name);
        } else if (is_map(u)) {
            write_map(file, u, map_unit);
            fprintf(file, "    glUniform1i(glGetUniformLocation(program, \"%s\"), %d);\n", u->name, map_unit);
            map_unit++;
        } else if (!u->count) {
            fprintf(file,
                    "    // %s\n    glUniform1i(glGetUniformLocation(program, \"%s\"), %d); // your texture: "
                    "glActiveTexture(GL_TEXTURE0 + %d)\n",
                    u->meaning, u->name, unit, unit);
            unit++;
        } else {
            set_uniform(file, u);
        }
        i++;
    }
}

static bool has_blocks(const lam_shader *s)
{
    bool any = false;
    for (int i = 0; i < s->uniform_count; i++)
        any |= s->uniforms[i].block != NULL;
    for (int i = 0; s->draw_count && i < s->draws[0].uniform_count; i++)
        any |= s->draws[0].uniforms[i].block != NULL;
    return any;
}

static void write_block_setter(FILE *file)
{
    fputs("// Sets the values of a uniform block. The buffer of a binding is created once and kept.\n"
          "static void set_block(GLuint program, const char *name, GLuint binding, const GLfloat *values, "
          "size_t bytes)\n"
          "{\n"
          "    static GLuint buffers[4];\n"
          "    if (!buffers[binding])\n"
          "        glGenBuffers(1, &buffers[binding]);\n"
          "    glBindBuffer(GL_UNIFORM_BUFFER, buffers[binding]);\n"
          "    glBufferData(GL_UNIFORM_BUFFER, (GLsizeiptr)bytes, values, GL_DYNAMIC_DRAW);\n"
          "    glBindBufferBase(GL_UNIFORM_BUFFER, binding, buffers[binding]);\n"
          "    glUniformBlockBinding(program, glGetUniformBlockIndex(program, name), binding);\n"
          "}\n\n",
          file);
}

static void write_lists(FILE *file, const lam_shader *s)
{
    for (int i = 0; i < s->texture_count; i++) {
        const lam_shader_texture *list = &s->textures[i];
        fprintf(file, "static const GLsizei %s_texels = %d;\nstatic const GLfloat %s[] = {\n", list->name, list->texels,
                list->name);
        for (int k = 0; k < list->texels; k++) {
            fprintf(file, "    ");
            shader_numbers(file, list->values + 4 * (size_t)k, 4, true);
            fprintf(file, ",\n");
        }
        fprintf(file, "};\n\n");
    }
    if (s->texture_count)
        fputs("// Sets a list as a texture of floats, 1024 texels in a row. The texture of a unit is created once "
              "and kept.\n"
              "static void set_list(GLuint program, const char *name, GLint unit, const GLfloat *values, "
              "GLsizei texels)\n"
              "{\n"
              "    static GLuint textures[2];\n"
              "    GLsizei rows = texels / 1024, rest = texels % 1024;\n"
              "    glActiveTexture(GL_TEXTURE0 + (GLenum)unit);\n"
              "    if (!textures[unit])\n"
              "        glGenTextures(1, &textures[unit]);\n"
              "    glBindTexture(GL_TEXTURE_2D, textures[unit]);\n"
              "    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);\n"
              "    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);\n"
              "    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA32F, 1024, rows + (rest > 0), 0, GL_RGBA, GL_FLOAT, "
              "NULL);\n"
              "    if (rows)\n"
              "        glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, 1024, rows, GL_RGBA, GL_FLOAT, values);\n"
              "    if (rest)\n"
              "        glTexSubImage2D(GL_TEXTURE_2D, 0, 0, rows, rest, 1, GL_RGBA, GL_FLOAT, values + 4096 "
              "* (size_t)rows);\n"
              "    glUniform1i(glGetUniformLocation(program, name), unit);\n"
              "}\n\n",
              file);
}

static void write_name(FILE *file, const char *before, const char *name)
{
    fputs(name ? before : "", file);
    print_foreign(file, FOREIGN_COMMENT, FOREIGN(name));
    fputs(name ? "'" : "", file);
}

// --- vertices and draws

static void write_vertices(FILE *file, const lam_shader *s)
{
    if (s->flat)
        fprintf(file, "// A vertex; each triangle has three of its own%s.\n",
                s->glsl == LAM_GLSL_120 ? "; they differ only in position" : "");
    else
        fprintf(file, "// A vertex.\n");
    fprintf(file, "struct vertex {\n");
    for (int i = 0; i < s->attribute_count; i++)
        fprintf(file, "    GLfloat %s[%c]; // %s\n", s->attributes[i].name, s->attributes[i].type[3],
                s->attributes[i].meaning);
    fputs("};\n\n"
          "// Describes the vertex layout to OpenGL. The buffer of vertices must be bound to GL_ARRAY_BUFFER\n"
          "// (and, if OpenGL requires it, a vertex array object must be bound).\n"
          "static void set_vertices(void)\n{\n",
          file);
    for (int i = 0; i < s->attribute_count; i++) {
        const lam_shader_attribute *a = &s->attributes[i];
        fprintf(file,
                "    glEnableVertexAttribArray(%d);\n"
                "    glVertexAttribPointer(%d, %c, GL_FLOAT, GL_FALSE, sizeof(struct vertex), (const void "
                "*)offsetof(struct vertex, %s));\n",
                a->location, a->location, a->type[3], a->name);
    }
    fprintf(file, "}\n\n");
}

static void write_program(FILE *file, const lam_shader *s)
{
    fputs("// Compiles and links the two sources. 0: the errors are in `log`.\n"
          "static GLuint make_program(const char *vertex, const char *fragment, char *log, GLsizei log_size)\n"
          "{\n"
          "    const char *const sources[2] = {vertex, fragment};\n"
          "    GLuint program = glCreateProgram();\n"
          "    GLint ok = 1;\n"
          "    int i;\n"
          "    for (i = 0; ok && i < 2; i++) {\n"
          "        GLuint shader = glCreateShader(i ? GL_FRAGMENT_SHADER : GL_VERTEX_SHADER);\n"
          "        glShaderSource(shader, 1, &sources[i], NULL);\n"
          "        glCompileShader(shader);\n"
          "        glGetShaderiv(shader, GL_COMPILE_STATUS, &ok);\n"
          "        if (!ok)\n"
          "            glGetShaderInfoLog(shader, log_size, NULL, log);\n"
          "        glAttachShader(program, shader);\n"
          "        glDeleteShader(shader);\n"
          "    }\n",
          file);
    for (int i = 0; s->glsl == LAM_GLSL_120 && i < s->attribute_count; i++)
        fprintf(file, "    glBindAttribLocation(program, %d, \"%s\");\n", s->attributes[i].location,
                s->attributes[i].name);
    fputs("    if (ok) {\n"
          "        glLinkProgram(program);\n"
          "        glGetProgramiv(program, GL_LINK_STATUS, &ok);\n"
          "        if (!ok)\n"
          "            glGetProgramInfoLog(program, log_size, NULL, log);\n"
          "    }\n"
          "    if (ok)\n"
          "        return program;\n"
          "    glDeleteProgram(program);\n"
          "    return 0;\n"
          "}\n\n",
          file);
}

static bool uses_color(const lam_shader *s)
{
    bool uses = false;
    for (int i = 0; i < s->attribute_count; i++)
        uses |= strcmp(s->attributes[i].name, "color") == 0;
    return uses;
}

static void write_draw(FILE *file, const lam_shader *s, const lam_shader_draw *d, int number)
{
    fprintf(file, "// Object %d", d->object);
    write_name(file, ", '", d->object_name);
    fprintf(file, ": triangles %u to %u of its mesh", d->first_triangle, d->first_triangle + d->triangle_count - 1);
    write_name(file, ", material '", d->material_name);
    fprintf(file, ".\n");
    if (d->origin[0] != 0 || d->origin[1] != 0 || d->origin[2] != 0)
        fprintf(file, "// Pass `position` relative to (%.17g, %.17g, %.17g), subtracted in double.\n", d->origin[0],
                d->origin[1], d->origin[2]);
    if (d->translucent)
        fprintf(file, "// Translucent: draw this after all opaque draws, with blending, the farthest first.\n");
    fprintf(file, "static void set_draw_%d(GLuint program)\n{\n", number);
    set_all(file, d->uniforms, d->uniform_count);
    fprintf(file, "    glFrontFace(%s);\n", d->clockwise ? "GL_CW" : "GL_CCW");
    if (d->cull == LAM_CULL_NONE)
        fprintf(file, "    glDisable(GL_CULL_FACE);\n");
    else
        fprintf(file, "    glEnable(GL_CULL_FACE);\n    glCullFace(%s);\n",
                d->cull == LAM_CULL_BACK ? "GL_BACK" : "GL_FRONT");
    if (uses_color(s) && !d->has_colors)
        fprintf(file, "    glDisableVertexAttribArray(2); // this mesh has no colours\n    "
                      "glVertexAttrib4f(2, 1, 1, 1, 1);\n");
    fprintf(file, "}\n\n");
}

void shader_host(FILE *file, const lam_shader *s, const char *name, const char *model)
{
    fputs("// Sets the inputs of ", file);
    print_foreign(file, FOREIGN_COMMENT, FOREIGN(name));
    fputs(" (.vert and .frag) for the picture of ", file);
    write_name(file, "'", model);
    fprintf(file,
            ". Made by lambent %s.\n"
            "// Include it after the header that declares OpenGL's functions, and <stddef.h>. The program:\n"
            "//     program = make_program(vertex, fragment, log, sizeof log);  glUseProgram(program);\n"
            "//     set_frame(program);  glEnable(GL_DEPTH_TEST);\n"
            "//     for each draw d: set_vertices() with the mesh's buffer bound; set_draw[d](program);\n"
            "//                      glDrawArrays(GL_TRIANGLES, 3 * draws[d].first, 3 * draws[d].count);\n"
            "// where the buffer holds three vertices for each triangle of the object's mesh, in the "
            "order of the file.\n\n",
            lam_version());
    if (s->application)
        fputs("// The colours of a vertex of draw d are computed by light_vertex(d, ...) of the .application.c file of "
              "that name,\n// which is compiled beside this program.\n\n",
              file);
    bool maps = false;
    for (int i = 0; i < s->draw_count; i++)
        for (int k = 0; k < s->draws[i].uniform_count; k++)
            maps |= is_map(&s->draws[i].uniforms[k]);
    if (maps)
        fputs("// LEFT OUT: the pictures of textures, which this code does not load. Before a draw, bind the textures "
              "that set_draw names:\n"
              "// linear RGBA, the first row at the top, with all levels of detail (glGenerateMipmap). Set\n"
              "// GL_TEXTURE_MIN_FILTER to GL_NEAREST_MIPMAP_NEAREST and GL_TEXTURE_MAG_FILTER to GL_NEAREST, because "
              "the\n"
              "// shader filters the textures itself. Without a texture, the map is black.\n\n",
              file);
    write_vertices(file, s);
    write_program(file, s);
    if (has_blocks(s))
        write_block_setter(file);
    write_lists(file, s);
    fprintf(file, "// Sets the uniforms of the whole picture. The program is in use.\nstatic void set_frame(GLuint "
                  "program)\n{\n");
    if (s->uniform_count)
        set_all(file, s->uniforms, s->uniform_count);
    else
        fprintf(file, "    (void)program;\n");
    fprintf(file, "}\n\n");
    for (int i = 0; i < s->draw_count; i++)
        write_draw(file, s, &s->draws[i], i);
    fprintf(file,
            "// The draws, in order.\nenum { DRAWS = %d };\nstatic void (*const set_draw[DRAWS])(GLuint "
            "program) = {",
            s->draw_count);
    for (int i = 0; i < s->draw_count; i++)
        fprintf(file, "%sset_draw_%d", i ? ", " : "", i);
    fprintf(file, "};\nstatic const struct draw {\n    int object;\n    GLint first; // triangle of its "
                  "mesh\n    GLsizei count;\n} draws[DRAWS] = {");
    for (int i = 0; i < s->draw_count; i++)
        fprintf(file, "%s{%d, %u, %u}", i ? ", " : "", s->draws[i].object, s->draws[i].first_triangle,
                s->draws[i].triangle_count);
    fprintf(file, "};\n");
}
