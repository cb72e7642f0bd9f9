// explain_rows.c: prints aligned rows of an explanation: a name, numbers and a remark.
#include "explain.h"

#include <stdio.h>

enum { COLUMN = 26 };

// Prints a label and its padding, counted in characters, not bytes.
void row_label(int indent, const char *text)
{
    int width = indent;
    for (const char *s = text; *s; s++)
        width += (*s & 0xC0) != 0x80;
    printf("%*s%s%*s", indent, "", text, width < COLUMN ? COLUMN - width : 1, "");
}

void row_three(int indent, const char *name, double x, double y, double z, const char *remark)
{
    row_label(indent, name);
    printf("%13.7g %13.7g %13.7g%s%s\n", x + 0.0, y + 0.0, z + 0.0, *remark ? "   " : "", remark);
}

// Prints the names of the columns.
void row_heading(int indent, const char *name, const char *alpha)
{
    row_label(indent, name);
    printf("%13s %13s %13s%s\n", "red", "green", "blue", alpha);
}

void row_vector(int indent, const char *name, lam_vec3 v, const char *remark)
{
    row_three(indent, name, v.x, v.y, v.z, remark);
}

void row_color(int indent, const char *name, lam_rgb c, const char *remark)
{
    row_three(indent, name, (double)c.r, (double)c.g, (double)c.b, remark);
}

void row_number(int indent, const char *name, double x, const char *remark)
{
    row_label(indent, name);
    printf("%13.7g%s%s\n", x, *remark ? "   " : "", remark);
}

void row_angle(const char *name, double radians, const char *remark)
{
    row_label(4, name);
    if (radians - radians == 0)
        printf("%12.5f°   %s\n", in_degrees(radians), remark);
    else
        printf("%13s   %s\n", "none", remark);
}
