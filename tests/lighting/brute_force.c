// brute_force.c: evaluates the light of a scene in double precision (brute_force.h). layered_textbook.h evaluates the
// lobes of physical materials.
#include "brute_force.h"

#include <stdbool.h>
#include <stddef.h>

static double number(struct world *w)
{
    w->random ^= w->random << 13;
    w->random ^= w->random >> 7;
    w->random ^= w->random << 17;
    return (double)(w->random >> 11) * 0x1p-53;
}

void sky_light(const struct world *w, vector toward, double out[3])
{
    for (int c = 0; c < 3; c++)
        out[c] = w->sky + w->gradient * (0.5 + 0.5 * toward.y) * (1 + 0.2 * c);
}

struct meeting {
    const struct board *board;
    double t, s, up; // the distance in lengths of the ray, and the position on the board
};

static bool meet(const struct board *b, vector from, vector along, bool whole_plane, struct meeting *out)
{
    vector n = across(b->along, b->up), d = sum(b->corner, times(-1, from));
    double facing = dot(n, along), t = dot(n, d) / facing;
    if (facing == 0 || t <= 1e-7 || t >= out->t)
        return false;
    vector at = sum(times(t, along), times(-1, d));
    double s = dot(across(at, b->up), n) / dot(n, n), up = dot(across(b->along, at), n) / dot(n, n);
    if (!whole_plane && (s < 0 || s > 1 || up < 0 || up > 1))
        return false;
    *out = (struct meeting){b, t, s, up};
    return true;
}

static const uint8_t *texel(const uint8_t (*texels)[4], const struct meeting *m)
{
    int column = (int)floor((m->s - floor(m->s)) * TEXELS), row = (int)floor((m->up - floor(m->up)) * TEXELS);
    return texels[(row < TEXELS ? row : TEXELS - 1) * TEXELS + (column < TEXELS ? column : TEXELS - 1)];
}

static double opacity(const struct world *w, const struct meeting *m)
{
    const struct paint *p = &w->paints[m->board->material];
    double a = (double)p->m.diffuse.a * (p->color ? texel(p->color, m)[3] / 255.0 : 1);
    return p->m.alpha_mode == LAM_ALPHA_OPAQUE ? 1
           : p->m.alpha_mode == LAM_ALPHA_MASK ? a >= (double)p->m.alpha_cutoff
                                               : a;
}

// Finds the surface that the ray meets. A surface of opacity a lets the ray pass with the probability 1 − a.
static bool nearest(struct world *w, vector from, vector along, struct meeting *out)
{
    double before = 0;
    for (int tries = 0; tries < SURFACES; tries++) {
        *out = (struct meeting){.t = INFINITY};
        for (int i = 0; i < w->board_count; i++)
            meet(&w->boards[i], from, along, false, out);
        if (!out->board)
            return false;
        double a = opacity(w, out);
        if (a >= 1 || number(w) < a) {
            out->t += before;
            return true;
        }
        before += out->t;
        from = sum(from, times(out->t, along));
    }
    return false;
}

// Returns the share of a lamp's light that passes the surfaces between.
static double passed(const struct world *w, vector from, vector along, double end)
{
    double share = 1;
    for (int i = 0; i < w->board_count && share > 0; i++) {
        struct meeting m = {.t = end};
        if (meet(&w->boards[i], from, along, false, &m))
            share *= 1 - opacity(w, &m);
    }
    return share;
}

// Returns the light that leaves a point towards v, for light of 1 from l.
static void reflected(const struct paint *p, const struct meeting *m, vector n, vector v, vector l, double out[3])
{
    const lam_material *g = &p->m;
    double base[3] = {(double)g->diffuse.r, (double)g->diffuse.g, (double)g->diffuse.b}, n_l = dot(n, l);
    for (int c = 0; c < 3 && p->color; c++)
        base[c] *= texel(p->color, m)[c] / 255.0;
    if (!g->physical) {
        const double ks[3] = {(double)g->specular.r, (double)g->specular.g, (double)g->specular.b};
        double shine = n_l > 0 ? pow(fmax(dot(n, unit(sum(l, v))), 0), (double)g->shininess) : 0;
        for (int c = 0; c < 3; c++)
            out[c] = base[c] * fmax(n_l, 0) + ks[c] * shine;
        return;
    }
    struct point at = {.n = n,
                       .v = v,
                       .l = l,
                       .t = n,
                       .coat_n = n,
                       .metallic = (double)g->metallic,
                       .roughness = (double)g->roughness,
                       .ior = (double)g->ior,
                       .weight = (double)g->specular_weight,
                       .coat = (double)g->clearcoat,
                       .coat_roughness = (double)g->clearcoat_roughness,
                       .sheen_roughness = (double)g->sheen_roughness,
                       .iridescence = (double)g->iridescence,
                       .film_ior = (double)g->iridescence_ior,
                       .film = (double)g->iridescence_thickness_max};
    const float colors[3][2] = {
        {g->f0_color.r, g->sheen_color.r}, {g->f0_color.g, g->sheen_color.g}, {g->f0_color.b, g->sheen_color.b}};
    for (int c = 0; c < 3; c++) {
        at.base[c] = base[c];
        at.color[c] = (double)colors[c][0];
        at.sheen[c] = (double)colors[c][1];
    }
    if (p->rough) {
        at.roughness *= texel(p->rough, m)[1] / 255.0;
        at.metallic *= texel(p->rough, m)[2] / 255.0;
    }
    double diffuse, specular[3];
    layered_textbook(&at,
                     LAYER_DIELECTRIC | (g->clearcoat > 0 ? LAYER_CLEARCOAT : 0) |
                         (largest(at.sheen) > 0 ? LAYER_SHEEN : 0) | (g->iridescence > 0 ? LAYER_IRIDESCENCE : 0),
                     &diffuse, specular);
    for (int c = 0; c < 3; c++)
        out[c] = base[c] * (1 - at.metallic) * diffuse + specular[c];
}

// Returns the attenuation of a lamp at a distance and angle.
static double weakening(const lam_light *lamp, double distance, double cosine)
{
    double a = (double)lamp->attenuation.constant + (double)lamp->attenuation.linear * distance +
               (double)lamp->attenuation.quadratic * distance * distance;
    if (lamp->type != LAM_LIGHT_SPOT)
        return 1 / a;
    double outer = cos((double)lamp->outer_rad), inner = cos((double)lamp->inner_rad);
    return pow(clamp((cosine - outer) / fmax(inner - outer, 0.001), 0, 1), 2) / a;
}

static void add_lamps(const struct world *w, const struct paint *p, const struct meeting *m, vector at, vector n,
                      vector v, double through[3], double light[3])
{
    for (int i = 0; i < w->lamp_count; i++) {
        const lam_light *lamp = &w->lamps[i];
        bool far = lamp->type == LAM_LIGHT_DIRECTIONAL;
        vector axis = unit((vector){lamp->direction.x, lamp->direction.y, lamp->direction.z});
        vector toward =
            far ? times(-1, axis) : sum((vector){lamp->position.x, lamp->position.y, lamp->position.z}, times(-1, at));
        double distance = sqrt(dot(toward, toward)), r[3];
        double share = far ? 1 : weakening(lamp, distance, -dot(axis, toward) / distance);
        if (dot(n, toward) <= 0 || share <= 0)
            continue;
        share *= passed(w, at, toward, far ? INFINITY : 1);
        reflected(p, m, n, v, unit(toward), r);
        const double color[3] = {(double)lamp->diffuse.r, (double)lamp->diffuse.g, (double)lamp->diffuse.b};
        for (int c = 0; c < 3; c++)
            light[c] += through[c] * share * r[c] * color[c];
    }
}

// Adds the light of one path that begins at a meeting of the ray.
static void follow(struct world *w, vector from, vector along, struct meeting m, double light[3])
{
    double through[3] = {1, 1, 1}, r[3];
    for (int bounce = 0;; bounce++) {
        const struct paint *p = &w->paints[m.board->material];
        const double emission[3] = {(double)p->m.emission.r, (double)p->m.emission.g, (double)p->m.emission.b};
        vector n = unit(across(m.board->along, m.board->up)), v = unit(times(-1, along)),
               at = sum(from, times(m.t, along));
        n = dot(n, v) < 0 ? times(-1, n) : n;
        for (int c = 0; c < 3; c++)
            light[c] += through[c] * emission[c] * (p->glow ? texel(p->glow, &m)[c] / 255.0 : 1);
        if (bounce == w->bounces)
            return;
        add_lamps(w, p, &m, at, n, v, through, light);
        double square = number(w), turn = 2 * PI * number(w), sine = sqrt(square), cosine = sqrt(1 - square);
        vector x = unit(across(n, fabs(n.x) < 0.6 ? (vector){1, 0, 0} : (vector){0, 1, 0})), y = across(n, x);
        vector l = sum(sum(times(sine * cos(turn), x), times(sine * sin(turn), y)), times(cosine, n));
        reflected(p, &m, n, v, l, r);
        for (int c = 0; c < 3; c++)
            through[c] *= cosine > 0 ? r[c] / cosine : 0;
        from = at;
        along = l;
        if (!nearest(w, from, along, &m)) {
            double sky[3];
            sky_light(w, along, sky);
            for (int c = 0; c < 3; c++)
                light[c] += through[c] * sky[c];
            return;
        }
    }
}

static vector ray_through(double x, double y)
{
    vector z = unit(sum(eye, times(-1, target))), right = unit(across((vector){0, 1, 0}, z)), up = across(z, right);
    double half = tan(FOVY_RAD / 2);
    return sum(sum(times((2 * x / SIZE - 1) * half, right), times((1 - 2 * y / SIZE) * half, up)), times(-1, z));
}

// Lambent shades mirrors and layers at several positions within the pixel, in the plane of the surface at its centre.
static bool moves(const struct paint *p)
{
    return p->m.physical && (p->m.roughness < 0.5f || p->rough || p->m.clearcoat > 0 || p->m.sheen_color.r > 0 ||
                             p->m.iridescence > 0 || p->m.ior != 1.5f || p->m.specular_weight != 1);
}

void add_sample(struct world *w, int x, int y, double light[3])
{
    vector along = ray_through(x + 0.5, y + 0.5);
    struct meeting m;
    if (!nearest(w, eye, along, &m))
        return;
    if (moves(&w->paints[m.board->material])) {
        const struct board *board = m.board;
        along = ray_through(x + number(w), y + number(w));
        m.t = INFINITY;
        if (!meet(board, eye, along, true, &m))
            return;
    }
    follow(w, eye, along, m, light);
}
