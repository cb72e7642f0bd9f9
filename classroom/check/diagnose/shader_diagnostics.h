// shader_diagnostics.h: diagnostics of shaders that were refused, and of names and types that do not fit the contract.
#ifndef SHADER_DIAGNOSTICS_H
#define SHADER_DIAGNOSTICS_H

#include "diagnostics.h"
#include "draw_request.h"
#include "shader_interface.h"

// The driver's log of a refused shader, line by line, with hints for the messages that are known.
void diagnostics_add_refusal(struct diagnostics *diagnostics, const struct draw_result *result,
                             const struct shader_interface *interface, const lam_check_params *params);

// Names that the contract does not know and types that do not fit, whether or not the shaders compile.
void diagnostics_add_names(struct diagnostics *diagnostics, const struct draw_result *result,
                           const struct shader_interface *interface, const lam_check_params *params);

#endif
