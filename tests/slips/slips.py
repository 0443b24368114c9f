"""Owns the run of the slips: programs with one mistake each (*.txt), and classes of slips that the tables of the
language give. Each must be answered with its place, its cause and what to write.

    slips.py VS WORK ONLY          prints ok/not ok lines, as every suite
    SCORE=1 slips.py VS WORK ONLY  also prints the number of slips that are answered, for each file

open.txt names the slips that are not answered yet; a slip of open.txt that is answered is a failure, too.

A row of a file:

    ## title                    one line
    @args -o a.dwg              arguments for vs after the program; default: -o out.off
    @file NAME text             a file beside the program
    @bytes                      the program's \\xHH are bytes
    @prompt                     the lines are typed at the prompt
    program                     one or more lines
    => LINE:COLUMN :: cause :: cure [:: check]

LINE:COLUMN is the place in the message; a line alone, or `-` for a message without a place. Cause and cure are regular
expressions that the message contains. `check`: vs check reports the slip at the same line with the same cure."""

import concurrent.futures
import os
import re
import subprocess
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import classes  # noqa: E402

VS, WORK, ONLY = sys.argv[1:4]
HERE = os.path.dirname(os.path.abspath(__file__))
SOURCES = os.path.dirname(os.path.dirname(HERE))
SCORE = bool(os.environ.get("SCORE"))


class Slip:
    def __init__(self, name, title):
        self.name, self.title = name, title
        self.args, self.files, self.bytes, self.prompt = ["-o", "out.off"], {}, False, False
        self.text, self.place, self.cause, self.cure, self.check = [], "-", "", "", False


def read_rows(path):
    base = os.path.splitext(os.path.basename(path))[0]
    rows, slip = [], None
    with open(path, encoding="utf-8") as file:
        for line in file.read().splitlines():
            if line.startswith("## "):
                slip = Slip(base, line[3:])
            elif line.startswith("@args "):
                slip.args = line[6:].split()
            elif line.startswith("@file "):
                _, name, text = line.split(" ", 2)
                slip.files[name] = text + "\n"
            elif line == "@bytes":
                slip.bytes = True
            elif line == "@prompt":
                slip.prompt = True
            elif line.startswith("=> "):
                parts = line[3:].split(" :: ")
                slip.place, slip.cause, slip.cure = parts[0], parts[1], parts[2]
                slip.check = parts[3:] == ["check"]
                rows.append(slip)
            else:
                slip.text.append(line)
    return rows


def run(arguments, folder, text=""):
    done = subprocess.run([VS] + arguments, cwd=folder, input=text.encode(), stdout=subprocess.PIPE,
                          stderr=subprocess.STDOUT, timeout=60)
    said = done.stdout.decode("utf-8", "replace")
    return "\n".join(line for line in said.splitlines() if not re.match(r" *[0-9]* \|", line))


def problems(said, slip, program, by_check=False):
    """Returns the parts that the answer lacks."""
    lacks = []
    if slip.place != "-":
        places = slip.place.split("|")
        if by_check:
            places = [place.split(":")[0] + ":" for place in places]
        else:
            places = [place + ":" for place in places]
        if not any(f"{program}:{place}" in said for place in places):
            lacks.append("place")
    if not re.search(slip.cause, said, re.S):
        lacks.append("cause")
    if not re.search(slip.cure, said, re.S):
        lacks.append("cure")
    return lacks


def answer(job):
    number, slip = job
    folder = os.path.join(WORK, f"slip{number}")
    os.mkdir(folder)
    for name, text in slip.files.items():
        with open(os.path.join(folder, name), "w", encoding="utf-8") as file:
            file.write(text)
    text = "\n".join(slip.text) + "\n"
    if slip.prompt:
        return problems(run([], folder, text), slip, "prompt"), "", []
    data = text.encode()
    if slip.bytes:
        data = re.sub(rb"\\x([0-9a-f]{2})", lambda m: bytes([int(m.group(1), 16)]), data)
    with open(os.path.join(folder, "slip.vs"), "wb") as file:
        file.write(data)
    said = run(["-q", "slip.vs"] + slip.args, folder)
    lacks, found, missed = problems(said, slip, "slip.vs"), "", []
    if slip.check:
        found = run(["check", "slip.vs"], folder)
        if "cure" in problems(found, slip, "slip.vs", True) or "place" in problems(found, slip, "slip.vs", True):
            missed = ["check"]
    return lacks + missed, said, found


def messages_by_line(said, program):
    """Returns the messages at each line of the program, joined."""
    found = {}
    for match in re.finditer(rf"{re.escape(program)}:(\d+):\d+: (.*)", said):
        found.setdefault(int(match.group(1)), []).append(match.group(2))
    return {line: "\n".join(texts) for line, texts in found.items()}


def run_class(name, make, checked):
    """Runs a class; returns the number of slips, of answered ones, and of those that vs check finds."""
    rows = list(make(SOURCES))
    folder = os.path.join(WORK, re.sub(r"\W", "-", name))
    os.mkdir(folder)
    text = "\n".join(line for line, _ in rows) + "\n"
    answers = messages_by_line(run([], folder, text), "prompt")
    found = {}
    part = 200  # vs check calls at most 3000 procedures with constants
    for start in range(0, len(rows) if checked else 0, part):
        with open(os.path.join(folder, "class.vs"), "w", encoding="utf-8") as file:
            file.write("\n".join(line for line, _ in rows[start:start + part]) + "\n")
        for line, said in messages_by_line(run(["check", "class.vs"], folder), "class.vs").items():
            found[start + line] = said
    answered = checks = 0
    bad = []
    for number, (line, wanted) in enumerate(rows, 1):
        said = answers.get(number, "")
        ok = not said and not checked or bool(re.search(wanted, said))
        seen = not checked or bool(re.search(wanted, found.get(number, "")))
        # arguments whose kinds fit in both orders are no error
        if checked and not said and not found.get(number):
            ok = seen = True
        answered += ok
        checks += seen
        if not ok or not seen:
            bad.append((line, said, found.get(number, "")))
    print(f"{'not ok' if bad else 'ok'} slips/{name}: {len(rows)} slips")
    for line, said, check in bad[:40]:
        print(f"    {line}\n      vs: {said}\n      vs check: {check}")
    return len(rows), answered, checks


def run_endings():
    """Endings of other programs' files (cli/endings.def), and slips in those of backends.def: the answer writes the
    name with the ending here, or the near one."""
    folder = os.path.join(WORK, "endings")
    os.mkdir(folder)
    with open(os.path.join(folder, "model.vs"), "w", encoding="utf-8") as file:
        file.write("(draw (make-box origin 1 1 1))\n")
    with open(os.path.join(SOURCES, "cli/endings.def"), encoding="utf-8") as file:
        rows = re.findall(r'^ENDING\("([^"]+)",\s*"([^"]+)"', file.read(), re.M)
    wanted = [(ending, f"write -o out.{here}, ") for endings, here in rows for ending in endings.split()]
    wanted += [(here[0] + here[2] + here[1] + here[3:], f"perhaps .{here};") for here in ("stl", "obj", "png", "html", "scad")]
    bad = []
    for ending, text in wanted:
        said = run(["-q", "model.vs", "-o", f"out.{ending}"], folder)
        if text not in said:
            bad.append(f"    out.{ending}: {said}")
    print(f"{'not ok' if bad else 'ok'} slips/endings of files: {len(wanted)} slips", *bad, sep="\n")
    return [len(wanted), len(wanted) - len(bad), 0, 0]


def main():
    sources = sorted(f for f in os.listdir(HERE) if f.endswith(".txt") and f != "open.txt")
    slips = [slip for f in sources for slip in read_rows(os.path.join(HERE, f))]
    slips = [s for s in slips if ONLY in ("", "slips") or ONLY in f"slips/{s.name}: {s.title}"]
    with open(os.path.join(HERE, "open.txt"), encoding="utf-8") as file:
        still_open = set(file.read().splitlines())
    score = {}
    with concurrent.futures.ThreadPoolExecutor(int(os.environ.get("JOBS") or 2)) as pool:
        for slip, (lacks, said, found) in zip(slips, pool.map(answer, enumerate(slips))):
            counts = score.setdefault(slip.name, [0, 0, 0, 0])
            counts[0] += 1
            counts[1] += not [l for l in lacks if l != "check"]
            counts[2] += slip.check
            counts[3] += slip.check and "check" not in lacks
            name = f"{slip.name}: {slip.title}"
            known = name in still_open
            if not lacks and not known:
                print(f"ok slips/{name}")
                continue
            if known and lacks and not SCORE:
                print(f"ok slips/{name} (open)")
                continue
            print(f"not ok slips/{name}: " + (f"no {', '.join(lacks)}" if lacks else "is answered: open.txt names it"))
            for line in slip.text:
                print(f"    {line}")
            for line in said.splitlines()[:8]:
                print(f"    vs: {line}")
            for line in str(found or "").splitlines()[:4]:
                print(f"    vs check: {line}")
    for name, (make, checked) in classes.CLASSES.items():
        if ONLY in ("", "slips") or ONLY in f"slips/{name}":
            rows, answered, checks = run_class(name, make, checked)
            score[name] = [rows, answered, rows if checked else 0, checks if checked else 0]
    if ONLY in ("", "slips") or ONLY in "slips/endings of files":
        score["endings of files"] = run_endings()
    if SCORE:
        for name, (rows, answered, checks, found) in score.items():
            print(f"    {name}: {answered} of {rows} answered, vs check finds {found} of {checks}")
        total = [sum(c[i] for c in score.values()) for i in range(4)]
        print(f"    all: {total[1]} of {total[0]} answered, vs check finds {total[3]} of {total[2]}")


main()
