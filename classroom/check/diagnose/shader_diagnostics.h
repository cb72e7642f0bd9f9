// shader_diagnostics.h: diagnostics of shaders that do not compile, and of names and types that do not match the
// contract.
#ifndef SHADER_DIAGNOSTICS_H
#define SHADER_DIAGNOSTICS_H

#include "diagnostics.h"
#include "draw_request.h"
#include "shader_interface.h"

// Adds the driver's log of a shader that does not compile, line by line, with hints for known messages.
void diagnostics_add_refusal(struct diagnostics *diagnostics, const struct draw_result *result,
                             const struct shader_interface *interface, const lam_check_params *params);

// Reports unknown names and mismatched types, whether or not the shaders compile.
void diagnostics_add_names(struct diagnostics *diagnostics, const struct draw_result *result,
                           const struct shader_interface *interface, const lam_check_params *params);

#endif
