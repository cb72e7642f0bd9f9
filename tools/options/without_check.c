// without_check.c: defines functions of the shader check for programs that are built without the check
// (-Dclassroom=false, and the web page's module). The option tables and the help call these functions. Here, the
// functions return no contracts and no mistakes.
#include <lambent/check.h>

#include <stddef.h>

const char *lam_check_contract_shipped(int index)
{
    (void)index;
    return NULL;
}

const char *lam_check_contract_text(const char *name)
{
    (void)name;
    return NULL;
}

const char *lam_check_mistake(int index)
{
    (void)index;
    return NULL;
}

const char *lam_check_mistake_explanation(int index)
{
    (void)index;
    return NULL;
}
