// generate.h: prints texts generated from the tables on standard output.
#ifndef GENERATE_H
#define GENERATE_H

#include "command.h"

void generate_man(void);      // manual.c
void generate_markdown(void); // manual.c
void generate_bash(void);     // completions.c
void generate_zsh(void);
void generate_fish(void);
void generate_scene_schema(void); // scene_schema.c

// Returns the name of a text that can be generated, or NULL if the index is out of range. Indices begin at 0.
const char *generate_kind(int index);

#endif
