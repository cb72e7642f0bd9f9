// opengl.c: a plain, competent OpenGL 3.3 program that draws the benchmark's scenes, so that its frame times can be
// compared with Lambent's:
//     opengl SCENE.txt loop|written [--derivatives] [--depth-first] [--cull] [--frames N] [--seconds S]
//            [--picture FILE.ppm]
//
// The program has no window. It draws in an EGL context without a surface, to its own framebuffer with 8 bits per
// channel and 24 bits of depth. On request the framebuffer is multisampled and resolved in each frame. Buffers are
// uploaded once. A frame consists of a clear, one draw call and glFinish. Pixels are not read back. With --depth-first
// there are two draw calls, and the first writes only depth, so that only visible fragments are lit. With --cull, back
// faces are not drawn. After one frame to warm up, the program draws N frames, or draws for S seconds. It prints a line
// of JSON. The exit code is 3 if OpenGL 3.3 is not available.
#define GL_GLEXT_PROTOTYPES
#include <GL/glcorearb.h>

#include <EGL/egl.h>
#include <EGL/eglext.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "opengl_shader.h"

enum { NO_OPENGL = 3, FRAMES_MOST = 1000 };

static void give_up(int code, const char *what, const char *detail)
{
    fprintf(stderr, "opengl: %s%s%s\n", what, *detail ? ": " : "", detail);
    exit(code);
}

static double now_ms(void)
{
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec * 1e3 + (double)t.tv_nsec * 1e-6;
}

static void make_context(void)
{
    PFNEGLGETPLATFORMDISPLAYEXTPROC get_display =
        (PFNEGLGETPLATFORMDISPLAYEXTPROC)(void *)eglGetProcAddress("eglGetPlatformDisplayEXT");
    EGLDisplay display =
        get_display ? get_display(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, NULL) : EGL_NO_DISPLAY;
    if (display == EGL_NO_DISPLAY || !eglInitialize(display, NULL, NULL))
        give_up(NO_OPENGL, "no EGL display without a window", "install libegl-mesa0 and libgl1-mesa-dri");
    const EGLint wanted[] = {EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT, EGL_NONE};
    const EGLint version[] = {
        EGL_CONTEXT_MAJOR_VERSION,           3,       EGL_CONTEXT_MINOR_VERSION, 3, EGL_CONTEXT_OPENGL_PROFILE_MASK,
        EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT, EGL_NONE};
    EGLConfig config = NULL;
    EGLint count = 0;
    eglBindAPI(EGL_OPENGL_API);
    // A display without surfaces may have no configuration for windows. None is needed.
    if (!eglChooseConfig(display, wanted, &config, 1, &count) || count < 1)
        config = NULL;
    EGLContext context = eglCreateContext(display, config, EGL_NO_CONTEXT, version);
    if (context == EGL_NO_CONTEXT || !eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, context))
        give_up(NO_OPENGL, "no OpenGL 3.3 context", "");
}

static GLuint compile(GLenum kind, char *text)
{
    GLuint shader = glCreateShader(kind);
    GLint done = 0;
    char log[2000] = "";
    glShaderSource(shader, 1, (const char *const *)&text, NULL);
    glCompileShader(shader);
    glGetShaderiv(shader, GL_COMPILE_STATUS, &done);
    glGetShaderInfoLog(shader, sizeof log, NULL, log);
    if (!done)
        give_up(1, "a shader does not compile", log);
    free(text);
    return shader;
}

// Computes the product of the perspective matrix and the look-at matrix, column-major, as OpenGL expects.
static void clip_matrix(const struct gl_scene *scene, float *result)
{
    double back[3], right[3], top[3];
    double length = 0;
    for (int k = 0; k < 3; k++)
        back[k] = scene->eye[k] - scene->target[k], length += back[k] * back[k];
    for (int k = 0; k < 3; k++)
        back[k] /= sqrt(length);
    const double *up = scene->up;
    right[0] = up[1] * back[2] - up[2] * back[1];
    right[1] = up[2] * back[0] - up[0] * back[2];
    right[2] = up[0] * back[1] - up[1] * back[0];
    length = sqrt(right[0] * right[0] + right[1] * right[1] + right[2] * right[2]);
    for (int k = 0; k < 3; k++)
        right[k] /= length;
    top[0] = back[1] * right[2] - back[2] * right[1];
    top[1] = back[2] * right[0] - back[0] * right[2];
    top[2] = back[0] * right[1] - back[1] * right[0];
    double near_plane = scene->near_plane, far_plane = scene->far_plane;
    double y_scale = 1 / tan(scene->fovy_degrees * 3.14159265358979323846 / 360);
    double x_scale = y_scale * scene->height / scene->width;
    double z_scale = (near_plane + far_plane) / (near_plane - far_plane);
    double z_move = 2 * near_plane * far_plane / (near_plane - far_plane);
    const double *rows[3] = {right, top, back};
    for (int column = 0; column < 4; column++) {
        double eye_space[3] = {0};
        for (int row = 0; row < 3; row++)
            if (column < 3)
                eye_space[row] = rows[row][column];
            else
                for (int k = 0; k < 3; k++)
                    eye_space[row] -= rows[row][k] * scene->eye[k];
        result[4 * column + 0] = (float)(x_scale * eye_space[0]);
        result[4 * column + 1] = (float)(y_scale * eye_space[1]);
        result[4 * column + 2] = (float)(z_scale * eye_space[2] + (column == 3 ? z_move : 0));
        result[4 * column + 3] = (float)-eye_space[2];
    }
}

// Links two shaders, uses the program and sets its camera.
static GLuint make_program(const struct gl_scene *scene, char *vertex, char *fragment)
{
    GLuint program = glCreateProgram();
    GLint done = 0;
    char log[2000] = "";
    glAttachShader(program, compile(GL_VERTEX_SHADER, vertex));
    glAttachShader(program, compile(GL_FRAGMENT_SHADER, fragment));
    glLinkProgram(program);
    glGetProgramiv(program, GL_LINK_STATUS, &done);
    glGetProgramInfoLog(program, sizeof log, NULL, log);
    if (!done)
        give_up(1, "the shaders do not link", log);
    glUseProgram(program);
    float matrix[16];
    clip_matrix(scene, matrix);
    glUniformMatrix4fv(glGetUniformLocation(program, "to_clip"), 1, GL_FALSE, matrix);
    return program;
}

struct programs {
    GLuint lit, depth; // 0 for `depth` without --depth-first
};

static struct programs make_programs(const struct gl_scene *scene, struct form form, int depth_first)
{
    struct programs programs = {0};
    if (depth_first)
        programs.depth = make_program(scene, depth_vertex_shader(), depth_fragment_shader());
    GLuint program = programs.lit = make_program(scene, vertex_shader(scene, form), fragment_shader(scene, form));
    glUniform3f(glGetUniformLocation(program, "eye"), (float)scene->eye[0], (float)scene->eye[1], (float)scene->eye[2]);
    glUniform3fv(glGetUniformLocation(program, "ambient"), 1, scene->ambient);
    glUniform1f(glGetUniformLocation(program, "shininess"), (float)scene->shininess);
    if (form.written_out)
        return programs;
    float *block = calloc((size_t)scene->light_count, 16 * sizeof(float));
    GLuint buffer;
    for (int i = 0; block && i < scene->light_count; i++) {
        memcpy(block + 16 * i, scene->lights[i].position, 12);
        memcpy(block + 16 * i + 4, scene->lights[i].diffuse, 12);
        memcpy(block + 16 * i + 8, scene->lights[i].specular, 12);
        memcpy(block + 16 * i + 12, scene->lights[i].attenuation, 12);
    }
    glGenBuffers(1, &buffer);
    glBindBuffer(GL_UNIFORM_BUFFER, buffer);
    glBufferData(GL_UNIFORM_BUFFER, (GLsizeiptr)(64 * (size_t)scene->light_count), block, GL_STATIC_DRAW);
    glBindBufferBase(GL_UNIFORM_BUFFER, 0, buffer);
    free(block);
    return programs;
}

static void put_vertex(float *to, const struct gl_scene *scene, size_t vertex, const float *normal)
{
    memcpy(to, scene->positions + 3 * vertex, 12);
    memcpy(to + 3, normal, 12);
}

// Uploads shared vertices and indices. For flat shading in the vertex shader, uploads three vertices with the face
// normal for each triangle.
static void upload(const struct gl_scene *scene, int shared)
{
    size_t count = shared ? scene->vertices : 3 * scene->triangles;
    float *data = malloc(count * 24);
    if (!data)
        give_up(1, "no memory for the vertices", "");
    for (size_t v = 0; shared && v < count; v++)
        put_vertex(data + 6 * v, scene, v, scene->normals + 3 * v);
    for (size_t t = 0; !shared && t < scene->triangles; t++) {
        const uint32_t *corner = scene->indices + 3 * t;
        const float *p[3];
        for (int k = 0; k < 3; k++)
            p[k] = scene->positions + 3 * (size_t)corner[k];
        float a[3], b[3], n[3];
        for (int k = 0; k < 3; k++)
            a[k] = p[1][k] - p[0][k], b[k] = p[2][k] - p[0][k];
        for (int k = 0; k < 3; k++)
            n[k] = a[(k + 1) % 3] * b[(k + 2) % 3] - a[(k + 2) % 3] * b[(k + 1) % 3];
        float length = sqrtf(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
        for (int k = 0; k < 3; k++)
            n[k] = length > 0 ? n[k] / length : 0;
        for (size_t k = 0; k < 3; k++)
            put_vertex(data + 6 * (3 * t + k), scene, corner[k], n);
    }
    GLuint array, buffers[2];
    glGenVertexArrays(1, &array);
    glBindVertexArray(array);
    glGenBuffers(2, buffers);
    glBindBuffer(GL_ARRAY_BUFFER, buffers[0]);
    glBufferData(GL_ARRAY_BUFFER, (GLsizeiptr)(count * 24), data, GL_STATIC_DRAW);
    glVertexAttribPointer(0, 3, GL_FLOAT, GL_FALSE, 24, (void *)0);
    glVertexAttribPointer(1, 3, GL_FLOAT, GL_FALSE, 24, (void *)12);
    glEnableVertexAttribArray(0);
    glEnableVertexAttribArray(1);
    if (shared) {
        glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, buffers[1]);
        glBufferData(GL_ELEMENT_ARRAY_BUFFER, (GLsizeiptr)(12 * scene->triangles), scene->indices, GL_STATIC_DRAW);
    }
    free(data);
}

static GLuint make_target(const struct gl_scene *scene, int samples)
{
    GLuint target, planes[2];
    glGenFramebuffers(1, &target);
    glBindFramebuffer(GL_FRAMEBUFFER, target);
    glGenRenderbuffers(2, planes);
    for (int i = 0; i < 2; i++) {
        glBindRenderbuffer(GL_RENDERBUFFER, planes[i]);
        glRenderbufferStorageMultisample(GL_RENDERBUFFER, samples > 1 ? samples : 0,
                                         i ? GL_DEPTH_COMPONENT24 : GL_RGBA8, scene->width, scene->height);
        glFramebufferRenderbuffer(GL_FRAMEBUFFER, i ? GL_DEPTH_ATTACHMENT : GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER,
                                  planes[i]);
    }
    GLint got = 0;
    glGetRenderbufferParameteriv(GL_RENDERBUFFER, GL_RENDERBUFFER_SAMPLES, &got);
    if (glCheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE || (samples > 1 && got != samples))
        give_up(NO_OPENGL, "no framebuffer of that size and number of samples", "");
    return target;
}

static void draw_triangles(const struct gl_scene *scene, int shared)
{
    if (shared)
        glDrawElements(GL_TRIANGLES, (GLsizei)(3 * scene->triangles), GL_UNSIGNED_INT, NULL);
    else
        glDrawArrays(GL_TRIANGLES, 0, (GLsizei)(3 * scene->triangles));
}

static void draw(const struct gl_scene *scene, const struct programs *programs, int shared, GLuint target,
                 GLuint resolved)
{
    glBindFramebuffer(GL_FRAMEBUFFER, target);
    glDepthMask(GL_TRUE);
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    if (programs->depth) {
        glUseProgram(programs->depth);
        glColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
        glDepthFunc(GL_LESS);
        draw_triangles(scene, shared);
        glUseProgram(programs->lit);
        glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
        glDepthFunc(GL_EQUAL);
        glDepthMask(GL_FALSE);
    }
    draw_triangles(scene, shared);
    if (resolved != target) {
        glBindFramebuffer(GL_DRAW_FRAMEBUFFER, resolved);
        glBlitFramebuffer(0, 0, scene->width, scene->height, 0, 0, scene->width, scene->height, GL_COLOR_BUFFER_BIT,
                          GL_NEAREST);
    }
    glFinish();
}

static void save_picture(const struct gl_scene *scene, const char *path)
{
    size_t row = (size_t)scene->width * 3;
    unsigned char *pixels = malloc(row * (size_t)scene->height);
    FILE *file = fopen(path, "wb");
    if (!pixels || !file)
        give_up(1, "cannot write", path);
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    glReadPixels(0, 0, scene->width, scene->height, GL_RGB, GL_UNSIGNED_BYTE, pixels);
    fprintf(file, "P6\n%d %d\n255\n", scene->width, scene->height);
    for (int y = scene->height; y-- > 0;)
        fwrite(pixels + row * (size_t)y, 1, row, file);
    fclose(file);
    free(pixels);
}

static int by_size(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

int main(int count, char **arguments)
{
    if (count < 3)
        give_up(1, "usage",
                "opengl SCENE.txt loop|written [--derivatives] [--depth-first] [--cull] [--frames N] [--seconds S] "
                "[--picture FILE.ppm]");
    struct form form = {.written_out = strcmp(arguments[2], "written") == 0};
    int frames = 10, depth_first = 0, cull = 0;
    double seconds = 5;
    const char *picture = NULL;
    for (int i = 3; i < count; i++) {
        if (strcmp(arguments[i], "--derivatives") == 0)
            form.derivatives = 1;
        else if (strcmp(arguments[i], "--depth-first") == 0)
            depth_first = 1;
        else if (strcmp(arguments[i], "--cull") == 0)
            cull = 1;
        else if (i + 1 < count && strcmp(arguments[i], "--frames") == 0)
            frames = atoi(arguments[++i]);
        else if (i + 1 < count && strcmp(arguments[i], "--seconds") == 0)
            seconds = atof(arguments[++i]);
        else if (i + 1 < count && strcmp(arguments[i], "--picture") == 0)
            picture = arguments[++i];
        else
            give_up(1, "unknown argument", arguments[i]);
    }
    if (frames < 1 || frames > FRAMES_MOST)
        give_up(1, "--frames", "expected 1 to 1000");
    struct gl_scene scene = gl_scene_read(arguments[1]);
    make_context();
    double start = now_ms();
    int shared = scene.shading != FLAT || form.derivatives;
    struct programs programs = make_programs(&scene, form, depth_first);
    upload(&scene, shared);
    GLuint resolved = make_target(&scene, 1);
    GLuint target = scene.samples > 1 ? make_target(&scene, scene.samples) : resolved;
    glViewport(0, 0, scene.width, scene.height);
    glEnable(GL_DEPTH_TEST);
    if (cull)
        glEnable(GL_CULL_FACE);
    glClearColor(0, 0, 0, 1);
    draw(&scene, &programs, shared, target, resolved);
    double setup_ms = now_ms() - start;

    static double times[FRAMES_MOST];
    int drawn = 0;
    double begun = now_ms();
    while (drawn < frames && (drawn == 0 || now_ms() - begun < seconds * 1e3)) {
        double before = now_ms();
        draw(&scene, &programs, shared, target, resolved);
        times[drawn++] = now_ms() - before;
    }
    if (picture) {
        glBindFramebuffer(GL_FRAMEBUFFER, resolved);
        save_picture(&scene, picture);
    }
    if (glGetError() != GL_NO_ERROR)
        give_up(1, "OpenGL reported an error", "");
    qsort(times, (size_t)drawn, sizeof *times, by_size);
    double median = drawn % 2 ? times[drawn / 2] : (times[drawn / 2 - 1] + times[drawn / 2]) / 2;
    printf("{\"frame_ms\": %.4f, \"least_ms\": %.4f, \"frames\": %d, \"setup_ms\": %.1f, \"renderer\": "
           "\"%s\", \"version\": \"%s\"}\n",
           median, times[0], drawn, setup_ms, (const char *)glGetString(GL_RENDERER),
           (const char *)glGetString(GL_VERSION));
    return 0;
}
