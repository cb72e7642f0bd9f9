// name_similarity.c: compares names of shaders word by word. For example, "eye_position" and "eyePoint" both mean the
// position of the eye.
#include "name_similarity.h"

#include <ctype.h>
#include <string.h>

#include <lambent/base.h>

enum { MAX_WORDS = 6, WORD_LENGTH = 24 };
static const double min_similarity = 0.5;

// Words in the same row have the same meaning. Words in different rows of one class contradict each other.
enum { CLASS_OWNER, CLASS_KIND, CLASS_TERM, CLASS_POWER, CLASS_SPACE, CLASS_FALLOFF };
static const struct {
    int class;
    const char *words; // separated by blanks
} roles[] = {
    {CLASS_OWNER, "eye view viewer camera cam v e"},
    {CLASS_OWNER, "light lamp lights l"},
    {CLASS_OWNER, "half halfway h"},
    {CLASS_OWNER, "normal normals norm n"},
    {CLASS_OWNER, "reflect reflected reflection r"},
    {CLASS_KIND, "position pos point location place p"},
    {CLASS_KIND, "direction dir vector vec"},
    {CLASS_KIND, "matrix mat mtx"},
    {CLASS_KIND, "color colour col"},
    {CLASS_TERM, "ambient amb ka"},
    {CLASS_TERM, "diffuse diff kd"},
    {CLASS_TERM, "specular spec ks"},
    {CLASS_TERM, "shininess shine gloss exponent"},
    {CLASS_TERM, "emission emissive ke"},
    {CLASS_POWER, "constant const"},
    {CLASS_POWER, "linear lin"},
    {CLASS_POWER, "quadratic quad"},
    {CLASS_SPACE, "model object world"},
    {CLASS_SPACE, "projection proj perspective"},
    {CLASS_FALLOFF, "attenuation atten att falloff"},
};
enum { ROLES = sizeof roles / sizeof roles[0] };

struct name_words {
    char words[MAX_WORDS][WORD_LENGTH];
    int roles[MAX_WORDS]; // index of the row, or −1
    int count;
};

static int role_of(const char *word)
{
    size_t length = strlen(word);
    for (int i = 0; i < ROLES; i++)
        for (const char *at = roles[i].words; (at = strstr(at, word)); at += length)
            if ((at == roles[i].words || at[-1] == ' ') && (at[length] == ' ' || at[length] == 0))
                return i;
    return -1;
}

// Splits a name into words at punctuation and capitals: "uLightPosition" and "light_position" become "light",
// "position". Removes the prefix that marks the kind of variable (vNormal, fN, uKa).
static void split(const char *name, struct name_words *out)
{
    *out = (struct name_words){0};
    if (strchr("vfuagi", name[0]) && name[0] && isupper((unsigned char)name[1]))
        name++;
    size_t length = 0;
    for (const char *c = name; out->count < MAX_WORDS; c++) {
        bool starts = isupper((unsigned char)*c) && c > name && islower((unsigned char)c[-1]);
        if (length > 0 && (starts || *c == 0 || *c == '_' || *c == '.' || *c == '[' || *c == ']')) {
            out->roles[out->count] = role_of(out->words[out->count]);
            out->count++;
            length = 0;
        }
        if (*c == 0)
            break;
        if (out->count < MAX_WORDS && isalnum((unsigned char)*c) && length + 1 < WORD_LENGTH)
            out->words[out->count][length++] = (char)tolower((unsigned char)*c);
    }
}

static bool same_word(const struct name_words *a, int i, const struct name_words *b, int k)
{
    return (a->roles[i] >= 0 && a->roles[i] == b->roles[k]) || strcmp(a->words[i], b->words[k]) == 0;
}

static bool has_word(const struct name_words *a, const struct name_words *b, int k)
{
    for (int i = 0; i < a->count; i++)
        if (same_word(a, i, b, k))
            return true;
    return false;
}

// Returns whether a word of one name contradicts a word of the other name. Only words of the same class can contradict
// each other.
static bool contradict(const struct name_words *a, const struct name_words *b)
{
    for (int i = 0; i < a->count; i++)
        for (int k = 0; k < b->count; k++)
            if (a->roles[i] >= 0 && b->roles[k] >= 0 && a->roles[i] != b->roles[k] &&
                roles[a->roles[i]].class == roles[b->roles[k]].class && !has_word(a, b, k) && !has_word(b, a, i))
                return true;
    return false;
}

// Returns the number of words that occur in both names, divided by the number of different words in the two names. Sets
// `telling` if one of the shared words is more specific than position, matrix or colour.
static double shared_words(const struct name_words *a, const struct name_words *b, bool *telling)
{
    int shared = 0;
    *telling = false;
    for (int i = 0; i < a->count; i++)
        if (has_word(b, a, i)) {
            shared++;
            *telling = *telling || a->roles[i] < 0 || roles[a->roles[i]].class != CLASS_KIND;
        }
    int all = a->count + b->count - shared;
    return all > 0 ? (double)shared / all : 0;
}

// Gets the sound of a name: the consonants of the name, without repetitions. Similar consonants become the same letter.
// "colour" and "color" become klr; "normalise" and "normalize" become nrmls.
static void sound_of(const char *name, char out[WORD_LENGTH])
{
    size_t length = 0;
    for (const char *c = name; *c && length + 1 < WORD_LENGTH; c++) {
        int letter = tolower((unsigned char)*c);
        if (letter == 'p' && tolower((unsigned char)c[1]) == 'h') {
            letter = 'f';
            c++;
        }
        letter = letter == 'c' || letter == 'q' ? 'k' : letter == 'z' ? 's' : letter;
        if (isalnum(letter) && !strchr("aeiouyh", letter) && (!length || out[length - 1] != letter))
            out[length++] = (char)letter;
    }
    out[length] = 0;
}

bool name_is_same(const char *a, const char *b)
{
    for (;; a++, b++) {
        a += strspn(a, "_");
        b += strspn(b, "_");
        if (tolower((unsigned char)*a) != tolower((unsigned char)*b))
            return false;
        if (!*a)
            return true;
    }
}

static void lower(const char *name, char out[64])
{
    size_t i = 0;
    for (; name[i] && i < 63; i++)
        out[i] = (char)tolower((unsigned char)name[i]);
    out[i] = 0;
}

double name_similarity(const char *a, const char *b)
{
    if (name_is_same(a, b))
        return 1;
    struct name_words words_a, words_b;
    split(a, &words_a);
    split(b, &words_b);
    bool telling = false, several = words_a.count > 1 && words_b.count > 1;
    double shared = shared_words(&words_a, &words_b, &telling);
    if (contradict(&words_a, &words_b))
        return 0;
    if (shared == 1)
        return 0.95;
    char lower_a[64], lower_b[64], sound_a[WORD_LENGTH], sound_b[WORD_LENGTH];
    lower(a, lower_a);
    lower(b, lower_b);
    size_t length = strlen(lower_a) < strlen(lower_b) ? strlen(lower_a) : strlen(lower_b);
    int distance = lam_edit_distance(lower_a, lower_b);
    int allowed = length < 3 ? 0 : length < 6 ? 1 : length < 12 ? 2 : 3;
    if (distance <= allowed)
        return 0.9 - 0.3 * distance / (double)length;
    sound_of(a, sound_a);
    sound_of(b, sound_b);
    if (strlen(sound_a) >= 3 && strcmp(sound_a, sound_b) == 0)
        return 0.75;
    if (several && telling && shared >= 0.5)
        return 0.5 + 0.2 * shared;
    // material_specular and reflect_specular name the same term with different prefixes.
    int last = words_a.count - 1;
    bool same_term = several && words_a.roles[last] >= 0 && roles[words_a.roles[last]].class == CLASS_TERM &&
                     same_word(&words_a, last, &words_b, words_b.count - 1);
    return same_term ? min_similarity : 0;
}

const char *name_nearest(const char *name, const char *const *candidates, int count)
{
    const char *nearest = NULL;
    double best = min_similarity;
    for (int i = 0; i < count; i++) {
        double similarity =
            candidates[i] && strcmp(candidates[i], name) != 0 ? name_similarity(name, candidates[i]) : 0;
        if (similarity > best || (similarity == best && !nearest)) {
            best = similarity;
            nearest = candidates[i];
        }
    }
    return nearest;
}
