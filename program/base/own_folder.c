// own_folder.c: finds the folder of this program.
#include "own_folder.h"

#include <stdlib.h>
#include <string.h>
#include <sys/types.h>
#include <unistd.h>
#ifdef __linux__
#include <sys/auxv.h>
#endif

bool own_folder(char folder[PATH_MAX])
{
    ssize_t length = readlink("/proc/self/exe", folder, PATH_MAX - 1);
    folder[length > 0 ? length : 0] = 0;
#ifdef __linux__
    const char *file = (const char *)getauxval(AT_EXECFN);
    if (length <= 0 && (!file || !realpath(file, folder))) // /proc is not mounted
        folder[0] = 0;
#endif
    char *slash = strrchr(folder, '/');
    folder[slash ? slash + 1 - folder : 0] = 0;
    return slash != NULL;
}
