// generate.c: the command `generate`: prints texts generated from the tables of options, commands and fields.
#include "classroom.h"
#include "console.h"
#include "command.h"
#include "help_texts.h"

#include <stdio.h>
#include <string.h>

static const struct {
    const char *name;
    void (*print)(void);
} kinds[] = {{"man", generate_man}, {"markdown", generate_markdown}, {"bash", generate_bash},
             {"zsh", generate_zsh}, {"fish", generate_fish},         {"scene-schema", generate_scene_schema}};

enum { KINDS = sizeof kinds / sizeof kinds[0] };

int run_generate(int operand_count, char **operands, const struct options *options)
{
    if (strncmp(operands[0], "contract-", 9) == 0)
        return classroom_run(operand_count, operands, options);
    struct suggestion nearest = suggest_start(operands[0]);
    for (int i = 0; i < KINDS; i++) {
        if (strcmp(kinds[i].name, operands[0]) == 0) {
            kinds[i].print();
            return 0;
        }
        suggest_try(&nearest, kinds[i].name);
    }
    lam_error error;
    complain(&error, LAM_BAD_ARGUMENT,
             "generate: found '%.100s', expected man, markdown, bash, zsh, fish, scene-schema, contract-schema or "
             "contract-NAME%s%s%s",
             operands[0], nearest.best ? "; did you mean '" : "", nearest.best ? nearest.best : "",
             nearest.best ? "'?" : "");
    say_error(error.text);
    return exit_code_of(error.code)->code;
}

// --- the completion scripts of bash, zsh and fish, which call `lambent complete` (complete.c).

// bash also splits words at : and = and replaces only the last fragment. COMP_LINE contains the words as typed.
void generate_bash(void)
{
    printf("# Completions of lambent for bash, made by `lambent generate bash`.\n"
           "_lambent()\n{\n"
           "    local IFS=$' \\t\\n' line=\"${COMP_LINE:0:COMP_POINT}\" word candidate files=\n"
           "    local -a words\n"
           "    read -a words <<<\"$line\"\n"
           "    [[ $line == *[[:space:]] ]] && words+=(\"\")\n"
           "    word=\"${words[-1]}\"\n"
           "    local breaks=\"${COMP_WORDBREAKS//[^:=@]/}\" kept=\n"
           "    [[ $breaks ]] && kept=\"${word%%\"${word##*[$breaks]}\"}\" # bash keeps it\n"
           "    COMPREPLY=()\n"
           "    while IFS=$'\\t' read -r candidate _; do\n"
           "        [[ $candidate == :files ]] && files=1 || COMPREPLY+=(\"${candidate#\"$kept\"}\")\n"
           "    done < <(\"${words[0]}\" complete -- \"${words[@]:1}\" 2>/dev/null)\n"
           "    if [[ $files ]]; then\n"
           "        compopt -o filenames 2>/dev/null\n"
           "        while read -r candidate; do COMPREPLY+=(\"$candidate\"); done < <(compgen -f -- "
           "\"${word#\"$kept\"}\")\n"
           "    elif [[ ${#COMPREPLY[@]} -eq 1 && ${COMPREPLY[0]} == *[:=] ]]; then\n"
           "        compopt -o nospace 2>/dev/null\n"
           "    fi\n"
           "}\n"
           "complete -F _lambent lambent\n");
}

void generate_zsh(void)
{
    printf("#compdef lambent\n"
           "# Completions of lambent for zsh, made by `lambent generate zsh`.\n"
           "_lambent()\n{\n"
           "    local line word files=\n"
           "    local -a closed open\n"
           "    for line in \"${(@f)$(\"${words[1]}\" complete -- \"${(@Q)words[2,CURRENT-1]}\" \"${(Q)PREFIX}\" "
           "2>/dev/null)}\"; do\n"
           "        word=\"${line%%%%$'\\t'*}\"\n"
           "        case \"$word\" in\n"
           "            '') ;;\n"
           "            :files) files=1 ;;\n"
           "            *[:=]) open+=(\"${word//:/\\\\:}:${line#*$'\\t'}\") ;;\n"
           "            *) closed+=(\"${word//:/\\\\:}:${line#*$'\\t'}\") ;;\n"
           "        esac\n"
           "    done\n"
           "    local found=1\n"
           "    (( $#closed )) && _describe -V word closed && found=0\n"
           "    (( $#open )) && _describe -V key open -S '' && found=0\n"
           "    if [[ $files ]]; then\n"
           "        compset -P '--*='\n"
           "        _files && found=0\n"
           "    fi\n"
           "    return found\n"
           "}\n"
           "if [[ ${funcstack[1]} == _lambent ]]; then\n"
           "    _lambent \"$@\"\n"
           "else\n"
           "    compdef _lambent lambent\n"
           "fi\n");
}

void generate_fish(void)
{
    printf("# Completions of lambent for fish, made by `lambent generate fish`.\n"
           "function __lambent_words\n"
           "    set -l words (commandline -opc)\n"
           "    $words[1] complete -- $words[2..-1] (commandline -ct) 2>/dev/null\n"
           "end\n"
           "complete -c lambent -f -a '(__lambent_words | string match -v -- :files)'\n"
           "complete -c lambent -n '__lambent_words | string match -q -- :files' -F\n");
}
