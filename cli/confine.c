/* Confines the process of an untrusted model, and its external programs: Landlock restricts the use of files, a seccomp
 * filter all other system calls.
 *
 * This is the second protection. The first is that the library opens no file itself for an untrusted model, and that
 * untrusted.c reads only files below the model's folder. The confinement holds even if an attacker takes control of a
 * library that decodes a picture or a font. */
#define _GNU_SOURCE
#include "cli/confine.h"

#ifdef __linux__

#include <fcntl.h>
#include <linux/audit.h>
#include <linux/filter.h>
#include <linux/seccomp.h>
#include <stddef.h>
#include <stdint.h>
#include <sys/prctl.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

/* ---- access to files ---- */

/* Constants of Landlock, which older system headers lack. */
enum { RULESET_CREATE = 444, RULESET_ADD = 445, RULESET_RESTRICT = 446, RULESET_VERSION = 1, RULE_BENEATH = 1 };
enum {
  FS_EXECUTE = 1 << 0,
  FS_WRITE = 1 << 1,
  FS_READ = 1 << 2,
  FS_READ_FOLDER = 1 << 3,
  FS_REMOVE_FOLDER = 1 << 4,
  FS_REMOVE = 1 << 5,
  FS_MAKE_FOLDER = 1 << 7,
  FS_MAKE = 1 << 8,
  FS_ALL_1 = (1 << 13) - 1,
  FS_REFER = 1 << 13 /* access right that Landlock knows from version 2 */,
  FS_TRUNCATE = 1 << 14 /* access right that Landlock knows from version 3 */,
  NET_ALL = 3 /* network rights that Landlock knows from version 4: bind and connect */
};
typedef struct { uint64_t files, net; } ruleset;
typedef struct __attribute__((packed)) { uint64_t allowed; int32_t parent; } rule;

static void allow(int rules, const char *path, uint64_t what, uint64_t handled) {
  struct stat info;
  rule r = { what & handled, open(path, O_PATH | O_CLOEXEC) };
  if (r.parent < 0) return; /* a file that does not exist needs no rule */
  if (fstat(r.parent, &info) == 0 && !S_ISDIR(info.st_mode)) r.allowed &= FS_EXECUTE | FS_WRITE | FS_READ | FS_TRUNCATE;
  syscall(RULESET_ADD, rules, RULE_BENEATH, &r, 0);
  close(r.parent);
}

static bool confine_files(const char *model, const char *const *written, size_t count, const char *scratch) {
  static const char *const system[] = {
    "/usr", "/lib", "/lib64", "/bin", "/etc/ld.so.cache", "/etc/localtime", "/sys/devices/system/cpu"
  };
  long version = syscall(RULESET_CREATE, NULL, 0, RULESET_VERSION);
  if (version < 1) return false;
  ruleset all = { FS_ALL_1 | (version >= 2 ? FS_REFER : 0) | (version >= 3 ? FS_TRUNCATE : 0),
                  version >= 4 ? NET_ALL : 0 };
  int rules = (int)syscall(RULESET_CREATE, &all, version >= 4 ? sizeof all : sizeof all.files, 0);
  if (rules < 0) return false;
  for (size_t i = 0; i < sizeof system / sizeof *system; i++)
    allow(rules, system[i], FS_EXECUTE | FS_READ | FS_READ_FOLDER, all.files);
  allow(rules, "/dev/null", FS_READ | FS_WRITE | FS_TRUNCATE, all.files);
  allow(rules, "/dev/urandom", FS_READ, all.files);
  allow(rules, model, FS_READ | FS_READ_FOLDER, all.files);
  const uint64_t making = FS_READ | FS_WRITE | FS_MAKE | FS_REMOVE | FS_TRUNCATE | FS_REFER;
  for (size_t i = 0; i < count; i++) allow(rules, written[i], making, all.files);
  if (scratch) allow(rules, scratch, making | FS_MAKE_FOLDER | FS_REMOVE_FOLDER | FS_READ_FOLDER, all.files);
  bool ok = syscall(RULESET_RESTRICT, rules, 0) == 0;
  close(rules);
  return ok;
}

/* ---- other system calls ---- */

#if defined(__x86_64__)
#define ARCHITECTURE AUDIT_ARCH_X86_64
#elif defined(__aarch64__)
#define ARCHITECTURE AUDIT_ARCH_AARCH64
#endif

static void confine_calls(void) {
#ifdef ARCHITECTURE
  static const unsigned short refused[] = {
    SYS_socket,
    SYS_socketpair,
    SYS_connect,
    SYS_bind,
    SYS_listen,
    SYS_ptrace,
    SYS_process_vm_readv,
    SYS_process_vm_writev,
    SYS_mount,
    SYS_umount2,
    SYS_pivot_root,
    SYS_chroot,
    SYS_setns,
    SYS_unshare,
    SYS_keyctl,
    SYS_add_key,
    SYS_request_key,
    SYS_bpf,
    SYS_perf_event_open,
    SYS_userfaultfd,
    SYS_init_module,
    SYS_finit_module,
    SYS_kexec_load,
    SYS_reboot,
    SYS_swapon,
    425 /* number of io_uring_setup */,
    428 /* number of open_tree */,
    429 /* number of move_mount */,
    430 /* number of fsopen */,
  };
  enum { REFUSED = sizeof refused / sizeof *refused };
  struct sock_filter code[REFUSED + 7];
  unsigned short n = 0;
  code[n++] = (struct sock_filter)BPF_STMT(BPF_LD | BPF_W | BPF_ABS, offsetof(struct seccomp_data, arch));
  code[n++] = (struct sock_filter)BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, ARCHITECTURE, 1, 0);
  code[n++] = (struct sock_filter)BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_KILL_PROCESS);
  code[n++] = (struct sock_filter)BPF_STMT(BPF_LD | BPF_W | BPF_ABS, offsetof(struct seccomp_data, nr));
  /* Refuses all system calls of the x32 ABI, whose numbers begin at 0x40000000. */
  code[n++] = (struct sock_filter)BPF_JUMP(BPF_JMP | BPF_JGE | BPF_K, 0x40000000, REFUSED + 1, 0);
  for (unsigned char i = 0; i < REFUSED; i++)
    code[n++] = (struct sock_filter)BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, refused[i], (unsigned char)(REFUSED - i), 0);
  code[n++] = (struct sock_filter)BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ALLOW);
  code[n++] = (struct sock_filter)BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ERRNO | 1 /* a refused system call fails with
                                                                                   * the error EPERM */);
  struct sock_fprog program = { n, code };
  prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, &program);
#endif
}

bool cli_confine(const char *model, const char *const *written, size_t count, const char *scratch) {
  if (prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) != 0) return false;
  bool files = confine_files(model, written, count, scratch);
  confine_calls();
  return files;
}

#else
bool cli_confine(const char *model, const char *const *written, size_t count, const char *scratch) {
  return (void)model, (void)written, (void)count, (void)scratch, false;
}
#endif
