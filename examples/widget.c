// widget.c: shows a model in a window, drawn by the CPU device into the program's own buffer.
// cc widget.c $(pkg-config --cflags --libs lambent sdl2) -o widget
//
// widget MODEL                  turns it at 30 pictures a second; drag to turn, drag right to move, wheel to zoom,
// click to pick widget MODEL FRAMES FILE.bmp  ends after FRAMES pictures and saves the last one
#include <SDL.h>
#include <lambent/lambent.h>
#include <stdio.h>
#include <stdlib.h>

enum { WIDTH = 640, HEIGHT = 480, FRAME_MS = 1000 / 30 };

struct widget {
    SDL_Window *window;
    SDL_Surface *buffer; // the pixels that Lambent draws to
    lam_scene *scene;
    lam_device *device;
    lam_orbit orbit;
    lam_draw_params params;
    bool held, ended; // the user has moved the model; the window is closed
};

// Makes a buffer of the window's size. Returns false if this fails; SDL_GetError states the reason.
static bool resize(struct widget *w)
{
    int width, height;
    SDL_GetWindowSize(w->window, &width, &height);
    SDL_FreeSurface(w->buffer);
    w->buffer = SDL_CreateRGBSurfaceWithFormat(0, width, height, 32, SDL_PIXELFORMAT_BGRA32);
    return w->buffer != NULL;
}

static bool draw(struct widget *w, lam_error *error)
{
    lam_image image = {.width = w->buffer->w,
                       .height = w->buffer->h,
                       .format = LAM_BGRA8,
                       .pixels = w->buffer->pixels,
                       .stride = w->buffer->pitch};
    lam_camera camera = lam_orbit_camera(&w->orbit);
    if (!lam_draw(w->device, w->scene, &camera, &w->params, &image, NULL, error))
        return false;
    SDL_BlitSurface(w->buffer, NULL, SDL_GetWindowSurface(w->window), NULL);
    SDL_UpdateWindowSurface(w->window);
    return true;
}

// Shows the picked object in the window's title.
static void pick(struct widget *w, int x, int y)
{
    lam_pick_pixel pixel = {.width = w->buffer->w, .height = w->buffer->h, .x = x, .y = y};
    lam_camera camera = lam_orbit_camera(&w->orbit);
    lam_picked found;
    char title[120] = "nothing";
    if (!lam_pick(w->scene, &camera, &w->params, &pixel, NULL, &found, NULL))
        return;
    if (found.object >= 0)
        snprintf(title, sizeof title, "object %d, triangle %u at %.4g %.4g %.4g", found.object,
                 (unsigned)found.triangle, found.position.x, found.position.y, found.position.z);
    SDL_SetWindowTitle(w->window, title);
}

static void answer(struct widget *w, const SDL_Event *event)
{
    const double pi = 3.14159265358979, height = w->buffer->h;
    if (event->type == SDL_QUIT)
        w->ended = true;
    if (event->type == SDL_MOUSEWHEEL)
        lam_orbit_zoom(&w->orbit, event->wheel.y > 0 ? 1.1 : 1 / 1.1);
    if (event->type == SDL_MOUSEBUTTONDOWN) {
        w->held = true;
        pick(w, event->button.x, event->button.y);
    }
    if (event->type == SDL_MOUSEMOTION && event->motion.state & SDL_BUTTON_LMASK)
        lam_orbit_turn(&w->orbit, -pi * event->motion.xrel / height, pi * event->motion.yrel / height);
    if (event->type == SDL_MOUSEMOTION && event->motion.state & SDL_BUTTON_RMASK)
        lam_orbit_pan(&w->orbit, -event->motion.xrel / height, event->motion.yrel / height);
    if (event->type == SDL_WINDOWEVENT && event->window.event == SDL_WINDOWEVENT_SIZE_CHANGED)
        w->ended |= !resize(w);
}

// Draws until the window is closed or `frames` pictures are drawn (0: no limit).
static bool run(struct widget *w, int frames, lam_error *error)
{
    SDL_Event event;
    Uint64 start = SDL_GetTicks64();
    double drawing_ms = 0;
    int drawn = 0;
    for (; !w->ended && (!frames || drawn < frames); drawn++) {
        Uint64 due = start + (Uint64)(drawn + 1) * FRAME_MS;
        Uint64 before = SDL_GetPerformanceCounter();
        if (!draw(w, error))
            return false;
        drawing_ms += 1e3 * (double)(SDL_GetPerformanceCounter() - before) / (double)SDL_GetPerformanceFrequency();
        for (Uint64 now = SDL_GetTicks64(); now < due && !w->ended; now = SDL_GetTicks64())
            if (SDL_WaitEventTimeout(&event, (int)(due - now)))
                answer(w, &event);
        while (SDL_PollEvent(&event)) // also if drawing takes longer than a frame
            answer(w, &event);
        if (!w->held)
            lam_orbit_turn(&w->orbit, 0.02, 0);
    }
    printf("%d pictures of %dx%d, %.1f a second, %.1f ms of drawing each\n", drawn, w->buffer->w, w->buffer->h,
           drawn * 1e3 / (double)(SDL_GetTicks64() - start + 1), drawing_ms / (drawn ? drawn : 1));
    return true;
}

int main(int argc, char **argv)
{
    lam_error error = {LAM_BAD_ARGUMENT, "usage: widget MODEL [FRAMES FILE.bmp]"};
    struct widget w = {.params = {.background = {0.8f, 0.85f, 0.9f, 1}}};
    bool ok = argc == 2 || argc == 4;
    if (ok && SDL_Init(SDL_INIT_VIDEO) != 0) {
        fprintf(stderr, "widget: %s\n", SDL_GetError());
        return LAM_UNSUPPORTED;
    }
    w.scene = ok ? lam_scene_load(argv[1], NULL, NULL, &error) : NULL;
    w.device = w.scene ? lam_device_cpu(NULL, &error) : NULL;
    if (w.device) {
        lam_camera camera = lam_camera_fit(w.scene, WIDTH, HEIGHT, NULL);
        w.orbit = lam_orbit_of(&camera, w.scene);
        w.window = SDL_CreateWindow("widget", SDL_WINDOWPOS_UNDEFINED, SDL_WINDOWPOS_UNDEFINED, WIDTH, HEIGHT,
                                    SDL_WINDOW_RESIZABLE);
        ok = w.window && resize(&w);
        if (!ok)
            snprintf(error.text, sizeof error.text, "%s", SDL_GetError());
        ok = ok && run(&w, argc == 4 ? atoi(argv[2]) : 0, &error);
        if (ok && argc == 4 && SDL_SaveBMP(w.buffer, argv[3]) != 0) {
            snprintf(error.text, sizeof error.text, "%s", SDL_GetError());
            ok = false;
        }
    }
    ok = ok && w.device;
    if (!ok)
        fprintf(stderr, "widget: %s\n", error.text);
    SDL_FreeSurface(w.buffer);
    lam_device_free(w.device);
    lam_scene_free(w.scene);
    SDL_DestroyWindow(w.window);
    SDL_Quit();
    return ok ? 0 : 1;
}
