// topics.h: defines the subjects of `lambent help TOPIC`. The man page and docs/command-line.md also contain these
// texts.
#ifndef TOPICS_H
#define TOPICS_H

#include <stdint.h>

enum topic_table { TOPIC_NO_TABLE, TOPIC_LIGHT_FIELDS, TOPIC_MATERIAL_FIELDS, TOPIC_EXIT_CODES };

struct topic {
    const char *name; // the argument of `lambent help WORD`
    const char *title;
    uint64_t groups;        // bit g is set if the options of group g belong to the subject
    enum topic_table table; // shown below the options
    const char *text;       // paragraphs with `code` in back quotes, also printed in the man page; may be NULL
};

extern const struct topic topics[]; // in the order of the man page; ends with a NULL name

#endif
