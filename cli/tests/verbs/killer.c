/* Runs a program and kills it with all its threads before the N-th system call that changes a file: killer N PROGRAM WORDS. With N 0 it counts them, on standard error. */

#define _GNU_SOURCE
#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/ptrace.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

static int changes(unsigned long long call, const unsigned long long *words)
{
    switch (call) {
#ifdef SYS_open
    case SYS_open:
        return (words[1] & (O_CREAT | O_TRUNC)) != 0;
    case SYS_rename:
    case SYS_unlink:
    case SYS_mkdir:
    case SYS_rmdir:
#endif
    case SYS_renameat:
    case SYS_renameat2:
    case SYS_unlinkat:
    case SYS_mkdirat:
    case SYS_fsync:
    case SYS_fdatasync:
    case SYS_ftruncate:
    case SYS_pwrite64:
    case SYS_copy_file_range:
        return 1;
    case SYS_openat:
        return (words[2] & (O_CREAT | O_TRUNC)) != 0;
    case SYS_write:
        return words[0] > 2;
    default:
        return 0;
    }
}

int main(int argc, char **argv)
{
    if (argc < 3)
        return 100;
    long at = atol(argv[1]), seen = 0;
    pid_t child = fork();
    if (child == 0) {
        if (ptrace(PTRACE_TRACEME, 0, 0, 0) != 0)
            _exit(101);
        raise(SIGSTOP);
        execv(argv[2], argv + 2);
        _exit(102);
    }
    int status = 0;
    waitpid(child, &status, 0);
    if (!WIFSTOPPED(status))
        return 101;
    long options = PTRACE_O_TRACESYSGOOD | PTRACE_O_TRACECLONE | PTRACE_O_TRACEFORK | PTRACE_O_TRACEVFORK | PTRACE_O_TRACEEXEC | PTRACE_O_EXITKILL;
    if (ptrace(PTRACE_SETOPTIONS, child, 0, options) != 0)
        return 101;
    ptrace(PTRACE_SYSCALL, child, 0, 0);
    for (;;) {
        pid_t thread = waitpid(-1, &status, __WALL);
        if (thread < 0)
            return 103;
        if (WIFEXITED(status) || WIFSIGNALED(status)) {
            if (thread != child)
                continue;
            if (at == 0)
                fprintf(stderr, "calls: %ld\n", seen);
            return WIFEXITED(status) ? WEXITSTATUS(status) : 104;
        }
        int signal = WSTOPSIG(status);
        if (signal == (SIGTRAP | 0x80)) {
            struct __ptrace_syscall_info info;
            long size = ptrace(PTRACE_GET_SYSCALL_INFO, thread, sizeof info, &info);
            if (size > 0 && info.op == PTRACE_SYSCALL_INFO_ENTRY && changes(info.entry.nr, (const unsigned long long *)info.entry.args) && ++seen == at) {
                kill(child, SIGKILL);
                while (waitpid(-1, &status, __WALL) > 0) {
                }
                return 99;
            }
            signal = 0;
        } else if (signal == SIGTRAP || signal == SIGSTOP) {
            signal = 0;
        }
        ptrace(PTRACE_SYSCALL, thread, 0, signal);
    }
}
