// lambent/lambent.h: the whole interface of liblambent. (liblambent-check has its own header, check.h.)
//
//   lam_error error;
//   lam_image image = {0};
//   if (!lam_render("bunny.obj", NULL, &image, NULL, &error) || !lam_image_save(&image, "bunny.png", NULL, &error))
//       fprintf(stderr, "%s\n", error.text);
//   lam_image_free(&image);
//
// The same, step by step:
//
//   lam_scene *scene = lam_scene_load("bunny.obj", NULL, NULL, &error);
//   lam_camera camera = lam_camera_fit(scene, 1024, 1024, NULL);
//   lam_device *device = lam_device_cpu(NULL, &error);
//   lam_image image = {0};
//   lam_image_make(&image, 1024, 1024, LAM_RGBA8, &error);
//   lam_draw(device, scene, &camera, NULL, &image, NULL, &error);
//   lam_image_save(&image, "bunny.png", NULL, &error);
#ifndef LAMBENT_LAMBENT_H
#define LAMBENT_LAMBENT_H

#include "animation.h"
#include "base.h"
#include "camera.h"
#include "caption.h"
#include "device.h"
#include "environment.h"
#include "export.h"
#include "explain.h"
#include "fields.h"
#include "gl.h"
#include "image.h"
#include "light.h"
#include "light_eval.h"
#include "material.h"
#include "mesh.h"
#include "pick.h"
#include "reflection.h"
#include "render.h"
#include "scene.h"
#include "scene_file.h"
#include "section.h"
#include "settings.h"
#include "shader.h"
#include "text.h"
#include "texture.h"
#include "words.h"

#endif
