// expectation.h: the result expected from a pair of shaders: the terms that the exercise demands, and the value of
// colours that the shaders do not declare.
//
// A term of whose names none is declared is not asked for. A colour that is not declared is white. Where the
// declarations leave it open whether a term is asked for, several expectations are right.
#ifndef EXPECTATION_H
#define EXPECTATION_H

#include "shader_interface.h"

// How the expected scene departs from the reference scene.
enum expectation {
    EXPECT_NO_AMBIENT = 1,
    EXPECT_NO_DIFFUSE = 2,
    EXPECT_NO_SPECULAR = 4,
    EXPECT_WHITE_DIFFUSE = 8,               // of the surface
    EXPECT_WHITE_SPECULAR = 16,             // of the surface
    EXPECT_WHITE_LIGHT = 32,                // Ld
    EXPECT_WHITE_SPECULAR_LIGHT = 64,       // Ls
    EXPECT_SPECULAR_LIGHT_AS_DIFFUSE = 128, // Ls is Ld
    EXPECT_WHITE_AMBIENT_LIGHT = 256,
    EXPECT_FULL_DIFFUSE = 512,   // kd is 1
    EXPECT_FULL_SPECULAR = 1024, // ks is 1
};

enum { MAX_EXPECTATIONS = 16 };

// Stores the possible expectations, bits of enum expectation, those with most terms first. `terms`: demanded bits of
// lam_check_term; 0: the terms that the declarations show. Returns their count, at least 1.
int expectations_of(const struct shader_interface *interface, unsigned terms, unsigned out[MAX_EXPECTATIONS]);

// Whether a fault of the table only makes a choice that the declarations leave open, so that it is none: some of the
// possible expectations include the change, and others do not.
bool expectation_permits(const struct shader_interface *interface, unsigned terms, const char *fault);

// Changes a scene from shader_interface_scene to the expected one.
void expectation_apply(unsigned expectation, struct reference_scene *scene);

// A sentence about terms that are not expected or taken as white; "" if there is nothing to say.
void expectation_describe(unsigned expectation, const struct shader_interface *interface, unsigned terms, char *out,
                          size_t capacity);

#endif
