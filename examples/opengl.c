// opengl.c: draws with OpenGL in the program's own context. It has no window; for a window, SDL, GLFW or GTK create the
// context and provide the function that loads OpenGL's functions.
// cc opengl.c $(pkg-config --cflags --libs lambent egl) -o opengl
#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <lambent/lambent.h>
#include <stdio.h>

// A context without a window, current on this thread.
static EGLDisplay make_context(void)
{
    static const EGLint wanted[] = {EGL_SURFACE_TYPE, EGL_PBUFFER_BIT, EGL_RENDERABLE_TYPE, EGL_OPENGL_ES3_BIT_KHR,
                                    EGL_NONE};
    static const EGLint version[] = {EGL_CONTEXT_CLIENT_VERSION, 3, EGL_NONE};
    static const EGLint size[] = {EGL_WIDTH, 1, EGL_HEIGHT, 1, EGL_NONE};
    EGLDisplay display = eglGetPlatformDisplay(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, NULL);
    if (!display) // not Mesa
        display = eglGetDisplay(EGL_DEFAULT_DISPLAY);
    EGLConfig config;
    EGLint count = 0;
    if (!eglInitialize(display, NULL, NULL) || !eglBindAPI(EGL_OPENGL_ES_API) ||
        !eglChooseConfig(display, wanted, &config, 1, &count) || count < 1)
        return EGL_NO_DISPLAY;
    EGLContext context = eglCreateContext(display, config, EGL_NO_CONTEXT, version);
    EGLSurface surface = eglCreatePbufferSurface(display, config, size);
    return eglMakeCurrent(display, surface, surface, context) ? display : EGL_NO_DISPLAY;
}

static lam_gl_function find(void *user, const char *name)
{
    (void)user;
    return eglGetProcAddress(name);
}

int main(int argc, char **argv)
{
    lam_error error = {LAM_BAD_ARGUMENT, "usage: opengl MODEL PICTURE"};
    EGLDisplay display = EGL_NO_DISPLAY;
    lam_device *device = NULL;
    lam_scene *scene = argc == 3 ? lam_scene_load(argv[1], NULL, NULL, &error) : NULL;
    if (scene && !(display = make_context())) {
        fprintf(stderr, "opengl: there is no OpenGL ES 3 here\n");
        lam_scene_free(scene);
        return LAM_UNSUPPORTED;
    }
    // The context belongs to the program: each call restores the state that it found.
    if (scene)
        device = lam_device_gl(&(lam_gl_params){.get_proc_address = find}, &error);
    lam_image image = {0};
    lam_draw_params params = {.shading = LAM_SHADING_GOURAUD, .stage = LAM_STAGE_VERTEX};
    bool ok = device && lam_image_make(&image, 512, 512, LAM_RGBA8, &error);
    for (int frame = 0; ok && frame < 8; frame++) { // moves around the model, which is uploaded only in the first frame
        lam_view view = {.from_angles = true, .azimuth_rad = frame * 0.1, .elevation_rad = 0.3};
        lam_camera camera = lam_camera_fit(scene, image.width, image.height, &view);
        lam_frame_report report;
        ok = lam_draw(device, scene, &camera, &params, &image, NULL, &error);
        lam_device_report(device, &report);
        printf("frame %d: %llu bytes sent, %.1f ms\n", frame, (unsigned long long)report.bytes_uploaded,
               report.total_ms);
    }
    ok = ok && lam_image_save(&image, argv[2], NULL, &error);
    if (!ok)
        fprintf(stderr, "opengl: %s\n", error.text);
    lam_image_free(&image);
    lam_device_free(device); // while the context is current
    lam_scene_free(scene);
    if (display)
        eglTerminate(display);
    return ok ? 0 : error.code;
}
