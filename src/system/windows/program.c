// program.c: the entry point of a program for Windows: converts the arguments to UTF-8, makes the streams binary, and
// then calls main().
#include "names.h"

#include <fcntl.h>
#include <io.h>
#include <stdlib.h>
#include <windows.h>

int main(int count, char **words);
int wmain(int count, wchar_t **wide);

static UINT before; // the console's code page before the program started

static void restore_console(void) { SetConsoleOutputCP(before); }

// Backslashes in arguments become slashes, because the program recognises folders only by slashes.
int wmain(int count, wchar_t **wide)
{
    char **words = calloc((size_t)count + 1, sizeof *words);
    for (int i = 0; words && i < count; i++)
        if (!(words[i] = narrow_text(wide[i], 1)))
            return 1;
    if (!words)
        return 1;
    for (int stream = 0; stream <= 2; stream++)
        _setmode(stream, _O_BINARY);
    before = GetConsoleOutputCP();
    if (before && SetConsoleOutputCP(CP_UTF8))
        atexit(restore_console);
    return main(count, words);
}
