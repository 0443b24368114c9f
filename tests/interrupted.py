#!/usr/bin/env python3
"""interrupted.py VS [COUNT [POINTS]]: measures how long vs still runs after an interrupt, for drawings of COUNT nodes.

The drawings are a chain, a comb, a fan, and single objects that all overlap. vs writes each drawing as .stl, .pov, .scad
and .off, and as .tree with each pass alone. At POINTS (8) evenly spaced points of a run the script sends SIGTERM, and reads the
processor time that vs uses from then on. Other load on the machine changes processor time little; the least of three runs counts.
The system needs time to free the memory, which a run that gets SIGKILL at the same point shows. The limit of 50 ms is
for the time that vs adds. Prints a line for each drawing and output. Ends with 1 if a time exceeds the limit, if vs
leaves an incomplete file, or if vs does not end with 130."""
import os, re, signal, subprocess, sys, tempfile, time

VS = os.path.abspath(sys.argv[1])
COUNT, POINTS = [int(word) for word in sys.argv[2:4]] + [1000000, 8][len(sys.argv) - 2:]
LIMIT, TRIES = .05, 3                 # LIMIT: seconds that vs may add
MOST = min(5, max(.5, COUNT / 2e5))   # seconds of a run in which the points lie
TICK = os.sysconf('SC_CLK_TCK')
PLACE = '(xyz (* 3 (modulo i 1000)) (* 3 (quotient i 1000)) 0)'
LOOP = ('(draw (let loop ([i 1] [o (unite (make-sphere origin 1) (make-box (xyz 0 0 0) (xyz 1 1 1)))])'
        '  (if (>= i %d) o (loop (+ i 1) %s))))')
DRAWINGS = {
    'chain': LOOP % (COUNT, "(do-move o (vxyz 1 0 0))"),
    'comb': LOOP % (COUNT // 3, "((if (odd? i) subtract unite) (do-rotate o 'z i) (make-sphere %s 1))" % PLACE),
    'fan': '(draw (unite (for/list ([i %d]) (make-sphere %s 1))))' % (COUNT, PLACE),
    'objects': '(for ([i %d]) (draw (do-rotate (make-box (xyz 0 0 0) (xyz 1 1 1)) \'z i)))' % COUNT,
}


def passes():
    with open(os.path.join(os.path.dirname(os.path.abspath(__file__)), '..', 'passes', 'passes.def')) as rows:
        return re.findall(r'^VS_PASS\(\w+, (\w+)', rows.read(), re.M)


def used(process):
    """Returns the user and the system time of the process so far, in seconds, or None after its end."""
    try:
        with open('/proc/%d/stat' % process.pid) as f: fields = f.read().rsplit(')', 1)[1].split()
    except OSError: return None
    return None if fields[0] == 'Z' else (int(fields[11]) / TICK, int(fields[12]) / TICK)


def start(program, options, folder):
    return subprocess.Popen([VS, '-q', '-e', program] + options, cwd=folder, stdout=subprocess.DEVNULL,
                            stderr=subprocess.DEVNULL)


def run_until(process, seconds):
    """Waits until the process has used so many seconds. Returns its times then, or None if it has ended before."""
    while (now := used(process)) is not None:
        if sum(now) >= seconds: return now
        time.sleep(.001)
    return None


def end(process, signal_number=None):
    if signal_number: process.send_signal(signal_number)
    _, status, usage = os.wait4(process.pid, 0)
    process.returncode = os.waitstatus_to_exitcode(status)
    return process.returncode, usage.ru_utime, usage.ru_stime


def outputs(folder):
    """Removes the files of the folder. Returns their bytes by name."""
    found = {}
    for name in os.listdir(folder):
        with open(os.path.join(folder, name), 'rb') as f: found[name] = f.read()
        os.unlink(os.path.join(folder, name))
    return found


def whole(program, options, folder):
    process = start(program, options, folder)
    now = run_until(process, MOST)
    _, user, system = end(process, signal.SIGKILL if now else None)
    return (MOST if now else user + system), outputs(folder)


def after(program, options, folder, at, signal_number):
    """Returns the exit code, and the user and system time after the signal; None if the run ended before."""
    process = start(program, options, folder)
    now = run_until(process, at)
    if now is None: return end(process) and None
    code, user, system = end(process, signal_number)
    return code, max(user - now[0], 0), max(system - now[1], 0)


def measure(name, program, options, folder):
    seconds, right = whole(program, options, folder)
    added, faults = [], []
    for i in range(POINTS):
        at, least = max(.02, seconds * (i + .5) / POINTS), None
        for _ in range(TRIES):
            ended = after(program, options, folder, at, signal.SIGTERM)
            if not ended or ended[0] == 0: break  # the output was whole
            code, user, system = ended
            left = outputs(folder)
            if code != 130 or left and left != right:
                faults.append('at %.2f s: ended with %d, leaving %s' % (at, code, list(left) or 'nothing'))
            killed = after(program, options, folder, at, signal.SIGKILL) if user + system > LIMIT else None
            took = user + max(system - killed[2] if killed else system, 0)
            least = took if least is None else min(least, took)
            if took <= LIMIT: break
        outputs(folder)
        if least is not None: added.append(least)
    worst, median = max(added, default=0), sorted(added)[len(added) // 2] if added else 0
    print('%-8s %-19s %5.2f s; after an interrupt median %3.0f ms, worst %3.0f ms' %
          (name, ' '.join(options), seconds, 1e3 * median, 1e3 * worst), flush=True)
    if worst > LIMIT: faults.append('%.0f ms after an interrupt, more than %.0f' % (1e3 * worst, 1e3 * LIMIT))
    for fault in faults: print('    WRONG: %s' % fault)
    return not faults


with tempfile.TemporaryDirectory() as folder:
    kinds = [['-o', 'o' + ending] for ending in ('.stl', '.pov', '.scad', '.off')] + [['-O' + name, '-o', 'o.tree'] for name in passes()]
    held = [measure(name, program, options, folder) for name, program in DRAWINGS.items() for options in kinds]
sys.exit(0 if all(held) else 1)
