// interrupt.c - Signals that end a tool, such as Ctrl-C.
#define _POSIX_C_SOURCE 200809L
#include "tools/common/interrupt.h"
#include "tools/common/file.h"

#include <signal.h>
#include <string.h>
#include <unistd.h>

#define GRACE 1u // Time that a frame has to end after a signal, s.

static volatile sig_atomic_t interrupted;
static char last_words[128];

// End the program at once, in a signal handler.
static void give_up(int number)
{
    (void)number;
    hair_output_remove_all();
    if (write(STDERR_FILENO, last_words, strlen(last_words)) < 0) {} // Nobody is left to tell.
    _exit(HAIR_EXIT_RUNTIME);
}

static void interrupt(int number)
{
    if (interrupted) give_up(number);
    interrupted = 1;
    alarm(GRACE);
}

void hair_interrupt_catch(const char* tool)
{
    struct sigaction action = {0};
    snprintf(last_words, sizeof last_words, "%s: interrupted within a frame\n", tool);
    action.sa_handler = interrupt;
    sigaction(SIGINT, &action, NULL);
    sigaction(SIGTERM, &action, NULL);
    sigaction(SIGHUP, &action, NULL);
    action.sa_handler = give_up;
    sigaction(SIGALRM, &action, NULL);
    action.sa_handler = SIG_IGN; // A failed write reports a reader that went away.
    sigaction(SIGPIPE, &action, NULL);
}

bool hair_interrupted(void)
{
    return interrupted != 0;
}
