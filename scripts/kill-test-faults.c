/* Loaded into footfall by scripts/kill-test.py (LD_PRELOAD): at the FAULT_AT-th call that can change a file, counted from
 * 1, the call fails with the error FAULT_ERRNO, or, where that is 0, the process gets the signal FAULT_SIGNAL, before the
 * call. FAULT_COUNT names a file that gets the number of calls. */
#define _GNU_SOURCE
#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <stdarg.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/stat.h>
#include <sys/types.h>
#include <unistd.h>

static atomic_long calls;

static long number(const char* name) {
    const char* text = getenv(name);
    return text ? atol(text) : 0;
}

/* Not 0: the call is to fail. */
static int fault(void) {
    if (++calls != number("FAULT_AT")) return 0;
    const int error = (int)number("FAULT_ERRNO");
    if (error == 0) {
        kill(getpid(), (int)number("FAULT_SIGNAL"));
        usleep(20000); /* until whoever waits for the signal has it */
        return 0;
    }
    errno = error;
    return 1;
}

static __attribute__((destructor)) void tell(void) {
    const char* name = getenv("FAULT_COUNT");
    FILE* file = name ? fopen(name, "w") : NULL;
    if (!file) return;
    fprintf(file, "%ld\n", (long)calls);
    fclose(file);
}

#define REAL(type, name, ...) ((type(*)(__VA_ARGS__))dlsym(RTLD_NEXT, #name))
#define WRAP(type, name, parameters, arguments, ...)                 \
    type name parameters {                                           \
        return fault() ? -1 : REAL(type, name, __VA_ARGS__) arguments; \
    }

WRAP(ssize_t, write, (int f, const void* b, size_t n), (f, b, n), int, const void*, size_t)
WRAP(int, fsync, (int f), (f), int)
WRAP(int, rename, (const char* a, const char* b), (a, b), const char*, const char*)
WRAP(int, renameat2, (int d, const char* a, int e, const char* b, unsigned f), (d, a, e, b, f), int, const char*, int,
     const char*, unsigned)
WRAP(int, linkat, (int d, const char* a, int e, const char* b, int f), (d, a, e, b, f), int, const char*, int, const char*,
     int)
WRAP(int, unlink, (const char* a), (a), const char*)
WRAP(int, mkdir, (const char* a, mode_t m), (a, m), const char*, mode_t)
WRAP(int, rmdir, (const char* a), (a), const char*)
WRAP(int, fchmod, (int f, mode_t m), (f, m), int, mode_t)
WRAP(int, flock, (int f, int o), (f, o), int, int)

int close(int f) {
    /* A close that fails has closed, as on Linux. */
    const int failed = fault(), error = errno, result = REAL(int, close, int)(f);
    if (!failed) return result;
    errno = error;
    return -1;
}

int open(const char* name, int how, ...) {
    va_list rest;
    va_start(rest, how);
    const mode_t mode = how & (O_CREAT | O_TMPFILE) ? va_arg(rest, mode_t) : 0;
    va_end(rest);
    return fault() ? -1 : REAL(int, open, const char*, int, ...)(name, how, mode);
}
