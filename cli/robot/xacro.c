// The program xacro as a child: no shell, its arguments as they were given, what it writes read through a pipe, with a
// limit on bytes and on seconds. What it has to say goes to standard error, as it is.
#include "robot/xacro.h"

#include "base/message.h"
#include "base/outputs.h"
#include "base/progress.h"

#include <errno.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

extern char **environ;

/// Most bytes of an expanded file, which the library reads, too, and seconds that expanding may take.
enum { SIZE_MOST = 1 << 26, SECONDS_MOST = 60 };
#define TOO_LONG "took more than 60 s"

int xacro_is_file(const char *path) { return path && outputs_has_extension(path, "xacro"); }

/// Starts the program. *from: what it writes. 0, or EXIT_INPUT after a message.
static int start(const char *path, char **words, pid_t *child, int *from) {
    int ends[2];
    posix_spawn_file_actions_t actions;
    if (pipe(ends) != 0) return message_error("%s: no pipe: %s", path, strerror(errno)), EXIT_INPUT;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_adddup2(&actions, ends[1], STDOUT_FILENO);
    posix_spawn_file_actions_addclose(&actions, ends[0]);
    posix_spawn_file_actions_addclose(&actions, ends[1]);
    // The tool passes over SIGPIPE; the program must not.
    posix_spawnattr_t attributes;
    sigset_t signals;
    posix_spawnattr_init(&attributes);
    sigemptyset(&signals);
    sigaddset(&signals, SIGPIPE);
    posix_spawnattr_setsigdefault(&attributes, &signals);
    posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGDEF);
    int wrong = posix_spawnp(child, "xacro", &actions, &attributes, words, environ);
    posix_spawnattr_destroy(&attributes);
    posix_spawn_file_actions_destroy(&actions);
    close(ends[1]);
    *from = ends[0];
    if (!wrong) return 0;
    close(ends[0]);
    if (wrong == ENOENT)
        message_error(
            "%s: this is xacro, of which URDF is made, and the program xacro is not on PATH: install it "
            "(Debian: xacro or ros-DISTRO-xacro; pip install xacro), or run \"xacro FILE > robot.urdf\" where "
            "it is, and give robot.urdf",
            path);
    else
        message_error("%s: the program xacro cannot be started: %s", path, strerror(wrong));
    return EXIT_INPUT;
}

/// Reads what the program writes, within the limits. NULL: all was read; else what is wrong.
static const char *read_output(int from, double end, ovoid_robot_text *text) {
    size_t capacity = 0;
    char *data = NULL;
    for (;;) {
        struct pollfd wait = {from, POLLIN, 0};
        double rest = end - progress_get_seconds();
        int ready = rest > 0 ? poll(&wait, 1, (int)(1000 * rest) + 1) : 0;
        if (ready < 0 && errno == EINTR) continue;
        text->data = data;
        if (ready <= 0) return TOO_LONG;
        if (text->size >= SIZE_MOST) return "wrote more than 64 MB";
        size_t room = text->size + (1 << 16);
        if (room > capacity) {
            capacity = 2 * room;
            char *more = realloc(data, capacity);
            if (!more) return "wrote more than there is memory for";
            text->data = data = more;
        }
        ssize_t count = read(from, data + text->size, 1 << 16);
        if (count < 0 && errno == EINTR) continue;
        if (count < 0) return "cannot be read";
        if (count == 0) return NULL;
        text->size += (size_t)count;
    }
}

/// Waits for the end of the program, which is killed where something is wrong, or where it does not end in time.
static int wait_for(pid_t child, double end, const char **wrong) {
    const struct timespec pause = {0, 5000000};
    int status = 0;
    for (;;) {
        if (*wrong) (void)kill(child, SIGKILL);
        pid_t ended = waitpid(child, &status, *wrong ? 0 : WNOHANG);
        if (ended == child || (ended < 0 && errno != EINTR)) return status;
        if (progress_get_seconds() > end) *wrong = TOO_LONG;
        if (!*wrong) (void)nanosleep(&pause, NULL);
    }
}

/// Ends the program. 0, or EXIT_INPUT after a message.
static int finish(pid_t child, const char *path, double end, const char *wrong) {
    int status = wait_for(child, end, &wrong);
    if (wrong)
        message_error("%s: xacro %s", path, wrong);
    else if (WIFEXITED(status) && WEXITSTATUS(status) == 0)
        return 0;
    else if (WIFEXITED(status))
        message_error("%s: xacro ended with the exit code %d; what it says stands above", path, WEXITSTATUS(status));
    else
        message_error("%s: xacro was ended by signal %d", path, WTERMSIG(status));
    return EXIT_INPUT;
}

/// The command line: the file, behind "./" where it would be an option, and the arguments. NULL where memory is out.
static char **make_words(char *file, const args_list *arguments) {
    char **words = calloc((size_t)arguments->count + 3, sizeof *words);
    static char name[] = "xacro";
    if (!words) return NULL;
    words[0] = name;
    words[1] = file;
    for (int i = 0; i < arguments->count; i++) words[2 + i] = (char *)arguments->items[i];
    return words;
}

int xacro_expand(const cli_command *command, const char *path, const args_list *arguments, ovoid_robot_text *text) {
    *text = (ovoid_robot_text){path, NULL, 0};
    for (int i = 0; i < arguments->count; i++) {
        const char *sign = strstr(arguments->items[i], ":=");
        if (!sign || sign == arguments->items[i] || arguments->items[i][0] == '-')
            return args_complain(command, "%s: --xacro needs NAME:=VALUE, got \"%s\"", command->name,
                                 arguments->items[i]);
    }
    size_t size = strlen(path) + 3;
    char *file = malloc(size);
    char **words = file ? make_words(file, arguments) : NULL;
    if (!words) return free(file), message_error("out of memory"), EXIT_INPUT;
    snprintf(file, size, "%s%s", path[0] == '-' ? "./" : "", path);
    pid_t child;
    int from, code = start(path, words, &child, &from);
    if (!code) {
        double end = progress_get_seconds() + SECONDS_MOST;
        const char *wrong = read_output(from, end, text);
        close(from);
        code = finish(child, path, end, wrong);
    }
    free(words);
    free(file);
    if (!code) return 0;
    free((char *)text->data);
    *text = (ovoid_robot_text){path, NULL, 0};
    return code;
}
