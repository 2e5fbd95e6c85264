/* Preloaded: the k-th call that would change something below a watched folder fails, once or from then on; and a file
   that is renamed although its last write was not synced is noted: a power cut would leave its name without content.
   What is counted and noted lives in memory that forked children share. */
#define _GNU_SOURCE
#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <stdarg.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <sys/types.h>
#include <sys/uio.h>
#include <unistd.h>

enum { MOST_SYNCED = 4096 };

typedef struct {
  atomic_long calls, fails_at;
  int error, lasting; /* errno; whether the later calls fail, too */
  char below[PATH_MAX];
  atomic_int n_synced;
  struct stat synced[MOST_SYNCED]; /* as they were when they were synced */
  char unsynced[PATH_MAX];
} faults;

static faults *state;

__attribute__((constructor)) static void begin(void) {
  state = mmap(NULL, sizeof *state, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  const char *always = getenv("LACUNA_TEST_FAULT"); /* of programs that the tested one starts: folder:errno */
  const char *colon = always ? strrchr(always, ':') : NULL;
  if (!colon) return;
  memcpy(state->below, always, (size_t)(colon - always));
  state->error = atoi(colon + 1);
  state->lasting = state->fails_at = 1;
}

/* Fails call `number` (0: none; from 1) below `folder`; forgets what was counted. */
void fault_arm(const char *folder, long number, int error, int lasting) {
  state->calls = state->n_synced = 0;
  state->unsynced[0] = 0;
  state->error = error;
  state->lasting = lasting;
  snprintf(state->below, sizeof state->below, "%s", folder);
  state->fails_at = number;
}

long fault_calls(void) {
  return state->calls;
}
const char *fault_unsynced(void) {
  return state->unsynced;
}

static int watched(const char *path) {
  const size_t n = state ? strlen(state->below) : 0;
  return n && strncmp(path, state->below, n) == 0 && (path[n] == '/' || !path[n]);
}

static int fails(void) {
  const long number = ++state->calls;
  if (!state->fails_at || number < state->fails_at || (number > state->fails_at && !state->lasting)) return 0;
  errno = state->error;
  return 1;
}

static const char *path_of(int fd, char *path, size_t size) {
  char link[64];
  snprintf(link, sizeof link, "/proc/self/fd/%d", fd);
  const ssize_t n = readlink(link, path, size - 1);
  path[n < 0 ? 0 : n] = 0;
  return path;
}

static int at_fails(int folder, const char *path) {
  char whole[2 * PATH_MAX], base[PATH_MAX];
  if (!path) return 0;
  if (path[0] == '/') return watched(path) && fails();
  if (folder == AT_FDCWD)
    if (!getcwd(base, sizeof base)) return 0;
  if (folder != AT_FDCWD) path_of(folder, base, sizeof base);
  snprintf(whole, sizeof whole, "%s/%s", base, path);
  return watched(whole) && fails();
}

static int fd_fails(int fd) {
  char path[PATH_MAX];
  return state && state->below[0] && watched(path_of(fd, path, sizeof path)) && fails();
}

static int same(const struct stat *a, const struct stat *b) {
  return a->st_ino == b->st_ino && a->st_size == b->st_size && a->st_mtim.tv_sec == b->st_mtim.tv_sec &&
         a->st_mtim.tv_nsec == b->st_mtim.tv_nsec;
}

static void note_sync(int fd) {
  const int k = state->n_synced++ % MOST_SYNCED;
  fstat(fd, &state->synced[k]);
}

static int renaming_fails(int from, const char *old, int to, const char *new) {
  struct stat now;
  if (at_fails(to, new)) return 1;
  if (!state || !state->below[0] || fstatat(from, old, &now, AT_SYMLINK_NOFOLLOW) || !S_ISREG(now.st_mode)) return 0;
  for (int k = 0; k < state->n_synced && k < MOST_SYNCED; ++k)
    if (same(&now, &state->synced[k])) return 0;
  snprintf(state->unsynced, sizeof state->unsynced, "%s", new);
  return 0;
}

#define REAL(name, type) ((type)dlsym(RTLD_NEXT, #name))
#define CHANGES(flags)   ((flags) & (O_WRONLY | O_RDWR | O_CREAT | O_TRUNC))

#define OPEN(name)                                                                                                     \
  int name(const char *path, int flags, ...) {                                                                         \
    va_list more;                                                                                                      \
    va_start(more, flags);                                                                                             \
    const int mode = (flags & (O_CREAT | O_TMPFILE)) ? va_arg(more, int) : 0;                                          \
    va_end(more);                                                                                                      \
    if (CHANGES(flags) && at_fails(AT_FDCWD, path)) return -1;                                                         \
    return REAL(name, int (*)(const char *, int, int))(path, flags, mode);                                             \
  }
OPEN(open)
OPEN(open64)

#define OPENAT(name)                                                                                                   \
  int name(int folder, const char *path, int flags, ...) {                                                             \
    va_list more;                                                                                                      \
    va_start(more, flags);                                                                                             \
    const int mode = (flags & (O_CREAT | O_TMPFILE)) ? va_arg(more, int) : 0;                                          \
    va_end(more);                                                                                                      \
    if (CHANGES(flags) && at_fails(folder, path)) return -1;                                                           \
    return REAL(name, int (*)(int, const char *, int, int))(folder, path, flags, mode);                                \
  }
OPENAT(openat)
OPENAT(openat64)

#define ON_FD(result, name, parameters, arguments, types)                                                              \
  result name parameters {                                                                                             \
    if (fd_fails(fd)) return -1;                                                                                       \
    return REAL(name, result(*) types) arguments;                                                                      \
  }
ON_FD(ssize_t, write, (int fd, const void *b, size_t n), (fd, b, n), (int, const void *, size_t))
ON_FD(ssize_t, pwrite, (int fd, const void *b, size_t n, off_t at), (fd, b, n, at), (int, const void *, size_t, off_t))
ON_FD(ssize_t, pwrite64, (int fd, const void *b, size_t n, off64_t at), (fd, b, n, at),
      (int, const void *, size_t, off64_t))
ON_FD(ssize_t, writev, (int fd, const struct iovec *v, int n), (fd, v, n), (int, const struct iovec *, int))
int fsync(int fd) {
  if (fd_fails(fd)) return -1;
  if (state && state->below[0]) note_sync(fd);
  return REAL(fsync, int (*)(int))(fd);
}
ON_FD(int, fdatasync, (int fd), (fd), (int))
ON_FD(int, ftruncate, (int fd, off_t n), (fd, n), (int, off_t))
ON_FD(int, ftruncate64, (int fd, off64_t n), (fd, n), (int, off64_t))

#define ON_PATH(name, folder, path, parameters, arguments, types)                                                      \
  int name parameters {                                                                                                \
    if (at_fails(folder, path)) return -1;                                                                             \
    return REAL(name, int(*) types) arguments;                                                                         \
  }
ON_PATH(mkdir, AT_FDCWD, p, (const char *p, mode_t m), (p, m), (const char *, mode_t))
ON_PATH(mkdirat, d, p, (int d, const char *p, mode_t m), (d, p, m), (int, const char *, mode_t))
int rename(const char *p, const char *q) {
  if (renaming_fails(AT_FDCWD, p, AT_FDCWD, q)) return -1;
  return REAL(rename, int (*)(const char *, const char *))(p, q);
}
int renameat(int d, const char *p, int e, const char *q) {
  if (renaming_fails(d, p, e, q)) return -1;
  return REAL(renameat, int (*)(int, const char *, int, const char *))(d, p, e, q);
}
ON_PATH(link, AT_FDCWD, q, (const char *p, const char *q), (p, q), (const char *, const char *))
ON_PATH(linkat, e, q, (int d, const char *p, int e, const char *q, int f), (d, p, e, q, f),
        (int, const char *, int, const char *, int))
ON_PATH(unlink, AT_FDCWD, p, (const char *p), (p), (const char *))
ON_PATH(unlinkat, d, p, (int d, const char *p, int f), (d, p, f), (int, const char *, int))
ON_PATH(rmdir, AT_FDCWD, p, (const char *p), (p), (const char *))
ON_PATH(chmod, AT_FDCWD, p, (const char *p, mode_t m), (p, m), (const char *, mode_t))
