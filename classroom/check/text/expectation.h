// expectation.h: the result expected from a pair of shaders: the terms that the exercise requires, and the values of
// undeclared colours.
//
// A term is expected only if one of the term's names is declared. An undeclared colour is white. If the declarations do
// not determine whether a term is expected, several expectations are valid.
#ifndef EXPECTATION_H
#define EXPECTATION_H

#include "shader_interface.h"

// The differences between the expected scene and the reference scene.
enum expectation {
    EXPECT_NO_AMBIENT = 1,
    EXPECT_NO_DIFFUSE = 2,
    EXPECT_NO_SPECULAR = 4,
    EXPECT_WHITE_DIFFUSE = 8,               // the surface's diffuse colour is white
    EXPECT_WHITE_SPECULAR = 16,             // the surface's specular colour is white
    EXPECT_WHITE_LIGHT = 32,                // Ld
    EXPECT_WHITE_SPECULAR_LIGHT = 64,       // Ls
    EXPECT_SPECULAR_LIGHT_AS_DIFFUSE = 128, // Ls is Ld
    EXPECT_WHITE_AMBIENT_LIGHT = 256,
    EXPECT_FULL_DIFFUSE = 512,   // kd is 1
    EXPECT_FULL_SPECULAR = 1024, // ks is 1
};

enum { MAX_EXPECTATIONS = 16 };

// Stores the possible expectations, bits of enum expectation. The first expectation includes the largest number of
// terms. `terms` contains the bits (lam_check_term) of the required terms; 0 means the terms that the declarations
// suggest. Returns the number of expectations, at least 1.
int expectations_of(const struct shader_interface *interface, unsigned terms, unsigned out[MAX_EXPECTATIONS]);

// Returns true if some of the possible expectations include the change that this fault makes, and others do not. The
// change is then an allowed choice and not a mistake.
bool expectation_permits(const struct shader_interface *interface, unsigned terms, const char *fault);

// Changes a scene from shader_interface_scene to the expected scene.
void expectation_apply(unsigned expectation, struct reference_scene *scene);

// Writes a sentence about terms that are not expected and colours that are treated as white. Writes "" if there are
// none.
void expectation_describe(unsigned expectation, const struct shader_interface *interface, unsigned terms, char *out,
                          size_t capacity);

#endif
