/* What the tests in C share: calls that must have a status, and sentences about failures. */
#include <incircle.h>
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static int failures = 0;

#define IS(call, status)                                                                          \
    do {                                                                                          \
        int found = (call);                                                                       \
        if (found != (status)) {                                                                  \
            char text[512];                                                                       \
            incircle_error(text, sizeof text);                                                    \
            fprintf(stderr, "line %d: %s is %d: %s\n", __LINE__, #call, found, text);             \
            ++failures;                                                                           \
        }                                                                                         \
    } while (0)
#define TRUE(condition) IS(!(condition), 0)

static const double SQUARE[][2] = {{0, 0}, {4, 0}, {4, 4}, {0, 4}, {4, 0}};

static void says(const char *part) {
    char text[512];
    size_t needed = incircle_error(text, sizeof text);
    TRUE(needed == strlen(text) + 1 && strstr(text, part) != NULL);
    char small[8];
    memset(small, 'x', sizeof small);
    TRUE(incircle_error(small, 5) == needed && strlen(small) == 4 && small[5] == 'x');
    TRUE(incircle_error(NULL, 0) == needed && incircle_error(NULL, 9) == needed);
    TRUE(incircle_error(small, 1) == needed && small[0] == 0);
}
