/* Leaves a process behind that has left its group and its session, and has no parent any more. */
#include <sys/wait.h>
#include <unistd.h>

#include "planted.h"

static void stay(void) {
  setsid();
  if (fork() != 0) _exit(0);
  for (;;) pause();
}

PLANTED_SOLVE {
  const pid_t child = fork();
  if (child == 0) stay();
  waitpid(child, NULL, 0);
  PLANTED_ANSWER(CONEBENCH_STALLED);
}
