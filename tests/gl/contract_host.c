// contract_host.c: a program that draws with the shaders and the C code printed by `lambent shader`, in a context without a
// window, and does not link lambent. contract.py compiles it with -DHOST="NAME.c" and writes its input.
//
//     contract_host VERSION WIDTH HEIGHT NAME.vert NAME.frag VERTICES PICTURE [CUBE SIDE]
//
// VERTICES is an array of struct vertex, three for each triangle; the program writes PICTURE as RGBA bytes, top row first;
// CUBE is six faces of SIDE x SIDE texels of three floats. Without OpenGL the program prints a sentence and exits with 77.
#define GL_GLEXT_PROTOTYPES
#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <GL/gl.h>
#include <GL/glext.h>

#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include HOST

static void *read_whole(const char *path, size_t *size)
{
    FILE *file = fopen(path, "rb");
    char *bytes;
    if (!file || fseek(file, 0, SEEK_END) != 0) {
        fprintf(stderr, "cannot read %s\n", path);
        exit(1);
    }
    *size = (size_t)ftell(file);
    rewind(file);
    bytes = malloc(*size + 1);
    if (!bytes || fread(bytes, 1, *size, file) != *size)
        exit(1);
    bytes[*size] = 0;
    fclose(file);
    return bytes;
}

static void no_gl(const char *reason)
{
    printf("%s\n", reason);
    exit(77);
}

static void make_context(const char *version)
{
    int es = strcmp(version, "300es") == 0, core = strcmp(version, "330") == 0;
    const EGLint attributes[] = {EGL_SURFACE_TYPE, 0, EGL_RENDERABLE_TYPE, es ? EGL_OPENGL_ES3_BIT : EGL_OPENGL_BIT,
                                 EGL_NONE};
    const EGLint core_context[] = {
        EGL_CONTEXT_MAJOR_VERSION,           3,       EGL_CONTEXT_MINOR_VERSION, 3, EGL_CONTEXT_OPENGL_PROFILE_MASK,
        EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT, EGL_NONE};
    const EGLint es_context[] = {EGL_CONTEXT_MAJOR_VERSION, 3, EGL_NONE};
    const EGLint old_context[] = {EGL_CONTEXT_MAJOR_VERSION, 2, EGL_CONTEXT_MINOR_VERSION, 1, EGL_NONE};
    EGLConfig config;
    EGLint count = 0;
    EGLContext context;
    EGLDisplay display = eglGetPlatformDisplay(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, NULL);
    if (display == EGL_NO_DISPLAY || !eglInitialize(display, NULL, NULL))
        no_gl("EGL has no surfaceless display (package libegl-mesa0)");
    if (!eglBindAPI(es ? EGL_OPENGL_ES_API : EGL_OPENGL_API) ||
        !eglChooseConfig(display, attributes, &config, 1, &count) || !count)
        no_gl("EGL has no configuration for this API (package libgl1-mesa-dri)");
    context = eglCreateContext(display, config, EGL_NO_CONTEXT, es ? es_context : core ? core_context : old_context);
    if (!context || !eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, context))
        no_gl("EGL makes no context of this version");
}

static void make_target(int width, int height)
{
    GLuint frame, color, depth;
    glGenFramebuffers(1, &frame);
    glBindFramebuffer(GL_FRAMEBUFFER, frame);
    glGenRenderbuffers(1, &color);
    glBindRenderbuffer(GL_RENDERBUFFER, color);
    glRenderbufferStorage(GL_RENDERBUFFER, GL_RGBA8, width, height);
    glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, color);
    glGenRenderbuffers(1, &depth);
    glBindRenderbuffer(GL_RENDERBUFFER, depth);
    glRenderbufferStorage(GL_RENDERBUFFER, GL_DEPTH_COMPONENT24, width, height);
    glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, depth);
    glViewport(0, 0, width, height);
}

// Makes the cube map as the contract requires: bilinear, seamless, no mipmaps.
static void make_cube(const char *path, int side, int es)
{
    size_t size;
    float *texels = read_whole(path, &size);
    GLuint texture;
    GLenum face;
    glActiveTexture(GL_TEXTURE0 + 2);
    glGenTextures(1, &texture);
    glBindTexture(GL_TEXTURE_CUBE_MAP, texture);
    for (face = 0; face < 6; face++)
        glTexImage2D(GL_TEXTURE_CUBE_MAP_POSITIVE_X + face, 0, GL_RGB16F, side, side, 0, GL_RGB, GL_FLOAT,
                     texels + (size_t)face * (size_t)side * (size_t)side * 3);
    glTexParameteri(GL_TEXTURE_CUBE_MAP, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    glTexParameteri(GL_TEXTURE_CUBE_MAP, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    if (!es)
        glEnable(GL_TEXTURE_CUBE_MAP_SEAMLESS);
    free(texels);
}

int main(int count, char **words)
{
    char log[4096] = "";
    size_t vertex_size, fragment_size, size;
    int width, height, d, y;
    char *vertex, *fragment;
    unsigned char *pixels;
    void *vertices;
    GLuint program, buffer, array;
    GLenum error;
    FILE *file;
    if (count < 8)
        return 2;
    width = atoi(words[2]);
    height = atoi(words[3]);
    make_context(words[1]);
    make_target(width, height);
    if (count > 9)
        make_cube(words[8], atoi(words[9]), strcmp(words[1], "300es") == 0);
    vertex = read_whole(words[4], &vertex_size);
    fragment = read_whole(words[5], &fragment_size);
    vertices = read_whole(words[6], &size);
    program = make_program(vertex, fragment, log, sizeof log);
    if (!program) {
        fprintf(stderr, "%s\n", log);
        return 1;
    }
    if (strcmp(words[1], "120") != 0) {
        glGenVertexArrays(1, &array);
        glBindVertexArray(array);
    }
    glGenBuffers(1, &buffer);
    glBindBuffer(GL_ARRAY_BUFFER, buffer);
    glBufferData(GL_ARRAY_BUFFER, (GLsizeiptr)size, vertices, GL_STATIC_DRAW);
    glClearColor(0, 0, 0, 0);
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    glUseProgram(program);
    set_frame(program);
    glEnable(GL_DEPTH_TEST);
    for (d = 0; d < DRAWS; d++) {
        set_vertices();
        set_draw[d](program);
        glDrawArrays(GL_TRIANGLES, 3 * draws[d].first, 3 * draws[d].count);
    }
    pixels = malloc((size_t)width * (size_t)height * 4);
    if (!pixels)
        return 1;
    glReadPixels(0, 0, width, height, GL_RGBA, GL_UNSIGNED_BYTE, pixels);
    error = glGetError();
    if (error) {
        fprintf(stderr, "OpenGL error 0x%x\n", error);
        return 1;
    }
    file = fopen(words[7], "wb");
    if (!file)
        return 1;
    for (y = height - 1; y >= 0; y--)
        fwrite(pixels + (size_t)y * (size_t)width * 4, 4, (size_t)width, file);
    return fclose(file) == 0 ? 0 : 1;
}
