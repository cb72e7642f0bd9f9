// completions.c: generates the completions of bash, zsh and fish from the tables of options and commands.
#include "generate.h"

#include <stdio.h>
#include <string.h>

// Prints the words that a value may be, separated by spaces.
static void words_of(const struct option *o)
{
    for (const struct word *w = o->words; w->name; w++)
        printf("%s%s", w == o->words ? "" : " ", w->name);
}

// Prints the possible first words, commands and shapes, separated by spaces.
static void first_words(void)
{
    for (const struct command *c = command_table; c->name; c++)
        printf("%s ", c->name);
    for (int i = 0; i < lam_shape_count(); i++)
        printf("%s%s", i ? " " : "", lam_shape_name(i));
}

void generate_bash(void)
{
    printf("# Completions of lambent for bash, made by `lambent generate bash`.\n"
           "_lambent()\n{\n"
           "    local now=\"${COMP_WORDS[COMP_CWORD]}\" before=\"${COMP_WORDS[COMP_CWORD-1]}\"\n"
           "    COMPREPLY=()\n"
           "    case \"$before\" in\n");
    for (const struct option *o = option_table; o->name; o++) {
        if (!o->value)
            continue;
        printf("        --%s", o->name);
        if (o->letter)
            printf("|-%c", o->letter);
        printf(") ");
        if (o->words) {
            printf("COMPREPLY=($(compgen %s-W '", o->takes_file ? "-f " : "");
            words_of(o);
            printf("' -- \"$now\"));");
        } else if (o->takes_file) {
            printf("COMPREPLY=($(compgen -f -- \"$now\"));");
        }
        printf(" return ;;\n");
    }
    printf("        generate) COMPREPLY=($(compgen -W 'man markdown bash zsh fish' -- \"$now\")); return ;;\n"
           "    esac\n"
           "    if [[ $now == -* ]]; then\n"
           "        COMPREPLY=($(compgen -W '");
    for (const struct option *o = option_table; o->name; o++)
        printf("%s--%s", o == option_table ? "" : " ", o->name);
    printf("' -- \"$now\"))\n"
           "        return\n"
           "    fi\n"
           "    COMPREPLY=($(compgen -f -- \"$now\"))\n"
           "    if [[ $COMP_CWORD -eq 1 ]]; then\n"
           "        COMPREPLY+=($(compgen -W '");
    first_words();
    printf("' -- \"$now\"))\n"
           "    fi\n"
           "}\n"
           "complete -o filenames -F _lambent lambent\n");
}

// Escapes a text inside single quotes of zsh's _arguments: brackets and colons have a meaning there, a quote ends it.
static void zsh_text(const char *text)
{
    for (; *text; text++) {
        if (*text == '\'')
            fputs("'\\''", stdout);
        else if (*text == '[' || *text == ']' || *text == ':' || *text == '\\')
            printf("\\%c", *text);
        else if (*text != '`')
            putchar(*text);
    }
}

void generate_zsh(void)
{
    printf("#compdef lambent\n# Completions of lambent for zsh, made by `lambent generate zsh`.\n_arguments "
           "-S \\\n");
    for (const struct option *o = option_table; o->name; o++) {
        printf("  ");
        if (o->letter)
            printf("'(-%c --%s)'{-%c%s,--%s%s}", o->letter, o->name, o->letter, o->value ? "+" : "", o->name,
                   o->value ? "=" : "");
        else
            printf("--%s%s", o->name, o->value ? "=" : "");
        printf("'[");
        zsh_text(o->summary);
        printf("]");
        if (o->value) {
            printf(":");
            zsh_text(o->value);
            printf(":");
            if (o->words) {
                printf("(");
                words_of(o);
                printf(")");
            } else if (o->takes_file) {
                printf("_files");
            }
        }
        printf("' \\\n");
    }
    printf("  '1:model or command:_alternative \"words:command or shape:(");
    first_words();
    printf(")\" \"files:model:_files\"' \\\n"
           "  '*:model:_files'\n");
}

static void fish_text(const char *text)
{
    for (; *text; text++) {
        if (*text == '\'' || *text == '\\')
            printf("\\%c", *text);
        else if (*text != '`')
            putchar(*text);
    }
}

void generate_fish(void)
{
    printf("# Completions of lambent for fish, made by `lambent generate fish`.\n");
    for (const struct option *o = option_table; o->name; o++) {
        printf("complete -c lambent -l %s", o->name);
        if (o->letter)
            printf(" -s %c", o->letter);
        if (o->value)
            printf(o->takes_file ? " -r" : " -x");
        if (o->words) {
            printf(" -a '");
            words_of(o);
            printf("'");
        }
        printf(" -d '");
        fish_text(o->summary);
        printf("'\n");
    }
    for (const struct command *c = command_table; c->name; c++) {
        printf("complete -c lambent -n __fish_is_first_arg -a %s -d '", c->name);
        fish_text(c->summary);
        printf("'\n");
    }
    for (int i = 0; i < lam_shape_count(); i++) {
        printf("complete -c lambent -n __fish_is_first_arg -a %s -d '", lam_shape_name(i));
        fish_text(lam_shape_summary(i));
        printf("'\n");
    }
    printf("complete -c lambent -n '__fish_seen_subcommand_from generate' -x -a 'man markdown bash zsh fish'\n");
}
