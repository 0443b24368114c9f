/* Confines POV-Ray's process, because POV-Ray does not enforce its own restrictions on files, and a scene may contain
 * text of the user (`native`) that writes files. Landlock prevents writing outside POV-Ray's private folder; a seccomp
 * filter prevents the use of the network. POV-Ray may read every file that vs may read, because the text may include
 * files.
 *
 * If a model is not trusted, the process of vs itself is confined much further, including reading (cli/confine.c). */
#define _GNU_SOURCE
#include "backends/povray/povray_confine.h"

#ifdef __linux__

#include <fcntl.h>
#include <linux/audit.h>
#include <linux/filter.h>
#include <linux/seccomp.h>
#include <stddef.h>
#include <stdint.h>
#include <sys/prctl.h>
#include <sys/syscall.h>
#include <unistd.h>

/* Landlock's numbers of system calls and rules, which older system headers lack. */
enum { RULESET_CREATE = 444, RULESET_ADD = 445, RULESET_RESTRICT = 446, RULESET_VERSION = 1, RULE_BENEATH = 1 };
enum { WRITE = 1 << 1, REMOVE_AND_MAKE = ((1 << 13) - 1) & ~((1 << 4) - 1), REFER = 1 << 13, TRUNCATE = 1 << 14 };
typedef struct { uint64_t files; } ruleset;
typedef struct __attribute__((packed)) { uint64_t allowed; int32_t parent; } rule;

static void allow(int rules, const char *path, uint64_t what) {
  rule r = { what, open(path, O_PATH | O_CLOEXEC) };
  if (r.parent < 0) return;
  syscall(RULESET_ADD, rules, RULE_BENEATH, &r, 0);
  close(r.parent);
}

static void confine_files(const char *folder) {
  long version = syscall(RULESET_CREATE, NULL, 0, RULESET_VERSION);
  if (version < 1) return;
  ruleset all = { (uint64_t)WRITE | REMOVE_AND_MAKE | (version >= 2 ? REFER : 0) | (version >= 3 ? TRUNCATE : 0) };
  int rules = (int)syscall(RULESET_CREATE, &all, sizeof all, 0);
  if (rules < 0) return;
  allow(rules, folder, all.files);
  allow(rules, "/dev/null", all.files & (WRITE | TRUNCATE));
  syscall(RULESET_RESTRICT, rules, 0);
  close(rules);
}

#if defined(__x86_64__)
#define ARCHITECTURE AUDIT_ARCH_X86_64
#elif defined(__aarch64__)
#define ARCHITECTURE AUDIT_ARCH_AARCH64
#endif

static void confine_network(void) {
#ifdef ARCHITECTURE
  struct sock_filter code[] = {
    BPF_STMT(BPF_LD | BPF_W | BPF_ABS, offsetof(struct seccomp_data, arch)),
    BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, ARCHITECTURE, 1, 0),
    BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_KILL_PROCESS),
    BPF_STMT(BPF_LD | BPF_W | BPF_ABS, offsetof(struct seccomp_data, nr)),
    BPF_JUMP(BPF_JMP | BPF_JGE | BPF_K, 0x40000000, 2, 0), /* a number from 0x40000000 is a system call of the x32
                                                            * interface */
    BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, SYS_socket, 1, 0),
    BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ALLOW),
    BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ERRNO | 1 /* the refused system call returns the error EPERM */),
  };
  struct sock_fprog program = { sizeof code / sizeof *code, code };
  prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, &program);
#endif
}

void vs_povray_confine(const char *folder) {
  if (prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) != 0) return;
  confine_files(folder);
  confine_network();
}

#else
void vs_povray_confine(const char *folder) { (void)folder; }
#endif
