// gl_vertex_lighting.c: the stage `application`: the CPU evaluates the equations of src/lighting at the vertices, and the
// front and back colours are uploaded as attributes. A draw is lit again only if an input of its colours has changed.
#include "gl_vertex_key.h"

#include "fail.h"
#include "fields.h"
#include "linear.h"

#define LANES 4
#include "cube_lookup.h"
#include "cube_map.h"
#include "light_rays.h"
#include "lighting.h"
#include "surroundings_at.h"

#include <stddef.h>
#include <stdlib.h>
#include <string.h>

enum { CHUNK = 4096 }; // vertices lit in one go, a multiple of LANES

// One side of a range.
struct side {
    const struct frame *frame;
    const struct environment_light *environment_light; // on physical materials; NULL: none
    const struct frame_draw *draw;
    const lam_mesh *mesh;
    const lam_material *material;
    float kd[3], ks[3];
    bool flip; // the back: lit with −n
    bool translucent;
    bool apart; // the terms that a diffuse map multiplies are apart from the rest
    bool glows; // and the emission is in neither, since an emission map multiplies it
    lam_reflection reflection;
    struct light_rays *rays; // NULL: no light casts shadows
};

// Where the shadow rays of LANES vertices start: at the vertices, where no triangle can shadow them.
struct vertex_rays {
    _Alignas(64) double origin[3][LANES];
    int32_t own[LANES];
    uint32_t turn[LANES];
};

LANE_FN vec3 of3(const float *v) { return (vec3){num_of(v[0]), num_of(v[1]), num_of(v[2])}; }
LANE_FN vec3 product3(const float *a, const float *b)
{
    return (vec3){num_of(a[0] * b[0]), num_of(a[1] * b[1]), num_of(a[2] * b[2])};
}
LANE_FN num row3(const float row[3], vec3 v) { return (row[0] * v.x + row[1] * v.y) + row[2] * v.z; }
LANE_FN vec3 turn(const float m[3][3], vec3 v) { return (vec3){row3(m[0], v), row3(m[1], v), row3(m[2], v)}; }

// Loads three floats of LANES vertices, from the offset `at` in floats.
LANE_FN vec3 load3(const struct mesh_vertex *from, size_t at)
{
    float v[3][LANES];
    for (int i = 0; i < LANES; i++)
        for (size_t c = 0; c < 3; c++)
            v[c][i] = ((const float *)&from[i])[at + c];
    return (vec3){num_load(v[0]), num_load(v[1]), num_load(v[2])};
}

LANE_FN light_source source_of(const struct side *side, const struct frame_light *light)
{
    light_source s;
    s.position = of3(light->position);
    s.direction = of3(light->axis);
    s.constant = num_of(light->attenuation[0]);
    s.linear = num_of(light->attenuation[1]);
    s.quadratic = num_of(light->attenuation[2]);
    s.inverse_range = num_of(light->inverse_range);
    s.cos_cutoff = num_of(light->cos_cutoff);
    s.exponent = num_of(light->exponent);
    s.cos_outer = num_of(light->cos_outer);
    s.inverse_width = num_of(light->inverse_width);
    s.diffuse = product3(side->kd, light->diffuse);
    s.specular = product3(side->ks, light->specular);
    return s;
}

LANE_FN vec3 environment_of(const struct frame *frame, surface s)
{
    vec3 r = turn(frame->to_environment, mirror3(s.v, s.n));
    struct cube_color c = cube_look(frame->environment, r.x, r.y, r.z);
    return pick3(both(present(s.n), present(s.v)), vec3_of(c.r, c.g, c.b), black3());
}

// Vertices take their elements as x of the pattern's turns (light_pattern.h).
static void start_rays(struct vertex_rays *out, const struct side *side, const struct mesh_vertex *from,
                       const uint32_t elements[LANES])
{
    for (int i = 0; i < LANES; i++) {
        double p[3];
        frame_to_world(side->draw, from[i].position, p);
        ray_point(side->rays->hierarchy, p, p);
        for (int k = 0; k < 3; k++)
            out->origin[k][i] = p[k];
        out->own[i] = NO_TRIANGLE;
        out->turn[i] = light_turn(elements[i], 0);
    }
}

// Takes the part of a light away that does not reach the vertices. Those that face away need no rays, unless light counts there too.
LANE_FN void pass_light(const struct side *side, const struct frame_light *l, const struct vertex_rays *rays,
                        bool every_side, surface s, light_sample *t, light_source *light)
{
    _Alignas(64) float passed[3][LANES];
    if (!side->rays || !l->casts_shadows)
        return;
    mask wanted = t->attenuation * t->spot > 0.0f;
    if (!every_side)
        wanted = both(wanted, dot3(s.n, t->l) > 0.0f);
    unsigned active = mask_bits(wanted);
    if (!active)
        return;
    const double *const o[3] = {rays->origin[0], rays->origin[1], rays->origin[2]};
    struct ray_starts starts = {{o[0], o[1], o[2]}, {o[0], o[1], o[2]}, rays->own, rays->turn};
    trace_light(side->rays, &starts, l, active, passed);
    num one = num_of(1.0f), red = pick(wanted, num_load(passed[0]), one);
    if (!side->frame->tints_rays) {
        t->attenuation = t->attenuation * red;
        return;
    }
    vec3 tint = vec3_of(red, pick(wanted, num_load(passed[1]), one), pick(wanted, num_load(passed[2]), one));
    light->diffuse = mul3(light->diffuse, tint);
    light->specular = mul3(light->specular, tint);
}

// The light that a source sends to the surface, before shadows. The ambient light that the rules of OpenGL 1 attenuate
// with it is added to *sum.
LANE_FN light_sample sample_of(const struct side *side, const struct frame_light *l, surface s, light_source *light,
                               terms *sum)
{
    *light = source_of(side, l);
    light_sample t = toward_light(s.p, *light, l->kind, l->falloff);
    if (side->frame->gl1)
        *sum = add_arriving_ambient(*sum, product3(&side->material->ambient.r, l->ambient), t);
    return t;
}

// The rest of evaluate_terms for a material with layers, as src/cpu/shade/layered.inc. `sign`: of the bitangent.
LANE_FN terms layered_terms(const struct side *side, const struct vertex_rays *rays, surface s, vec3 color, num sign,
                            terms sum, vec3 *around)
{
    const struct frame *frame = side->frame;
    const lam_material *m = side->material;
    int set = frame_layers(frame, m);
    layer_values given = layers_of(m);
    given.base = mul3(given.base, color);
    given.clearcoat_normal = s.n;
    double turned = (double)m->anisotropy_rotation_rad;
    vec3 across = scale3(cross3(s.n, s.t), sign * (float)math_sin(turned));
    given.stretch = unit3(add3(scale3(s.t, num_of((float)math_cos(turned))), across));
    layered y = layered_of(s, given, !frame->single_scattering, set);
    for (int i = 0; i < frame->light_count; i++) {
        const struct frame_light *l = &frame->lights[i];
        light_source light;
        light_sample t = sample_of(side, l, s, &light, &sum);
        pass_light(side, l, rays, true, s, &t, &light);
        lobe_value lobe = reflect_light(s, t.l, lobe_parameters_of(m, 0), (int)side->reflection);
        sum = add_layered(sum, light, t, layered_light(s, y, t.l, lobe, set));
    }
    sum = cover_terms(sum, y, set);
    if (side->environment_light) {
        vec3 kd = scale3(given.base, 1.0f - given.metallic);
        num mean = set & LAYER_ANISOTROPY ? mean_roughness(given.roughness, given.anisotropy) : given.roughness;
        surroundings e = surroundings_at(frame, side->environment_light, s, mean), top = e;
        if (set & LAYER_ANISOTROPY)
            e.prefiltered =
                surroundings_at(frame, side->environment_light, bent_surface(s, y, given.anisotropy), given.roughness)
                    .prefiltered;
        if (set & LAYER_CLEARCOAT)
            top = surroundings_at(frame, side->environment_light, coat_surface(s, y), y.coat_roughness);
        vec3 light = layered_surroundings(s, y, kd, e, top, set);
        mask lit = both(present(s.n), present(s.v));
        if (side->apart)
            *around = pick3(lit, sub3(light, layered_surroundings(s, y, black3(), e, top, set)), black3());
        sum.reflection = pick3(lit, add3(sum.reflection, light), sum.reflection);
    }
    return tint_terms(sum, color);
}

// `around`: zero; becomes the part of the reflection that a diffuse map multiplies.
LANE_FN terms evaluate_terms(const struct side *side, const struct vertex_rays *rays, surface s, vec3 color, num sign,
                             vec3 *around)
{
    const struct frame *frame = side->frame;
    const lam_material *m = side->material;
    int model = (int)side->reflection;
    if (model == LAM_REFLECTION_NONE)
        return tint_terms(unlit_terms(of3(&m->diffuse.r)), color);
    terms sum = start_terms(product3(&m->ambient.r, frame->ambient), of3(&m->emission.r));
    for (int i = 0; i < frame->hemisphere_count; i++) {
        const struct frame_hemisphere *h = &frame->hemispheres[i];
        sum = add_hemisphere(
            sum, s, (hemisphere){of3(h->up), product3(&m->ambient.r, h->sky), product3(&m->ambient.r, h->ground)});
    }
    if (frame_is_physical(side->reflection) && frame_layers(frame, m))
        return layered_terms(side, rays, s, color, sign, sum, around);
    num gain = frame->single_scattering || !(lobe_properties(model) & LOBE_MICROFACET)
                   ? num_of(0.0f)
                   : scattering_gain(s, num_of(m->roughness));
    fresnel mirror = fresnel_of(mul3(of3(&m->diffuse.r), color), num_of(m->metallic), gain);
    lobe_parameters parameters = lobe_parameters_of(m, frame_shininess(frame, m));
    for (int i = 0; i < frame->light_count; i++) {
        const struct frame_light *l = &frame->lights[i];
        light_source light;
        light_sample t = sample_of(side, l, s, &light, &sum);
        if (lobe_properties(model) & LOBE_MICROFACET)
            light = with_fresnel(light, mirror, s.v, t.l);
        pass_light(side, l, rays, (lobe_properties(model) & LOBE_TANGENT) != 0, s, &t, &light);
        sum = add_reflected(sum, light, t, reflect_light(s, t.l, parameters, model));
    }
    if (side->environment_light && (lobe_properties(model) & LOBE_MICROFACET)) {
        vec3 kd = scale3(mul3(of3(&m->diffuse.r), color), num_of(1.0f - m->metallic));
        surroundings e = surroundings_at(frame, side->environment_light, s, num_of(m->roughness));
        vec3 light = surroundings_light(mirror, kd, e);
        mask lit = both(present(s.n), present(s.v));
        if (side->apart)
            *around = pick3(lit, sub3(light, surroundings_light(mirror, black3(), e)), black3());
        sum.reflection = pick3(lit, add3(sum.reflection, light), sum.reflection);
    }
    if (frame->environment && !m->physical &&
        (m->reflectivity.r != 0 || m->reflectivity.g != 0 || m->reflectivity.b != 0))
        sum = add_environment(sum, of3(&m->reflectivity.r), environment_of(frame, s));
    return tint_terms(sum, color);
}

LANE_FN vec3 output_terms(const struct side *side, terms t)
{
    switch (side->frame->output) {
    case LAM_OUTPUT_AMBIENT:
        return t.ambient;
    case LAM_OUTPUT_DIFFUSE:
        return t.diffuse;
    case LAM_OUTPUT_SPECULAR:
        return t.specular;
    case LAM_OUTPUT_EMISSION:
        return t.emission;
    case LAM_OUTPUT_REFLECTION:
        return t.reflection;
    case LAM_OUTPUT_LIGHT:
        return side->reflection == LAM_REFLECTION_NONE ? black3() : add3(add3(t.ambient, t.diffuse), t.specular);
    default:
        return sum_terms(t);
    }
}

LANE_FN vec3 output_vector(const struct side *side, surface s)
{
    lam_output output = side->frame->output;
    if (output == LAM_OUTPUT_NORMALS)
        return s.n;
    if (output == LAM_OUTPUT_TANGENTS)
        return s.t;
    const struct frame_light *light = &side->frame->lights[0]; // the only one
    vec3 l = toward_light(s.p, source_of(side, light), light->kind, FALLOFF_NONE).l;
    num c = cosine(dot3(s.n, output == LAM_OUTPUT_N_L ? l : halfway3(l, s.v)));
    return vec3_of(c, c, c);
}

// The tangent for a mesh without tangents: around the mesh's y axis; along x where the normal is along y.
LANE_FN vec3 field_tangent(const struct side *side, vec3 n)
{
    const float(*m)[3] = side->draw->tangent;
    vec3 axis = unit3(vec3_of(num_of(m[0][1]), num_of(m[1][1]), num_of(m[2][1])));
    vec3 x = unit3(vec3_of(num_of(m[0][0]), num_of(m[1][0]), num_of(m[2][0])));
    vec3 around = cross3(axis, n);
    return pick3(dot3(around, around) < 1e-8f, x, around);
}

LANE_FN surface surface_of(const struct side *side, const struct mesh_vertex *from)
{
    const struct frame *frame = side->frame;
    const float(*eye)[4] = side->draw->eye;
    vec3 p = load3(from, 0);
    surface s;
    s.p = (vec3){row3(eye[0], p) + eye[0][3], row3(eye[1], p) + eye[1][3], row3(eye[2], p) + eye[2][3]};
    vec3 n = unit3(turn(side->draw->normal, load3(from, 3)));
    s.n = unit3(side->flip ? negate3(n) : n);
    s.v = to_eye(s.p, frame->distant_viewer ? VIEWER_INFINITE : VIEWER_LOCAL);
    s.t = black3();
    bool stretched = frame_is_physical(side->reflection) && material_layers(side->material) & LAYER_ANISOTROPY;
    if (lobe_properties((int)side->reflection) & LOBE_TANGENT || stretched || frame->output == LAM_OUTPUT_TANGENTS)
        s.t = perpendicular3(
            side->mesh->tangents ? unit3(turn(side->draw->tangent, load3(from, 10))) : field_tangent(side, s.n), s.n);
    return s;
}

// The sign of the bitangent on the visible side.
LANE_FN num sign_of(const struct side *side, const struct mesh_vertex *from)
{
    float sign[LANES], turned = (side->flip ? -1.0f : 1.0f) * (side->draw->mirrored ? -1.0f : 1.0f);
    for (int i = 0; i < LANES; i++)
        sign[i] = side->mesh->tangents ? from[i].tangent[3] * turned : turned;
    return num_load(sign);
}

// The part of the terms that a diffuse map multiplies (`mapped`), or the rest, as far as it is shown. `around`: the matte part
// of the reflection.
LANE_FN vec3 part_terms(const struct side *side, terms t, vec3 around, bool mapped)
{
    terms part = {black3(), black3(), black3(), black3(), black3()};
    if (mapped) {
        part.ambient = t.ambient;
        part.diffuse = t.diffuse;
        part.reflection = around;
    } else {
        part.specular = t.specular;
        part.reflection = sub3(t.reflection, around);
        part.emission = side->glows ? black3() : t.emission;
    }
    return output_terms(side, part);
}

LANE_FN vec3 clamped3(vec3 c, bool clamped)
{
    return clamped ? vec3_of(saturate(c.x), saturate(c.y), saturate(c.z)) : c;
}

LANE_FN void store_vertices(float (*out)[4], vec3 color)
{
    for (int i = 0; i < LANES; i++) {
        out[i][0] = lane(color.x, i);
        out[i][1] = lane(color.y, i);
        out[i][2] = lane(color.z, i);
        out[i][3] = 1;
    }
}

// Computes the colours of vertices, with alpha, and if they are kept apart the rest of each; `count` is a multiple of LANES.
// `elements` (with shadows): their elements in the mesh.
static void light_side(const struct side *side, const struct mesh_vertex *from, const uint32_t *elements,
                       uint32_t count, float (*out)[4], float (*rest)[4])
{
    struct vertex_rays rays;
    const struct frame *frame = side->frame;
    bool clamped = frame->gl1 && output_is_picture(frame->output);
    for (uint32_t first = 0; first < count; first += LANES, from += LANES, out += LANES) {
        surface s = surface_of(side, from);
        if (side->rays)
            start_rays(&rays, side, from, elements + first);
        vec3 white = vec3_of(num_of(1.0f), num_of(1.0f), num_of(1.0f));
        vec3 color;
        if (output_is_vector(frame->output)) {
            color = output_vector(side, s);
        } else {
            vec3 around = black3();
            terms t = evaluate_terms(side, &rays, s, side->mesh->colors ? load3(from, 6) : white, sign_of(side, from),
                                     &around);
            color = side->apart ? part_terms(side, t, around, true) : output_terms(side, t);
            if (side->apart)
                store_vertices(rest, clamped3(part_terms(side, t, around, false), clamped));
        }
        rest += LANES;
        store_vertices(out, clamped3(color, clamped));
        for (int i = 0; i < LANES; i++) {
            if (side->translucent)
                out[i][3] = side->material->diffuse.a * (side->mesh->colors ? from[i].color[3] : 1.0f);
            if (frame->gl1)
                out[i][3] = out[i][3] > 1 ? 1 : out[i][3];
        }
    }
}

// --- lighting and upload

// The mesh's element of a vertex.
static uint32_t element_of(const struct gl_mesh *mesh, uint32_t vertex)
{
    return mesh->form == FORM_SHARED || !mesh->mesh.indices ? vertex : mesh->mesh.indices[vertex];
}

// Lights the vertices of a range, and interleaves front and back colours.
static bool light_run(struct gl_frame *f, const struct gl_mesh *mesh, const struct frame_draw_range *run,
                      uint32_t first, uint32_t end, uint32_t each, struct light_rays *rays, float (*lit)[4])
{
    const struct frame_draw *draw = &f->frame->draws[run->draw];
    struct side side = {.frame = f->frame,
                        .environment_light = f->environment_light,
                        .draw = draw,
                        .mesh = &mesh->mesh,
                        .translucent = run->translucent,
                        .apart = glsl_keeps_apart(f->frame, run),
                        .reflection = run->reflection,
                        .rays = rays};
    for (int back = 0; back < 2; back++)
        side.glows |= f->frame->materials[back ? run->back : run->front]->maps[LAM_MAP_EMISSION] != NULL;
    struct mesh_vertex *from = f->device->scratch.data;
    float(*colors)[4] = (float(*)[4])(from + CHUNK), (*rest)[4] = colors + CHUNK;
    uint32_t *elements = (uint32_t *)(rest + CHUNK);
    for (; first < end; first += CHUNK) {
        uint32_t chunk = end - first < CHUNK ? end - first : CHUNK, padded = (chunk + LANES - 1) / LANES * LANES;
        if (!call_should_continue(f->call))
            return false;
        mesh_vertices(f->device, &mesh->mesh, mesh->form, first, chunk, from);
        for (uint32_t i = chunk; i < padded; i++)
            from[i] = from[chunk - 1];
        for (uint32_t i = 0; i < padded && side.rays; i++)
            elements[i] = element_of(mesh, first + (i < chunk ? i : chunk - 1));
        for (int back = 0; back < 2; back++) {
            if (!back || !draw->one_sided) { // one-sided: the back repeats the front
                side.material = f->frame->materials[back ? run->back : run->front];
                frame_material_colors(side.material, side.kd, side.ks);
                side.flip = back;
                light_side(&side, from, elements, padded, colors, rest);
                f->device->base.report.points_lit += chunk;
                f->device->base.report.lights_evaluated += (uint64_t)chunk * (uint64_t)f->frame->light_count;
            }
            for (uint32_t i = 0; i < chunk; i++)
                memcpy(lit[(first + i) * each + (uint32_t)back], colors[i], sizeof colors[i]);
            for (uint32_t i = 0; i < chunk && side.apart; i++)
                memcpy(lit[(first + i) * each + 2 + (uint32_t)back], rest[i], sizeof rest[i]);
        }
    }
    return true;
}

static bool send_colors(struct gl_frame *f, struct gl_vertex_lighting *row, const struct gl_mesh *mesh, int number,
                        lam_error *error)
{
    const struct frame *frame = f->frame;
    uint64_t start = now_ns();
    uint32_t count = mesh_vertex_count(&mesh->mesh, mesh->form);
    uint32_t each = row->apart ? 4 : 2; // colours of a vertex
    uint64_t bytes = (uint64_t)count * each * 4 * sizeof(float);
    if (!buffer_reserve(&f->device->scratch,
                        CHUNK * (sizeof(struct mesh_vertex) + 8 * sizeof(float) + sizeof(uint32_t)), f->call, error) ||
        !gl_charge(f, &row->bytes, bytes, error))
        return false;
    float(*lit)[4] = gl_buffer_map_new(f, row->colors, (size_t)bytes, GL_DYNAMIC_DRAW, error);
    if (!lit)
        return false;
    struct ray_layers layers = {0};
    struct light_pattern pattern;
    struct light_rays rays = {frame, &f->device->hierarchy.hierarchy, &pattern, &layers, 0};
    if (frame->shadows)
        light_pattern_fill(&pattern, frame->shadow_samples);
    bool on = true;
    bool shared = mesh->form == FORM_SHARED, done = false; // shared vertices: all ranges have one material
    for (int i = 0; on && !done && i < frame->range_count; i++) {
        const struct frame_draw_range *s = &frame->ranges[i];
        uint32_t first = 3 * (s->first_id - frame->draws[number].first_id);
        if (s->draw != number)
            continue;
        on = light_run(f, mesh, s, shared ? 0 : first, shared ? count : first + 3 * s->count, each,
                       frame->shadows ? &rays : NULL, lit);
        done = shared;
    }
    f->gl->UnmapBuffer(GL_ARRAY_BUFFER);
    free(layers.list);
    f->device->base.report.rays += rays.sent;
    f->device->base.report.lighting_ms += (double)(now_ns() - start) * 1e-6;
    if (layers.failed)
        return fail_memory(error, (size_t)layers.capacity * 2 * sizeof *layers.list);
    return on || call_error(f->call, error);
}

static bool reserve_row(struct gl_device *device, int draw, lam_error *error)
{
    if (draw < device->vertex_lighting_capacity)
        return true;
    int capacity = draw + 8;
    struct gl_vertex_lighting *grown = realloc(device->vertex_lighting, (size_t)capacity * sizeof *grown);
    if (!grown)
        return fail_memory(error, (size_t)capacity * sizeof *grown);
    memset(grown + device->vertex_lighting_capacity, 0,
           (size_t)(capacity - device->vertex_lighting_capacity) * sizeof *grown);
    device->vertex_lighting = grown;
    device->vertex_lighting_capacity = capacity;
    return true;
}

// An attribute of the vertex array, of `size` floats.
static void point_to(struct gl_frame *f, GLuint location, GLint size, size_t stride, size_t at)
{
    f->gl->EnableVertexAttribArray(location);
    f->gl->VertexAttribPointer(location, size, GL_FLOAT, GL_FALSE, (GLsizei)(stride * sizeof(float)),
                               (const void *)(at * sizeof(float)));
}

// Sets the vertex attributes: those of the mesh that fragments read, and the colours.
static void describe(struct gl_frame *f, struct gl_vertex_lighting *row, const struct gl_mesh *mesh)
{
    const struct gl *gl = f->gl;
    const lam_mesh *m = &mesh->mesh;
    size_t stride = mesh_vertex_floats(m), at = 6;
    gl_use_array(f->device, row->array);
    gl->BindBuffer(GL_ARRAY_BUFFER, mesh->vertices);
    point_to(f, 0, 3, stride, 0);
    if (m->colors)
        point_to(f, 2, 4, stride, at);
    at += (m->colors ? 4 : 0) + (m->tangents ? 4u : 0);
    if (m->texcoords)
        point_to(f, 7, 2, stride, at);
    at += m->texcoords ? 2 : 0;
    if (m->second_texcoords)
        point_to(f, 8, 2, stride, at);
    gl->BindBuffer(GL_ARRAY_BUFFER, row->colors);
    for (GLuint side = 0; side < 2; side++) {
        point_to(f, 4 + side, 4, row->apart ? 16 : 8, side * 4);
        if (row->apart)
            point_to(f, 9 + side, 3, 16, 8 + side * 4);
        else
            gl->DisableVertexAttribArray(9 + side);
    }
    gl->BindBuffer(GL_ELEMENT_ARRAY_BUFFER, mesh->elements);
    row->of_vertices = mesh->vertices;
}

GLuint vertex_lighting_upload(struct gl_frame *f, int draw, struct gl_mesh *mesh, lam_error *error)
{
    struct gl_device *device = f->device;
    const struct gl *gl = f->gl;
    size_t size = 0;
    if (!reserve_row(device, draw, error) ||
        !vertex_lighting_key(f, &device->vertex_lighting[draw], mesh, draw, &size, error))
        return 0;
    struct gl_vertex_lighting *row = &device->vertex_lighting[draw];
    bool apart = false;
    for (int i = 0; i < f->frame->range_count; i++)
        apart |= f->frame->ranges[i].draw == draw && glsl_keeps_apart(f->frame, &f->frame->ranges[i]);
    if (row->apart != apart)
        row->sent_key_size = row->of_vertices = 0;
    row->apart = apart;
    if (!row->colors) {
        gl->GenBuffers(1, &row->colors);
        gl->GenVertexArrays(1, &row->array);
    }
    if (size != row->sent_key_size || memcmp(row->frame_key.data, row->sent_key.data, size) != 0) {
        row->sent_key_size = 0;
        if (!send_colors(f, row, mesh, draw, error))
            return 0;
        struct buffer swapped = row->sent_key;
        row->sent_key = row->frame_key;
        row->frame_key = swapped;
        row->sent_key_size = size;
        lam_environment_free(row->environment);
        row->environment = cube_share(f->frame->environment);
    }
    if (row->of_vertices != mesh->vertices)
        describe(f, row, mesh);
    return row->array;
}

void vertex_lighting_free(struct gl_device *device)
{
    const struct gl *gl = &device->context.gl;
    for (int i = 0; i < device->vertex_lighting_capacity; i++) {
        struct gl_vertex_lighting *row = &device->vertex_lighting[i];
        gl->DeleteBuffers(1, &row->colors);
        gl->DeleteVertexArrays(1, &row->array);
        lam_environment_free(row->environment);
        buffer_free(&row->sent_key);
        buffer_free(&row->frame_key);
    }
    free(device->vertex_lighting);
}
