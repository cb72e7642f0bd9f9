// gltf_nodes.h: reads the node tree (section 3.5).
#ifndef GLTF_NODES_H
#define GLTF_NODES_H

#include "gltf.h"

struct gltf_node {
    int parent; // −1 for a root
    // The transform as a matrix, or as translation, rotation (a unit quaternion x y z w) and scale.
    bool has_matrix;
    double matrix[16]; // column by column
    double translation[3], rotation[4], scale[3];
    double *weights; // weights of morph targets; NULL means the mesh's weights
    size_t weight_count;
    bool visible;   // KHR_node_visibility: the node and all its ancestors are visible
    bool in_scene;  // the node belongs to the scene that is drawn
    lam_mat4 world; // transform from the node's space to the file's space
};

// Reads all nodes, checks that they form trees, and marks the nodes of the requested scene.
bool gltf_nodes_read(struct gltf *gltf);

// Computes node->world and node->visible for all nodes.
void gltf_nodes_place(struct gltf *gltf);

// Normalizes a quaternion; a zero quaternion becomes the identity.
void gltf_unit_quaternion(double q[4]);

lam_mat4 gltf_transform(const double translation[3], const double rotation[4], const double scale[3]);

#endif
