// corner_fan.h: the normals at one position, from the corners that meet there.
//
// Kept apart from the search for those corners, so that it can also be asked for single positions.
#ifndef CORNER_FAN_H
#define CORNER_FAN_H

#include "arena.h"

#include <lambent/mesh.h>

// One corner at the position, seen from it.
struct spoke {
    uint32_t corner;
    uint32_t smoothing_group;
    uint32_t next[3],
        before[3];    // bits of the positions of the triangle's next corner and the one before, −0 as 0
    double normal[3]; // of the triangle, unit; zero without area
    double weight;    // twice the area × the angle at the corner in radians
    uint32_t fan;     // while joining: a spoke that this one is joined to; then the number of its fan
};

// Room that grows with the largest position met; a thread's own.
struct fan_room {
    struct arena arena;
    uint32_t *corners; // for the caller: the corners at a position
    struct spoke *spokes;
    struct fan_edge *edges;
    float (*normals)[3]; // of the fans
    uint32_t room;
};
void fan_room_start(struct fan_room *room, struct call_control *call);
void fan_room_free(struct fan_room *room);
// Makes room for `count` corners, keeping `corners`. False when memory is out.
bool fan_room_reserve(struct fan_room *room, uint32_t count);

// Works out the fans of the `count` corners in room->corners, ascending, all at one position, by the rule in
// normals.h. Returns the number of fans; room->normals[fan] is the fan's unit normal (zero where nothing
// tells one), fans being numbered by their first corner, and room->spokes[i].fan is the fan of corner i.
uint32_t fan_normals(const lam_mesh *mesh, double least_cosine, struct fan_room *room, uint32_t count);

// Puts the corners in order, quickly where they nearly are.
void fan_sort(uint32_t *corners, uint32_t count);

// The cosine that two faces' normals must reach for fan_normals, from the crease angle between them.
double fan_least_cosine(double crease_angle_rad);

// The vertex of a corner.
static inline uint32_t corner_vertex(const lam_mesh *mesh, size_t corner)
{
    return mesh->indices ? mesh->indices[corner] : (uint32_t)corner;
}

#endif
